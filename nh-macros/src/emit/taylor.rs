//! The Taylor coefficients of solutions, order by order.
//!
//! Order 0 is the program of the derivative; a loop computes the further ones by the recurrences of
//! its values. The code is as long as twice the program, whatever the order.

mod orders;

use std::collections::BTreeSet;

use nonholonomic_core::id::SymbolId;
use nonholonomic_core::model::Request;
use nonholonomic_core::program::{Program, Recurrences, Rule, Step, Value, Variation};
use nonholonomic_core::system::System;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use self::orders::Writer;
use super::inherent_method::{Part, drops};
use super::layout::local;
use super::program::{Body, body};
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The inherent method `taylor` and `impl TaylorSeries for Sleigh`, if they are asked for.
///
/// The coefficients of corrections of rounding errors are zero: the program is the one without them.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System, derivative: &Program) -> Part {
    let model = &system.model;
    if !model.requests.iter().any(|(request, _)| *request == Request::Taylor) {
        return Part::default();
    }
    let state = system.state();
    let plain = context.lowering.without_corrections(model, &system.derivative, derivative);
    let recurrences = Recurrences::of(&plain, |symbol| {
        if symbol == model.time {
            Variation::Time
        } else if state.contains(&symbol) {
            Variation::Variable
        } else {
            Variation::Constant
        }
    });
    let Context { runtime, scalar, .. } = context;
    let [products, squares] =
        [recurrences.products.len(), recurrences.squares.len()].map(Literal::usize_unsuffixed);
    let terms = terms(context);
    let workspace = quote!(#runtime::History<#scalar, #products, #squares, #terms>);
    let body = expansion(context, scope, &recurrences, &state);
    let items = implementation(context, &workspace, &body);
    Part { methods: method(context), items, programs: Vec::new() }
}

/// The same items with nothing to do.
pub(super) fn stub(context: &Context) -> Part {
    let drops = drops(context, &BTreeSet::new(), true);
    let [unit, series, workspace] = ["unit", "series", "workspace"].map(local);
    let body = quote!(#drops _ = (#unit, #series, #workspace););
    Part {
        methods: method(context),
        items: implementation(context, &quote!(()), &body),
        programs: Vec::new(),
    }
}

/// The name of the constant parameter, unlike those of the scalar and of the types beside it, which it would hide.
fn terms(context: &Context) -> Ident {
    let types = [&context.layout.name, &context.layout.types.state, &context.layout.types.input];
    let is_taken = |name: &str| types.into_iter().chain(context.parameter()).any(|taken| taken == name);
    let names = ["P", "TERMS", "COUNT", "NUMBER", "LENGTH"];
    let free = names.into_iter().find(|name| !is_taken(name)).unwrap_or("P");
    Ident::new(free, Span::call_site())
}

/// The inherent method.
fn method(context: &Context) -> TokenStream {
    let Context { runtime, visibility, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type, terms) =
        (context.type_of(&context.state), context.input_type(), terms(context));
    quote! {
        /// The first Taylor coefficients of the solution through a state, with a constant input:
        /// x(t + τ) = Σ x_k τᵏ.
        #[must_use]
        #[inline]
        #visibility fn taylor<const #terms: ::core::primitive::usize>(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type
        ) -> [#state_type; #terms] {
            #runtime::TaylorSeries::taylor::<#terms>(self, #t, #state, #input)
        }
    }
}

/// `impl TaylorSeries for Sleigh`.
fn implementation(context: &Context, workspace_type: &TokenStream, body: &TokenStream) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let [unit, series, workspace] = ["unit", "series", "workspace"].map(local);
    let (state_type, input_type, terms) =
        (context.type_of(&context.state), context.input_type(), terms(context));
    let body = quote! {
        type Workspace<const #terms: ::core::primitive::usize> = #workspace_type;
        fn expand<const #terms: ::core::primitive::usize>(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type, #unit: #scalar,
            #series: &mut [#state_type], #workspace: &mut Self::Workspace<#terms>,
        ) {
            #body
        }
    };
    context.implement(&quote!(#runtime::TaylorSeries), &body)
}

/// The body of `expand`: order 0, then a loop over the orders.
fn expansion(context: &Context, scope: &Scope, recurrences: &Recurrences, state: &[SymbolId]) -> TokenStream {
    let seeds = seeds(recurrences);
    let mut start = recurrences.start.clone();
    // what is listed twice has a name
    start.outputs.extend(seeds.iter().chain(&seeds));
    let Body { statements, outputs, used, names } = body(context, scope, &start);
    let (rates, values) = outputs.split_at(recurrences.start.outputs.len());
    let mut writer = Writer::new(context, scope, recurrences, names);
    writer.values = seeds.iter().copied().zip(values.iter().cloned()).collect();
    let places = context.state.places(&writer.own.series_k);
    writer.places = state.iter().copied().zip(places).collect();
    for (value, rule) in recurrences.rules.iter_ids() {
        writer.rule(value, rule);
    }
    let drops = drops(context, &with_state(used), true);
    let orders = writer.orders(rates);
    quote!(#drops #statements #orders)
}

/// The state is always read: it is the coefficient of order 0.
fn with_state(mut used: BTreeSet<Argument>) -> BTreeSet<Argument> {
    used.insert(Argument::State);
    used
}

/// The values whose coefficients of order 0 the rules name.
fn seeds(recurrences: &Recurrences) -> Vec<Value> {
    let mut seeds = BTreeSet::new();
    for (value, rule) in recurrences.rules.iter_ids() {
        match rule {
            Rule::Scaled(_, constant) => _ = seeds.insert(*constant),
            Rule::Product(a, b, _) => seeds.extend([a, b]),
            Rule::Square(a, _) => _ = seeds.insert(*a),
            Rule::Quotient { over, .. } | Rule::Power { over, .. } => seeds.extend([value, *over]),
            Rule::Root { over, .. } | Rule::IntegralOver { over, .. } => _ = seeds.insert(*over),
            Rule::Integral { rate, .. } => _ = seeds.insert(*rate),
            Rule::Angle { y, x, over, .. } => seeds.extend([y, x, over]),
            Rule::System { varying } => {
                if let Step::Solve { matrix, .. } = &recurrences.start.steps[value] {
                    seeds.extend(matrix.iter().flatten());
                }
                seeds.extend(varying.iter().flatten().map(|(_, unknown, _)| *unknown));
            }
            Rule::Constant
            | Rule::Seed
            | Rule::Variable(_)
            | Rule::Time
            | Rule::Same(_)
            | Rule::Negative(_)
            | Rule::Sum(..)
            | Rule::Difference(..)
            | Rule::Unknown => {}
        }
    }
    seeds.into_iter().collect()
}

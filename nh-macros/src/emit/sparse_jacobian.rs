//! The Jacobian of the derivative without its zeros, alone and with the derivative: a pattern that the compiler knows, and
//! the values in one array.

use std::collections::BTreeSet;

use nonholonomic_core::model::Request;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Head, Part};
use super::layout::local;
use super::program::{body, body_in_place};
use super::setting::Context;
use super::symbols::Scope;

/// The pattern and the methods, if they are asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let is_asked = system.model.requests.iter().any(|(request, _)| *request == Request::SparseJacobian);
    let (Some(linearized), Some(jacobian), true) = (&system.linearized, system.jacobian(), is_asked) else {
        return Part::default();
    };
    let inputs = context.input.as_ref().map_or(0, super::record::Record::len);
    let width = (context.state.len() + inputs).max(1);
    let graph = &system.model.graph;
    let entries = jacobian.outputs.iter().enumerate().filter(|(_, entry)| !graph.is_literal_zero(**entry));
    let mut entries: Vec<(usize, usize, _)> =
        entries.map(|(place, entry)| (place % width, place / width, *entry)).collect();
    entries.sort_by_key(|(column, row, _)| (*column, *row));
    let pattern: Vec<[usize; 2]> = entries.iter().map(|(column, row, _)| [*row, *column]).collect();
    let values: Vec<_> = entries.into_iter().map(|(.., entry)| entry).collect();
    // 1. alone
    let mut methods = constants(context, &pattern);
    let alone = context.derivative(system, "sparse_jacobian", &jacobian.with_outputs(values.clone()));
    let of_alone = body(context, scope, &alone);
    let (statements, entries) = (&of_alone.statements, array(&of_alone.outputs));
    let code = quote!(#statements #entries);
    methods.extend(head(context, pattern.len()).with_body(context, &of_alone.used, &code));
    // 2. with the derivative
    let rates = linearized.outputs.iter().copied().take(context.state.len());
    let outputs: Vec<_> = rates.chain(values).collect();
    let together = context.derivative(system, "sparse_linearized", &linearized.with_outputs(outputs));
    let all = local("all");
    let entries = (0..pattern.len()).map(Literal::usize_unsuffixed).map(|place| quote!(#all.1[#place]));
    let places: Vec<_> = context.state.places(&quote!(#all.0)).into_iter().chain(entries).collect();
    let of_both = body_in_place(context, scope, &together, &places);
    let (rates, entries) = of_both.outputs.split_at(context.state.len().min(of_both.outputs.len()));
    let rates = context.state.construct(&context.state_name(), rates);
    let (statements, entries) = (&of_both.statements, array(entries));
    let code = quote!(let mut #all = (#rates, #entries); #statements #all);
    methods.extend(head_of_both(context, pattern.len()).with_body(context, &of_both.used, &code));
    Part {
        methods,
        programs: vec![("sparse_jacobian", alone), ("sparse_linearized", together)],
        ..Part::default()
    }
}

/// Entries in one array.
fn array(entries: &[TokenStream]) -> TokenStream {
    let entries = entries.iter().map(element);
    quote!([#(#entries),*])
}

/// The same without entries.
pub(super) fn stub(context: &Context) -> Part {
    let (runtime, scalar, used) = (&context.runtime, &context.scalar, BTreeSet::new());
    let zeros = vec![quote!(<#scalar as #runtime::Scalar>::ZERO); context.state.len()];
    let rates = context.state.construct(&context.state_name(), &zeros);
    let mut methods = constants(context, &[]);
    methods.extend(head(context, 0).with_body(context, &used, &quote!([])));
    methods.extend(head_of_both(context, 0).with_body(context, &used, &quote!((#rates, []))));
    Part { methods, ..Part::default() }
}

fn head(context: &Context, count: usize) -> Head {
    let scalar = &context.scalar;
    let count = Literal::usize_unsuffixed(count);
    Head {
        name: "sparse_jacobian",
        doc: &[
            " The entries of the Jacobian of the derivative that are not always zero, column by column: those in",
            " the rows `JACOBIAN_ROWS` and the columns `JACOBIAN_COLUMNS`.",
        ],
        takes_input: true,
        returns: quote!([#scalar; #count]),
    }
}

fn head_of_both(context: &Context, count: usize) -> Head {
    let (scalar, state) = (&context.scalar, context.type_of(&context.state));
    let count = Literal::usize_unsuffixed(count);
    Head {
        name: "sparse_linearized",
        doc: &[" The derivative together with the entries of `sparse_jacobian`."],
        takes_input: true,
        returns: quote!((#state, [#scalar; #count])),
    }
}

/// Where the entries stand.
fn constants(context: &Context, pattern: &[[usize; 2]]) -> TokenStream {
    let (visibility, count) = (&context.visibility, Literal::usize_unsuffixed(pattern.len()));
    let [rows, columns] = [0, 1].map(|side| {
        let places = pattern.iter().map(move |place| Literal::usize_unsuffixed(place[side]));
        quote!([#(#places),*])
    });
    quote! {
        /// The row of each entry of `sparse_jacobian`: a component of the derivative.
        #visibility const JACOBIAN_ROWS: [::core::primitive::usize; #count] = #rows;
        /// The column of each entry of `sparse_jacobian`, ascending: a variable of the state, or behind these an
        /// input.
        #visibility const JACOBIAN_COLUMNS: [::core::primitive::usize; #count] = #columns;
    }
}

//! The Jacobian of the derivative, by the state and by the inputs.

use std::collections::BTreeSet;
use std::ops::Range;

use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::Request;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Head, Part, drops};
use super::layout::local;
use super::program::{Body, body, body_in_place};
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The inherent method `jacobian` and `impl Jacobian for Sleigh`, if they are asked for.
///
/// The method computes both matrices in one program. The trait has a program of its own for each
/// of them, so that an implicit integrator does not pay for the other, and one for the derivative with both; without
/// inputs there is only one matrix, and the method forwards to it.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let is_asked = system.model.requests.iter().any(|(request, _)| *request == Request::Jacobian);
    let (Some(linearized), Some(jacobian), true) = (&system.linearized, system.jacobian(), is_asked) else {
        return Part::default();
    };
    let (n, m) = sizes(context);
    let mut all = together(context, scope, &context.derivative(system, "linearized", linearized));
    all.extend(dependence(context, system, &jacobian));
    all.extend(super::slopes_of_return::method(context, system));
    let within = |columns: Range<usize>| {
        let row = |row: &[_]| row.get(columns.clone()).unwrap_or_default().to_vec();
        let outputs = jacobian.outputs.chunks((n + m).max(1)).flat_map(row).collect();
        context.derivative(system, "jacobian", &jacobian.with_outputs(outputs))
    };
    let by_state = within(0..n);
    let state_body = body(context, scope, &by_state);
    let of_state = trait_body(context, &state_body, n);
    if m == 0 {
        let methods = forwarded(context);
        let of_input = by_input_of_none(context);
        let items = implementation(context, &of_state, &of_input, &all);
        return Part { methods, items, programs: vec![("jacobian", by_state)] };
    }
    let (by_input, whole) = (within(n..n + m), within(0..n + m));
    let input_body = body(context, scope, &by_input);
    let of_input = trait_body(context, &input_body, m);
    let body = body(context, scope, &whole);
    let entries = |columns: Range<usize>| -> Vec<TokenStream> {
        let column = |column: usize| {
            let column = body.outputs.iter().skip(column).step_by(n + m).map(element);
            quote!([#(#column),*])
        };
        columns.map(column).collect()
    };
    let (statements, a, b) = (&body.statements, entries(0..n), entries(n..n + m));
    let a = from_columns(context, n, &quote!([#(#a),*]));
    let b = from_columns(context, m, &quote!([#(#b),*]));
    let both = quote!(#statements (#a, #b));
    let items = implementation(context, &of_state, &of_input, &all);
    Part {
        methods: head(context).with_body(context, &body.used, &both),
        items,
        programs: vec![("jacobian", whole), ("state_jacobian", by_state), ("input_jacobian", by_input)],
    }
}

/// The same items with zeros for all entries.
pub(super) fn stub(context: &Context) -> Part {
    let runtime = &context.runtime;
    let scalar = &context.scalar;
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let (n, m) = sizes(context);
    let rows = |columns: usize| {
        let (rows, columns) = (Literal::usize_unsuffixed(n), Literal::usize_unsuffixed(columns));
        let drops = drops(context, &BTreeSet::new(), true);
        quote!(#drops [[#zero; #columns]; #rows])
    };
    let [a, b] = [n, m].map(|count| {
        let (rows, columns) = (Literal::usize_unsuffixed(n), Literal::usize_unsuffixed(count));
        from_columns(context, count, &quote!([[#zero; #rows]; #columns]))
    });
    Part {
        methods: head(context).with_body(context, &BTreeSet::new(), &quote!((#a, #b))),
        items: implementation(context, &rows(n), &rows(m), &TokenStream::new()),
        programs: Vec::new(),
    }
}

/// The numbers of state variables and of inputs.
fn sizes(context: &Context) -> (usize, usize) {
    (context.state.len(), context.input.as_ref().map_or(0, super::record::Record::len))
}

/// A matrix with a row for each state variable, from the array of its columns.
fn from_columns(context: &Context, count: usize, columns: &TokenStream) -> TokenStream {
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let rows = Literal::usize_unsuffixed(sizes(context).0);
    let count = Literal::usize_unsuffixed(count);
    quote! {
        <#runtime::nalgebra::SMatrix<#scalar, #rows, #count> as
            ::core::convert::From<[[#scalar; #rows]; #count]>>::from(#columns)
    }
}

/// The head of `jacobian`.
fn head(context: &Context) -> Head {
    let (n, m) = sizes(context);
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let [a, b] = [n, m].map(|columns| {
        let (rows, columns) = (Literal::usize_unsuffixed(n), Literal::usize_unsuffixed(columns));
        quote!(#runtime::nalgebra::SMatrix<#scalar, #rows, #columns>)
    });
    Head {
        name: "jacobian",
        doc: &[
            " The Jacobian of the derivative by the state, and by the inputs: entry (i, j) of the first matrix",
            " is the derivative of component i of ẋ by component j of the state.",
        ],
        takes_input: true,
        returns: quote!((#a, #b)),
    }
}

/// `jacobian` without inputs: the matrix of the trait, and one without columns.
fn forwarded(context: &Context) -> TokenStream {
    let runtime = &context.runtime;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let rows = local("rows");
    let (n, _) = sizes(context);
    // the compiler sees through the transposition
    let by_state = from_columns(context, n, &quote!(#rows));
    let by_input = from_columns(context, 0, &quote!([]));
    let both = quote! {
        let #rows = #runtime::Jacobian::state_jacobian(self, #t, #state, #input);
        (#by_state.transpose(), #by_input)
    };
    let used = [Argument::This, Argument::Time, Argument::State, Argument::Input].into();
    head(context).with_body(context, &used, &both)
}

/// The body of a method of the trait: statements, and the rows of the matrix.
fn trait_body(context: &Context, body: &Body, columns: usize) -> TokenStream {
    let drops = drops(context, &body.used, true);
    let statements = &body.statements;
    let rows = body.outputs.chunks(columns.max(1)).map(|row| {
        let row = row.iter().map(element);
        quote!([#(#row),*])
    });
    quote!(#drops #statements [#(#rows),*])
}

/// The rows of a matrix without columns.
fn by_input_of_none(context: &Context) -> TokenStream {
    let drops = drops(context, &BTreeSet::new(), true);
    let rows = Literal::usize_unsuffixed(sizes(context).0);
    quote!(#drops [[]; #rows])
}

/// The method of the trait that computes the derivative and both matrices.
fn together(context: &Context, scope: &Scope, program: &Program) -> TokenStream {
    let scalar = &context.scalar;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let (n, m) = sizes(context);
    let all = local("all");
    let mut places = context.state.places(&quote!(#all.0));
    for row in (0..n).map(Literal::usize_unsuffixed) {
        let of = |matrix: Literal, columns: usize| {
            let (all, row) = (&all, &row);
            (0..columns)
                .map(Literal::usize_unsuffixed)
                .map(move |column| quote!(#all.#matrix[#row][#column]))
                .collect::<Vec<_>>()
        };
        places.extend(of(Literal::usize_unsuffixed(1), n));
        places.extend(of(Literal::usize_unsuffixed(2), m));
    }
    let body = body_in_place(context, scope, program, &places);
    let (rates, matrix) = body.outputs.split_at(n.min(body.outputs.len()));
    let name = &context.state.name;
    let rates = context.state.construct(&quote!(#name), rates);
    let rows = |columns: Range<usize>| {
        let rows = matrix.chunks((n + m).max(1)).map(|row| {
            let row = row.get(columns.clone()).unwrap_or_default().iter().map(element);
            quote!([#(#row),*])
        });
        quote!([#(#rows),*])
    };
    let (by_state, by_input) = (rows(0..n), rows(n..n + m));
    let (n, m) = (Literal::usize_unsuffixed(n), Literal::usize_unsuffixed(m));
    let drops = drops(context, &body.used, true);
    let statements = &body.statements;
    quote! {
        #[inline]
        fn linearized(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type
        ) -> (#state_type, [[#scalar; #n]; #n], [[#scalar; #m]; #n]) {
            #drops
            let mut #all = (#rates, #by_state, #by_input);
            #statements
            #all
        }
    }
}

/// The function of the trait that knows which derivatives by the state are zero everywhere.
fn dependence(context: &Context, system: &System, jacobian: &Procedure) -> TokenStream {
    let (n, m) = sizes(context);
    let graph = &system.model.graph;
    let by_state = jacobian.outputs.chunks((n + m).max(1)).flat_map(|row| row.iter().take(n));
    // places row by row, as ranges
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for (place, _) in by_state.enumerate().filter(|(_, entry)| !graph.is_literal_zero(**entry)) {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == place => *last = place,
            _ => ranges.push((place, place)),
        }
    }
    let (row, column) = (local("row"), local("column"));
    let n = Literal::usize_unsuffixed(n);
    let depends = if ranges.is_empty() {
        quote!({
            let _ = (#row, #column);
            false
        })
    } else {
        let ranges = ranges.iter().map(|(first, last)| {
            let [from, to] = [first, last].map(|place| Literal::usize_unsuffixed(*place));
            if first == last { quote!(#from) } else { quote!(#from..=#to) }
        });
        quote!(::core::matches!(#row.wrapping_mul(#n).wrapping_add(#column), #(#ranges)|*))
    };
    quote! {
        #[inline]
        fn state_depends(
            #row: ::core::primitive::usize, #column: ::core::primitive::usize
        ) -> ::core::primitive::bool {
            #depends
        }
    }
}

/// `impl Jacobian for Sleigh`.
fn implementation(
    context: &Context,
    of_state: &TokenStream,
    of_input: &TokenStream,
    together: &TokenStream,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let (n, m) = sizes(context);
    let (n, m) = (Literal::usize_unsuffixed(n), Literal::usize_unsuffixed(m));
    let body = quote! {
        type InputDim = #runtime::D<#m>;
        #[inline]
        fn state_jacobian(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type
        ) -> [[#scalar; #n]; #n] {
            #of_state
        }
        #[inline]
        fn input_jacobian(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type
        ) -> [[#scalar; #m]; #n] {
            #of_input
        }
        #together
    };
    context.implement(&quote!(#runtime::Jacobian), &body)
}

//! The Jacobian of the derivative without its zeros: a pattern that the compiler knows, and the values in one array.

use std::collections::BTreeSet;

use nonholonomic_core::model::Request;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Head, Part};
use super::program::body;
use super::setting::Context;
use super::symbols::Scope;

/// The pattern and the method, if they are asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let is_asked = system.model.requests.iter().any(|(request, _)| *request == Request::SparseJacobian);
    let Some(jacobian) = system.jacobian().filter(|_| is_asked) else { return Part::default() };
    let inputs = context.input.as_ref().map_or(0, super::record::Record::len);
    let width = (context.state.len() + inputs).max(1);
    let graph = &system.model.graph;
    let entries = jacobian.outputs.iter().enumerate().filter(|(_, entry)| !graph.is_literal_zero(**entry));
    let mut entries: Vec<(usize, usize, _)> =
        entries.map(|(place, entry)| (place % width, place / width, *entry)).collect();
    entries.sort_by_key(|(column, row, _)| (*column, *row));
    let pattern: Vec<[usize; 2]> = entries.iter().map(|(column, row, _)| [*row, *column]).collect();
    let values = entries.into_iter().map(|(.., entry)| entry).collect();
    let program = context.lowering.program(&system.model, &jacobian.with_outputs(values));
    let body = body(context, scope, &program);
    let (statements, values) = (&body.statements, body.outputs.iter().map(element));
    let mut methods = constants(context, &pattern);
    let body = (&body.used, &quote!(#statements [#(#values),*]));
    methods.extend(head(context, pattern.len()).with_body(context, body.0, body.1));
    Part { methods, programs: vec![("sparse_jacobian", program)], ..Part::default() }
}

/// The same without entries.
pub(super) fn stub(context: &Context) -> Part {
    let mut methods = constants(context, &[]);
    methods.extend(head(context, 0).with_body(context, &BTreeSet::new(), &quote!([])));
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

//! The derivative of the derivative by the parameters.

use std::collections::BTreeSet;

use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::expression::element;
use super::function::{Head, Part, program};
use super::program::body;
use super::scope::{Scope, parameter_places};

/// The inherent method `parameter_jacobian`, if it is asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(jacobian) = &system.parameter_jacobian else { return Part::default() };
    let count = parameter_places(context).len();
    let program = program(&system.model, jacobian);
    let body = body(context, scope, &program);
    let columns = (0..count).map(|column| {
        let column = body.outputs.iter().skip(column).step_by(count).map(element);
        quote!([#(#column),*])
    });
    let (statements, matrix) = (&body.statements, matrix_type(context));
    let matrix = from_columns(context, &matrix, &quote!([#(#columns),*]));
    let methods = head(context).with_body(context, &body.used, &quote!(#statements #matrix));
    Part { methods, items: TokenStream::new(), programs: vec![("parameter_jacobian", program)] }
}

/// The same method with zeros for all entries.
pub(super) fn stub(context: &Context) -> Part {
    let Context { runtime, scalar, .. } = context;
    let [rows, columns] =
        [context.state.len(), parameter_places(context).len()].map(Literal::usize_unsuffixed);
    let zeros = quote!([[<#scalar as #runtime::Scalar>::ZERO; #rows]; #columns]);
    let matrix = from_columns(context, &matrix_type(context), &zeros);
    let methods = head(context).with_body(context, &BTreeSet::new(), &matrix);
    Part { methods, ..Part::default() }
}

/// `SMatrix<f64, N, P>`.
fn matrix_type(context: &Context) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let [rows, columns] =
        [context.state.len(), parameter_places(context).len()].map(Literal::usize_unsuffixed);
    quote!(#runtime::nalgebra::SMatrix<#scalar, #rows, #columns>)
}

fn from_columns(context: &Context, matrix: &TokenStream, columns: &TokenStream) -> TokenStream {
    let scalar = &context.scalar;
    let [rows, count] = [context.state.len(), parameter_places(context).len()].map(Literal::usize_unsuffixed);
    quote!(<#matrix as ::core::convert::From<[[#scalar; #rows]; #count]>>::from(#columns))
}

fn head(context: &Context) -> Head {
    Head {
        name: "parameter_jacobian",
        doc: &[
            " The derivative of the derivative by the parameters: entry (i, j) is that of component i of ẋ by",
            " the parameter j, the numbers in the fields of the struct counted in order.",
        ],
        takes_input: true,
        returns: matrix_type(context),
    }
}

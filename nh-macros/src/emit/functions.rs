//! The functions of the table: one printer for each shape makes the methods of all of them, and, with zeros,
//! what stands for them beside errors.

use std::collections::BTreeSet;

use nonholonomic_core::functions::{self, Function, Shape, Signature, Sizes, TABLE, When};
use nonholonomic_core::model::Request;
use nonholonomic_core::program::Limits;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::infix::element;
use super::inherent_method::{Head, Part};
use super::power;
use super::program::body;
use super::results::Results;
use super::setting::Context;
use super::symbols::{Argument, Scope};
use crate::resolve::Outline;

/// The inherent methods, with the structs that they give.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let printer = Printer { context, sizes: system.sizes(), results: Results::of(context, system) };
    let mut part = Part { items: printer.results.emit(context), ..Part::default() };
    if system.functions.get(&functions::POWER).is_some() {
        part.items.extend(power::item(context, &printer.results));
    }
    for Function { signature, procedure } in system.functions.iter() {
        let is_of_motion = signature.request().is_some_and(Request::computes_slopes);
        let limits = if is_of_motion { system.limits_at_rest() } else { Limits::Open };
        let program = context.lowering.derivative(&system.model, (signature.name, procedure), limits);
        let mut body = body(context, scope, &program);
        if signature.shape == Shape::OverThePoint && !system.state_coordinates.is_empty() {
            // the coordinates are handed through
            body.used.insert(Argument::State);
        }
        let (statements, value) = (&body.statements, printer.value(signature.shape, &body.outputs));
        part.methods.extend(printer.head(signature).with_body(
            context,
            &body.used,
            &quote!(#statements #value),
        ));
        part.programs.push((signature.name, program));
    }
    part
}

/// The same with zeros, as far as their shapes are known beside errors.
pub(super) fn stubs(context: &Context, outline: &Outline) -> Part {
    let sizes = Sizes {
        state: context.state.len(),
        velocities: outline.velocities,
        sections: context.velocity.len(),
        outputs: context.outputs.as_ref().map_or(0, super::record::Record::len),
        parameters: super::symbols::parameter_places(context).len(),
        vertical: outline.splitting.0,
        lifted: outline.splitting.1,
    };
    let printer = Printer { context, sizes, results: Results::expected(context, outline) };
    let mut part = Part { items: printer.results.emit(context), ..Part::default() };
    if outline.requests.contains(&Request::Power) {
        part.items.extend(power::item(context, &printer.results));
    }
    for signature in TABLE.iter().filter(|signature| printer.is_expected(signature, outline)) {
        let zero = printer.zero(signature.shape);
        part.methods.extend(printer.head(signature).with_body(context, &BTreeSet::new(), &zero));
    }
    part
}

/// What printing a function takes.
struct Printer<'a> {
    context: &'a Context<'a>,
    sizes: Sizes,
    results: Results,
}

impl Printer<'_> {
    fn head(&self, signature: &'static Signature) -> Head {
        let Signature { name, doc, takes_input, shape, .. } = *signature;
        Head { name, doc, takes_input, returns: self.type_of(shape) }
    }

    /// Whether a declaration in error would probably have the function.
    fn is_expected(&self, signature: &Signature, outline: &Outline) -> bool {
        let is_there = match signature.when {
            When::Always => true,
            When::Asked(request) => outline.requests.contains(&request),
            When::WithSymmetries => !outline.momenta.is_empty(),
            When::WithOutputs => self.context.outputs.is_some(),
            When::WithSection => outline.claims_section,
            When::WithConstraints => !outline.labels.is_empty(),
            When::WithQuadratures => !outline.quadratures.is_empty(),
        };
        is_there && self.is_known(signature.shape)
    }

    /// Whether the type that a function gives is known.
    fn is_known(&self, shape: Shape) -> bool {
        let is_known = |size: &functions::Size| self.sizes.of(*size) > 0;
        match shape {
            Shape::Scalar | Shape::OverThePoint | Shape::Power => true,
            Shape::Record(record) => self.results.get(self.context, record).is_some(),
            Shape::Array(lengths) => lengths.iter().all(is_known),
            Shape::Matrix(rows, _) | Shape::ByStateAndInput(rows) => is_known(&rows),
        }
    }

    fn type_of(&self, shape: Shape) -> TokenStream {
        let Context { runtime, scalar, .. } = self.context;
        match shape {
            Shape::Scalar => scalar.clone(),
            Shape::OverThePoint => self.context.type_of(&self.context.state),
            Shape::Record(record) => self
                .results
                .get(self.context, record)
                .map_or_else(TokenStream::new, |record| self.context.type_of(record)),
            Shape::Array(lengths) => lengths.iter().rev().fold(quote!(#scalar), |inner, length| {
                let length = Literal::usize_unsuffixed(self.sizes.of(*length));
                quote!([#inner; #length])
            }),
            Shape::Matrix(rows, columns) => {
                let [rows, columns] =
                    [rows, columns].map(|size| Literal::usize_unsuffixed(self.sizes.of(size)));
                quote!(#runtime::nalgebra::SMatrix<#scalar, #rows, #columns>)
            }
            Shape::ByStateAndInput(rows) => {
                let rows = Literal::usize_unsuffixed(self.sizes.of(rows));
                let [state, inputs] = self.columns().map(Literal::usize_unsuffixed);
                quote! {(
                    #runtime::nalgebra::SMatrix<#scalar, #rows, #state>,
                    #runtime::nalgebra::SMatrix<#scalar, #rows, #inputs>,
                )}
            }
            Shape::Power => power::type_of(self.context, &self.results),
        }
    }

    /// The numbers of state variables and of inputs.
    fn columns(&self) -> [usize; 2] {
        [self.sizes.state, self.context.input.as_ref().map_or(0, super::record::Record::len)]
    }

    /// The value that is made of the outputs of a program.
    fn value(&self, shape: Shape, outputs: &[TokenStream]) -> TokenStream {
        let context = self.context;
        match shape {
            Shape::Scalar => outputs.iter().cloned().collect(),
            Shape::OverThePoint => {
                let kept = context.state.places(&context.locals.state);
                let coordinates = kept.len().saturating_sub(self.sizes.velocities);
                context.state.construct(&context.state_name(), &[&kept[..coordinates], outputs].concat())
            }
            Shape::Record(record) => {
                let record = self.results.get(context, record);
                record.map_or_else(TokenStream::new, |record| {
                    record.construct(&record.name.to_token_stream(), outputs)
                })
            }
            Shape::Array(lengths) => {
                let lengths: Vec<usize> = lengths.iter().map(|length| self.sizes.of(*length)).collect();
                array(&lengths, outputs)
            }
            Shape::Matrix(rows, columns) => {
                matrix(context, self.sizes.of(rows), self.sizes.of(columns), outputs)
            }
            Shape::ByStateAndInput(rows) => {
                let (rows, [state, inputs]) = (self.sizes.of(rows), self.columns());
                let part = |columns: std::ops::Range<usize>| -> Vec<TokenStream> {
                    let chunks = outputs.chunks((state + inputs).max(1));
                    chunks.flat_map(|row| row[columns.clone()].to_vec()).collect()
                };
                let by_state = matrix(context, rows, state, &part(0..state));
                let by_input = matrix(context, rows, inputs, &part(state..state + inputs));
                quote!((#by_state, #by_input))
            }
            Shape::Power => power::value(context, &self.results, outputs),
        }
    }

    fn zero(&self, shape: Shape) -> TokenStream {
        let Context { runtime, scalar, .. } = self.context;
        match shape {
            Shape::Scalar => quote!(<#scalar as #runtime::Scalar>::ZERO),
            Shape::Matrix(rows, columns) => {
                let [rows, columns] = [rows, columns].map(|size| self.sizes.of(size));
                let [r, c] = [rows, columns].map(Literal::usize_unsuffixed);
                let zeros = quote!([[<#scalar as #runtime::Scalar>::ZERO; #r]; #c]);
                of_columns(self.context, rows, columns, &zeros)
            }
            Shape::ByStateAndInput(rows) => {
                let zeros = |columns: usize| {
                    let rows = self.sizes.of(rows);
                    let [r, c] = [rows, columns].map(Literal::usize_unsuffixed);
                    let zeros = quote!([[<#scalar as #runtime::Scalar>::ZERO; #r]; #c]);
                    of_columns(self.context, rows, columns, &zeros)
                };
                let [by_state, by_input] = self.columns().map(zeros);
                quote!((#by_state, #by_input))
            }
            Shape::Record(_) | Shape::OverThePoint | Shape::Array(_) | Shape::Power => {
                quote!(::core::default::Default::default())
            }
        }
    }
}

/// Nested arrays of the entries.
fn array(lengths: &[usize], entries: &[TokenStream]) -> TokenStream {
    let mut level: Vec<TokenStream> = entries.iter().map(element).collect();
    for length in lengths.iter().rev() {
        level = level.chunks((*length).max(1)).map(|chunk| quote!([#(#chunk),*])).collect();
    }
    level.into_iter().collect()
}

/// An `SMatrix` from its entries, row by row.
pub(super) fn matrix(context: &Context, rows: usize, columns: usize, entries: &[TokenStream]) -> TokenStream {
    let by_column = (0..columns).map(|column| {
        let column = entries.iter().skip(column).step_by(columns).map(element);
        quote!([#(#column),*])
    });
    of_columns(context, rows, columns, &quote!([#(#by_column),*]))
}

/// An `SMatrix` from the array of its columns.
pub(super) fn of_columns(
    context: &Context,
    rows: usize,
    columns: usize,
    by_column: &TokenStream,
) -> TokenStream {
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let [rows, columns] = [rows, columns].map(Literal::usize_unsuffixed);
    quote! {
        <#runtime::nalgebra::SMatrix<#scalar, #rows, #columns> as
            ::core::convert::From<[[#scalar; #rows]; #columns]>>::from(#by_column)
    }
}

//! What the symbols of a program stand for in a generated function.

use std::collections::BTreeMap;

use nonholonomic_core::id::{Id, SymbolId};
use nonholonomic_core::model::Model;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::setting::Context;

/// One parameter of a generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Argument {
    /// `&self`
    This,
    /// `t`
    Time,
    /// `state`
    State,
    /// `input`
    Input,
    /// `start`, where an iteration began
    Start,
    /// `present`, where an iteration is
    Present,
    /// `values`, computed ahead
    Values,
    /// `phase`, coordinates and momenta
    Phase,
    /// `covector`, a differential
    Covector,
    /// `length`, of a step
    Length,
    /// `direction`, in which the state changes
    Direction,
    /// `input_direction`, in which the inputs change
    InputDirection,
    /// `weights`, of the components of the derivative
    Weights,
}

/// The tokens of every symbol, and the argument that each comes from.
pub(super) struct Scope<'a> {
    model: &'a Model,
    places: BTreeMap<SymbolId, (Argument, TokenStream)>,
}

impl<'a> Scope<'a> {
    /// `self.m`, `t`, `state.theta[0]`, `input.torque`.
    pub(super) fn new(context: &Context, model: &'a Model, in_state: &[SymbolId]) -> Self {
        let mut places = BTreeMap::new();
        let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
        places.insert(model.time, (Argument::Time, quote!(#t)));
        let parameters = parameter_places(context);
        for (parameter, place) in model.parameters.iter().zip(parameters) {
            places.insert(parameter.symbol, (Argument::This, place));
        }
        for (symbol, place) in in_state.iter().zip(context.state.places(state)) {
            places.insert(*symbol, (Argument::State, place));
        }
        if let Some(record) = &context.input {
            for (entry, place) in model.inputs.iter().zip(record.places(input)) {
                places.insert(entry.symbol, (Argument::Input, place));
            }
        }
        Self { model, places }
    }

    /// The same with an array's entries for some symbols: where an iteration is, or began.
    pub(super) fn with_array(mut self, argument: Argument, array: &Ident, symbols: &[SymbolId]) -> Self {
        for (index, symbol) in symbols.iter().enumerate() {
            let index = Literal::usize_unsuffixed(index);
            self.places.insert(*symbol, (argument, quote!(#array[#index])));
        }
        self
    }

    /// The same with places for some symbols.
    pub(super) fn with_places(
        mut self,
        argument: Argument,
        symbols: &[SymbolId],
        places: Vec<TokenStream>,
    ) -> Self {
        for (symbol, place) in symbols.iter().zip(places) {
            self.places.insert(*symbol, (argument, place));
        }
        self
    }

    /// Where a symbol's value is.
    pub(super) fn place(&self, symbol: SymbolId) -> Option<&(Argument, TokenStream)> {
        self.places.get(&symbol)
    }

    /// The methods that differentiate a method of the user's by its arguments, if they are declared.
    pub(super) fn derivatives(&self, method: &str) -> &[String] {
        let call = self.model.calls.iter().find(|call| call.method == method);
        call.and_then(|call| call.derivatives.as_deref()).unwrap_or_default()
    }

    /// A symbol's name in the declaration.
    pub(super) fn name(&self, symbol: SymbolId) -> &str {
        let symbols = self.model.graph.symbols();
        if symbol.index() < symbols.len() { &symbols[symbol] } else { "" }
    }
}

/// `self.I[0][1]` for each scalar parameter, in order.
pub(super) fn parameter_places(context: &Context) -> Vec<TokenStream> {
    let parameters = context.layout.parameters.iter();
    let places = parameters.flat_map(|family| {
        let ident = &family.ident;
        family.entries().into_iter().map(move |entry| {
            let indices = entry.into_iter().map(Literal::u32_unsuffixed);
            quote!(self.#ident #([#indices])*)
        })
    });
    places.collect()
}

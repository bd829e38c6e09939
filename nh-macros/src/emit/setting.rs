//! What every emitter needs: paths, generics, and the shapes of the generated structs.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use nonholonomic_core::choose::Lowering;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::System;
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::{GenericParam, Generics};

use super::layout::{Family, Layout, local};
use super::lint::inherited;
use super::record::{Field, Record};
use crate::syntax::ast;

/// What every emitter needs.
pub(super) struct Context<'a> {
    pub(super) layout: &'a Layout,
    /// `::nonholonomic::__private`
    pub(super) runtime: TokenStream,
    /// `::core::primitive::f64`, or the type parameter.
    pub(super) scalar: TokenStream,
    /// The struct's visibility, with spans that belong to the macro.
    pub(super) visibility: TokenStream,
    /// The attributes of all generated items.
    pub(super) lints: TokenStream,
    /// The struct's generics, with the scalar bound.
    pub(super) generics: Generics,
    pub(super) state: Record,
    pub(super) velocity: Record,
    /// `None` without inputs: then the type is `()`.
    pub(super) input: Option<Record>,
    /// `None` without outputs.
    pub(super) outputs: Option<Record>,
    pub(super) locals: Locals,
    pub(super) lowering: Lowering,
    /// The decimal exponents of numbers that the scalar type does not have.
    pub(super) beyond: Rc<RefCell<BTreeSet<i64>>>,
    /// Whether numbers are printed with their partial derivatives, `Jet`s.
    pub(super) differentiates: bool,
}

/// The parameters of generated functions.
pub(super) struct Locals {
    pub(super) t: Ident,
    pub(super) state: Ident,
    pub(super) input: Ident,
}

impl<'a> Context<'a> {
    /// The program of a derivative of the motion, with the values that it tends to at rest.
    pub(super) fn derivative(&self, system: &System, name: &'static str, procedure: &Procedure) -> Program {
        self.lowering.derivative(&system.model, (name, procedure), system.limits_at_rest())
    }

    /// `in_state` are the coordinates, velocities and auxiliary states in the state, `basis` the velocities of all
    /// sections of the basis.
    pub(super) fn new(layout: &'a Layout, in_state: &[SymbolId], basis: &[SymbolId]) -> Self {
        let path = &layout.runtime;
        let runtime = quote!(#path::__private);
        let mut generics = layout.generics.clone();
        if let ast::Scalar::Parameter(ident) = &layout.scalar {
            let predicates = &mut generics.make_where_clause().predicates;
            if let Ok(predicate) = syn::parse2(quote!(#ident: #runtime::Scalar)) {
                predicates.push(predicate);
            }
        }
        let name = layout.name.to_string();
        let fields = |families: &[Family], what: &str| -> Vec<Field> {
            families.iter().map(|family| Field::of(family, what)).collect()
        };
        let mut state = coordinate_fields(layout, in_state, "coordinate");
        state.extend(velocity_fields(layout, in_state));
        state.extend(auxiliary_fields(layout, in_state));
        let more = if layout.auxiliary.is_empty() { "" } else { ", then auxiliary states" };
        let some = |record: Record| (!record.fields.is_empty()).then_some(record);
        Self {
            scalar: layout.scalar_type(),
            visibility: respan(layout.visibility.to_token_stream()),
            lints: inherited(&layout.attributes),
            generics,
            state: Record {
                name: layout.types.state.clone(),
                doc: format!("The state of [`{name}`]: base coordinates, then velocities{more}."),
                fields: state,
            },
            velocity: Record {
                name: layout.types.velocity.clone(),
                doc: format!("The quasi-velocities of [`{name}`]."),
                fields: velocity_fields(layout, basis),
            },
            input: some(Record {
                name: layout.types.input.clone(),
                doc: format!("The control inputs of [`{name}`]."),
                fields: fields(&layout.inputs, "input"),
            }),
            outputs: some(Record {
                name: layout.types.outputs.clone(),
                doc: format!("The observables of [`{name}`]."),
                fields: fields(&layout.outputs, "output"),
            }),
            locals: Locals { t: local("t"), state: local("state"), input: local("input") },
            layout,
            runtime,
            lowering: Lowering::default(),
            beyond: Rc::default(),
            differentiates: false,
        }
    }

    /// The same with those outputs alone that are named here.
    pub(super) fn observing(mut self, names: &[String]) -> Self {
        let families = &self.layout.outputs;
        let known: Vec<String> = families.iter().flat_map(Family::names).collect();
        if let Some(outputs) = &mut self.outputs {
            outputs.fields = entry_fields(families.iter(), &known, names, "output");
        }
        self.outputs = self.outputs.filter(|outputs| !outputs.fields.is_empty());
        self
    }

    /// The same where every number is one with derivatives in some directions; `layout` is to have a type parameter.
    pub(super) fn with_jets(&self, layout: &'a Layout, in_state: &[SymbolId]) -> Self {
        let (runtime, scalar) = (&self.runtime, &self.scalar);
        let mut jets = Self::new(layout, in_state, &[]);
        jets.scalar = quote!(#runtime::Directed<#scalar>);
        jets.differentiates = true;
        jets.beyond = Rc::clone(&self.beyond);
        jets
    }

    /// The type parameter, if the scalar is one.
    pub(super) fn parameter(&self) -> Option<&Ident> {
        match &self.layout.scalar {
            ast::Scalar::Parameter(ident) => Some(ident),
            ast::Scalar::F64 | ast::Scalar::F32 => None,
        }
    }

    /// `SleighState`, or `SleighState<T>`.
    pub(super) fn type_of(&self, record: &Record) -> TokenStream {
        let name = &record.name;
        match self.parameter() {
            None => quote!(#name),
            Some(parameter) => quote!(#name<#parameter>),
        }
    }

    /// `SleighState`, as a value of it is written.
    pub(super) fn state_name(&self) -> TokenStream {
        self.state.name.to_token_stream()
    }

    /// The input's type.
    pub(super) fn input_type(&self) -> TokenStream {
        self.input.as_ref().map_or_else(|| quote!(()), |record| self.type_of(record))
    }

    /// `<T>` as a record declares it, with the default that the struct gives it.
    pub(super) fn record_generics(&self) -> TokenStream {
        let Some(parameter) = self.parameter() else { return TokenStream::new() };
        let default = self.layout.generics.params.iter().find_map(|param| match param {
            GenericParam::Type(param) if param.ident == *parameter => param.default.clone(),
            _ => None,
        });
        match default {
            None => quote!(<#parameter>),
            Some((_, default)) => quote!(<#parameter = #default>),
        }
    }

    /// `<T: Scalar>` for the impls of a record.
    pub(super) fn record_impl_generics(&self) -> TokenStream {
        let runtime = &self.runtime;
        self.parameter().map_or_else(TokenStream::new, |parameter| quote!(<#parameter: #runtime::Scalar>))
    }

    /// `impl … Trait for Sleigh { body }`.
    pub(super) fn implement(&self, of: &TokenStream, body: &TokenStream) -> TokenStream {
        let (name, lints) = (&self.layout.name, &self.lints);
        let (impl_generics, ty_generics, where_clause) = self.generics.split_for_impl();
        quote! {
            #lints
            #[automatically_derived]
            impl #impl_generics #of for #name #ty_generics #where_clause { #body }
        }
    }

    /// `impl Trait for Sleigh { body }`, where the numbers have an order.
    pub(super) fn implement_for_reals(&self, of: &TokenStream, body: &TokenStream) -> TokenStream {
        let (name, lints, runtime) = (&self.layout.name, &self.lints, &self.runtime);
        let mut generics = self.generics.clone();
        if let Some(parameter) = self.parameter() {
            generics.make_where_clause().predicates.push(syn::parse_quote!(#parameter: #runtime::Real));
        }
        let (impl_generics, ty_generics, where_clause) = generics.split_for_impl();
        quote! {
            #lints
            #[automatically_derived]
            impl #impl_generics #of for #name #ty_generics #where_clause { #body }
        }
    }

    /// The generics of an alias of the struct: names without bounds, which an alias does not check.
    pub(super) fn parameters_of_alias(&self) -> Generics {
        let mut generics = self.layout.generics.clone();
        generics.where_clause = None;
        for parameter in generics.type_params_mut() {
            parameter.bounds.clear();
        }
        generics
    }

    /// `impl Sleigh { body }`.
    pub(super) fn inherent(&self, body: &TokenStream) -> TokenStream {
        let (name, lints) = (&self.layout.name, &self.lints);
        let (impl_generics, ty_generics, where_clause) = self.generics.split_for_impl();
        // a group takes the tokens as they are, where quoting them copies each
        let body = Group::new(Delimiter::Brace, body.clone());
        quote!(#lints impl #impl_generics #name #ty_generics #where_clause #body)
    }
}

/// A copy of the parameters, for what is kept beside them; told at the name of the struct where there is none.
pub(super) fn copy_of_parameters(context: &Context) -> TokenStream {
    let runtime = &context.runtime;
    let this = Ident::new("self", context.layout.name.span().resolved_at(Span::call_site()));
    quote!(#runtime::kept_parameters(#this))
}

/// The fields of the coordinates among some symbols.
pub(super) fn coordinate_fields(layout: &Layout, symbols: &[SymbolId], what: &str) -> Vec<Field> {
    entry_fields(layout.coordinates.iter(), &layout.coordinate_symbols, symbols, what)
}

/// The fields of the velocities among some symbols.
fn velocity_fields(layout: &Layout, symbols: &[SymbolId]) -> Vec<Field> {
    let families = layout.velocities.iter().chain(&layout.frame);
    entry_fields(families, &layout.velocity_symbols, symbols, "quasi-velocity")
}

/// The fields of the auxiliary states among some symbols.
fn auxiliary_fields(layout: &Layout, symbols: &[SymbolId]) -> Vec<Field> {
    entry_fields(layout.auxiliary.iter(), &layout.auxiliary_symbols, symbols, "auxiliary state")
}

/// The fields of those of some symbols, or names, that are entries of families, in order. Entries of a family
/// that stand there as a whole, one after the other, are one array; else each entry is a field of its
/// own.
fn entry_fields<'a, Key: PartialEq>(
    families: impl Iterator<Item = &'a Family>,
    known: &[Key],
    wanted: &[Key],
    what: &str,
) -> Vec<Field> {
    let entries: Vec<(&Family, usize)> =
        families.flat_map(|family| (0..family.entries().len()).map(move |offset| (family, offset))).collect();
    let place = |key: &Key| known.iter().position(|known| known == key);
    let positions: Vec<usize> = wanted.iter().filter_map(place).collect();
    let mut fields = Vec::new();
    let mut rest = positions.as_slice();
    while let Some((first, others)) = rest.split_first() {
        let Some((family, offset)) = entries.get(*first) else { break };
        let length = family.entries().len();
        let whole = *offset == 0 && rest.iter().copied().take(length).eq(*first..*first + length);
        if whole {
            fields.push(Field::of(family, what));
            rest = &rest[length..];
        } else {
            fields.push(Field::of_entry(family, &family.entries()[*offset], what));
            rest = others;
        }
    }
    fields
}

/// The tokens with spans that belong to the macro, so that lints know generated code.
pub(super) fn respan(tokens: TokenStream) -> TokenStream {
    let respanned = tokens.into_iter().map(|mut token| {
        if let TokenTree::Group(group) = &token {
            token = Group::new(group.delimiter(), respan(group.stream())).into();
        }
        token.set_span(Span::call_site());
        token
    });
    respanned.collect()
}

//! The power of forces and constraints: a struct of two records, and their total.

use nonholonomic_core::functions::Record as Kind;
use nonholonomic_core::model::{ForceDirection, Model};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::layout::Family;
use super::record::{Field, Record};
use super::results::Results;
use super::setting::Context;

/// What each declared force acts along, as it is written.
pub(crate) fn directions_of_forces(model: &Model) -> Vec<String> {
    let name = |direction| match direction {
        ForceDirection::Coordinate(coordinate) => model.coordinates[coordinate].name.clone(),
        // where E = TM a force is written along the coordinate
        ForceDirection::Section(symbol) => model
            .coordinates
            .iter()
            .find(|coordinate| coordinate.rate == symbol)
            .map_or_else(|| model.graph.symbols()[symbol].clone(), |coordinate| coordinate.name.clone()),
    };
    model.forces.iter().map(|force| name(force.direction)).collect()
}

/// The record of the forces; nothing if there are none.
pub(super) fn of_forces(context: &Context, directions: &[String]) -> Option<Record> {
    let layout = context.layout;
    let fields: Vec<Field> = directions
        .iter()
        .map(|direction| {
            let field = direction.replace("][", "_").replace('[', "_").replace(']', "");
            let ident = syn::parse_str(&field).unwrap_or_else(|_| Ident::new_raw(&field, Span::call_site()));
            let family = Family { ident, lengths: Vec::new(), docs: TokenStream::new(), units: Vec::new() };
            Field::of(&family, "").described(&format!(" The power of the force along `{direction}`."))
        })
        .collect();
    (!fields.is_empty()).then(|| Record {
        name: format_ident!("{}OfForces", layout.types.power),
        doc: format!("The power of the forces of [`{}`], by their directions.", layout.name),
        fields,
    })
}

/// The record of the constraints; nothing if there are none.
pub(super) fn of_constraints(context: &Context, fields: Vec<Field>) -> Option<Record> {
    let layout = context.layout;
    (!fields.is_empty()).then(|| Record {
        name: format_ident!("{}OfConstraints", layout.types.power),
        doc: format!("The power of the constraints of [`{}`]: not 0 where they have a drift.", layout.name),
        fields,
    })
}

/// The records that there are, with the names of their fields.
fn parts<'a>(context: &'a Context, results: &'a Results) -> Vec<(Ident, &'a Record)> {
    let parts = [("forces", Kind::PowerOfForces), ("constraints", Kind::PowerOfConstraints)];
    let part = |(name, kind)| Some((Ident::new(name, Span::call_site()), results.get(context, kind)?));
    parts.into_iter().filter_map(part).collect()
}

/// `SleighPower`, or `SleighPower<T>` where it has fields.
pub(super) fn type_of(context: &Context, results: &Results) -> TokenStream {
    let name = &context.layout.types.power;
    match context.parameter() {
        Some(parameter) if !parts(context, results).is_empty() => quote!(#name<#parameter>),
        _ => quote!(#name),
    }
}

/// The struct, and `total`.
pub(super) fn item(context: &Context, results: &Results) -> TokenStream {
    let Context { visibility, lints, scalar, runtime, .. } = context;
    let (name, generics) = (&context.layout.types.power, context.record_generics());
    let parts = parts(context, results);
    let doc = format!(" What forces and constraints do to the energy of [`{}`].", context.layout.name);
    let fields = parts.iter().map(|(field, record)| {
        let type_of = context.type_of(record);
        let doc = format!(" The power of the {field}.");
        quote!(#[doc = #doc] pub #field: #type_of)
    });
    let terms = parts.iter().flat_map(|(field, record)| record.places(&quote!(self.#field)));
    let sum = terms.reduce(|sum, term| quote!(#sum + #term));
    let sum = sum.unwrap_or_else(|| quote!(<#scalar as #runtime::Scalar>::ZERO));
    let receiver = if parts.is_empty() { quote!(_ = self;) } else { TokenStream::new() };
    let (impl_generics, type_of) = (context.record_impl_generics(), type_of(context, results));
    // without fields the numbers are those of the method alone
    let none = TokenStream::new();
    let (generics, impl_generics, own) =
        if parts.is_empty() { (&none, &none, &impl_generics) } else { (&generics, &impl_generics, &none) };
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::default::Default)]
        #lints
        #visibility struct #name #generics { #(#fields),* }

        #lints
        impl #impl_generics #type_of {
            /// The sum of all of them: the rate of the energy, but for what the Lagrangian changes with the time.
            #[inline]
            #[must_use]
            #visibility fn total #own (&self) -> #scalar {
                #receiver
                #sum
            }
        }
    }
}

/// The value from the numbers in order.
pub(super) fn value(context: &Context, results: &Results, outputs: &[TokenStream]) -> TokenStream {
    let name = &context.layout.types.power;
    let mut rest = outputs;
    let mut fields = Vec::new();
    for (field, record) in parts(context, results) {
        let (own, others) = rest.split_at(record.len().min(rest.len()));
        rest = others;
        let value = record.construct(&record.name.to_token_stream(), own);
        fields.push(quote!(#field: #value));
    }
    quote!(#name { #(#fields),* })
}

//! The momenta of symmetries, and their rates.

use std::collections::BTreeSet;

use nonholonomic_core::system::System;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::constraint::ident;
use super::context::Context;
use super::function::{Head, Part, program};
use super::layout::Family;
use super::program::body;
use super::record::{Field, Record};
use super::scope::Scope;

/// The struct of the momenta.
fn record(context: &Context, names: &[String]) -> Record {
    let fields = names.iter().map(|name| {
        let field = name.replace('[', "_").replace(']', "");
        let family = Family { ident: ident(&field), lengths: Vec::new(), docs: TokenStream::new() };
        Field::of(&family, "").described(&format!(" Of the symmetry `{name}`."))
    });
    let name = context.layout.name.to_string();
    Record {
        name: context.layout.types.momenta.clone(),
        doc: format!("The momenta σ · ∂L/∂y of the sections σ of [`{name}`], or their rates."),
        fields: fields.collect(),
    }
}

/// The heads of `momenta` and `momentum_rates`.
fn heads(context: &Context, record: &Record) -> [Head; 2] {
    [
        Head {
            name: "momenta",
            doc: &[" The momenta of the symmetries: σ · ∂L/∂y for each section σ."],
            takes_input: false,
            returns: context.type_of(record),
        },
        Head {
            name: "momentum_rates",
            doc: &[
                " The rates of the momenta along the motion, by the momentum equation; zero if conserved.",
            ],
            takes_input: true,
            returns: context.type_of(record),
        },
    ]
}

/// The inherent methods `momenta` and `momentum_rates` with their struct, if there are symmetries.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(momenta) = &system.momenta else { return Part::default() };
    let record = record(context, &momenta.names);
    let mut part = Part { items: record.emit(context), ..Part::default() };
    for (head, procedure) in heads(context, &record).iter().zip([&momenta.values, &momenta.rates]) {
        let program = program(&system.model, procedure);
        let body = body(context, scope, &program);
        let result = record.construct(&record.name.to_token_stream(), &body.outputs);
        let statements = &body.statements;
        part.methods.extend(head.with_body(context, &body.used, &quote!(#statements #result)));
        part.programs.push((head.name, program));
    }
    part
}

/// The same with zeros.
pub(super) fn stub(context: &Context, names: &[String]) -> Part {
    if names.is_empty() {
        return Part::default();
    }
    let record = record(context, names);
    let default = quote!(::core::default::Default::default());
    let methods =
        heads(context, &record).into_iter().map(|head| head.with_body(context, &BTreeSet::new(), &default));
    Part { methods: methods.collect(), items: record.emit(context), programs: Vec::new() }
}

//! Functions with a component for each of some coordinates: the rates that Routh reduction leaves to
//! quadratures, and the gyroscopic force of a Chaplygin system.

use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::system::System;
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};

use super::context::{Context, coordinate_fields};
use super::function::{Head, Part, program};
use super::program::body;
use super::record::Record;
use super::scope::Scope;

/// The inherent methods `quadratures` and `gyroscopic` with their structs, where there are any.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let types = &context.layout.types;
    let mut part = Part::default();
    if let Some(quadratures) = &system.quadratures {
        let entry = Entry {
            record: &types.quadratures,
            about: "The rates of the coordinates that are not in the state",
            name: "quadratures",
            doc: &[" The rates of the coordinates that are not in the state: quadratures give these back."],
            what: "rate of the coordinate",
        };
        part = part.with(entry.emit(context, scope, system, &quadratures.coordinates, &quadratures.rates));
    }
    if let Some(gyroscopic) = &system.gyroscopic {
        let entry = Entry {
            record: &types.gyroscopic,
            about: "The gyroscopic force of the constraints",
            name: "gyroscopic",
            doc: &[
                " The force ⟨J, K⟩ on the right of the Euler–Lagrange equations of the reduced Lagrangian, by the",
                " curvature K of the constraint distribution.",
            ],
            what: "force along the coordinate",
        };
        part = part.with(entry.emit(context, scope, system, &gyroscopic.coordinates, &gyroscopic.force));
    }
    part
}

/// One of the methods.
struct Entry<'a> {
    /// The name of the struct.
    record: &'a Ident,
    /// What the struct is.
    about: &'static str,
    name: &'static str,
    doc: &'static [&'static str],
    /// What a field is.
    what: &'static str,
}

impl Entry<'_> {
    fn emit(
        &self,
        context: &Context,
        scope: &Scope,
        system: &System,
        coordinates: &[SymbolId],
        procedure: &Procedure,
    ) -> Part {
        let record = Record {
            name: self.record.clone(),
            doc: format!("{} of [`{}`].", self.about, context.layout.name),
            fields: coordinate_fields(context.layout, coordinates, self.what),
        };
        let program = program(&system.model, procedure);
        let body = body(context, scope, &program);
        let result = record.construct(&record.name.to_token_stream(), &body.outputs);
        let statements = &body.statements;
        let Self { name, doc, .. } = self;
        let head = Head { name, doc, takes_input: false, returns: context.type_of(&record) };
        let methods: TokenStream = head.with_body(context, &body.used, &quote!(#statements #result));
        Part { methods, items: record.emit(context), programs: vec![(name, program)] }
    }
}

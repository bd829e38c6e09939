//! The constraints: their multipliers, the forces that they exert, and what a state leaves of them.

use std::collections::BTreeSet;

use nh_core::mechanics::Procedure;
use nh_core::model::Model;
use nh_core::system::System;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};

use super::context::Context;
use super::function::{Head, Part, program};
use super::layout::{Family, plain};
use super::program::body;
use super::record::{Field, Record};
use super::scope::Scope;

/// The struct of the multipliers, if they are computed.
pub(super) fn multipliers(context: &Context, system: &System) -> Option<Record> {
    let count = number(system.multipliers.as_ref())?;
    let name = context.layout.name.to_string();
    Some(Record {
        name: context.layout.types.multipliers.clone(),
        doc: format!("The multipliers of the constraints of [`{name}`], which enter as +λ ∂φ/∂y."),
        fields: fields(&system.model, count, "multiplier of the constraint"),
    })
}

/// The struct of the reaction forces, if they are computed.
pub(super) fn reactions(context: &Context, system: &System) -> Option<Record> {
    number(system.reactions.as_ref())?;
    let layout = context.layout;
    let name = layout.name.to_string();
    let fields = context.velocity.fields.iter().map(|field| {
        let forces = if field.is_family() { "forces" } else { "force" };
        field.described(&format!(" The constraint {forces} along `{}`.", plain(&field.ident)))
    });
    Some(Record {
        name: layout.types.reactions.clone(),
        doc: format!(
            "The constraint forces of [`{name}`] along its sections: each times the quasi-velocity of the \
             same name is a power."
        ),
        fields: fields.collect(),
    })
}

/// The struct of the constraints' left-hand sides less their right-hand sides, if a state can be off.
pub(super) fn residual(context: &Context, system: &System) -> Option<Record> {
    let count = number(system.residual.as_ref())?;
    let name = context.layout.name.to_string();
    Some(Record {
        name: context.layout.types.residual.clone(),
        doc: format!("The constraints of [`{name}`] at a state: left-hand sides less right-hand sides."),
        fields: fields(&system.model, count, "residual of the constraint"),
    })
}

/// How many numbers a function computes, if any.
fn number(procedure: Option<&Procedure>) -> Option<usize> {
    procedure.map(|procedure| procedure.outputs.len()).filter(|count| *count > 0)
}

/// A field for each constraint, by its label, or `constraint_1`, ….
fn fields(model: &Model, count: usize, what: &str) -> Vec<Field> {
    let declared = model.constraints.len() == count;
    let mut labels: Vec<Option<&str>> = vec![None; count];
    if declared {
        labels = model.constraints.iter().map(|constraint| constraint.label.as_deref()).collect();
    }
    let mut taken: BTreeSet<String> = labels.iter().flatten().map(|label| (*label).to_owned()).collect();
    let mut fields = Vec::with_capacity(count);
    for (index, label) in labels.into_iter().enumerate() {
        let number = index + 1;
        let (name, doc) = match label {
            Some(label) => (label.to_owned(), format!(" The {what} `{label}`.")),
            None if declared => (unused(number, &mut taken), format!(" The {what} number {number}.")),
            None => (unused(number, &mut taken), format!(" The {what} number {number} of those derived.")),
        };
        let family = Family { ident: ident(&name), lengths: Vec::new(), docs: TokenStream::new() };
        fields.push(Field::of(&family, "").described(&doc));
    }
    fields
}

/// `constraint_1`, unless that is a label.
fn unused(number: usize, taken: &mut BTreeSet<String>) -> String {
    let mut name = format!("constraint_{number}");
    while !taken.insert(name.clone()) {
        name.push('_');
    }
    name
}

/// The identifier of a field, raw where it has to be.
fn ident(name: &str) -> Ident {
    let name = name.strip_prefix("r#").unwrap_or(name);
    syn::parse_str::<Ident>(name).unwrap_or_else(|_| Ident::new_raw(name, Span::call_site()))
}

/// A struct, the function that computes it, and the method's name, documentation, and input.
type Entry<'a> = (Option<Record>, &'a Option<Procedure>, &'static str, &'static [&'static str], bool);

/// The inherent methods `multipliers`, `reactions` and `constraint_residual`, and their structs.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let heads: [Entry; 3] = [
        (
            multipliers(context, system),
            &system.multipliers,
            "multipliers",
            &[" The multipliers of the constraints, with their sign in +λ ∂φ/∂y on the side of the forces."],
            true,
        ),
        (
            reactions(context, system),
            &system.reactions,
            "reactions",
            &[" The forces along the sections by which the constraints are kept."],
            true,
        ),
        (
            residual(context, system),
            &system.residual,
            "constraint_residual",
            &[" The constraints at a state: left-hand side less right-hand side, zero where they hold."],
            false,
        ),
    ];
    let mut part = Part::default();
    for (record, procedure, name, doc, takes_input) in heads {
        let (Some(record), Some(procedure)) = (record, procedure) else { continue };
        let program = program(&system.model, procedure);
        let body = body(context, scope, &program);
        let result = record.construct(&record.name.to_token_stream(), &body.outputs);
        let statements = &body.statements;
        let head = Head { name, doc, takes_input, returns: context.type_of(&record) };
        part.methods.extend(head.with_body(context, &body.used, &quote!(#statements #result)));
        part.items.extend(record.emit(context));
        part.programs.push((name, program));
    }
    part
}

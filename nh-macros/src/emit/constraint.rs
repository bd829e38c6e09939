//! The constraints: their multipliers, the forces that they exert, and what a state leaves of them.

use std::collections::BTreeSet;

use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::Formulation;
use nonholonomic_core::system::System;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};

use super::context::Context;
use super::function::{Head, Part, program};
use super::layout::{Family, plain};
use super::program::body;
use super::record::{Field, Record};
use super::scope::Scope;

/// The struct of the multipliers; nothing if there are no constraints.
fn multipliers(context: &Context, labels: &[Option<&str>], count: usize) -> Option<Record> {
    let name = context.layout.name.to_string();
    (count > 0).then(|| Record {
        name: context.layout.types.multipliers.clone(),
        doc: format!("The multipliers of the constraints of [`{name}`], which enter as +λ ∂φ/∂y."),
        fields: fields(labels, count, "multiplier of the constraint"),
    })
}

/// The struct of the reaction forces.
fn reactions(context: &Context) -> Record {
    let layout = context.layout;
    let name = layout.name.to_string();
    let fields = context.velocity.fields.iter().map(|field| {
        let forces = if field.is_family() { "forces" } else { "force" };
        field.described(&format!(" The constraint {forces} along `{}`.", plain(&field.ident)))
    });
    Record {
        name: layout.types.reactions.clone(),
        doc: format!(
            "The constraint forces of [`{name}`] along its sections: each times the quasi-velocity of the \
             same name is a power."
        ),
        fields: fields.collect(),
    }
}

/// The struct of the constraints' left-hand sides less their right-hand sides, if a state can be off.
fn residual(context: &Context, labels: &[Option<&str>], count: usize) -> Option<Record> {
    let name = context.layout.name.to_string();
    (count > 0).then(|| Record {
        name: context.layout.types.residual.clone(),
        doc: format!("The constraints of [`{name}`] at a state: left-hand sides less right-hand sides."),
        fields: fields(labels, count, "residual of the constraint"),
    })
}

/// How many numbers a function computes.
fn number(procedure: Option<&Procedure>) -> usize {
    procedure.map_or(0, |procedure| procedure.outputs.len())
}

/// The labels of the declared constraints, and of the levels that are kept like them.
fn labels(system: &System) -> Vec<Option<&str>> {
    let model = &system.model;
    let mut labels: Vec<Option<&str>> =
        model.constraints.iter().map(|constraint| constraint.label.as_deref()).collect();
    if system.formulation == Formulation::Projected {
        labels.extend(model.routh.iter().map(|level| Some(level.symmetry.as_str())));
    }
    labels
}

/// A field for each constraint, by its label, or `constraint_1`, ….
fn fields(labels: &[Option<&str>], count: usize, what: &str) -> Vec<Field> {
    let declared = labels.len() >= count;
    let labels = if declared { labels[..count].to_vec() } else { vec![None; count] };
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
pub(super) fn ident(name: &str) -> Ident {
    let name = name.strip_prefix("r#").unwrap_or(name);
    syn::parse_str::<Ident>(name).unwrap_or_else(|_| Ident::new_raw(name, Span::call_site()))
}

/// A method about the constraints and the struct that it returns.
struct Entry {
    record: Record,
    name: &'static str,
    doc: &'static [&'static str],
    takes_input: bool,
}

impl Entry {
    fn head(&self, context: &Context) -> Head {
        let Self { record, name, doc, takes_input } = self;
        Head { name, doc, takes_input: *takes_input, returns: context.type_of(record) }
    }
}

/// The methods `multipliers`, `reactions` and `constraint_residual` with the numbers of their
/// results; nothing for none.
fn entries(context: &Context, labels: &[Option<&str>], counts: [usize; 3]) -> [Option<Entry>; 3] {
    let [of_multipliers, of_reactions, of_residual] = counts;
    let multipliers = multipliers(context, labels, of_multipliers).map(|record| Entry {
        record,
        name: "multipliers",
        doc: &[" The multipliers of the constraints, with their sign in +λ ∂φ/∂y on the side of the forces."],
        takes_input: true,
    });
    let reactions = (of_reactions > 0).then(|| Entry {
        record: reactions(context),
        name: "reactions",
        doc: &[" The forces along the sections by which the constraints are kept."],
        takes_input: true,
    });
    let residual = residual(context, labels, of_residual).map(|record| Entry {
        record,
        name: "constraint_residual",
        doc: &[" The constraints at a state: left-hand side less right-hand side, zero where they hold."],
        takes_input: false,
    });
    [multipliers, reactions, residual]
}

/// The inherent methods and their structs.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let procedures = [&system.multipliers, &system.reactions, &system.residual].map(Option::as_ref);
    let mut part = Part::default();
    for (entry, procedure) in entries(context, &labels(system), procedures.map(number)).iter().zip(procedures)
    {
        let (Some(entry), Some(procedure)) = (entry, procedure) else { continue };
        let program = program(&system.model, procedure);
        let body = body(context, scope, &program);
        let result = entry.record.construct(&entry.record.name.to_token_stream(), &body.outputs);
        let statements = &body.statements;
        let method = entry.head(context).with_body(context, &body.used, &quote!(#statements #result));
        part.methods.extend(method);
        part.items.extend(entry.record.emit(context));
        part.programs.push((entry.name, program));
    }
    part
}

/// The same with zeros.
pub(super) fn stub(context: &Context, labels: &[Option<&str>], counts: [usize; 3]) -> Part {
    let mut part = Part::default();
    for entry in entries(context, labels, counts).iter().flatten() {
        let default = quote!(::core::default::Default::default());
        part.methods.extend(entry.head(context).with_body(context, &BTreeSet::new(), &default));
        part.items.extend(entry.record.emit(context));
    }
    part
}

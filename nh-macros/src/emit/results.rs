//! The structs that functions give, beside state, velocities and outputs.

use std::collections::BTreeSet;

use nonholonomic_core::functions::{self, MULTIPLIERS, REACTIONS, RESIDUAL};
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::model::{Formulation, Request};
use nonholonomic_core::system::System;
use proc_macro2::{Ident, Span, TokenStream};

use super::labels::{Group, flat, grouped, with_suffix};
use super::layout::{Family, plain};
use super::record::{Field, Record};
use super::setting::{Context, coordinate_fields};
use crate::resolve::Outline;

/// The structs of one system.
pub(super) struct Results(Vec<(functions::Record, Record)>);

impl Results {
    /// Those of a derived system.
    pub(super) fn of(context: &Context, system: &System) -> Self {
        let labels = labels(system);
        let number = |signature| {
            system
                .functions
                .get(signature)
                .map_or(0, |f: &nonholonomic_core::mechanics::Procedure| f.outputs.len())
        };
        let mut found = Self(Vec::new());
        found.add_if(functions::Record::Multipliers, multipliers(context, &labels, number(&MULTIPLIERS)));
        if number(&REACTIONS) > 0 {
            found.add(functions::Record::Reactions, reactions(context));
        }
        let named = (system.positions.is_some()).then(|| residual_names(system));
        let named = named.iter().flatten().map(|name| Some(name.as_str())).collect::<Vec<_>>();
        let of_residual = if named.is_empty() { labels.as_slice() } else { named.as_slice() };
        found.add_if(functions::Record::Residual, residual(context, of_residual, number(&RESIDUAL)));
        if !system.momenta.is_empty() && system.functions.get(&functions::MOMENTA).is_some() {
            found.add(functions::Record::Momenta, momenta(context, &system.momenta));
        }
        found.add_along(context, &system.quadratures, &system.gyroscopic);
        if let Some(procedure) = system.functions.get(&functions::POWER) {
            let directions = super::power::directions_of_forces(&system.model);
            let constraints = procedure.outputs.len().saturating_sub(directions.len());
            found.add_if(functions::Record::PowerOfForces, super::power::of_forces(context, &directions));
            let record = super::power::of_constraints(context, fields(&labels, constraints, "power"));
            found.add_if(functions::Record::PowerOfConstraints, record);
        }
        found
    }

    /// Those of a declaration in error. What stands there in vain does no harm.
    pub(super) fn expected(context: &Context, outline: &Outline) -> Self {
        let labels: Vec<Option<&str>> = outline.labels.iter().map(Option::as_deref).collect();
        let asked = |request| outline.requests.contains(&request);
        let count = |is_there| if is_there { labels.len() } else { 0 };
        let mut found = Self(Vec::new());
        let of_multipliers = multipliers(context, &labels, count(asked(Request::Multipliers)));
        found.add_if(functions::Record::Multipliers, of_multipliers);
        if asked(Request::Reactions) {
            found.add(functions::Record::Reactions, reactions(context));
        }
        found.add_if(functions::Record::Residual, residual(context, &labels, labels.len()));
        if !outline.momenta.is_empty() {
            found.add(functions::Record::Momenta, momenta(context, &outline.momenta));
        }
        found.add_along(context, &outline.quadratures, &outline.gyroscopic);
        if asked(Request::Power) {
            let of_forces = super::power::of_forces(context, &outline.directions);
            found.add_if(functions::Record::PowerOfForces, of_forces);
            let of_constraints =
                super::power::of_constraints(context, fields(&labels, labels.len(), "power"));
            found.add_if(functions::Record::PowerOfConstraints, of_constraints);
        }
        found
    }

    /// The structs with a field for each of some coordinates.
    fn add_along(&mut self, context: &Context, quadratures: &[SymbolId], gyroscopic: &[SymbolId]) {
        let types = &context.layout.types;
        if !quadratures.is_empty() {
            let about = "The rates of the coordinates that are not in the state";
            let what = "rate of the coordinate";
            let record = of_coordinates(context, &types.quadratures, about, quadratures, what);
            self.add(functions::Record::Quadratures, record);
        }
        if !gyroscopic.is_empty() {
            let (about, what) = ("The gyroscopic force of the constraints", "force along the coordinate");
            let record = of_coordinates(context, &types.gyroscopic, about, gyroscopic, what);
            self.add(functions::Record::Gyroscopic, record);
        }
    }

    fn add(&mut self, kind: functions::Record, record: Record) {
        self.0.push((kind, record));
    }

    fn add_if(&mut self, kind: functions::Record, record: Option<Record>) {
        self.0.extend(record.map(|record| (kind, record)));
    }

    /// The struct of a kind, if there is one.
    pub(super) fn get<'a>(&'a self, context: &'a Context, kind: functions::Record) -> Option<&'a Record> {
        match kind {
            functions::Record::State => Some(&context.state),
            functions::Record::Velocity => Some(&context.velocity),
            functions::Record::Outputs => context.outputs.as_ref(),
            _ => self.0.iter().find(|(known, _)| *known == kind).map(|(_, record)| record),
        }
    }

    /// Their declarations.
    pub(super) fn emit(&self, context: &Context) -> TokenStream {
        self.0.iter().map(|(_, record)| record.emit(context)).collect()
    }
}

/// The struct of the multipliers; nothing if there are no constraints.
fn multipliers(context: &Context, labels: &[Option<&str>], count: usize) -> Option<Record> {
    let name = context.layout.name.to_string();
    (count > 0).then(|| Record {
        name: context.layout.types.multipliers.clone(),
        doc: format!("The multipliers of the constraints of [`{name}`], which enter as +λ ∂φ/∂y."),
        fields: fields(labels, count, "multiplier"),
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
        fields: fields(labels, count, "residual"),
    })
}

/// The struct of the momenta.
fn momenta(context: &Context, names: &[String]) -> Record {
    let fields = names.iter().map(|name| {
        let field = name.replace('[', "_").replace(']', "");
        let family =
            Family { ident: ident(&field), lengths: Vec::new(), docs: TokenStream::new(), units: Vec::new() };
        Field::of(&family, "").described(&format!(" Of the symmetry `{name}`."))
    });
    let name = context.layout.name.to_string();
    Record {
        name: context.layout.types.momenta.clone(),
        doc: format!("The momenta σ · ∂L/∂y of the sections σ of [`{name}`], or their rates."),
        fields: fields.collect(),
    }
}

/// A struct with a component for each of some coordinates.
fn of_coordinates(
    context: &Context,
    name: &Ident,
    about: &str,
    coordinates: &[SymbolId],
    what: &str,
) -> Record {
    Record {
        name: name.clone(),
        doc: format!("{about} of [`{}`].", context.layout.name),
        fields: coordinate_fields(context.layout, coordinates, what),
    }
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

/// The names of what `constraint_residual` gives where there are position constraints: these by the names of
/// their multipliers, those without one behind them, then velocity forms as rates, `closure_dot`, and the other
/// constraints.
pub(super) fn residual_names(system: &System) -> Vec<String> {
    let Some(positions) = &system.positions else { return Vec::new() };
    let count = system.model.positions.len();
    let labels = labels(system);
    let of_multipliers: Vec<String> =
        fields(&labels, labels.len(), "").iter().flat_map(Field::names).cloned().collect();
    let (forms, others) = of_multipliers.split_at(count.min(of_multipliers.len()));
    let mut names: Vec<String> = forms.to_vec();
    let followers = positions.redundant.iter().enumerate();
    names.extend(
        followers.map(|(index, label)| label.clone().unwrap_or_else(|| format!("redundant_{}", index + 1))),
    );
    if system.formulation == Formulation::Projected {
        names.extend(forms.iter().map(|form| with_suffix(form, "_dot")));
        names.extend(others.iter().cloned());
    }
    let mut taken = BTreeSet::new();
    for name in &mut names {
        while !taken.insert(name.clone()) {
            *name = flat(name) + "_";
        }
    }
    names
}

/// A field for each label, or `constraint_1`, …; `what` is what it holds for each of its constraints.
fn fields(labels: &[Option<&str>], count: usize, what: &str) -> Vec<Field> {
    let declared = labels.len() >= count;
    let labels = if declared { labels[..count].to_vec() } else { vec![None; count] };
    let groups = grouped(&labels);
    let mut taken: BTreeSet<String> = groups.iter().filter_map(|group| group.name.clone()).collect();
    let mut fields = Vec::with_capacity(groups.len());
    for Group { name, lengths, places } in groups {
        let number = places.start + 1;
        let (name, doc) = match name {
            Some(name) if lengths.is_empty() => {
                let doc = format!(" The {what} of the constraint `{name}`.");
                (name, doc)
            }
            Some(name) => {
                let doc = format!(" The {what}s of the constraints `{name}`.");
                (name, doc)
            }
            None if declared => {
                (unused(number, &mut taken), format!(" The {what} of the constraint number {number}."))
            }
            None => (
                unused(number, &mut taken),
                format!(" The {what} of the constraint number {number} of those derived."),
            ),
        };
        let family = Family { ident: ident(&name), lengths, docs: TokenStream::new(), units: Vec::new() };
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

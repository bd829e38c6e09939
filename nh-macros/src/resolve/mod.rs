//! Stage 2, resolve: [`SystemDecl`] to [`Model`], span table and [`Layout`].
//!
//! After this point there are no identifiers and no tokens but in the layout; positions are opaque
//! origins. Every section is read on its own, so that one mistake does not hide another.

mod alike;
mod arithmetic;
mod array;
mod attitudes;
mod auxiliary;
mod between_sections;
mod bodies;
mod brackets;
mod calls;
mod choices;
mod context;
mod declare;
mod declared_impacts;
mod definitions;
mod dimensions;
mod dropped;
mod dynamics;
mod expression;
mod facts;
mod frame;
mod holonomic;
mod homogeneity;
mod index;
mod kept_variables;
mod kinematics;
mod methods;
mod origins;
mod other_lengths;
mod outline;
mod partial;
mod places;
mod product;
mod rate;
mod related_systems;
mod reports;
mod resolver;
mod rotations;
mod scope;
mod shared;
mod statements;
mod symmetries;
mod tensors;
mod track;
mod turns;
mod uncalled;
mod vectors;
mod written;

#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use nonholonomic_core::algebra::Facts;
use nonholonomic_core::id::{Origin, SymbolId};
use nonholonomic_core::model::{Located, Model, Request};

pub(crate) use self::dropped::resolve_quotient;
pub(crate) use self::origins::Origins;
pub(crate) use self::other_lengths::told_of_lengths;
pub(crate) use self::outline::{Outline, OutlinedImpact};
pub(crate) use self::related_systems::{Unrelated, resolve_morphism};
use self::resolver::{Resolver, Tables};
use crate::emit::Layout;
use crate::report::Diagnostic;
use crate::syntax::ast::{Scalar, SystemDecl};

/// A declaration with its names resolved.
#[derive(Debug)]
pub(crate) struct Resolved {
    /// What the engine reads.
    pub(crate) model: Model,
    /// What the origins of the model are in the declaration.
    pub(crate) origins: Origins,
}

/// A declaration in error.
#[derive(Debug)]
pub(crate) struct Unresolved {
    /// What is wrong.
    pub(crate) errors: Vec<Diagnostic>,
    /// What is known, of which parts in error are left out: what stubs are made of.
    pub(crate) model: Box<Model>,
    /// The steps that were taken.
    pub(crate) steps: usize,
}

/// Resolves a declaration. The layout starts from that of the struct; what is known of it is
/// filled in also in case of errors, for stubs to be made of.
pub(crate) fn resolve(declaration: &SystemDecl, layout: &mut Layout) -> Result<Resolved, Unresolved> {
    let mut resolver = Resolver::new(choices::whole(declaration));
    resolver.homogeneity.wanted = declaration.sections.units.is_some();
    resolver.declare(declaration, layout);
    resolver.surroundings(declaration, layout);
    let model = resolver.model(declaration, layout);
    let Resolver { origins, reports, .. } = resolver;
    let steps = reports.steps_taken();
    match reports.finish(()) {
        Ok(()) => Ok(Resolved { model, origins }),
        Err(errors) => Err(Unresolved { errors, model: Box::new(model), steps }),
    }
}

impl Resolver {
    /// The parameters that stand in no expression.
    fn idle(&self, declaration: &SystemDecl) -> BTreeSet<String> {
        let fields = declaration.structure.parameters.iter().map(|declared| declared.name.text.clone());
        fields.filter(|name| !self.mentioned.contains(name)).collect()
    }

    /// The inputs that stand in no expression.
    fn idle_inputs(&self, declaration: &SystemDecl) -> Vec<String> {
        let declared = declaration.sections.inputs.iter().flat_map(|section| &section.body);
        let names = declared.map(|declared| declared.name.text.clone());
        names.filter(|name| !self.mentioned.contains(name)).collect()
    }

    /// What `emit` asks for.
    fn asked(&mut self, declaration: &SystemDecl) -> Vec<(Request, Origin)> {
        let sections = &declaration.sections;
        let generic = matches!(declaration.structure.scalar, Scalar::Parameter(_));
        let constrained =
            sections.constraints.is_some() || sections.distribution.is_some() || sections.holonomic.is_some();
        sections.emit.as_ref().map(|s| self.requests(&s.body, constrained, generic)).unwrap_or_default()
    }

    /// The model, of which parts in error are left out.
    fn model(&mut self, declaration: &SystemDecl, layout: &mut Layout) -> Model {
        let sections = &declaration.sections;
        let kinematics = self.kinematics(declaration, layout);
        let identities = sections.on.as_ref().map(|s| self.identities(&s.body)).unwrap_or_default();
        let brackets = self.brackets(&sections.brackets);
        layout.frame = sections.frame.as_ref().map(|s| self.frame(&s.body)).unwrap_or_default();
        let distribution = sections.distribution.as_ref().map(|section| self.distribution(section));
        let lagrangian = sections.lagrangian.as_ref().and_then(|s| self.lagrangian(&s.body).ok());
        let mut labels = holonomic::Labels::default();
        let positions = sections.holonomic.as_ref().map(|s| self.positions(&s.body, &mut labels));
        let (positions, redundant) = positions.unwrap_or_default();
        let constraints = sections.constraints.as_ref();
        let constraints =
            constraints.map(|s| self.constraints(&s.body, &sections.lost, &kinematics, &mut labels));
        let constraints = self.with_velocity_forms(&positions, constraints.unwrap_or_default());
        let impacts = sections.impacts.as_ref().map(|s| self.impacts(&s.body)).unwrap_or_default();
        let forces = sections.forces.as_ref().map(|s| self.forces(&s.body)).unwrap_or_default();
        if let Some(section) = &sections.auxiliary {
            self.auxiliary(&section.body);
        }
        let outputs = sections.outputs.as_ref().map(|s| self.outputs(&s.body, layout)).unwrap_or_default();
        sections.derivative.iter().for_each(|section| self.derivatives(&section.body));
        layout.methods = std::mem::take(&mut self.methods);
        let claims = sections.conserved.as_ref().map(|s| self.claims(&s.body)).unwrap_or_default();
        let (symmetries, broken) =
            sections.symmetries.as_ref().map(|s| self.symmetries(&s.body)).unwrap_or_default();
        let volume = sections.volume.as_ref().and_then(|claim| self.volume(claim).ok());
        let hamilton_jacobi = sections.hamilton_jacobi.as_ref().map(|s| self.hamilton_jacobi(s));
        let routh =
            sections.routh.as_ref().map(|s| self.routh(&s.body, (&symmetries, &broken))).unwrap_or_default();
        let assumptions = sections.assume.as_ref().map(|s| self.assumptions(&s.body)).unwrap_or_default();
        let requests = self.asked(declaration);
        self.unused();
        let orthonormal = sections.orthonormal.as_ref().map(|s| self.orthonormal(s, layout));
        let tracked = sections.track.as_ref().map(|s| self.tracked(s, &outputs));
        let linearization = sections.linearization.as_ref().map(|s| self.linearization(s));
        let (chart, independent) = self.independent(sections);
        let formulation = sections.formulation.as_ref().map(|s| self.formulation(s));
        let accuracy = sections.accuracy.as_ref().map(|s| self.accuracy(s)).unwrap_or_default();
        self.graph.set_accuracy(accuracy);
        layout.idle = self.idle(declaration);
        let named = dimensions::Named {
            outputs: &outputs,
            claims: &claims,
            constraints: &constraints,
            symmetries: &symmetries,
            impulses: &self.impulses(&impacts),
            orthonormal: orthonormal.as_ref().map_or(&[], |(symbols, _)| symbols),
        };
        let units = sections.units.as_ref().map(|s| self.units(&s.body, &named, layout)).unwrap_or_default();
        let lagrangian = lagrangian.unwrap_or(Located { value: self.time(), origin: Self::whole() });
        let tables = std::mem::take(&mut self.tables);
        know_symbols(layout, &tables, orthonormal.as_ref());
        Model {
            graph: std::mem::take(&mut self.graph),
            name: declaration.structure.name.to_string(),
            origin: Self::whole(),
            time: self.time,
            parameters: tables.parameters,
            coordinates: tables.coordinates,
            sections: tables.sections,
            inputs: tables.inputs,
            auxiliary: tables.auxiliary,
            identities,
            kinematics,
            brackets,
            brackets_declared: !sections.brackets.is_empty(),
            almost: sections.almost.is_some(),
            calls: std::mem::take(&mut self.calls),
            dropped: std::mem::take(&mut self.dropped),
            shortened: Vec::new(),
            claimed: std::mem::take(&mut self.claimed),
            symmetric: std::mem::take(&mut self.symmetric),
            bodies: std::mem::take(&mut self.bodies),
            frame: tables.frame,
            lagrangian,
            positions,
            redundant,
            constraints,
            impacts,
            distribution,
            forces,
            outputs,
            claims,
            symmetries,
            volume,
            hamilton_jacobi,
            routh,
            assumptions,
            facts: Facts::default(),
            requests,
            tracked,
            linearization,
            orthonormal,
            independent,
            chart,
            formulation,
            units,
            idle: layout.idle.iter().cloned().collect(),
            idle_inputs: self.idle_inputs(declaration),
        }
    }
}

/// Tells the layout what the engine knows the entries of its families by.
fn know_symbols(layout: &mut Layout, tables: &Tables, orthonormal: Option<&(Vec<SymbolId>, Origin)>) {
    let declared = tables.sections.iter().map(|section| section.symbol);
    let frame = tables.frame.iter().map(|section| section.symbol);
    let basis = orthonormal.into_iter().flat_map(|(symbols, _)| symbols.iter().copied());
    layout.velocity_symbols = declared.chain(frame).chain(basis).collect();
    layout.coordinate_symbols = tables.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    layout.auxiliary_symbols = tables.auxiliary.iter().map(|state| state.symbol).collect();
}

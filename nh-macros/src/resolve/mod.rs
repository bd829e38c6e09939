//! Stage 2, resolve: [`SystemDecl`] to [`Model`], span table and [`Layout`].
//!
//! After this point there are no identifiers and no tokens but in the layout; positions are opaque
//! origins. Every section is read on its own, so that one mistake does not hide another.

mod arithmetic;
mod array;
mod brackets;
mod choices;
mod context;
mod declare;
mod definitions;
mod dynamics;
mod expression;
mod facts;
mod frame;
mod function;
mod index;
mod items;
mod kinematics;
mod origins;
mod places;
mod product;
mod reports;
mod resolver;
mod scope;

#[cfg(test)]
mod tests;

use nh_core::id::SectionId;
use nh_core::model::{Formulation, Located, Model};

pub(crate) use self::origins::Origins;
use self::resolver::Resolver;
use crate::emit::{Family, Layout};
use crate::report::Diagnostic;
use crate::syntax::ast::SystemDecl;

/// A declaration with its names resolved.
#[derive(Debug)]
pub(crate) struct Resolved {
    /// What the engine reads.
    pub(crate) model: Model,
    /// What the origins of the model are in the declaration.
    pub(crate) origins: Origins,
    /// The families of the sections of the frame, with entries in the order of the model.
    #[allow(dead_code, reason = "frames are not emitted yet")]
    pub(crate) frame: Vec<Family>,
}

/// A declaration in error.
#[derive(Debug)]
pub(crate) struct Unresolved {
    /// What is wrong.
    pub(crate) errors: Vec<Diagnostic>,
    /// The velocities that the state would probably have: what stubs are made of.
    pub(crate) kept: Vec<SectionId>,
}

/// Resolves a declaration. The layout starts from that of the struct; what is known of it is
/// filled in also in case of errors, for stubs to be made of.
pub(crate) fn resolve(declaration: &SystemDecl, layout: &mut Layout) -> Result<Resolved, Unresolved> {
    let mut resolver = Resolver::new(choices::whole(declaration));
    resolver.declare(declaration, layout);
    resolver.surroundings(declaration, layout);
    let (model, frame) = resolver.model(declaration, layout);
    let kept = probable_state(&model);
    let Resolver { origins, reports, .. } = resolver;
    reports.finish(Resolved { model, origins, frame }).map_err(|errors| Unresolved { errors, kept })
}

impl Resolver {
    /// The model, of which parts in error are left out, and the families of the frame.
    fn model(&mut self, declaration: &SystemDecl, layout: &mut Layout) -> (Model, Vec<Family>) {
        let sections = &declaration.sections;
        let kinematics = self.kinematics(declaration, layout);
        let identities = sections.on.as_ref().map(|s| self.identities(&s.body)).unwrap_or_default();
        let brackets = self.brackets(&sections.brackets);
        let frame = sections.frame.as_ref().map(|s| self.frame(&s.body)).unwrap_or_default();
        let distribution = sections.distribution.as_ref().map(|s| self.distribution(&s.body));
        let lagrangian = sections.lagrangian.as_ref().and_then(|s| self.lagrangian(&s.body).ok());
        let constraints =
            sections.constraints.as_ref().map(|s| self.constraints(&s.body, &kinematics)).unwrap_or_default();
        let forces = sections.forces.as_ref().map(|s| self.forces(&s.body)).unwrap_or_default();
        let outputs = sections.outputs.as_ref().map(|s| self.outputs(&s.body, layout)).unwrap_or_default();
        let claims = sections.conserved.as_ref().map(|s| self.claims(&s.body)).unwrap_or_default();
        let assumptions = sections.assume.as_ref().map(|s| self.assumptions(&s.body)).unwrap_or_default();
        let requests = sections.emit.as_ref().map(|s| self.requests(&s.body)).unwrap_or_default();
        let independent = sections.independent.as_ref().map(|s| self.independent(&s.body));
        let formulation = sections.formulation.as_ref().map(|s| self.formulation(s));
        let origin = Self::whole();
        let lagrangian = lagrangian.unwrap_or(Located { value: self.time(), origin });
        let tables = std::mem::take(&mut self.tables);
        let model = Model {
            graph: std::mem::take(&mut self.graph),
            name: declaration.structure.name.to_string(),
            origin,
            time: self.time,
            parameters: tables.parameters,
            coordinates: tables.coordinates,
            sections: tables.sections,
            inputs: tables.inputs,
            identities,
            kinematics,
            brackets,
            brackets_declared: !sections.brackets.is_empty(),
            almost: sections.almost.is_some(),
            calls: std::mem::take(&mut self.calls),
            frame: tables.frame,
            lagrangian,
            constraints,
            distribution,
            forces,
            outputs,
            claims,
            assumptions,
            requests,
            independent,
            formulation,
        };
        (model, frame)
    }
}

/// The velocities that the state of a declaration in error would probably have.
pub(crate) fn probable_state(model: &Model) -> Vec<SectionId> {
    if let Some(named) = &model.independent {
        let is_named = |symbol| named.iter().any(|(velocity, _)| *velocity == symbol);
        return model.sections.iter_ids().filter(|(_, s)| is_named(s.symbol)).map(|(id, _)| id).collect();
    }
    let mut kept: Vec<SectionId> = model.sections.ids().collect();
    if !matches!(model.formulation, Some((Formulation::Projected, _))) {
        for constraint in &model.constraints {
            let solved = kept.iter().position(|id| Some(model.sections[*id].symbol) == constraint.solved_for);
            let removed = solved.or(kept.len().checked_sub(1));
            removed.map(|position| kept.remove(position));
        }
    }
    kept
}

//! What claims refer to that the functions do not hold themselves: the declared data, as they are written.

use super::super::Proved;
use super::super::differentiated::returned;
use super::super::kept_volume::vanishing;
use super::Derivatives;
use crate::choose::AppliedForce;
use crate::id::{CoordId, ExprId, Id, SymbolId};
use crate::model::ForceDecl;

/// The declared data.
pub(super) struct Declared {
    /// The variables of the state, then the inputs.
    pub(super) arguments: Vec<SymbolId>,
    pub(super) state: Vec<SymbolId>,
    /// The coordinates, the velocities where a projection starts, and the rest of the state.
    pub(super) moved: Vec<SymbolId>,
    pub(super) parameters: Vec<SymbolId>,
    /// The symbols of ẋ.
    pub(super) rates: Vec<SymbolId>,
    pub(super) identities: Vec<ExprId>,
    /// What volumes are divided by.
    pub(super) vanishing: Vec<ExprId>,
    pub(super) outputs: Vec<ExprId>,
    pub(super) forces: Vec<AppliedForce>,
    /// σ and f of each momentum.
    pub(super) sections: Vec<(Vec<ExprId>, Option<ExprId>)>,
    /// α_a of a claimed section of D*.
    pub(super) claimed: Vec<ExprId>,
    /// The coordinates along which the gyroscopic force acts.
    pub(super) gyroscopic: Vec<CoordId>,
    /// What `constraint_residual` gives: positions, then velocities where the state does not solve these.
    pub(super) residuals: Vec<ExprId>,
    /// Ψ y + b of the rows of each impact.
    pub(super) impacts: Vec<Vec<ExprId>>,
    /// The constraints among the residuals of the reference.
    pub(super) constraints: usize,
}

impl Declared {
    pub(super) fn of(proved: &mut Proved, found: &Derivatives) -> Self {
        let Derivatives { given, parts } = found;
        let forces = forces(proved);
        let Proved { model, symmetries, positions, constraints, impacts, .. } = proved;
        let forms = impacts.iter().map(|impact| impact.rows.iter().map(|row| row.form).collect());
        let impacts = forms.collect();
        let zero = model.graph.zero();
        let section = model.hamilton_jacobi.as_ref();
        let component = |velocity: &SymbolId| {
            let components = section.iter().flat_map(|claim| &claim.components);
            components.filter(|(known, _)| known == velocity).map(|(_, value)| value.value).next()
        };
        let claimed = given.velocities.iter().map(|velocity| component(velocity).unwrap_or(zero)).collect();
        let coordinates: Vec<SymbolId> =
            model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        let auxiliary = model.auxiliary.iter().map(|state| state.symbol);
        let state: Vec<SymbolId> =
            coordinates.iter().copied().chain(given.velocities.iter().copied()).chain(auxiliary).collect();
        let inputs = model.inputs.iter().map(|input| input.symbol);
        let with_momentum = |name: &String| {
            let further = symmetries.found.iter().map(|(_, symmetry)| symmetry);
            let symmetry =
                symmetries.declared.iter().chain(further).find(|symmetry| symmetry.name == *name)?;
            let gauge = model.symmetries.iter().find(|symmetry| symmetry.name == *name);
            Some((symmetry.section.clone(), gauge.and_then(|symmetry| symmetry.gauge)))
        };
        let started = parts.projection.as_ref().map_or(&[][..], |projection| &projection.start);
        let moved = returned(model, started, given.velocities);
        let place = |symbol: &SymbolId| coordinates.iter().position(|known| known == symbol);
        let on_positions = model.positions.iter().chain(&positions.redundant).map(|position| position.value);
        Self {
            arguments: state.iter().copied().chain(inputs).collect(),
            state,
            moved,
            parameters: model.parameters.iter().map(|parameter| parameter.symbol).collect(),
            rates: model.coordinates.iter().map(|coordinate| coordinate.rate).collect(),
            identities: model.identities.iter().map(|identity| identity.value).collect(),
            vanishing: vanishing(model, given.formulation),
            outputs: model.outputs.iter().map(|output| output.value).collect(),
            forces,
            sections: parts.momenta.iter().filter_map(with_momentum).collect(),
            claimed,
            gyroscopic: parts.gyroscopic.iter().filter_map(place).map(CoordId::from_index).collect(),
            residuals: on_positions.chain(given.residuals.iter().copied()).collect(),
            impacts,
            constraints: constraints.residuals.len(),
        }
    }
}

/// The forces with the velocities along which they act.
fn forces(proved: &mut Proved) -> Vec<AppliedForce> {
    let forces = proved.model.forces.clone();
    let force = |force: &ForceDecl| AppliedForce { value: force.value, along: proved.along(force.direction) };
    forces.iter().map(force).collect()
}

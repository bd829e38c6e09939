//! What stubs are made of: a guess at the outcome of a declaration in error.

use nonholonomic_core::algebra::{Derivation, Graph};
use nonholonomic_core::id::{ExprId, Origin, SymbolId};
use nonholonomic_core::model::{
    AnchorDecl, ConstraintDecl, Formulation, ImpactDecl, ImpactRowDecl, Kinematics, Model, OutputDecl,
    Request, TrackedItem,
};
use nonholonomic_core::system::System;

use super::declare::DIMENSION;
use crate::emit::directions_of_forces;

/// The entries of a record beyond which there are more than a system can have: the declaration is refused, and a compiler
/// may run out of stack over what is derived for a record of many thousands.
const MOST: usize = 2 * DIMENSION;

/// The shape that the generated items of a declaration in error would probably have.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    /// The coordinates and velocities in the state.
    pub(crate) in_state: Vec<SymbolId>,
    /// The outputs that are kept, where `track` may leave some out.
    pub(crate) outputs: Option<Vec<String>>,
    /// What is to be generated beyond the default.
    pub(crate) requests: Vec<Request>,
    /// The labels of the constraints.
    pub(crate) labels: Vec<Option<String>>,
    /// What the forces act along.
    pub(crate) directions: Vec<String>,
    /// The coordinates along which the gyroscopic force acts.
    pub(crate) gyroscopic: Vec<SymbolId>,
    /// The coordinates that are left to quadratures.
    pub(crate) quadratures: Vec<SymbolId>,
    /// The rank of S = D ∩ V, and the number of the horizontal lifts.
    pub(crate) splitting: (usize, usize),
    /// The labels of the momenta.
    pub(crate) momenta: Vec<String>,
    /// The number of identities of the base.
    pub(crate) identities: usize,
    /// The number of velocities in the state.
    pub(crate) velocities: usize,
    /// Whether there are position constraints.
    pub(crate) has_positions: bool,
    /// How many variables a linearisation keeps.
    pub(crate) kept: Option<usize>,
    /// What velocities jump to.
    pub(crate) impacts: Vec<OutlinedImpact>,
    /// Whether a section of D* is claimed to solve the Hamilton–Jacobi equation.
    pub(crate) claims_section: bool,
}

/// The shape of an impact.
#[derive(Clone, Debug)]
pub(crate) struct OutlinedImpact {
    /// Its label.
    pub(crate) label: String,
    /// How many rows act together.
    pub(crate) rows: usize,
    /// How many of them are on positions.
    pub(crate) positions: usize,
}

fn outlined(model: &Model, impact: &ImpactDecl) -> OutlinedImpact {
    let rates = model.coordinates.iter().map(|coordinate| coordinate.rate);
    let sections = model.sections.iter().map(|section| section.symbol);
    let frame = model.frame.iter().map(|section| section.symbol);
    let moving: Vec<SymbolId> = rates.chain(sections).chain(frame).collect();
    let is_position = |row: &&ImpactRowDecl| {
        !model.graph.symbols_in(&[row.value]).iter().any(|symbol| moving.contains(symbol))
    };
    let positions = impact.rows.iter().filter(is_position).count();
    OutlinedImpact { label: impact.label.clone(), rows: impact.rows.len(), positions }
}

impl Outline {
    /// The outline of a model, of which parts in error are left out.
    pub(crate) fn of(model: &Model) -> Self {
        let labels = model.constraints.iter().map(|constraint| constraint.label.clone());
        let in_state = in_state(model);
        Self {
            outputs: kept_outputs(model, &in_state),
            in_state,
            requests: model.requests.iter().map(|(request, _)| *request).collect(),
            labels: labels.take(MOST).collect(),
            directions: directions_of_forces(model).into_iter().take(MOST).collect(),
            momenta: momenta(model),
            identities: model.identities.len().min(MOST),
            velocities: kept(model).len(),
            has_positions: !model.positions.is_empty(),
            kept: model.linearization.as_ref().map(|kept| linearized(model, &kept.variables)),
            impacts: model.impacts.iter().map(|impact| outlined(model, impact)).collect(),
            claims_section: model.hamilton_jacobi.is_some(),
            gyroscopic: Vec::new(),
            quadratures: Vec::new(),
            splitting: (0, 0),
        }
    }

    /// The same with what was derived of a declaration without what is claimed and asked for.
    pub(crate) fn derived(mut self, system: &System, with_momenta: bool) -> Self {
        self.in_state = system.state();
        self.outputs = Some(system.model.outputs.iter().map(|output| output.name.clone()).collect());
        self.velocities = system.state_velocities.len();
        if with_momenta {
            self.momenta.clone_from(&system.momenta);
        }
        self.gyroscopic.clone_from(&system.gyroscopic);
        self.quadratures.clone_from(&system.quadratures);
        let sizes = system.sizes();
        self.splitting = (sizes.vertical, sizes.lifted);
        let kept = system.linearization.as_ref().map(|linearization| linearization.kept.len());
        self.kept = self.kept.map(|guess| kept.unwrap_or(guess));
        self
    }
}

/// The declared symmetries; or the coordinates, which may be cyclic, if momenta are asked for.
fn momenta(model: &Model) -> Vec<String> {
    let asked = model.requests.iter().any(|(request, _)| *request == Request::Momenta);
    let mut names: Vec<String> = model.symmetries.iter().map(|symmetry| symmetry.name.clone()).collect();
    if names.is_empty() && asked {
        names.extend(model.coordinates.iter().map(|coordinate| coordinate.name.clone()));
    }
    names.truncate(MOST);
    names
}

/// The state: all of it, or what is tracked with what flows into it at once.
fn in_state(model: &Model) -> Vec<SymbolId> {
    let (gone, reduced) = reduced(model);
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.symbol);
    let coordinates = coordinates.filter(|symbol| !gone.contains(symbol));
    let velocities = kept(model).into_iter().filter(|symbol| !reduced.contains(symbol));
    let auxiliary = model.auxiliary.iter().map(|state| state.symbol);
    let Some(tracked) = &model.tracked else {
        return coordinates.chain(velocities).chain(auxiliary).collect();
    };
    let mut declared = vec![model.lagrangian.value];
    declared.extend(model.constraints.iter().map(|constraint| constraint.residual));
    declared.extend(model.forces.iter().map(|force| force.value));
    let mut needed = model.graph.symbols_in(&declared);
    for (item, _) in tracked {
        match item {
            TrackedItem::Variable(symbol) => needed.push(*symbol),
            TrackedItem::Output(index) => {
                let output = model.outputs.get(*index).map(|output| output.value);
                needed.extend(model.graph.symbols_in(output.as_slice()));
            }
        }
    }
    if let Kinematics::Anchor(lines) = &model.kinematics {
        // what flows into a coordinate by its rate takes its own rate along
        loop {
            let tracked = |line: &&AnchorDecl| needed.contains(&model.coordinates[line.coordinate].symbol);
            let rates: Vec<ExprId> = lines.iter().filter(tracked).map(|line| line.rate).collect();
            let known = needed.len();
            let found = model.graph.symbols_in(&rates).into_iter();
            let more: Vec<SymbolId> = found.filter(|symbol| !needed.contains(symbol)).collect();
            needed.extend(more);
            if needed.len() == known {
                break;
            }
        }
    }
    let auxiliary = auxiliary.filter(|symbol| needed.contains(symbol));
    coordinates.filter(|symbol| needed.contains(symbol)).chain(velocities).chain(auxiliary).collect()
}

/// The outputs that stand by variables of the state alone; nothing where all are kept, since all variables are.
fn kept_outputs(model: &Model, in_state: &[SymbolId]) -> Option<Vec<String>> {
    model.tracked.as_ref()?;
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.symbol);
    let mut missing = coordinates.chain(model.auxiliary.iter().map(|state| state.symbol)).collect::<Vec<_>>();
    missing.retain(|symbol| !in_state.contains(symbol));
    let is_kept = |output: &&OutputDecl| {
        !model.graph.symbols_in(&[output.value]).iter().any(|symbol| missing.contains(symbol))
    };
    Some(model.outputs.iter().filter(is_kept).map(|output| output.name.clone()).collect())
}

/// The coordinates and velocities that Routh reduction probably takes out of the state.
fn reduced(model: &Model) -> (Vec<SymbolId>, Vec<SymbolId>) {
    let (mut coordinates, mut velocities) = (Vec::new(), Vec::new());
    for level in &model.routh {
        let declared = model.symmetries.iter().find(|symmetry| symmetry.name == level.symmetry);
        let velocity = declared.and_then(|symmetry| model.graph.as_symbol(symmetry.value));
        let coordinate = model.coordinates.iter().find(|coordinate| match velocity {
            Some(velocity) => coordinate.rate == velocity,
            None => coordinate.name == level.symmetry,
        });
        coordinates.extend(coordinate.map(|coordinate| coordinate.symbol));
        velocities.extend(velocity.or(coordinate.map(|coordinate| coordinate.rate)));
    }
    (coordinates, velocities)
}

/// How many variables a linearisation keeps.
fn linearized(model: &Model, named: &[(SymbolId, Origin)]) -> usize {
    if !named.is_empty() {
        return named.len();
    }
    let coordinates = model.chart.as_ref().map_or(model.coordinates.len(), Vec::len);
    let velocities =
        if model.independent.is_none() && model.chart.is_some() { coordinates } else { kept(model).len() };
    coordinates + velocities + model.auxiliary.len()
}

/// The velocities in the state.
fn kept(model: &Model) -> Vec<SymbolId> {
    if let Some((symbols, _)) = &model.orthonormal {
        return symbols.clone();
    }
    if let Some(named) = model.independent.as_ref().or(model.distribution.as_ref()) {
        return named.iter().map(|(symbol, _)| *symbol).collect();
    }
    let all: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
    let projects = matches!(model.formulation, Some((Formulation::Projected, _)));
    if projects || (!model.positions.is_empty() && model.formulation.is_none()) {
        return all;
    }
    let mut kept = all.clone();
    let mut choice = Choice::of(model);
    for constraint in &model.constraints {
        match choice.eliminated(constraint, &kept) {
            Some(position) if position < kept.len() => _ = kept.remove(position),
            Some(_) => {}
            // no velocity can be eliminated everywhere: the state keeps them all
            None => return all,
        }
    }
    kept
}

/// Chooses what a constraint eliminates.
struct Choice<'a> {
    model: &'a Model,
    /// Derivatives are taken aside: the model stays as it was declared.
    graph: Option<Graph>,
}

impl<'a> Choice<'a> {
    fn of(model: &'a Model) -> Self {
        Self { model, graph: None }
    }

    /// The position among `kept` of the velocity that a constraint eliminates; nothing if it has none
    /// with a constant coefficient.
    fn eliminated(&mut self, constraint: &ConstraintDecl, kept: &[SymbolId]) -> Option<usize> {
        if let Some(solved) = kept.iter().position(|symbol| Some(*symbol) == constraint.solved_for) {
            return Some(solved);
        }
        let model = self.model;
        let graph = self.graph.get_or_insert_with(|| model.graph.clone());
        if graph.as_number(constraint.residual).is_some() {
            return Some(kept.len().saturating_sub(1));
        }
        kept.iter().rposition(|velocity| {
            let coefficient = coefficient(graph, model, constraint.residual, *velocity);
            let is_parameter = |symbol: &SymbolId| model.parameters.iter().any(|p| p.symbol == *symbol);
            !graph.is_literal_zero(coefficient) && graph.symbols_in(&[coefficient]).iter().all(is_parameter)
        })
    }
}

/// ∂φ/∂y, through the rates.
fn coefficient(graph: &mut Graph, model: &Model, residual: ExprId, velocity: SymbolId) -> ExprId {
    let mut seeds = vec![(velocity, graph.one())];
    if let Kinematics::Anchor(lines) = &model.kinematics {
        for line in lines {
            let rate = model.coordinates[line.coordinate].rate;
            seeds.push((rate, graph.partial(line.rate, velocity)));
        }
    }
    Derivation::new(seeds).apply(graph, residual)
}

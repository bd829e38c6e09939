//! One of the two systems of a morphism, with what the first stages prove of it.

use super::Refusal;
use crate::algebra::{Graph, Matrix, Substitution, Verdict};
use crate::check::Chosen;
use crate::choose::Given;
use crate::compile::{Proved, compile, given, prove};
use crate::geometry::{ConstraintDistribution, LinearConstraints, Manifold};
use crate::id::{ExprId, Id, SectionId, SymbolId};
use crate::model::Model;

/// A checked system.
pub(super) struct Side {
    /// What was proved.
    pub(super) proved: Proved,
    /// D with its basis, in the adapted formulation.
    pub(super) distribution: Option<Box<ConstraintDistribution>>,
    /// The state: coordinates, then velocities, then auxiliary states.
    pub(super) state: Vec<SymbolId>,
    /// The rates of the auxiliary states, in quasi-velocities.
    pub(super) rates: Vec<ExprId>,
    /// Sections that span the velocities tangent to the positions, at most places, each with its name: those of the
    /// basis, where no position constraints hold.
    pub(super) tangent: Vec<(String, Vec<ExprId>)>,
    /// All velocities, by those that name these sections.
    on_tangent: Vec<(SymbolId, ExprId)>,
    /// Where the constraints hold over the embedded base.
    manifold: Manifold,
}

impl Side {
    /// Checks a declaration; what is wrong with it, it says itself.
    pub(super) fn of(model: Model) -> Result<Self, Refusal> {
        let whole = model.tracked.is_some().then(|| compile(model.clone()));
        let (mut proved, chosen) = prove(model).map_err(|_| Refusal::IllPosed)?;
        let velocities = proved.system.algebroid.velocities.clone();
        let distribution = match chosen {
            Chosen::Adapted { distribution, .. } => Some(distribution),
            Chosen::Projected { .. } => None,
        };
        let manifold = match distribution {
            Some(_) => proved.positions.manifold.clone(),
            None => proved.constraints.manifold(&mut proved.model.graph, &velocities),
        };
        let state = if let Some(system) = whole {
            system.map_err(|_| Refusal::IllPosed)?.state()
        } else {
            let coordinates = proved.model.coordinates.iter().map(|coordinate| coordinate.symbol);
            let kept = distribution.as_ref().map_or(velocities, |d| d.independent.clone());
            let auxiliary = proved.model.auxiliary.iter().map(|state| state.symbol);
            coordinates.chain(kept).chain(auxiliary).collect()
        };
        let rates = rates(&mut proved);
        let (tangent, on_tangent) = tangent(&mut proved).unwrap_or_else(|| all_velocities(&mut proved));
        Ok(Self { proved, distribution, state, rates, tangent, on_tangent, manifold })
    }

    /// The expressions.
    pub(super) fn graph(&mut self) -> &mut Graph {
        &mut self.proved.model.graph
    }

    /// The name of the system.
    pub(super) fn name(&self) -> String {
        self.proved.model.name.clone()
    }

    /// The quasi-velocities of E.
    pub(super) fn velocities(&self) -> &[SymbolId] {
        &self.proved.system.algebroid.velocities
    }

    /// The rank of D.
    pub(super) fn rank(&self) -> usize {
        match &self.distribution {
            Some(distribution) => distribution.rank(),
            None => self.velocities().len().saturating_sub(self.proved.constraints.residuals.len()),
        }
    }

    /// Functions that vanish where the constraints hold, and nowhere else.
    pub(super) fn residuals(&mut self) -> Vec<ExprId> {
        let Some(distribution) = &self.distribution else { return self.proved.constraints.residuals.clone() };
        let graph = &mut self.proved.model.graph;
        let velocity = self.proved.system.algebroid.velocity(graph);
        let constraints = &distribution.constraints;
        let rows = constraints.annihilator.iter().zip(&constraints.drift);
        rows.map(|(row, drift)| {
            let linear = graph.inner_product(row, &velocity);
            graph.formula(linear + drift)
        })
        .collect()
    }

    /// A function on E in the variables of the state, where the constraints hold.
    pub(super) fn restricted(&mut self, function: ExprId) -> ExprId {
        let graph = &mut self.proved.model.graph;
        let velocities = &self.proved.system.algebroid.velocities;
        let mut restriction = match &self.distribution {
            Some(distribution) => distribution.restriction(graph, velocities),
            None => Substitution::new([]),
        };
        restriction.apply(graph, function)
    }

    /// A function on E, on the velocities that are tangent to the positions.
    pub(super) fn on_tangent(&mut self, function: ExprId) -> ExprId {
        let mut restriction = Substitution::new(self.on_tangent.iter().copied());
        restriction.apply(&mut self.proved.model.graph, function)
    }

    /// Whether a function on E vanishes where the constraints hold.
    pub(super) fn vanishes_on_constraints(&mut self, function: ExprId) -> Verdict {
        let restricted = self.restricted(function);
        let verdict = self.manifold.zero_test(&mut self.proved.model.graph, restricted);
        self.unless_elsewhere(verdict)
    }

    /// Whether a function on E or on the base vanishes over the positions: the embedded base, or the part of it where
    /// position constraints hold.
    pub(super) fn vanishes(&mut self, function: ExprId) -> Verdict {
        let Proved { model, positions, .. } = &mut self.proved;
        let verdict = positions.manifold.zero_test(&mut model.graph, function);
        self.unless_elsewhere(verdict)
    }

    /// What is not 0 may be so where position constraints hold of which no points were found.
    fn unless_elsewhere(&self, verdict: Verdict) -> Verdict {
        let Proved { model, positions, .. } = &self.proved;
        match (&verdict, positions.unsolved.first()) {
            (Verdict::NonZero(_), Some(function)) => {
                let function = model.graph.text_within(*function, 200);
                Verdict::Unknown(format!("no points were found where {function} = 0"))
            }
            _ => verdict,
        }
    }

    /// The generic rank of a matrix over the positions.
    pub(super) fn rank_over_base(&mut self, matrix: &Matrix) -> Result<usize, String> {
        let Proved { model, positions, .. } = &mut self.proved;
        let restricted = positions.manifold.restrict_matrix(&mut model.graph, matrix);
        self.proved.model.graph.generic_rank(&restricted)
    }

    /// The rank of covectors on the virtual displacements: Φ on ker ∂φ/∂y.
    pub(super) fn rank_on_displacements(&mut self, covectors: &Matrix) -> Result<usize, String> {
        if let Some(distribution) = &self.distribution {
            let columns = distribution.sections();
            let graph = &mut self.proved.model.graph;
            let product: Matrix = covectors.iter().map(|row| graph.image(&columns, row)).collect();
            return self.rank_over_base(&product);
        }
        // rank Φ|ker J = rank [J; Φ] − rank J
        let residuals = self.residuals();
        let velocities = self.velocities().to_vec();
        let graph = &mut self.proved.model.graph;
        let jacobian: Matrix = residuals
            .iter()
            .map(|residual| velocities.iter().map(|symbol| graph.partial(*residual, *symbol)).collect())
            .collect();
        let both: Matrix = jacobian.iter().chain(covectors).cloned().collect();
        let [all, alone] = [&both, &jacobian].map(|matrix| {
            let restricted = self.manifold.restrict_matrix(&mut self.proved.model.graph, matrix);
            if restricted.is_empty() { Ok(0) } else { self.proved.model.graph.generic_rank(&restricted) }
        });
        Ok(all?.saturating_sub(alone?))
    }
}

/// Sections that span the kernel of A = ∂f ρ at most places where f = 0, and the velocities in them.
type Tangent = (Vec<(String, Vec<ExprId>)>, Vec<(SymbolId, ExprId)>);

/// `None` without position constraints, or where they could not be solved.
fn tangent(proved: &mut Proved) -> Option<Tangent> {
    let Proved { model, system, positions, .. } = proved;
    let velocities = &system.algebroid.velocities;
    let graph = &mut model.graph;
    let drift = vec![graph.zero(); positions.jacobian.len()];
    let rows = LinearConstraints { annihilator: positions.jacobian.clone(), drift };
    if rows.annihilator.is_empty() {
        return None;
    }
    let on_positions = positions.manifold.restrict_matrix(graph, &rows.annihilator);
    let dependent = graph.independent_columns(&on_positions).ok()?;
    let dependent: Vec<SectionId> = dependent.into_iter().map(SectionId::from_index).collect();
    let found = ConstraintDistribution::solved_for(graph, rows, &dependent, velocities)?;
    let names = found.independent.iter().map(|symbol| graph.symbols()[*symbol].clone());
    let sections = names.zip(found.sections()).collect();
    Some((sections, velocities.iter().copied().zip(found.velocity).collect()))
}

/// The basis: what holds for all velocities does for those that are tangent.
fn all_velocities(proved: &mut Proved) -> Tangent {
    let names = proved.model.sections.iter().map(|section| section.name.clone());
    let identity = proved.model.graph.identity(proved.system.algebroid.rank());
    (names.zip(identity).collect(), Vec::new())
}

/// The rates of the auxiliary states in quasi-velocities, with those that occur in others put in.
fn rates(proved: &mut Proved) -> Vec<ExprId> {
    let mut known = Substitution::new([]);
    for given in given(&mut proved.model, &mut proved.motion) {
        // each after those that occur in it
        if let Given::Rate { symbol, value } = given {
            let value = known.apply(&mut proved.model.graph, value);
            known.insert(symbol, value);
        }
    }
    let rates: Vec<_> = proved.model.auxiliary.iter().map(|state| state.rate).collect();
    let graph = &mut proved.model.graph;
    let mut found = Vec::with_capacity(rates.len());
    for rate in rates {
        let rate = graph.symbol(rate);
        found.push(known.apply(graph, rate));
    }
    found
}

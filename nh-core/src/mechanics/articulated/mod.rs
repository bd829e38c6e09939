//! Accelerations by elimination from the last bodies of chains to the first: articulated inertias, mathematics (39).
//!
//! With L = F(t, x, h, u), u^k = θ^k(y), and heights h^j(x) that enter linearly, the equations (8) say that v̇ makes
//! Gauss's function
//!
//! `Z = ½ F_kl u̇^k u̇^l + e_k u̇^k − F_j dh^j(ẏ) − r_α ẏ^α`
//!
//! least among the accelerations that D admits: F_kl = ∂²F/∂u^k∂u^l, e_k is what d/dt F_k has beside F_kl u̇^l, with
//! the curl of θ^k, and r the forces and the slope of F at u and h. Velocities of neighbouring bodies differ in few
//! terms, u^k = u^l + Σ d_j ω^j, once rates of turning are counted absolutely (`rates.rs`), and so do accelerations
//! (`carried.rs`), those of points in turning axes with what the turning adds (`turning_axes.rs`). Then one body after the other leaves Z (`gauss.rs`), in a number of operations that grows like the
//! number of bodies.

mod balance;
mod carried;
mod gauss;
mod rates;
mod turning_axes;
mod written;

use super::euler_lagrange::LagrangianSystem;
use super::exterior_derivative::ExteriorDerivative;
use super::procedure::Procedure;
use crate::algebra::{Graph, Matrix, Rational, Substitution};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use balance::Balance;
use carried::{Along, Angles, Bodies, Dependent, Order};
use gauss::{GaussFunction, Minimum};
use rates::{Quantity, Rates};
use turning_axes::{Turned, Turns};
use written::{Written, in_numbers};

/// Fewer velocities than this, beside those that constraints mix, are solved for as quickly at once.
const JOINTS: usize = 2;

/// ẋ and v̇, where bodies carry one another; `None` where nothing is gained by it.
///
/// Pivots are those of C in another order: for C that is definite. Where it is to be differentiated, it says what it has
/// solved.
pub fn accelerations_from_the_tips(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    is_differentiated: bool,
) -> Option<Procedure> {
    // 1. unknowns: those that constraints mix first, then absolute rates
    let kept = Kept::of(graph, system, distribution)?;
    let written = Written::of(graph, system)?;
    let angles = Angles::of(graph, system, &written.rows);
    let turning = written.rows.iter().filter_map(|row| in_numbers(graph, row)).collect();
    let rates = Rates::of(system.algebroid.rank(), &kept.mixed, [turning, angles.rates.clone()]);
    let rows: Matrix = written.rows.iter().map(|row| rates.changed(graph, row)).collect();
    let bodies = Bodies::of(graph, &rows)?;
    // 2. velocities, and how accelerations are carried
    let mut procedure = Procedure::default();
    let velocity = kept.velocity(graph, &mut procedure);
    let unknowns = unknowns(graph, &rates, &velocity, &mut procedure);
    let mut along = angles.along(graph, system, &velocity, &unknowns, &rates);
    let dependent = kept.dependent(graph, &rates, &mut along);
    let mut turned = Turned::of(graph, system, &written.forms, &velocity);
    let turns = Turns::of(graph, &bodies, &mut turned);
    let by_unknowns =
        turns.any().then(|| angles.along_by_unknowns(graph, system, (&velocity, &unknowns), &rates));
    let order =
        bodies.ordered(graph, (&mut along, by_unknowns), (&unknowns, &dependent), &turns, &mut procedure);
    // 3. the minimum of Z
    let problem = Problem {
        kept: &kept,
        written: &written,
        rates: &rates,
        order: &order,
        velocity: &velocity,
        turned: &turned,
    };
    let gauss = problem.gauss_function(graph, &mut along);
    let balance = is_differentiated.then(|| Balance::of(graph, &gauss));
    let Minimum { values: found, left } = gauss.minimum(graph, &order.accelerations, &mut procedure)?;
    if let Some(balance) = balance {
        procedure.solved.extend(balance.solved(graph, &order.accelerations, left, &found));
    }
    let mut outputs = system.algebroid.rates(graph, &velocity);
    for section in &kept.independent {
        let terms = rates.velocities[*section].iter();
        let terms: Vec<(Rational, ExprId)> =
            terms.map(|(unknown, number)| (number.clone(), found[order.of_unknowns[*unknown]])).collect();
        outputs.push(graph.linear_combination(&terms));
    }
    let whole = procedure.with_outputs(outputs);
    Some(whole.as_far_as(graph, &whole.outputs))
}

/// The velocities of the state among the quasi-velocities.
struct Kept<'s> {
    system: &'s LagrangianSystem,
    distribution: &'s ConstraintDistribution,
    independent: Vec<usize>,
    dependent: Vec<usize>,
    /// The independent ones that dependent ones contain, and these.
    mixed: Vec<usize>,
}

impl<'s> Kept<'s> {
    /// `None` where they are no quasi-velocities, or few are left beside those that constraints mix.
    fn of(
        graph: &Graph,
        system: &'s LagrangianSystem,
        distribution: &'s ConstraintDistribution,
    ) -> Option<Self> {
        if !distribution.eliminated.is_empty() {
            return None;
        }
        let velocities = &system.algebroid.velocities;
        let section_of = |symbol: &SymbolId| velocities.iter().position(|velocity| velocity == symbol);
        let independent: Vec<usize> =
            distribution.independent.iter().map(section_of).collect::<Option<_>>()?;
        let dependent: Vec<usize> = (0..velocities.len()).filter(|s| !independent.contains(s)).collect();
        let is_mixed = |(a, _): &(usize, &usize)| {
            dependent.iter().any(|s| !graph.is_literal_zero(distribution.basis[*s][*a]))
        };
        let mixed = independent.iter().enumerate().filter(is_mixed);
        let mut mixed: Vec<usize> = mixed.map(|(_, section)| *section).collect();
        if independent.len() < mixed.len() + JOINTS {
            return None;
        }
        mixed.extend(&dependent);
        Some(Self { system, distribution, independent, dependent, mixed })
    }

    /// y on D.
    fn velocity(&self, graph: &mut Graph, procedure: &mut Procedure) -> Vec<ExprId> {
        let velocities = &self.system.algebroid.velocities;
        let mut found: Vec<ExprId> = velocities.iter().map(|symbol| graph.symbol(*symbol)).collect();
        for section in &self.dependent {
            let value = self.distribution.velocity[*section];
            let name = format!("{}_on_d", graph.symbols()[velocities[*section]]);
            found[*section] = procedure.define(graph, &name, value);
        }
        found
    }

    /// ẏ = B v̇ + Ḃ v + ẏ₀ for the dependent velocities.
    fn dependent(&self, graph: &mut Graph, rates: &Rates, along: &mut Along) -> Vec<Dependent> {
        let zero = graph.zero();
        let of = |section: &usize| {
            let mut row = vec![zero; self.system.algebroid.rank()];
            for (a, independent) in self.independent.iter().enumerate() {
                row[*independent] = self.distribution.basis[*section][a];
            }
            let unknown = rates.sections.iter().position(|other| other == section).unwrap_or_default();
            let bias = along.apply(graph, self.distribution.velocity[*section]);
            Dependent { unknown, row: rates.changed(graph, &row), bias }
        };
        self.dependent.iter().map(of).collect()
    }
}

/// The values of the unknowns.
fn unknowns(graph: &mut Graph, rates: &Rates, velocity: &[ExprId], procedure: &mut Procedure) -> Vec<ExprId> {
    let mut found: Vec<ExprId> = Vec::with_capacity(velocity.len());
    for made_of in &rates.made_of {
        let value = |quantity: &Quantity| match quantity {
            Quantity::Velocity(section) => velocity[*section],
            Quantity::Unknown(unknown) => found[*unknown],
        };
        let terms: Vec<(Rational, ExprId)> =
            made_of.iter().map(|(quantity, number)| (number.clone(), value(quantity))).collect();
        let rate = graph.linear_combination(&terms);
        found.push(procedure.define(graph, "rate", rate));
    }
    found
}

/// What Z is made of.
struct Problem<'s> {
    kept: &'s Kept<'s>,
    written: &'s Written,
    rates: &'s Rates,
    order: &'s Order,
    /// y on D.
    velocity: &'s [ExprId],
    turned: &'s Turned,
}

impl Problem<'_> {
    fn gauss_function(&self, graph: &mut Graph, along: &mut Along) -> GaussFunction {
        let Self { written, order, turned, .. } = self;
        let mut gauss = GaussFunction::default();
        let symbols: Vec<SymbolId> = written.forms.forms.iter().map(|(symbol, _)| *symbol).collect();
        let mut values = written.values(&order.of_rows, &order.velocities);
        let function = written.forms.function;
        let slopes: Vec<ExprId> = symbols.iter().map(|symbol| graph.partial(function, *symbol)).collect();
        for (k, slope) in slopes.iter().enumerate() {
            let occurring = graph.symbols_in(&[*slope]);
            let coupled = symbols.iter().enumerate().skip(k);
            for (l, symbol) in coupled.filter(|(_, symbol)| occurring.contains(symbol)) {
                let entry = graph.partial(*slope, *symbol);
                let entry = values.apply(graph, entry);
                gauss.couple(graph, order.of_rows[k], order.of_rows[l], entry);
            }
            let change = along.apply(graph, *slope);
            let change = values.apply(graph, change);
            gauss.push(graph, order.of_rows[k], change);
        }
        for (place, height) in order.of_rows[symbols.len()..].iter().zip(&written.heights) {
            let slope = graph.partial(function, height.symbol);
            let push = graph.formula(-slope);
            gauss.push(graph, *place, push);
        }
        let momenta = values.apply_all(graph, &slopes);
        for ([first, second], rate) in &turned.pairs {
            // dθ¹ = ω∧θ², dθ² = −ω∧θ¹
            let forth = graph.formula(rate * momenta[*first]);
            let back = graph.formula(-(rate * momenta[*second]));
            gauss.push(graph, order.of_rows[*second], forth);
            gauss.push(graph, order.of_rows[*first], back);
        }
        let forces = self.forces(graph, &mut values, &momenta);
        for (unknown, force) in self.rates.changed(graph, &forces).into_iter().enumerate() {
            let push = graph.formula(-force);
            gauss.push(graph, order.of_unknowns[unknown], push);
        }
        gauss
    }

    /// r: the forces, the slope of F, and the brackets and curls that are not in Z otherwise.
    fn forces(&self, graph: &mut Graph, values: &mut Substitution, momenta: &[ExprId]) -> Vec<ExprId> {
        let Self { kept, written, velocity, turned, .. } = self;
        let Kept { system, distribution, independent, .. } = kept;
        let velocities = &system.algebroid.velocities;
        let images = velocities.iter().copied().zip(velocity.iter().copied());
        let mut restriction =
            Substitution::new(images.filter(|(symbol, value)| graph.as_symbol(*value) != Some(*symbol)));
        let mut forces = restriction.apply_all(graph, &system.forces);
        for (symbol, section) in distribution.independent.iter().zip(independent) {
            for value in system.forces_along(*symbol) {
                let value = restriction.apply(graph, value);
                forces[*section] = graph.formula(forces[*section] + value);
            }
        }
        let anchor = &system.algebroid.anchor;
        let gradient = anchor.coordinates.iter().map(|coordinate| {
            let slope = graph.partial(written.forms.function, *coordinate);
            values.apply(graph, slope)
        });
        let gradient: Vec<ExprId> = gradient.collect();
        let zero = graph.zero();
        let own = |velocity: &SymbolId| {
            let form = written.forms.forms.iter().position(|(symbol, _)| symbol == velocity);
            form.map_or(zero, |k| momenta[k])
        };
        let own: Vec<ExprId> = velocities.iter().map(own).collect();
        let bracket = system.algebroid.structure.bracket_term(graph, velocity, &own);
        for (index, force) in forces.iter_mut().enumerate() {
            let unit = graph.unit_vector(velocities.len(), index);
            let field = anchor.vector_field(graph, &unit);
            let slope = graph.inner_product(&field, &gradient);
            *force = graph.formula(*force + slope - bracket[index]);
            let mut curl = None;
            for k in &turned.others {
                let curl = curl.get_or_insert_with(|| ExteriorDerivative::of(graph, system, velocity, &unit));
                let curl = curl.apply(graph, written.forms.forms[*k].1);
                *force = graph.formula(*force - momenta[*k] * curl);
            }
        }
        forces
    }
}

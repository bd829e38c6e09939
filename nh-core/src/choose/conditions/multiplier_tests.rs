//! Divisors of solutions with multipliers.

use super::*;
use crate::algebra::{Function, Rational};
use crate::geometry::{Algebroid, Anchor, Clock, StructureFunctions};
use crate::mechanics::{LagrangianSystem, saddle_equations};

/// L = (m ẋ² + m ẏ² + J ż²)/2 with ż = y ẋ, whose J may be zero.
fn particle(graph: &mut Graph) -> (LagrangianSystem, Vec<ExprId>, [SymbolId; 2]) {
    let names = ["x", "y", "z", "x_dot", "y_dot", "z_dot", "m", "J", "t"];
    let [x, y, z, u, v, w, m, j, time] = names.map(|name| graph.new_symbol(name));
    let identity = graph.identity(3);
    let anchor = Anchor { entries: identity, coordinates: vec![x, y, z], rank: 3 };
    let structure = StructureFunctions::commuting(3);
    let algebroid = Algebroid { anchor, structure, velocities: vec![u, v, w] };
    let [height, u, v, w, mass, inertia] = [y, u, v, w, m, j].map(|symbol| graph.symbol(symbol));
    let (uu, vv, ww) = (graph.square(u), graph.square(v), graph.square(w));
    let energy = graph.formula(mass * uu + mass * vv + inertia * ww);
    let lagrangian = graph.scale(Rational::new(1, 2), energy);
    let zero = graph.zero();
    let residual = graph.formula(w - height * u);
    let clock = Clock::of_time(time);
    let system = LagrangianSystem {
        algebroid,
        lagrangian,
        forces: vec![zero; 3],
        forces_on_distribution: Vec::new(),
        clock,
    };
    (system, vec![residual], [m, j])
}

#[test]
fn a_parameter_that_may_be_zero_is_none_of_theirs() {
    let graph = &mut Graph::new();
    let (system, residuals, parameters) = particle(graph);
    let equations = saddle_equations(graph, &system, &residuals);
    let reference = Reference::projected(graph, &system, Vec::new(), residuals);
    // where J is 0, W is singular, and C is not: weighed constraints make it definite
    let mut weighed = equations.mass.clone();
    let row = equations.jacobian[0].clone();
    for (alpha, entries) in weighed.iter_mut().enumerate() {
        for (beta, entry) in entries.iter_mut().enumerate() {
            *entry = graph.formula(*entry + row[alpha] * row[beta]);
        }
    }
    let regular = Regular {
        reference: &reference,
        definitions: &Procedure::default(),
        mass: &weighed,
        definiteness: Definiteness::Definite,
        jacobian: &equations.jacobian,
        turned: &[],
        parameters: &parameters,
        facts: &Facts::default(),
    };
    let [m, j] = parameters.map(|parameter| graph.symbol(parameter));
    let y = graph.symbol(system.algebroid.anchor.coordinates[1]);
    let yy = graph.square(y);
    // λ = (…)/(m + J y²), with det [[W, −Jᵀ], [J, 0]] = m (m + J y²) below
    let whole = graph.formula(m + j * yy);
    let one = graph.one();
    for (divisor, is_added) in [(m, false), (whole, false), (j, true), (y, true)] {
        let quotient = Procedure::of(vec![graph.formula(one / divisor)]);
        let added = regular.added(graph, &quotient);
        assert_eq!(added, is_added.then_some(divisor), "{}", graph.text(divisor));
    }
}

/// Where exp y + x y exp y is declared not to vanish, neither does 1 + x y; sums with other powers of exp y may.
#[test]
fn exponentials_vary_by_themselves() {
    let graph = &mut Graph::new();
    let (system, _, parameters) = particle(graph);
    let [x, y] = [0, 1].map(|k| graph.symbol(system.algebroid.anchor.coordinates[k]));
    let [u, w] = [0, 2].map(|k| graph.symbol(system.algebroid.velocities[k]));
    let (one, exp) = (graph.one(), graph.apply(Function::Exp, y));
    let declared = graph.formula(exp + x * y * exp);
    let residual = graph.formula(w - u / declared);
    let equations = saddle_equations(graph, &system, &[residual]);
    let reference = Reference::projected(graph, &system, Vec::new(), vec![residual]);
    let regular = Regular {
        reference: &reference,
        definitions: &Procedure::default(),
        mass: &equations.mass,
        definiteness: Definiteness::Definite,
        jacobian: &equations.jacobian,
        turned: &[],
        parameters: &parameters,
        facts: &Facts::default(),
    };
    let bare = graph.formula(one + x * y);
    let times = graph.formula(exp * bare);
    let other = graph.formula(exp + x * y);
    let alone = graph.formula(exp - one - one);
    for (divisor, is_added) in [(bare, false), (times, false), (other, true), (alone, true)] {
        let quotient = Procedure::of(vec![graph.formula(one / divisor)]);
        let added = regular.added(graph, &quotient);
        assert_eq!(added.is_some(), is_added, "{}", graph.text(divisor));
    }
}

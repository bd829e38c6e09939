//! The adapted frame of CLMM section 3, built by the change of basis (5) and with the equations
//! (3.7), gives the same accelerations as the reduced form (8).

use crate::systems;

use nonholonomic_core::algebra::{Facts, Graph, Substitution};
use nonholonomic_core::check;
use nonholonomic_core::geometry::{Algebroid, ChangeOfBasis, ConstraintDistribution};
use nonholonomic_core::id::{ExprId, Id, SymbolId};
use nonholonomic_core::mechanics::{LagrangianSystem, reduced_equations};
use nonholonomic_core::model::Model;

/// The stages up to the distribution, as in `compile`.
pub(crate) fn stages(model: &mut Model) -> (LagrangianSystem, ConstraintDistribution) {
    let mut motion = check::kinematics(model).unwrap();
    let base = check::embedding(model, &motion).unwrap();
    let structure = check::structure_functions(model, &motion, &base).unwrap();
    let velocities = model.sections.iter().map(|s| s.symbol).collect();
    let algebroid = Algebroid { anchor: motion.anchor.clone(), structure, velocities };
    let on_base = check::Positions::none(&base);
    let constraints = check::constraints(model, &mut motion, &algebroid, &on_base).unwrap();
    let chosen = check::choose_formulation(model, &constraints, &Facts::default(), &base).unwrap();
    let check::Chosen::Adapted { distribution, .. } = chosen else { panic!("an adapted basis exists") };
    let lagrangian = motion.rates.apply(&mut model.graph, model.lagrangian.value);
    let zero = model.graph.zero();
    let forces = vec![zero; algebroid.rank()];
    (
        LagrangianSystem {
            algebroid,
            lagrangian,
            forces,
            forces_on_distribution: Vec::new(),
            clock: model.clock(),
        },
        *distribution,
    )
}

/// Accelerations by solving the mass matrix in floating point.
fn accelerations(graph: &Graph, mass: &[Vec<ExprId>], force: &[ExprId]) -> Vec<f64> {
    let value =
        |symbol: SymbolId| 0.3 + f64::from(u8::try_from((symbol.index() * 7919) % 13).unwrap()) / 11.0;
    let n = force.len();
    let entries: Vec<ExprId> = mass.iter().flatten().chain(force).copied().collect();
    let values: Vec<f64> = graph.evaluate(&entries, value).iter().map(|b| b.value).collect();
    let mut a: Vec<Vec<f64>> =
        (0..n).map(|i| [&values[i * n..(i + 1) * n], &values[n * n + i..=n * n + i]].concat()).collect();
    for i in 0..n {
        let pivot = (i..n).max_by(|x, y| a[*x][i].abs().total_cmp(&a[*y][i].abs())).unwrap();
        a.swap(i, pivot);
        let leading = a[i].clone();
        for (j, row) in a.iter_mut().enumerate() {
            if j != i {
                let factor = row[i] / leading[i];
                row.iter_mut().zip(&leading).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    (0..n).map(|i| a[i][n] / a[i][i]).collect()
}

/// Checks mathematics (5) and (8).
fn both_forms_agree(mut model: Model) {
    let (system, distribution) = stages(&mut model);
    let graph = &mut model.graph;
    let reduced = reduced_equations(graph, &system, &distribution);
    let expected = accelerations(graph, &reduced.mass, &reduced.force);

    // the adapted frame; w^a keeps the symbol of v^a, so that both are evaluated at one point
    let change = ChangeOfBasis::adapted(graph, &distribution);
    let mut adapted = change.apply(graph, &system.algebroid, system.algebroid.velocities.clone());
    for section in &distribution.dependent {
        adapted.velocities[section.index()] = graph.new_symbol(format!("w{}", section.index()));
    }
    let w = adapted.velocity(graph);
    let y = change.old_velocity(graph, &w);
    let lagrangian =
        Substitution::new(system.algebroid.velocities.iter().copied().zip(y)).apply(graph, system.lagrangian);
    let system = LagrangianSystem { algebroid: adapted, lagrangian, ..system };
    // (3.7): everything at y^A = 0
    let zero = graph.zero();
    let normal: Vec<SymbolId> =
        distribution.dependent.iter().map(|s| system.algebroid.velocities[s.index()]).collect();
    let mut on_d = Substitution::new(normal.iter().map(|symbol| (*symbol, zero)));
    let velocity: Vec<ExprId> = w.iter().map(|w| on_d.apply(graph, *w)).collect();
    let balance = system.force_balance(graph, &velocity, &mut on_d);
    let mut mass = Vec::new();
    let mut force = Vec::new();
    for a in &distribution.independent {
        let index = system.algebroid.velocities.iter().position(|symbol| symbol == a).unwrap();
        let row = distribution.independent.iter().map(|b| graph.partial(balance.momenta[index], *b));
        mass.push(row.collect::<Vec<_>>());
        force.push(graph.formula(-balance.rest[index]));
    }
    let found = accelerations(graph, &mass, &force);
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() <= 1e-11 * (1.0 + b.abs()), "{found:?} is not {expected:?}");
    }
}

#[test]
fn sleigh() {
    both_forms_agree(systems::sleigh());
}

#[test]
fn robot() {
    both_forms_agree(systems::robot());
}

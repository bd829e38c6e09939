//! Whether the kinetic energy is definite at a real point.

use super::super::proof::FIRST_SEED;
use crate::algebra::{FieldPoint, Graph, Matrix, Residue, eliminated};
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::LagrangianSystem;

/// Where a pivot of ∂²L/∂y² is so much smaller than the entry it is left of, it is 0 but for rounding.
const SMALL: f64 = 1e-9;
/// Lines on which it is seen whether L is quadratic in the velocities.
const LINES: u64 = 2;

/// ∂²L/∂y², as it is evaluated at points.
pub(super) enum KineticEnergy<'q> {
    /// By differences of L, which are exact where it is quadratic in y.
    Quadratic(&'q Graph, &'q LagrangianSystem),
    /// By its entries, in a graph that has them.
    Entries(Box<Graph>, Matrix),
}

impl<'q> KineticEnergy<'q> {
    pub(super) fn of(graph: &'q Graph, system: &'q LagrangianSystem) -> Self {
        if is_quadratic(graph, system) {
            return Self::Quadratic(graph, system);
        }
        let mut own = Box::new(graph.clone());
        let velocities = &system.algebroid.velocities;
        let mut entries = Matrix::new();
        for velocity in velocities {
            let momentum = own.partial(system.lagrangian, *velocity);
            entries.push(velocities.iter().map(|other| own.partial(momentum, *other)).collect());
        }
        Self::Entries(own, entries)
    }

    /// Whether it is positive definite, and not nearly singular.
    pub(super) fn is_definite(&self, values: impl Fn(SymbolId) -> f64) -> bool {
        let rows = match self {
            Self::Quadratic(graph, system) => by_differences(graph, system, values),
            Self::Entries(graph, entries) => {
                let row = |row: &Vec<ExprId>| graph.evaluate(row, &values).iter().map(|x| x.value).collect();
                entries.iter().map(row).collect()
            }
        };
        let mut before = 1.0;
        rows.iter().enumerate().all(|(last, whole)| {
            let minor = rows[..=last].iter().map(|row: &Vec<f64>| row[..=last].to_vec()).collect();
            let determinant = eliminated(minor).0;
            let pivot = determinant / before;
            before = determinant;
            pivot > SMALL * whole[last].abs()
        })
    }
}

/// Whether third differences of L along lines through the velocities vanish.
fn is_quadratic(graph: &Graph, system: &LagrangianSystem) -> bool {
    let at = |seed: u64, place: u64| {
        let mut point = FieldPoint::random(FIRST_SEED + seed);
        for velocity in &system.algebroid.velocities {
            let [start, slope] = [2_531, 2_533].map(|end| Residue::mixed(end, velocity.index() as u64));
            point.chosen.insert(*velocity, start + slope * Residue::of_word(place));
        }
        graph.evaluate_in_field(&[system.lagrangian], &point).ok().map(|values| values[0])
    };
    (0..LINES).all(|seed| {
        let [Some(a), Some(b), Some(c), Some(d)] = [0, 1, 2, 3].map(|place| at(seed, place)) else {
            return false;
        };
        // a − 3 b + 3 c − d
        let inner = c - b;
        a - d + inner + inner + inner == Residue::ZERO
    })
}

fn by_differences(
    graph: &Graph,
    system: &LagrangianSystem,
    values: impl Fn(SymbolId) -> f64,
) -> Vec<Vec<f64>> {
    let at = |steps: &[(SymbolId, f64)]| {
        let moved = |symbol: SymbolId| {
            let own = steps.iter().filter(|(velocity, _)| *velocity == symbol);
            values(symbol) + own.map(|(_, step)| step).sum::<f64>()
        };
        graph.evaluate(&[system.lagrangian], moved)[0].value
    };
    let rest = at(&[]);
    let entry = |a: &SymbolId, b: &SymbolId| {
        if a == b {
            at(&[(*a, 1.0)]) + at(&[(*a, -1.0)]) - 2.0 * rest
        } else {
            at(&[(*a, 1.0), (*b, 1.0)]) - at(&[(*a, 1.0)]) - at(&[(*b, 1.0)]) + rest
        }
    };
    let velocities = &system.algebroid.velocities;
    velocities.iter().map(|a| velocities.iter().map(|b| entry(a, b)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Algebroid, Anchor, Clock, StructureFunctions};

    /// A system on the line with a Lagrangian of its velocity and a number.
    fn on_a_line(lagrangian: impl FnOnce(&mut Graph, ExprId) -> ExprId) -> (Graph, LagrangianSystem) {
        let mut graph = Graph::new();
        let [velocity, time] = ["v", "t"].map(|name| graph.new_symbol(name));
        let v = graph.symbol(velocity);
        let lagrangian = lagrangian(&mut graph, v);
        let anchor = Anchor { entries: Vec::new(), coordinates: Vec::new(), rank: 1 };
        let structure = StructureFunctions::commuting(1);
        let algebroid = Algebroid { anchor, structure, velocities: vec![velocity] };
        let (forces, forces_on_distribution) = (vec![graph.zero()], Vec::new());
        let clock = Clock::of_time(time);
        (graph, LagrangianSystem { algebroid, lagrangian, forces, forces_on_distribution, clock })
    }

    #[test]
    fn the_energy_of_velocities_beyond_quadratic_is_differentiated() {
        // v⁴ − 0.3 v²: ∂²L/∂v² = 12 v² − 0.6 is negative at 0, where the difference of step 1 is 1.4
        let (graph, system) = on_a_line(|graph, v| {
            let square = graph.square(v);
            let fourth = graph.square(square);
            let less = graph.scale(crate::algebra::Rational::new(3, 10), square);
            graph.formula(fourth - less)
        });
        let energy = KineticEnergy::of(&graph, &system);
        assert!(matches!(energy, KineticEnergy::Entries(..)));
        assert!(!energy.is_definite(|_| 0.0) && energy.is_definite(|_| 1.0));
        let (graph, system) = on_a_line(Graph::square);
        let energy = KineticEnergy::of(&graph, &system);
        assert!(matches!(energy, KineticEnergy::Quadratic(..)) && energy.is_definite(|_| 0.5));
    }
}

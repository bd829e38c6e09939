//! Points whose velocities have components along axes that turn.
//!
//! Let dθ¹ = ω∧θ² and dθ² = −ω∧θ¹, and let θ¹ and θ² enter L as μ/2 (u₁² + u₂²). Then Z contains, up to what does not
//! depend on accelerations, `μ/2 ((u̇₁ − ω u₂)² + (u̇₂ + ω u₁)²)`: the curls are in Z once accelerations are those of the
//! point, not of the components. Between neighbours these differ by what is between them alone, so that no velocity
//! of a point has to be known.

use super::carried::{ALONE, Bodies};
use crate::algebra::Graph;
use crate::id::ExprId;
use crate::mechanics::LagrangianSystem;
use crate::mechanics::exterior_derivative::ExteriorDerivative;
use crate::mechanics::planar_points::{points, squares};
use crate::mechanics::velocity_forms::{VelocityForms, spin};

/// Forms that are not closed.
pub(super) struct Turned {
    /// Pairs with dθ¹ = ω∧θ², dθ² = −ω∧θ¹, and ω(y).
    pub(super) pairs: Vec<([usize; 2], ExprId)>,
    pub(super) others: Vec<usize>,
}

impl Turned {
    /// Of the forms that a Lagrangian is written in, at y = `velocity`.
    pub(super) fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        forms: &VelocityForms,
        velocity: &[ExprId],
    ) -> Self {
        let velocities = &system.algebroid.velocities;
        let mut turned = Self { pairs: Vec::new(), others: Vec::new() };
        let mut curl = ExteriorDerivative::anywhere(graph, system);
        for (k, (symbol, form)) in forms.forms.iter().enumerate() {
            if !velocities.contains(symbol) && !curl.vanishes(graph, *form) {
                turned.others.push(k);
            }
        }
        if turned.others.is_empty() {
            return turned;
        }
        let squares = squares(graph, velocities, forms);
        for point in points(graph, &squares) {
            if !point.forms.iter().any(|k| turned.others.contains(k)) {
                continue;
            }
            if let Some(spin) = spin(graph, system, forms, (point.forms, point.axes), &mut curl) {
                let rate = graph.inner_product(&spin, velocity);
                turned.others.retain(|k| !point.forms.contains(k));
                turned.pairs.push((point.forms, rate));
            }
        }
        turned
    }
}

/// The other component of a velocity, and what its value is multiplied by in the acceleration: −ω or ω.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Turn {
    other: usize,
    rate: ExprId,
}

/// The velocities whose accelerations are those of points, at the places of bodies.
pub(super) struct Turns {
    all: Vec<Option<Turn>>,
}

impl Turns {
    /// Takes the pairs that are to be so out of those whose curls are added to Z.
    pub(super) fn of(graph: &mut Graph, bodies: &Bodies, turned: &mut Turned) -> Self {
        let mut turns = Self { all: vec![None; bodies.all.len()] };
        let pairs = std::mem::take(&mut turned.pairs);
        let at = |[first, second]: [usize; 2]| [bodies.rows[first], bodies.rows[second]];
        for (forms, rate) in &pairs {
            let [first, second] = at(*forms);
            // all that is at these places turns with them
            let alike = pairs.iter().filter(|(other, with)| at(*other) == [first, second] && with == rate);
            let alike = alike.count();
            let is_alone = |place| bodies.rows.iter().filter(|row| **row == place).count() == alike;
            let is_free = first != second && first.min(second) >= bodies.unknowns;
            if !(is_free && is_alone(first) && is_alone(second)) {
                turned.pairs.push((*forms, *rate));
                continue;
            }
            let minus = graph.formula(-*rate);
            turns.set(graph, [first, second], minus);
        }
        let mut reached: Vec<usize> = (0..turns.all.len()).collect();
        while let Some(place) = reached.pop() {
            let Some(Turn { other, rate }) = turns.all[place] else { continue };
            let before = [place, other].map(|index| carrier(graph, bodies, index));
            if let [Some(first), Some(second)] = before
                && first != second
                && [first, second]
                    .iter()
                    .all(|index| turns.all[*index].is_none() && bodies.rows.iter().all(|row| row != index))
            {
                turns.set(graph, [first, second], rate);
                reached.extend([first, second]);
            }
        }
        turns
    }

    /// Whether there are such.
    pub(super) fn any(&self) -> bool {
        self.all.iter().any(Option::is_some)
    }

    /// Components of one velocity, with the rate of the first.
    fn set(&mut self, graph: &mut Graph, [first, second]: [usize; 2], rate: ExprId) {
        let minus = graph.formula(-rate);
        self.all[first] = Some(Turn { other: second, rate });
        self.all[second] = Some(Turn { other: first, rate: minus });
    }

    /// What the acceleration of a velocity has beside Σ ċ_p y_p: its own turning, less that of what carries it.
    pub(super) fn terms(
        &self,
        graph: &mut Graph,
        index: usize,
        bodies: &Bodies,
        (unknowns, velocity): (&[ExprId], &impl Fn(usize) -> ExprId),
    ) -> Vec<ExprId> {
        let (zero, one) = (graph.zero(), graph.one());
        let row = |place: usize| bodies.all[place].row.as_slice();
        // a velocity that few unknowns move is written out, so that its terms meet those of Σ ċ_p y_p
        let moved = |graph: &mut Graph, row: &[ExprId]| {
            let is_short = row.iter().filter(|entry| **entry != zero).count() <= ALONE;
            is_short.then(|| graph.inner_product(row, unknowns))
        };
        let mut terms = Vec::new();
        let mut own = self.all[index];
        for (p, coefficient) in &bodies.all[index].by {
            let Some(turn) = self.all[*p] else { continue };
            if let Some(Turn { other, rate }) = own
                && (rate, *coefficient) == (turn.rate, one)
            {
                let between: Vec<ExprId> =
                    row(other).iter().zip(row(turn.other)).map(|(a, b)| graph.formula(a - b)).collect();
                if let Some(between) = moved(graph, &between) {
                    terms.push(graph.formula(rate * between));
                    own = None;
                    continue;
                }
            }
            terms.push(graph.formula(-(coefficient * turn.rate * velocity(turn.other))));
        }
        if let Some(Turn { other, rate }) = own {
            let value = moved(graph, row(other)).unwrap_or_else(|| velocity(other));
            terms.push(graph.formula(rate * value));
        }
        terms
    }
}

/// What carries a velocity with coefficient 1, and is no unknown.
fn carrier(graph: &mut Graph, bodies: &Bodies, index: usize) -> Option<usize> {
    let one = graph.one();
    let mut by = bodies.all[index].by.iter();
    by.find(|(p, coefficient)| *coefficient == one && *p >= bodies.unknowns).map(|(p, _)| *p)
}

//! Solutions that leave part of a set of zeros out.
//!
//! `a s + b = 0` is solved by s = −b/a, unless a and b vanish together where one equation more would have to hold: of
//! `(x − y) (s − x)` it is a solution where x = y is not. Zeros of a are looked for in floating point, by Newton's
//! method in one symbol from several places, and b is looked at there. What is found only forbids a solution.

use crate::algebra::{Bounded, Graph, sample};
use crate::id::{ExprId, SymbolId};

/// The places from which zeros are looked for.
const PLACES: u64 = 6;
/// The symbols in which they are looked for at each.
const MOVED: usize = 3;
/// The steps of Newton's method.
const STEPS: usize = 24;
/// What is so small beside its size elsewhere is taken for zero: a zero of second order is found to half of the digits.
const SMALL: f64 = 1e-6;

/// Whether all of some functions vanish where the first of them does, as symbols move.
pub(super) fn vanish_together(graph: &mut Graph, functions: &[ExprId], moving: &[SymbolId]) -> bool {
    let Some((first, others)) = functions.split_first() else { return false };
    let inside: Vec<SymbolId> =
        graph.symbols_in(&[*first]).into_iter().filter(|symbol| moving.contains(symbol)).collect();
    if inside.is_empty() {
        return false;
    }
    let symbols = graph.symbols_in(functions);
    inside.iter().take(MOVED).any(|symbol| {
        let slope = graph.partial(*first, *symbol);
        let mut newton = graph.evaluator(&[*first, slope]);
        let mut rest = graph.evaluator(others);
        (0..PLACES).any(|place| {
            let at = |moved: f64| {
                let symbols = &symbols;
                move |other: SymbolId| {
                    if other == *symbol {
                        return moved;
                    }
                    sample(place, symbols.iter().position(|known| *known == other).unwrap_or(0))
                }
            };
            let start = sample(place, symbols.iter().position(|known| known == symbol).unwrap_or(0));
            let size = newton.at(at(start))[0].value.abs();
            let mut x = start;
            for _ in 0..STEPS {
                let values = newton.at(at(x));
                let step = values[0].value / values[1].value;
                if !step.is_finite() || step.abs() <= f64::EPSILON * x.abs() {
                    break;
                }
                x -= step;
            }
            let is_zero = |value: f64, size: f64| value.abs() <= SMALL * size && size > 0.0;
            let left = newton.at(at(x))[0];
            if !is_zero(left.value, size) && left.value.abs() > left.error {
                return false;
            }
            let elsewhere = rest.at(at(start));
            let there = rest.at(at(x));
            let vanishes = |(there, elsewhere): (&Bounded, &Bounded)| {
                there.value.abs() <= there.error || is_zero(there.value, elsewhere.value.abs())
            };
            there.iter().zip(&elsewhere).all(vanishes)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_factors_are_found_and_others_are_not() {
        let mut g = Graph::new();
        let all = ["x", "y", "l"].map(|name| g.new_symbol(name));
        let [x, y, l] = all.map(|symbol| g.symbol(symbol));
        let (sin, cos) = (g.sin(x), g.cos(x));
        let double = g.formula(sin * cos);
        let (gap, square) = (g.formula(x - y), g.formula(x * x - y * y));
        let definite = g.formula(x * x + l * l);
        let moving = &all[..2];
        for (functions, together) in [
            ([cos, double], true),
            ([cos, sin], false),
            ([gap, square], true),
            ([square, gap], true),
            ([gap, x], false),
            ([definite, definite], false),
            ([l, gap], false),
        ] {
            assert_eq!(vanish_together(&mut g, &functions, moving), together, "{functions:?}");
        }
        let twice = g.formula(gap * gap);
        let product = g.formula(twice * x);
        assert!(vanish_together(&mut g, &[twice, product], moving));
    }
}

//! Points of the field where given radicands are squares.
//!
//! An element of the field is a square with probability one half, so a random point gives values to n square roots
//! with probability 2⁻ⁿ. Symbols that are chosen one after the other, each until the radicands that it completes are
//! squares, take about 2ᵏ trials where k radicands wait for one symbol: a point for the distances of many bodies
//! is found in a few hundred trials.

use super::field::Residue;
use super::graph::Graph;
use super::modular::{FieldPass, FieldPoint, NoValue};
use super::node::Node;
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId};
use num_integer::Integer;
use std::collections::BTreeMap;

/// The radicands of square roots, by the last of their symbols that may be chosen.
#[derive(Clone, Debug, Default)]
pub(crate) struct Radicands {
    completed: BTreeMap<SymbolId, Vec<ExprId>>,
}

/// Trials for one symbol, for each of the patterns that the radicands waiting for it may have: a radicand that is no
/// square whatever the symbol is, is given up after these.
const TRIALS: u64 = 16;
/// More radicands than this do not wait for one symbol together.
const TOGETHER: usize = 10;

impl Radicands {
    /// Those of even roots in expressions. Some symbols may not be chosen, since others determine them.
    pub(crate) fn of(graph: &Graph, expressions: &[ExprId], determined: &[SymbolId]) -> Self {
        let mut completed: BTreeMap<SymbolId, Vec<ExprId>> = BTreeMap::new();
        for id in graph.reachable(expressions) {
            let Node::Product { factors, .. } = graph.node(id) else { continue };
            let is_even = |exponent: &Rational| !exponent.is_integer() && exponent.denominator().is_even();
            for (base, _) in factors.iter().filter(|(_, exponent)| is_even(exponent)) {
                let symbols = graph.symbols_in(&[*base]).into_iter();
                if let Some(last) = symbols.filter(|symbol| !determined.contains(symbol)).max() {
                    let radicands = completed.entry(last).or_default();
                    if !radicands.contains(base) {
                        radicands.push(*base);
                    }
                }
            }
        }
        Self { completed }
    }

    /// Whether no symbol has to be chosen with care.
    pub(crate) fn is_empty(&self) -> bool {
        self.completed.is_empty()
    }

    /// The random point number `seed` where they are squares, as far as such a point is found.
    pub(crate) fn point(&self, graph: &Graph, seed: u64) -> FieldPoint {
        self.found(seed, |radicand, point| {
            graph.evaluate_in_field(&[radicand], point).map(|values| values[0])
        })
    }

    /// The same where functions are evaluated in passes of a kind.
    pub(crate) fn point_in<'a>(&self, seed: u64, pass: impl Fn(FieldPoint) -> FieldPass<'a>) -> FieldPoint {
        self.found(seed, |radicand, point| pass(point.clone()).evaluate(&[radicand]).map(|values| values[0]))
    }

    fn found(
        &self,
        seed: u64,
        value: impl Fn(ExprId, &FieldPoint) -> Result<Residue, NoValue>,
    ) -> FieldPoint {
        let mut point = FieldPoint::random(seed);
        for (symbol, radicands) in &self.completed {
            for trial in 0..TRIALS << radicands.len().min(TOGETHER) {
                if trial > 0 {
                    let number = trial.wrapping_mul(0x1_0001).wrapping_add(symbol.index() as u64);
                    point.chosen.insert(*symbol, Residue::mixed(!seed, number));
                }
                // one after the other: half of the points fail at the first
                let is_square =
                    |radicand: &ExprId| value(*radicand, &point).is_ok_and(|value| value.sqrt().is_some());
                if radicands.iter().all(is_square) {
                    break;
                }
            }
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distances_of_six_points_have_values() {
        let mut g = Graph::new();
        let places: Vec<[ExprId; 2]> = (0..6)
            .map(|body| {
                ["x", "y"].map(|axis| {
                    let symbol = g.new_symbol(format!("{axis}{body}"));
                    g.symbol(symbol)
                })
            })
            .collect();
        let mut distances = Vec::new();
        for (i, a) in places.iter().enumerate() {
            for b in &places[i + 1..] {
                let gaps = [g.sub(a[0], b[0]), g.sub(a[1], b[1])].map(|gap| g.square(gap));
                let sum = g.add(gaps[0], gaps[1]);
                distances.push(g.sqrt(sum));
            }
        }
        let radicands = Radicands::of(&g, &distances, &[]);
        for seed in 0..4 {
            assert!(g.evaluate_in_field(&distances, &radicands.point(&g, seed)).is_ok());
        }
    }
}

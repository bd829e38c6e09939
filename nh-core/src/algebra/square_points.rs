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
use crate::limits;
use num_integer::Integer;
use std::collections::BTreeMap;

/// The radicands of square roots, by the last of their symbols that may be chosen.
#[derive(Clone, Debug, Default)]
pub(crate) struct Radicands {
    completed: BTreeMap<SymbolId, Vec<Radicand>>,
    /// The common denominator of angles in the expressions.
    division: i64,
}

/// What has to be a square.
#[derive(Clone, Debug)]
struct Radicand {
    value: ExprId,
    /// What it is made of besides: evaluated once.
    given: Vec<ExprId>,
    /// What changes with the symbol that it waits for and with no radicand before it, itself at last: evaluated at every
    /// trial.
    changing: Vec<ExprId>,
    /// The work of a trial.
    work: usize,
}

/// Trials for one symbol, for each of the patterns that the radicands waiting for it may have: a radicand that is no
/// square whatever the symbol is, is given up after these.
const TRIALS: u64 = 16;
/// More radicands than this are not given more trials.
const TOGETHER: usize = 10;
/// Of more radicands than this that wait for one symbol, so many trials hardly ever find all squares: none is made.
const HOPELESS: usize = 16;

impl Radicands {
    /// Those of even roots in expressions. Some symbols may not be chosen, since others determine them.
    pub(crate) fn of(graph: &Graph, expressions: &[ExprId], determined: &[SymbolId]) -> Self {
        let mut waiting: BTreeMap<SymbolId, Vec<ExprId>> = BTreeMap::new();
        let order = graph.reachable(expressions);
        for id in &order {
            let Node::Product { factors, .. } = graph.node(*id) else { continue };
            let is_even = |exponent: &Rational| !exponent.is_integer() && exponent.denominator().is_even();
            for (base, _) in factors.iter().filter(|(_, exponent)| is_even(exponent)) {
                let symbols = graph.symbols_in(&[*base]).into_iter();
                if let Some(last) = symbols.filter(|symbol| !determined.contains(symbol)).max() {
                    let radicands = waiting.entry(last).or_default();
                    if !radicands.contains(base) {
                        radicands.push(*base);
                    }
                }
            }
        }
        waiting.retain(|_, radicands| radicands.len() <= HOPELESS);
        if waiting.is_empty() {
            return Self::default();
        }
        let completed =
            waiting.into_iter().map(|(symbol, values)| (symbol, taken_apart(graph, symbol, &values)));
        Self { completed: completed.collect(), division: graph.angle_division_among(&order) }
    }

    /// Whether no symbol has to be chosen with care.
    pub(crate) fn is_empty(&self) -> bool {
        self.completed.is_empty()
    }

    /// The random point number `seed` where they are squares, as far as such a point is found.
    pub(crate) fn point(&self, graph: &Graph, seed: u64) -> FieldPoint {
        self.point_in(seed, |point| FieldPass::new(graph, point, self.division))
    }

    /// The same where functions are evaluated in passes of a kind.
    pub(crate) fn point_in<'a>(&self, seed: u64, pass: impl Fn(FieldPoint) -> FieldPass<'a>) -> FieldPoint {
        let point = FieldPoint::random(seed);
        if self.is_empty() {
            return point;
        }
        let mut here = pass(point);
        for (symbol, radicands) in &self.completed {
            if !chosen(&mut here, *symbol, radicands).unwrap_or(false) {
                // some values are those of earlier trials
                here = pass(here.into_point());
            }
        }
        here.into_point()
    }
}

/// Radicands that wait for a symbol.
fn taken_apart(graph: &Graph, symbol: SymbolId, values: &[ExprId]) -> Vec<Radicand> {
    let mut before: Vec<ExprId> = Vec::new();
    let mut found = Vec::with_capacity(values.len());
    for value in values {
        let (mut given, mut changing) = (Vec::new(), Vec::new());
        for id in graph.reachable(&[*value]) {
            let node = graph.node(id);
            let changes = graph.as_symbol(id) == Some(symbol)
                || node.operands().any(|operand| before.contains(&operand) || changing.contains(&operand));
            if !changes {
                given.push(id);
            } else if !before.contains(&id) {
                changing.push(id);
            }
        }
        let work = changing.len() + Residue::ROOT_WORK;
        before.extend(&changing);
        found.push(Radicand { value: *value, given, changing, work });
    }
    found
}

/// Chooses a symbol so that all radicands that wait for it are squares; whether such a value was found.
fn chosen(pass: &mut FieldPass, symbol: SymbolId, radicands: &[Radicand]) -> Result<bool, NoValue> {
    for radicand in radicands {
        pass.evaluate(&radicand.given)?;
    }
    for trial in 0..TRIALS << radicands.len().min(TOGETHER) {
        if trial > 0 {
            let number = trial.wrapping_mul(0x1_0001).wrapping_add(symbol.index() as u64);
            pass.change(symbol, Residue::mixed(!pass.seed(), number));
        }
        // one after the other: half of the points fail at the first
        let is_square = |radicand: &Radicand| {
            limits::spend(radicand.work);
            pass.evaluate_again(&radicand.changing, radicand.value).is_ok_and(|value| value.sqrt().is_some())
        };
        if radicands.iter().all(is_square) {
            return Ok(true);
        }
    }
    Ok(false)
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

    /// Of so many springs on one coordinate, at every point that is asked for.
    fn work_of_springs(count: i64) -> u64 {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        let lengths: Vec<ExprId> = (1..=count)
            .map(|times| {
                let (square, two) = (g.square(x), g.number(2));
                let sum = g.linear_combination(&[(Rational::from(times), square), (Rational::from(1), two)]);
                g.sqrt(sum)
            })
            .collect();
        let work = limits::within_limits(|| {
            let radicands = Radicands::of(&g, &lengths, &[]);
            for seed in 0..4 {
                let is_found = g.evaluate_in_field(&lengths, &radicands.point(&g, seed)).is_ok();
                assert!(is_found || count > 10, "{count}");
            }
            limits::spent()
        });
        work.unwrap()
    }

    #[test]
    fn what_is_hopeless_takes_no_trials() {
        assert!(work_of_springs(10) < 500_000, "{}", work_of_springs(10));
        assert!(work_of_springs(400) < 200_000, "{}", work_of_springs(400));
    }

    #[test]
    fn angles_in_radicands_are_divided_as_in_expressions() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        let (half, two) = (g.scale(Rational::new(1, 2), x), g.number(2));
        let (sine, of_half) = (g.sin(x), g.sin(half));
        let sum = g.add(sine, two);
        let root = g.sqrt(sum);
        let whole = g.mul(root, of_half);
        let radicands = Radicands::of(&g, &[whole], &[]);
        for seed in 0..16 {
            assert!(g.evaluate_in_field(&[whole], &radicands.point(&g, seed)).is_ok());
        }
    }
}

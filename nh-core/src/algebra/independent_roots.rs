//! Square roots each of which is a proper extension of what is before it.
//!
//! Radicands r₁, …, r_k, each a function of symbols and of the roots before it, make fields K₀ ⊂ K₁ ⊂ … ⊂ K_k, K_j =
//! K_{j−1}(√r_j). If r_j were c g² with a number c and g in K_{j−1}, it would be a square at all points of the field
//! where r₁, …, r_{j−1} are, or at none: it is proved not to be by two points. Then every K_j is of degree two over
//! the one before, and a function E in K_k that is not zero has a norm in K₀ that is not zero, of at most 2^k times its
//! degree. At a point where radicands are squares, E vanishes for some choice of roots only if its norm does; and one
//! of about 2^k points is such a point. So a point proves what it would prove without roots but for 2 k bits. Radicands that
//! are the same function, written in two ways, count once.

use super::field::Residue;
use super::graph::Graph;
use super::modular::{FieldPass, FieldPoint};
use super::node::{Function, Function2, Node};
use crate::id::{ExprId, SymbolId};
use num_integer::Integer;

/// At so many points have radicands the same values if they are the same functions, written otherwise: each has the
/// chance of two differing functions, which is below 2⁻²⁸ where their degree is below 2²⁰.
const POINTS_OF_EQUALS: u32 = 3;
/// What is a square at so many points, or at none of them, is taken for one everywhere, or nowhere.
const HOPELESS: u32 = 24;
/// More roots are not looked at: points where all radicands are squares are rare.
const MOST: usize = 6;
/// Points tried for each pattern of squares.
const TRIALS: u64 = 48;
/// Where these points begin.
const FIRST_SEED: u64 = 13_000_000;

/// Square roots that are proved to be independent.
pub(crate) struct IndependentRoots {
    /// What they are roots of, each after those in it.
    pub(crate) radicands: Vec<ExprId>,
    /// How many of these are not the same functions as others.
    distinct: usize,
}

impl IndependentRoots {
    /// How much less a point proves than without them: log₂.
    pub(crate) fn bits(&self) -> f64 {
        2.0 * f64::from(u32::try_from(self.distinct).unwrap_or(u32::MAX))
    }
}

/// What was seen of a radicand.
#[derive(Clone, Debug, Default)]
struct Seen {
    square: bool,
    none: bool,
    /// The points where it had a value.
    points: u32,
    /// The radicand before it whose values it has had, and at how many points.
    same: Option<(usize, u32)>,
    /// Whether it was at any point, and is its own function.
    differs: bool,
}

impl Seen {
    /// Takes note of a value, which is also that of a radicand before it; whether it is a square.
    fn take(&mut self, value: Residue, before: Option<usize>) -> bool {
        self.same = match (before, self.same) {
            (Some(place), None) if !self.differs => Some((place, 1)),
            (Some(place), Some((known, times))) if place == known => Some((known, times + 1)),
            _ => None,
        };
        self.differs |= self.same.is_none();
        // −1 is no square; what is zero, or no residue, tells nothing
        let [square, none] = [value, -value].map(|value| value.sqrt().is_some());
        self.points += 1;
        self.square |= square && !none;
        self.none |= none && !square;
        square && !none
    }

    /// Whether it has been a square always, or never, and that is hardly by chance.
    fn is_hopeless(&self) -> bool {
        self.points >= HOPELESS && !self.is_enough()
    }

    /// Whether it is a function of its own, and no square, or the same function as another.
    fn is_enough(&self) -> bool {
        self.square && self.none || self.same.is_some_and(|(_, times)| times >= POINTS_OF_EQUALS)
    }
}

/// Radicands that are those before them, written with names of intermediate results.
struct Others {
    /// Which of them each is.
    same: Vec<Option<usize>>,
    points: u32,
}

impl Others {
    fn of(count: usize) -> Self {
        Self { same: vec![None; count], points: 0 }
    }

    /// Whether it is known of each.
    fn is_known(&self) -> bool {
        self.same.is_empty() || self.points >= POINTS_OF_EQUALS
    }

    /// Takes note of values at a point; whether each is that of the radicand that it was at the points before.
    fn take(&mut self, values: &[Residue], known: &[Residue]) -> bool {
        self.points += 1;
        self.same.iter_mut().zip(values).all(|(same, value)| {
            let place = known.iter().position(|known| known == value);
            place.is_some_and(|place| *same.get_or_insert(place) == place)
        })
    }
}

impl Graph {
    /// The square roots in expressions, if they are proved to be independent as functions of symbols none of which is
    /// `bound` to others, and nothing else there has branches. What is bound has to be one of these written otherwise: it
    /// is given its values at a point, where they are known.
    pub(crate) fn independent_roots<'a>(
        &self,
        roots: &[ExprId],
        bound: &[SymbolId],
        pass: impl Fn(FieldPoint) -> FieldPass<'a>,
        values_of_bound: impl Fn(FieldPoint, &[ExprId]) -> Option<Vec<Residue>>,
    ) -> Option<IndependentRoots> {
        let radicands = self.square_radicands(roots)?;
        let is_free = |radicand: &ExprId| bound.is_empty() || !self.depends_on(*radicand, bound);
        let (radicands, others): (Vec<ExprId>, Vec<ExprId>) = radicands.into_iter().partition(is_free);
        let mut written_otherwise = Others::of(others.len());
        let mut seen = vec![Seen::default(); radicands.len()];
        for seed in FIRST_SEED..FIRST_SEED + (TRIALS << radicands.len().min(MOST)) {
            let point = FieldPoint::random(seed);
            let mut pass = pass(point.clone());
            let mut values: Vec<Residue> = Vec::with_capacity(radicands.len());
            for (radicand, seen) in radicands.iter().zip(&mut seen) {
                let Ok(value) = pass.evaluate_one(*radicand) else { break };
                let before = values.iter().position(|known| *known == value);
                let goes_on = seen.take(value, before);
                values.push(value);
                if !goes_on {
                    break;
                }
            }
            if seen.iter().any(Seen::is_hopeless) {
                return None;
            }
            if !written_otherwise.is_known()
                && values.len() == radicands.len()
                && let Some(of_others) = values_of_bound(point, &others)
                && !written_otherwise.take(&of_others, &values)
            {
                return None;
            }
            let distinct = seen.iter().filter(|seen| seen.same.is_none()).count();
            if written_otherwise.is_known() && seen.iter().all(Seen::is_enough) && distinct <= MOST {
                return Some(IndependentRoots { radicands, distinct });
            }
        }
        None
    }

    /// Whether a function is the square of another one that is not zero, as far as points tell: then its roots are two
    /// functions, which have nothing to do with one another.
    pub(crate) fn is_square_everywhere(&self, function: ExprId) -> bool {
        if let Some(number) = self.value_of(function) {
            return !number.is_zero() && number.sqrt().is_some();
        }
        if self.symbols_in(&[function]).is_empty() {
            return false;
        }
        let values = (FIRST_SEED..FIRST_SEED + TRIALS)
            .filter_map(|seed| FieldPass::new(self, FieldPoint::random(seed), 1).evaluate_one(function).ok());
        // the first that is none tells
        let mut points = 0;
        for value in values.filter(|value| *value != Residue::ZERO).take(HOPELESS as usize) {
            if value.sqrt().is_none() {
                return false;
            }
            points += 1;
        }
        points == HOPELESS
    }

    /// Whether numbers that are not rational are parts of an expression: √3, or cos(π/6).
    pub(crate) fn has_irrational_numbers(&self, root: ExprId) -> bool {
        let mut found = false;
        self.each_reachable(&[root], |id| {
            found |= match self.node(id) {
                Node::Pi => true,
                Node::Product { factors, .. } => factors
                    .iter()
                    .any(|(base, exponent)| !exponent.is_integer() && self.value_of(*base).is_some()),
                Node::Apply(_, x) => self.value_of(*x).is_some(),
                _ => false,
            };
            !found
        });
        found
    }

    /// What roots of even order in expressions are taken of, as far as there are symbols in it.
    pub(crate) fn radicands(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let mut found: Vec<ExprId> = Vec::new();
        for id in self.reachable(roots) {
            let Node::Product { factors, .. } = self.node(id) else { continue };
            for (base, exponent) in factors.iter() {
                let is_even = !exponent.is_integer() && !exponent.denominator().is_odd();
                if is_even && !self.symbols_in(&[*base]).is_empty() && !found.contains(base) {
                    found.push(*base);
                }
            }
        }
        found
    }

    /// What square roots in expressions are taken of, but for numbers; `None` where something else has branches.
    pub(crate) fn square_radicands(&self, roots: &[ExprId]) -> Option<Vec<ExprId>> {
        let mut found: Vec<ExprId> = Vec::new();
        for id in self.reachable(roots) {
            match self.node(id) {
                Node::Product { factors, .. } => {
                    for (base, exponent) in factors.iter().filter(|(_, exponent)| !exponent.is_integer()) {
                        let order = exponent.denominator();
                        // cube roots and their like are unique, and those of numbers are the same at all points
                        if order.is_odd() || self.symbols_in(&[*base]).is_empty() {
                            continue;
                        }
                        if exponent.to_small().is_none_or(|(_, order)| order != 2) {
                            return None;
                        }
                        if !found.contains(base) {
                            found.push(*base);
                        }
                    }
                }
                Node::Apply(Function::Asin | Function::Acos, _)
                | Node::Apply2(Function2::Min | Function2::Max, ..) => return None,
                // above arcs the circle has roots
                Node::Apply(Function::Sin | Function::Cos, x) if !self.inside_arcs(*x).is_empty() => {
                    return None;
                }
                _ => {}
            }
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rational;

    fn are_independent(graph: &Graph, roots: &[ExprId]) -> bool {
        let found = graph.independent_roots(roots, &[], |point| FieldPass::new(graph, point, 1), |_, _| None);
        found.is_some_and(|found| !found.radicands.is_empty())
    }

    /// The root of an intermediate result is no further one where that is what another root is taken of.
    #[test]
    fn intermediate_results_are_recognised() {
        let mut g = Graph::new();
        let [x, bound] = ["x", "s"].map(|name| g.new_symbol(name));
        let [x, name] = [x, bound].map(|symbol| g.symbol(symbol));
        let (one, xx) = (g.one(), g.square(x));
        let (radicand, further) = (g.formula(xx + one), g.formula(xx + one + one));
        let roots = [radicand, name].map(|radicand| g.sqrt(radicand));
        let pass = |point| FieldPass::new(&g, point, 1);
        let found = |meant: ExprId| {
            let values = |point, _: &[ExprId]| Some(vec![pass(point).evaluate_one(meant).ok()?]);
            g.independent_roots(&roots, &[bound], pass, values).map(|roots| roots.bits())
        };
        assert_eq!(found(radicand), Some(2.0));
        assert_eq!(found(further), None);
        assert!(g.independent_roots(&roots, &[bound], pass, |_, _| None).is_none());
    }

    #[test]
    fn what_is_a_square_of_others_is_seen() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let one = g.one();
        let (xx, yy) = (g.square(x), g.square(y));
        let (circle, shifted) = (g.add(xx, yy), g.add(xx, one));
        let [first, second] = [circle, shifted].map(|radicand| g.sqrt(radicand));
        assert!(are_independent(&g, &[first, second]));
        // √((x² + y²)(x² + 1)) is the product of both, up to its sign
        let product = g.mul(circle, shifted);
        let expanded = g.simplify(product);
        let third = g.sqrt(expanded);
        assert!(are_independent(&g, &[first, third]) && !are_independent(&g, &[first, second, third]));
        // 3 x² + 3 is no square, but a multiple of another radicand
        let multiple = g.linear_combination(&[(3.into(), xx), (3.into(), one)]);
        let multiple = g.sqrt(multiple);
        assert!(are_independent(&g, &[multiple]) && !are_independent(&g, &[second, multiple]));
        // one of them written otherwise is no further one
        let written = g.sqrt(expanded);
        let factors = g.sqrt(product);
        assert!(are_independent(&g, &[written, factors, first]));
        // fourth roots are not counted as square roots, beside one of the same or alone
        let fourth = g.pow(circle, Rational::new(1, 4));
        assert!(!are_independent(&g, &[first, fourth]) && !are_independent(&g, &[fourth]));
        // √(x²) is x or −x
        let length = g.sqrt(xx);
        assert!(!are_independent(&g, &[length]));
        // (√(x² + 1) + y)² written out, over √(x² + 1)
        let sum = g.add(second, y);
        let square = g.square(sum);
        let square = g.simplify(square);
        let [nested, beside] = [square, sum].map(|radicand| g.sqrt(radicand));
        assert!(!are_independent(&g, &[nested]) && are_independent(&g, &[beside]));
        // a symbol that is bound to others may make a square of anything
        let symbols = g.symbols_in(&[y]).into_iter().collect::<Vec<_>>();
        assert!(
            g.independent_roots(&[first], &symbols, |point| FieldPass::new(&g, point, 1), |_, _| None)
                .is_none()
        );
    }
}

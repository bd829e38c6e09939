//! Whether inequalities contradict each other, over all real values of their symbols.
//!
//! Six proofs are tried. Intervals are propagated through every part of the expressions, from the
//! symbols to the whole and back (F. Benhamou, F. Goualard, L. Granvilliers, J.-F. Puget, *Revising hull and box
//! consistency*, ICLP 1999). Quadratic polynomials have the least value that completing squares gives.
//! And non-negative multiples of the inequalities, with the squares of sums and differences of their
//! variables, may add up to `0 > 0` (`simplex.rs`), as they are or where functions have their extreme values
//! (`bounded_terms.rs`), or where the equations among them are solved (`solved_equations.rs`). The arithmetic mean of
//! positive products is not below the geometric one (`mean_inequality.rs`), and the product of what is positive is
//! positive (`sign_parity.rs`). Points that satisfy all of
//! them are looked for before what is dear: some that are at hand, and where there are equations, those that Newton's steps
//! lead to (`regular_points.rs`). A system that none of them refutes is *not* known to have a solution.

use super::combination::negative;
use super::enclosure::Point;
use super::graph::Graph;
use super::interval::Interval;
use super::node::{Function, Node};
use super::number::Rational;
use super::polynomial_terms::{Terms, least_value};
use super::range::{Facts, Range};
use super::zero_test::sample;
use crate::id::{ExprId, Id, SymbolId};
use crate::limits;
use rustc_hash::FxHashMap;

/// What an expression is required to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// Above 0.
    Positive,
    /// Not below 0.
    NotNegative,
    /// Not 0.
    Nonzero,
    /// 0.
    Zero,
}

impl Demand {
    pub(super) fn interval(self) -> Interval {
        match self {
            Self::Positive => Interval::positive(),
            Self::NotNegative => Interval::not_negative(),
            Self::Nonzero => Interval::NONZERO,
            Self::Zero => Interval::point(&Rational::ZERO),
        }
    }
}

/// Why demands contradict each other.
#[derive(Clone, Debug, PartialEq)]
pub enum Contradiction {
    /// No values are left for one of them.
    Nowhere(usize),
    /// These multiples of them add up to a number that is not as demanded.
    Combination(Vec<(usize, Rational)>),
    /// One of them asks the negative of a sum of squares to be positive, or the like.
    NegativeSquares(usize),
    /// They exclude each other by a proof that is not shown: products of them, what holds of functions, equations that
    /// are solved.
    Together,
}

/// Points that are tried before anything is proved.
const SAMPLES: u64 = 6;
/// Times that intervals are propagated.
const ROUNDS: usize = 12;
/// Expressions with more parts are not looked at.
const LARGEST: usize = 2000;
/// Operands of longer sums and products tell nothing of each other.
const MANY: usize = 40;
/// Steps of work after which intervals are left as wide as they are.
const PROPAGATED: u64 = 1_000_000;

/// What intervals the parts of expressions are in.
pub(super) type Known = FxHashMap<ExprId, Interval>;

/// A sum: the range of a part of it, and other terms with their coefficients.
struct Shifted {
    range: Interval,
    others: Vec<(ExprId, Rational)>,
}

impl Graph {
    /// A proof that no values of the symbols satisfy all demands, if one is found.
    #[must_use]
    pub fn contradiction(&self, demands: &[(ExprId, Demand)]) -> Option<Contradiction> {
        if self.are_met_somewhere(demands) {
            return None;
        }
        let mut known = Known::default();
        if let Err(index) = self.propagate_for_a_while(demands, &mut known) {
            return Some(Contradiction::Nowhere(index));
        }
        let is_below = |(id, demand): &(ExprId, Demand)| {
            self.polynomial_terms(*id).is_some_and(|terms| self.is_below_its_mean(&terms, *demand, &known))
        };
        // last, since these say less of the reason than the others
        let excluded = || demands.iter().any(is_below) || self.have_no_signs(demands);
        self.combination(demands, &known).or_else(|| excluded().then_some(Contradiction::Together))
    }

    /// Those demands that are about expressions, or about what others of them are about.
    #[must_use]
    pub fn related_demands(&self, demands: &[(ExprId, Demand)], to: &[ExprId]) -> Vec<(ExprId, Demand)> {
        let mut symbols = self.symbols_in(to);
        let (mut found, mut open) = (Vec::new(), demands.to_vec());
        loop {
            let is_near = |(id, _): &(ExprId, Demand)| self.depends_on(*id, &symbols);
            let (near, far): (Vec<_>, Vec<_>) = open.into_iter().partition(is_near);
            if near.is_empty() {
                return found;
            }
            let roots: Vec<ExprId> = near.iter().map(|(id, _)| *id).collect();
            symbols.extend(self.symbols_in(&roots));
            found.extend(near);
            open = far;
        }
    }

    /// Whether one of a few points is found that certainly satisfies all demands.
    fn are_met_somewhere(&self, demands: &[(ExprId, Demand)]) -> bool {
        if demands.iter().any(|(_, demand)| *demand == Demand::Zero) {
            return false;
        }
        let roots: Vec<ExprId> = demands.iter().map(|(id, _)| *id).collect();
        let points = (0..SAMPLES).map(|point| {
            move |symbol: SymbolId| {
                let number = sample(point, symbol.index());
                if point % 2 == 0 { number.abs() } else { number }
            }
        });
        self.evaluate_each(&roots, points).any(|values| {
            values.iter().zip(demands).all(|(value, (_, demand))| {
                value.is_certainly_nonzero() && (*demand == Demand::Nonzero || value.value > 0.0)
            })
        })
    }

    /// Facts that follow from demands that do not contradict each other.
    #[must_use]
    pub fn consequences(&self, demands: &[(ExprId, Demand)]) -> Facts {
        let (mut known, mut facts) = (Known::default(), Facts::default());
        if self.propagate_for_a_while(demands, &mut known).is_ok() {
            for (id, interval) in known {
                let (low, high) = interval.to_f64();
                let range = Range { low, high, nonzero: interval.is_nonzero() };
                if let Some(symbol) = self.as_symbol(id)
                    && range != Range::ALL
                {
                    facts.symbols.insert(symbol, range);
                }
            }
        }
        facts
    }

    /// [`Self::propagate`], as far as that goes at moderate work.
    fn propagate_for_a_while(&self, demands: &[(ExprId, Demand)], known: &mut Known) -> Result<(), usize> {
        limits::attempt(PROPAGATED, || self.propagate(demands, known)).unwrap_or(Ok(()))
    }

    /// Narrows the intervals of all parts; the index of a demand that leaves nothing, if one does.
    fn propagate(&self, demands: &[(ExprId, Demand)], known: &mut Known) -> Result<(), usize> {
        let parts: Vec<Vec<ExprId>> = demands.iter().map(|(id, _)| self.reachable(&[*id])).collect();
        if parts.iter().map(Vec::len).sum::<usize>() > LARGEST {
            return Ok(());
        }
        for (index, parts) in parts.iter().enumerate() {
            for part in parts {
                if let Some(fixed) = self.fixed_interval(*part, known) {
                    narrow(known, *part, &fixed).map_err(|()| index)?;
                }
            }
        }
        let shifted: FxHashMap<ExprId, Shifted> =
            parts.iter().flatten().filter_map(|id| Some((*id, self.shifted_sum(*id)?))).collect();
        for _ in 0..ROUNDS {
            let mut changed = false;
            for (index, ((id, demand), parts)) in demands.iter().zip(&parts).enumerate() {
                for part in parts {
                    let interval = self.interval_of_node(*part, known);
                    changed |= narrow(known, *part, &interval).map_err(|()| index)?;
                    if let Some(Shifted { range, others }) = shifted.get(part) {
                        let sum = others.iter().fold(range.clone(), |sum, (other, c)| {
                            sum.plus(&known.get(other).unwrap_or(&Interval::ALL).scaled(c))
                        });
                        changed |= narrow(known, *part, &sum).map_err(|()| index)?;
                    }
                }
                changed |= narrow(known, *id, &demand.interval()).map_err(|()| index)?;
                for part in parts.iter().rev() {
                    changed |= self.push_down(*part, known).map_err(|()| index)?;
                }
            }
            if !changed {
                break;
            }
        }
        Ok(())
    }

    /// What is known of a node whatever else is: the value of a number, the range of a quadratic polynomial.
    fn fixed_interval(&self, id: ExprId, known: &Known) -> Option<Interval> {
        if let Some(number) = self.value_of(id) {
            return Some(Interval::point(number));
        }
        if known.contains_key(&id) || matches!(self.node(id), Node::Symbol(_)) {
            return None;
        }
        if self.node(id).operands().all(|operand| self.is_number(operand)) {
            return Some(self.interval_of_number(id));
        }
        let Node::Sum { .. } = self.node(id) else { return None };
        self.polynomial_terms(id).map(|polynomial| range_of_quadratic(&polynomial))
    }

    /// A sum as a part with a range whatever its symbols are, and parts that stand in no other term: sines and cosines,
    /// and a quadratic polynomial with a least or a largest value.
    fn shifted_sum(&self, id: ExprId) -> Option<Shifted> {
        let Node::Sum { .. } = self.node(id) else { return None };
        let polynomial = self.polynomial_terms(id)?;
        let harmonics = self.without_harmonics(&polynomial);
        let is_harmonic = harmonics.is_some();
        let (range, mut polynomial) =
            harmonics.unwrap_or_else(|| (Interval::point(&Rational::ZERO), polynomial.clone()));
        let mut others = Vec::new();
        for (monomial, coefficient) in polynomial.clone() {
            let [(part, exponent)] = monomial.as_slice() else { continue };
            let is_elsewhere =
                polynomial.keys().any(|other| *other != monomial && other.iter().any(|(p, _)| p == part));
            let stands_alone = is_harmonic || matches!(self.node(*part), Node::Apply(..));
            if exponent.is_one() && !is_elsewhere && stands_alone {
                polynomial.remove(&monomial);
                others.push((*part, coefficient));
            }
        }
        let rest = match polynomial.len() {
            0 => Interval::point(&Rational::ZERO),
            _ if is_harmonic && polynomial.keys().all(Vec::is_empty) => {
                polynomial.values().fold(Interval::point(&Rational::ZERO), |_, value| Interval::point(value))
            }
            _ => range_of_quadratic(&polynomial),
        };
        let range = range.plus(&rest);
        ((is_harmonic || !others.is_empty()) && range != Interval::ALL).then_some(Shifted { range, others })
    }

    /// Whether no symbol occurs.
    fn is_number(&self, id: ExprId) -> bool {
        self.value_of(id).is_some() || self.symbols_in(&[id]).is_empty()
    }

    /// The values of a node for values of its operands.
    fn interval_of_node(&self, id: ExprId, known: &Known) -> Interval {
        match self.node(id) {
            Node::Sum { constant, terms } => {
                let start = Interval::point(constant);
                terms.iter().fold(start, |sum, (term, c)| sum.plus(&known[term].scaled(c)))
            }
            Node::Product { coefficient, factors } => {
                let product = factors.iter().map(|(base, e)| known[base].power(e));
                product.fold(Interval::point(coefficient), |product, factor| product.times(&factor))
            }
            Node::Apply(function, x) => known[x].function(*function),
            _ => Interval::ALL,
        }
    }

    /// An expression without symbols.
    fn interval_of_number(&self, id: ExprId) -> Interval {
        let nowhere = |_| Rational::ZERO;
        let value = self.evaluate_exactly(&[id], Point::Given(&nowhere), 192);
        let verdict = || self.zero_test(id).is_zero();
        match value {
            Ok(evaluated) if !evaluated.values[0].ball.is_nonzero() && verdict() => {
                Interval::point(&Rational::ZERO)
            }
            Ok(evaluated) => Interval::of_ball(&evaluated.values[0].ball),
            Err(_) => Interval::ALL,
        }
    }

    /// Narrows the operands of a node by what is known of it; whether something changed.
    fn push_down(&self, id: ExprId, known: &mut Known) -> Result<bool, ()> {
        let whole = known[&id].clone();
        let mut changed = false;
        match self.node(id) {
            Node::Sum { constant, terms } if terms.len() <= MANY => {
                for (index, (term, coefficient)) in terms.iter().enumerate() {
                    let others = terms.iter().enumerate().filter(|(other, _)| *other != index);
                    let rest = others.fold(Interval::point(constant), |sum, (_, (other, c))| {
                        sum.plus(&known[other].scaled(c))
                    });
                    let Some(inverse) = coefficient.recip() else { continue };
                    let share = whole.plus(&rest.scaled(&Rational::MINUS_ONE)).scaled(&inverse);
                    changed |= narrow(known, *term, &share)?;
                }
            }
            Node::Product { coefficient, factors } => {
                for (index, (base, exponent)) in factors.iter().enumerate() {
                    let others = factors.iter().enumerate().filter(|(other, _)| *other != index);
                    let product = || {
                        others.fold(Interval::point(coefficient), |product, (_, (other, e))| {
                            product.times(&known[other].power(e))
                        })
                    };
                    let rest = if factors.len() <= MANY { product() } else { Interval::ALL };
                    let mut share = Interval::ALL;
                    if rest.is_nonzero() {
                        share = whole.times(&rest.reciprocal());
                    } else if whole.is_nonzero() {
                        share = Interval::NONZERO;
                    }
                    changed |= narrow(known, *base, &share.base_of_power(exponent, &known[base]))?;
                    if !exponent.is_integer() {
                        changed |= narrow(known, *base, &Interval::not_negative())?;
                    }
                    if exponent.is_negative() {
                        changed |= narrow(known, *base, &Interval::NONZERO)?;
                    }
                }
            }
            Node::Apply(function, x) => {
                changed |= narrow(known, *x, &whole.argument_of(*function, &known[x]))?;
                if *function == Function::Ln {
                    changed |= narrow(known, *x, &Interval::positive())?;
                }
            }
            _ => {}
        }
        Ok(changed)
    }
}

/// Narrows one interval; whether it changed, or an error where nothing is left.
fn narrow(known: &mut Known, id: ExprId, by: &Interval) -> Result<bool, ()> {
    let before = known.get(&id).cloned().unwrap_or(Interval::ALL);
    let after = before.meet(by);
    if after.is_empty() {
        return Err(());
    }
    let changed = after != before;
    known.insert(id, after);
    Ok(changed)
}

/// The values of a quadratic polynomial over all real numbers.
fn range_of_quadratic(polynomial: &Terms) -> Interval {
    if polynomial.keys().all(|monomial| monomial.len() < 2 && monomial.iter().all(|(_, e)| e.is_one())) {
        return Interval::ALL;
    }
    if let Some(least) = least_value(polynomial) {
        return Interval::at_least(least);
    }
    match least_value(&negative(polynomial)) {
        Some(least) => Interval::at_least(least).scaled(&Rational::MINUS_ONE),
        None => Interval::ALL,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Demands on x and y from the coefficients of 1, x, y, x², xy, y².
    fn demands(g: &mut Graph, list: &[([i64; 6], Demand)]) -> Vec<(ExprId, Demand)> {
        let [x, y] = ["x", "y"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let monomials = [g.one(), x, y, g.square(x), g.mul(x, y), g.square(y)];
        list.iter()
            .map(|(coefficients, demand)| {
                let terms: Vec<_> =
                    coefficients.iter().zip(monomials).map(|(c, m)| ((*c).into(), m)).collect();
                (g.linear_combination(&terms), *demand)
            })
            .collect()
    }

    /// x² + xy + y² + a f(z) + b = 0.
    #[test]
    fn quadratic_polynomials_beside_functions() {
        for (function, coefficient, constant, is_contradictory) in [
            (Function::Exp, 1, 0, true),
            (Function::Exp, -1, 0, false),
            (Function::Cosh, 1, 0, true),
            (Function::Cosh, 1, -2, false),
            (Function::Sin, 1, 2, true),
            (Function::Sin, 3, 2, false),
            (Function::Ln, 1, 5, false),
        ] {
            let mut g = Graph::new();
            let z = g.new_symbol("z");
            let z = g.symbol(z);
            let term = g.apply(function, z);
            let found = demands(&mut g, &[([constant, 0, 0, 1, 1, 1], Demand::Zero)]);
            let sum = g.linear_combination(&[(Rational::ONE, found[0].0), (coefficient.into(), term)]);
            let outcome = g.contradiction(&[(sum, Demand::Zero)]);
            assert_eq!(outcome.is_some(), is_contradictory, "{function:?} {coefficient} {constant}");
        }
    }

    #[test]
    fn what_contradicts_and_what_does_not() {
        use Demand::{Nonzero, NotNegative, Positive, Zero};
        let product = [0, 0, 0, 0, 1, 0];
        for (is_contradictory, list) in [
            // x ≥ 1, x ≤ 1, then x ≠ 1
            (false, vec![([-1, 1, 0, 0, 0, 0], NotNegative), ([1, -1, 0, 0, 0, 0], NotNegative)]),
            (
                true,
                vec![
                    ([-1, 1, 0, 0, 0, 0], NotNegative),
                    ([1, -1, 0, 0, 0, 0], NotNegative),
                    ([-1, 1, 0, 0, 0, 0], Nonzero),
                ],
            ),
            // x ≥ y, y ≥ x, x ≠ y
            (
                true,
                vec![
                    ([0, 1, -1, 0, 0, 0], NotNegative),
                    ([0, -1, 1, 0, 0, 0], NotNegative),
                    ([0, 1, -1, 0, 0, 0], Nonzero),
                ],
            ),
            // x² + xy + y² < 0, ≤ 0
            (true, vec![([0, 0, 0, -1, -1, -1], Positive)]),
            (false, vec![([0, 0, 0, -1, -1, -1], NotNegative)]),
            (true, vec![([-1, 0, 0, -1, -1, -1], Zero)]),
            (false, vec![([-1, 0, 0, 1, 1, 1], Zero)]),
            (false, vec![([0, 0, 0, -1, -3, -1], Positive)]),
            // xy = 1, x² + y² = 1 or 4
            (true, vec![([-1, 0, 0, 0, 1, 0], Zero), ([-1, 0, 0, 1, 0, 1], Zero)]),
            (false, vec![([-1, 0, 0, 0, 1, 0], Zero), ([-4, 0, 0, 1, 0, 1], Zero)]),
            // x > 1, y > 1, xy < 1 or 2
            (
                true,
                vec![
                    ([-1, 1, 0, 0, 0, 0], Positive),
                    ([-1, 0, 1, 0, 0, 0], Positive),
                    ([1, 0, 0, 0, -1, 0], Positive),
                ],
            ),
            (
                false,
                vec![
                    ([-1, 1, 0, 0, 0, 0], Positive),
                    ([-1, 0, 1, 0, 0, 0], Positive),
                    ([2, 0, 0, 0, -1, 0], Positive),
                ],
            ),
            (false, vec![(product, Positive), ([0, 1, 1, 0, 0, 0], Positive)]),
        ] {
            let mut g = Graph::new();
            let demands = demands(&mut g, &list);
            assert_eq!(g.contradiction(&demands).is_some(), is_contradictory, "{list:?}");
        }
    }
}

//! Expressions with branches: what vanishes at some points may be one branch that they lie on.
//!
//! Absolute values, signs, the smaller and the larger of two, roots of squares and arcs are other functions on other sides
//! of places that random points of order one need not lie on both sides of: a stop at x = −1, a peg of 2 cm. What is
//! taken for zero is looked at in many decades, and both sides of every kink have to have been seen.

use super::evaluate::Bounded;
use super::field::Residue;
use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::range::Facts;
use super::verdict::{Verdict, Witness};
use crate::id::{ExprId, SymbolId};

/// Points at which is looked.
const POINTS: u64 = 400;
/// Expressions with more parts, which have roots alone, are not looked at.
const LARGEST: usize = 200;
/// The decades of numbers: from 10⁻⁴ on.
const DECADES: u64 = 13;

/// Two operands whose difference has a kink where it is 0; one of them, where the other is 0.
type Kink = (ExprId, Option<ExprId>);

impl Graph {
    /// What becomes of the verdict that an expression is zero, if it has branches.
    pub(super) fn zero_on_all_branches(&self, expression: ExprId) -> Verdict {
        let parts = self.reachable(&[expression]);
        let kinks: Vec<Kink> = parts.iter().filter_map(|id| self.kink(*id)).collect();
        let is_branched = !kinks.is_empty() || parts.len() <= LARGEST && self.has_other_branches(&parts);
        if !is_branched {
            return Verdict::Zero;
        }
        let symbols = self.symbols_in(&[expression]);
        let sides: Vec<ExprId> =
            kinks.iter().flat_map(|(a, b)| [Some(*a), *b]).flatten().chain([expression]).collect();
        let mut evaluator = self.evaluator(&sides);
        let mut seen = vec![[false; 2]; kinks.len()];
        for attempt in 0..POINTS {
            let value = |symbol: SymbolId| {
                symbols
                    .iter()
                    .position(|known| *known == symbol)
                    .map_or(f64::NAN, |index| wide(attempt, index))
            };
            let values = evaluator.at(value);
            let Some((last, mut rest)) = values.split_last() else { break };
            if last.value.is_finite() && last.is_certainly_nonzero() {
                let point = symbols.iter().enumerate().map(|(index, symbol)| (*symbol, wide(attempt, index)));
                return Verdict::NonZero(Witness { value: last.value, point: point.collect() });
            }
            for ((_, other), seen) in kinks.iter().zip(&mut seen) {
                let (own, beyond) = rest.split_at(1 + usize::from(other.is_some()));
                rest = beyond;
                let side = match own {
                    [a] => *a,
                    [a, b] => Bounded::rounded(a.value - b.value, a.error + b.error),
                    _ => continue,
                };
                if side.is_certainly_nonzero() {
                    seen[usize::from(side.value > 0.0)] = true;
                }
            }
        }
        let unseen = kinks.iter().zip(&seen).find(|((a, b), seen)| {
            let has_one_side = b.is_none() && {
                let range = self.range(*a, &Facts::default());
                range.low >= 0.0 || range.high <= 0.0
            };
            !has_one_side && **seen != [true; 2]
        });
        match unseen {
            None => Verdict::Zero,
            Some(((a, b), _)) => {
                let side = match b {
                    None => format!("{} changes its sign", self.text_within(*a, 100)),
                    Some(b) => {
                        format!("{} and {} cross", self.text_within(*a, 100), self.text_within(*b, 100))
                    }
                };
                Verdict::Unknown(format!("it is zero at every point tried, but {side} at none of them"))
            }
        }
    }

    /// Where a node has a kink.
    fn kink(&self, id: ExprId) -> Option<Kink> {
        match self.node(id) {
            Node::Apply(Function::Abs | Function::Sign, x) => Some((*x, None)),
            Node::Apply2(Function2::Min | Function2::Max, a, b) => Some((*a, Some(*b))),
            _ => None,
        }
    }

    /// Whether there are arcs, or roots that may be those of squares.
    fn has_other_branches(&self, parts: &[ExprId]) -> bool {
        parts.iter().any(|id| match self.node(*id) {
            Node::Apply(Function::Asin | Function::Acos | Function::Atan, _)
            | Node::Apply2(Function2::Atan2, ..) => true,
            Node::Product { factors, .. } => factors
                .iter()
                .any(|(base, exponent)| !exponent.is_integer() && !self.symbols_in(&[*base]).is_empty()),
            _ => false,
        })
    }
}

/// Numbers of one or two digits in many decades and of both signs; at every other point all in one decade.
pub(super) fn wide(attempt: u64, index: usize) -> f64 {
    let word = Residue::mixed(attempt, 5_000 + index as u64).word();
    let common = Residue::mixed(attempt, 4_999).word();
    let decade = (if attempt.is_multiple_of(2) { common } else { word >> 32 }) % DECADES;
    let digits = f64::from(u16::try_from(word % 90).unwrap_or(0) + 10) / 10.0;
    let sign = if word >> 16 & 1 == 0 { 1.0 } else { -1.0 };
    sign * digits * 10.0_f64.powi(i32::try_from(decade).unwrap_or(0) - 4)
}

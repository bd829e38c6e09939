//! What an expression costs to evaluate, roughly.

use crate::algebra::graph::Graph;
use crate::algebra::node::{Function, Function2, Node};
use crate::algebra::number::Rational;
use crate::count::Count;
use crate::id::ExprId;
use rustc_hash::FxHashSet;

const DIVISION: u64 = 5;
const ROOT: u64 = 6;
const FUNCTION: u64 = 20;

impl Graph {
    /// The weighted number of distinct operations in `roots`, in units of one addition or
    /// multiplication.
    ///
    /// A sum costs its terms less one and its coefficients, a product its factors less one, a
    /// power its chain of multiplications, a root 6, all denominators of a product together one
    /// division for 5, a function 20 – sine and cosine of one angle together once – but |x|, a sign, min and max 1. Whatever
    /// occurs several times counts once.
    #[must_use]
    pub fn operation_count(&self, roots: &[ExprId]) -> Count {
        self.operation_count_within(roots, usize::MAX).unwrap_or(Count::TOO_MANY)
    }

    /// The cost, if there are at most `limit` distinct expressions.
    pub(super) fn operation_count_within(&self, roots: &[ExprId], limit: usize) -> Option<Count> {
        let (mut tally, mut found) = (Tally::default(), 0);
        self.each_reachable(roots, |id| {
            found += 1;
            tally.count(self.node(id));
            found <= limit
        });
        (found <= limit).then_some(tally.cost)
    }
}

#[derive(Default)]
struct Tally {
    cost: Count,
    powers: FxHashSet<(ExprId, Rational)>,
    angles: FxHashSet<(bool, ExprId)>,
}

impl Tally {
    fn count(&mut self, node: &Node) {
        match node {
            Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => {}
            Node::Sum { constant, terms } => {
                self.cost += Count::from(terms.len()) - 1 + u64::from(!constant.is_zero());
                self.cost += Count::from(terms.iter().filter(|(_, c)| !is_unit(c)).count());
            }
            Node::Product { coefficient, factors } => {
                let below =
                    Count::from(factors.iter().filter(|(_, exponent)| exponent.is_negative()).count());
                let above = Count::from(factors.len()) - below + u64::from(!is_unit(coefficient));
                self.cost += (above - 1) + (below - 1);
                self.cost += if below > 0 { DIVISION } else { 0 };
                for (base, exponent) in factors.iter() {
                    if is_unit(exponent) {
                        continue;
                    }
                    let exponent = exponent.abs();
                    if self.powers.insert((*base, exponent.clone())) {
                        self.cost += power(&exponent);
                    }
                }
            }
            Node::Apply(Function::Abs | Function::Sign, _)
            | Node::Apply2(Function2::Min | Function2::Max, ..) => self.cost += 1,
            Node::Apply(Function::Sin | Function::Cos, x) => self.angle(true, *x),
            Node::Apply(Function::Sinh | Function::Cosh, x) => self.angle(false, *x),
            Node::Apply(..) | Node::Apply2(..) => self.cost += FUNCTION,
        }
    }

    fn angle(&mut self, circular: bool, x: ExprId) {
        if self.angles.insert((circular, x)) {
            self.cost += FUNCTION;
        }
    }
}

fn is_unit(coefficient: &Rational) -> bool {
    coefficient.is_one() || *coefficient == Rational::MINUS_ONE
}

fn power(exponent: &Rational) -> u64 {
    match exponent.to_small() {
        Some((n, 1)) => chain(n),
        Some((n, 2)) => ROOT + chain(n),
        _ => FUNCTION,
    }
}

/// Multiplications of a binary chain.
fn chain(n: i64) -> u64 {
    let n = n.unsigned_abs().max(1);
    u64::from(n.ilog2()) + u64::from(n.count_ones()) - 1
}

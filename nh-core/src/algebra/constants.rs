//! Numbers that have names: to the rules of algebra they are operands like symbols, to proofs and samples
//! numbers.
//!
//! Were they numbers to the algebra, they would be distributed over sums and collected, which hides
//! what the terms of long equations have in common. So derivations take the way that they take with
//! parameters, and programs fold what is made of constants alone (`program/fold.rs`). Wherever
//! something is proved or sampled a constant is its value: what holds, or fails, for these values alone is
//! found. Automatic identity:
//!
//! | identity | condition |
//! |---|---|
//! | `a·x − b·x = 0` | `a`, `b` of numbers and constants alone, of equal value |

use super::node::Node;
use super::number::Rational;
use crate::id::{ConstantId, ExprId, Table};
use rustc_hash::FxHashMap;

/// A number that has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    /// The name, for messages and printing.
    pub name: String,
    /// The value.
    pub value: Rational,
}

/// The constants of a graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Constants {
    pub(super) table: Table<ConstantId, Constant>,
    /// The values of expressions made of constants, and numbers, alone.
    pub(super) values: FxHashMap<ExprId, Rational>,
}

/// What is left of a term without its numbers and constants.
pub(super) type Rest = Vec<(ExprId, Rational)>;

impl Constants {
    /// Notes the value of a new node, if it has one.
    pub(super) fn note(&mut self, id: ExprId, node: &Node) {
        if !self.table.is_empty()
            && let Some(value) = self.value_of_node(node)
        {
            self.values.insert(id, value);
        }
    }

    /// The value of a node over the values of its operands.
    fn value_of_node(&self, node: &Node) -> Option<Rational> {
        let value = match node {
            Node::Constant(constant) => self.table[*constant].value.clone(),
            Node::Sum { constant, terms } => {
                terms.iter().try_fold(constant.clone(), |sum, (term, coefficient)| {
                    Some(sum + coefficient.clone() * self.values.get(term)?.clone())
                })?
            }
            Node::Product { coefficient, factors } => {
                factors.iter().try_fold(coefficient.clone(), |product, (base, exponent)| {
                    Some(product * self.values.get(base)?.pow(exponent.to_i64()?)?)
                })?
            }
            _ => return None,
        };
        (value.to_small().is_some() || value.bits() <= Rational::MAX_BITS).then_some(value)
    }

    /// The number that a term is a multiple of, and what is left of it.
    pub(super) fn split(&self, node: &Node, term: ExprId) -> (Rational, Rest) {
        if let Some(value) = self.values.get(&term) {
            return (value.clone(), Rest::new());
        }
        let Node::Product { coefficient, factors } = node else {
            return (Rational::ONE, vec![(term, Rational::ONE)]);
        };
        let mut number = coefficient.clone();
        let mut rest = Rest::with_capacity(factors.len());
        for (base, exponent) in factors.iter() {
            let power = self.values.get(base).and_then(|value| value.pow(exponent.to_i64()?));
            match power {
                Some(power) => number = number * power,
                None => rest.push((*base, exponent.clone())),
            }
        }
        (number, rest)
    }
}

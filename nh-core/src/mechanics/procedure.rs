//! What a generated function computes, before it is scheduled.

use super::solved::Solved;
use crate::algebra::{Graph, Node};
use crate::id::{ExprId, SymbolId};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// An intermediate result with a symbol of its own, which later expressions use.
///
/// Intermediate results are barriers: the algebra does not merge what is inside with what is
/// outside, so that the order of the arithmetic of a factorisation is the one written down.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Definition {
    /// `symbol = value`.
    Value {
        /// The intermediate result.
        symbol: SymbolId,
        /// Its value.
        value: ExprId,
    },
    /// `symbol = self.method(arguments)`, a method of the user's that is no formula.
    Call {
        /// The result.
        symbol: SymbolId,
        /// The name of the method.
        method: String,
        /// What it is called with.
        arguments: Vec<ExprId>,
        /// The methods that differentiate it by each argument, if they are declared.
        derivatives: Option<Vec<String>>,
    },
    /// The unknowns solve `matrix · unknowns = right`, with numerical pivoting.
    Solve {
        /// The intermediate results.
        unknowns: Vec<SymbolId>,
        /// The rows of the square matrix.
        matrix: Vec<Vec<ExprId>>,
        /// The right-hand side.
        right: Vec<ExprId>,
    },
}

/// A function: intermediate results in order, then outputs in terms of symbols and them.
#[derive(Clone, Debug, Default)]
pub struct Procedure {
    /// Intermediate results, each in terms of symbols and earlier ones.
    pub definitions: Vec<Definition>,
    /// The results.
    pub outputs: Vec<ExprId>,
    /// The linear systems among the intermediate results that are solved in closed form.
    pub(crate) solved: Vec<Solved>,
    /// Whether it will be differentiated: what systems are solved with for other right-hand sides is noted at its cost.
    pub(crate) is_differentiated: bool,
    /// Whether `define` puts values in place instead of naming them.
    inline: bool,
}

impl Procedure {
    /// Whether this is the same function in the same steps.
    #[must_use]
    pub(crate) fn computes_alike(&self, other: &Self) -> bool {
        self.outputs == other.outputs && self.definitions == other.definitions
    }

    /// Where the results of another function stand among the results of this one, if it takes the same steps.
    #[must_use]
    pub(crate) fn places_of(&self, other: &Self) -> Option<Vec<usize>> {
        if self.definitions != other.definitions {
            return None;
        }
        let places: BTreeMap<ExprId, usize> =
            self.outputs.iter().enumerate().map(|(place, output)| (*output, place)).collect();
        other.outputs.iter().map(|output| places.get(output).copied()).collect()
    }

    /// A function without intermediate results.
    #[must_use]
    pub fn of(outputs: Vec<ExprId>) -> Self {
        Self { outputs, ..Self::default() }
    }

    /// Functions beside each other: the results of the first, then those of the next.
    #[must_use]
    pub fn joined<'p>(functions: impl IntoIterator<Item = &'p Self>) -> Self {
        let mut joined = Self::default();
        for function in functions {
            joined.definitions.extend_from_slice(&function.definitions);
            joined.outputs.extend_from_slice(&function.outputs);
            joined.solved.extend_from_slice(&function.solved);
        }
        joined
    }

    /// A function whose intermediate results stay in place: for expressions that are only studied.
    #[must_use]
    pub fn inline() -> Self {
        Self { inline: true, ..Self::default() }
    }

    /// The same, to be differentiated or not.
    #[must_use]
    pub(crate) fn differentiated(&self, is_differentiated: bool) -> Self {
        Self { is_differentiated, ..self.clone() }
    }

    /// The same intermediate results with other outputs.
    #[must_use]
    pub fn with_outputs(&self, outputs: Vec<ExprId>) -> Self {
        Self { outputs, ..self.clone() }
    }

    /// Whether it calls a method of the user's.
    #[must_use]
    pub fn calls(&self) -> bool {
        self.definitions.iter().any(|definition| matches!(definition, Definition::Call { .. }))
    }

    /// The values of intermediate results, then the outputs with those that are such results replaced by
    /// their values: equal for procedures that compute the same from different names.
    #[must_use]
    pub fn values(&self, graph: &Graph) -> Vec<ExprId> {
        let mut values = Vec::with_capacity(self.definitions.len() + self.outputs.len());
        let mut named: FxHashMap<SymbolId, ExprId> = FxHashMap::default();
        for definition in &self.definitions {
            match definition {
                Definition::Value { symbol, value } => {
                    named.insert(*symbol, *value);
                    values.push(*value);
                }
                Definition::Call { arguments, .. } => values.extend(arguments),
                Definition::Solve { matrix, right, .. } => {
                    values.extend(matrix.iter().flatten().chain(right));
                }
            }
        }
        let value = |output: &ExprId| graph.as_symbol(*output).and_then(|symbol| named.get(&symbol).copied());
        values.extend(self.outputs.iter().map(|output| value(output).unwrap_or(*output)));
        values
    }

    /// Names `value`, unless it is a number, a constant or a symbol already.
    pub fn define(&mut self, graph: &mut Graph, name: &str, value: ExprId) -> ExprId {
        if self.inline || matches!(graph.node(value), Node::Number(_) | Node::Constant(_) | Node::Symbol(_)) {
            return value;
        }
        let symbol = graph.new_symbol(name);
        self.definitions.push(Definition::Value { symbol, value });
        graph.symbol(symbol)
    }

    /// The result of a call with these arguments, which is made once.
    pub(crate) fn call(&mut self, graph: &mut Graph, called: &str, with: &[ExprId]) -> ExprId {
        let known = self.definitions.iter().find_map(|definition| match definition {
            Definition::Call { symbol, method, arguments, .. } if method == called && arguments == with => {
                Some(*symbol)
            }
            _ => None,
        });
        let symbol = known.unwrap_or_else(|| {
            let symbol = graph.new_symbol(format!("self.{called}(…)"));
            let (method, arguments) = (called.to_owned(), with.to_vec());
            self.definitions.push(Definition::Call { symbol, method, arguments, derivatives: None });
            symbol
        });
        graph.symbol(symbol)
    }
}

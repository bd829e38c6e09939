//! The hash-consed expression graph: every distinct expression is stored once.
//!
//! Nodes are canonical on construction by identities that hold wherever both sides are defined
//! (`sum.rs`, `product.rs`, `transcendental.rs` list them). Operands are created before what is
//! built from them, so ascending ids are a topological order and no pass needs recursion.

use super::accuracy::Accuracy;
use super::normal_form::Simplifier;
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId, Table};
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;

/// A function of one argument. `tan x` is stored as `sin x / cos x`, `sqrt x` as `x^(1/2)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names are the functions")]
pub enum Function {
    Sin,
    Cos,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Abs,
    /// −1, 0 or 1.
    Sign,
}

impl Function {
    /// The name in a declaration.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
            Self::Sign => "sign",
        }
    }
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names are the functions")]
pub enum Function2 {
    Atan2,
    Min,
    Max,
}

impl Function2 {
    /// The name in a declaration.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Atan2 => "atan2",
            Self::Min => "min",
            Self::Max => "max",
        }
    }
}

/// One expression, in terms of its operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// The number π.
    Pi,
    /// A coordinate, velocity, parameter, input, or the time.
    Symbol(SymbolId),
    /// `constant + Σ coefficient · term`: terms ascend, none is a number or a sum, no coefficient
    /// is zero, and there are at least two summands.
    Sum {
        /// The number among the summands.
        constant: Rational,
        /// The other summands.
        terms: Box<[(ExprId, Rational)]>,
    },
    /// `coefficient · Π base^exponent`: bases ascend, no exponent is zero, and it is not a mere
    /// number, symbol or sum. A sum among several factors is primitive (see `product.rs`).
    Product {
        /// The number in front.
        coefficient: Rational,
        /// Bases with their exponents.
        factors: Box<[(ExprId, Rational)]>,
    },
    /// A function of one argument.
    Apply(Function, ExprId),
    /// A function of two arguments.
    Apply2(Function2, ExprId, ExprId),
}

impl Node {
    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = ExprId> + '_ {
        let (list, pair): (&[(ExprId, Rational)], [Option<ExprId>; 2]) = match self {
            Self::Number(_) | Self::Pi | Self::Symbol(_) => (&[], [None, None]),
            Self::Sum { terms, .. } => (terms, [None, None]),
            Self::Product { factors, .. } => (factors, [None, None]),
            Self::Apply(_, x) => (&[], [Some(*x), None]),
            Self::Apply2(_, x, y) => (&[], [Some(*x), Some(*y)]),
        };
        list.iter().map(|(id, _)| *id).chain(pair.into_iter().flatten())
    }
}

/// The expressions of one declaration, and the names that occur in them.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Table<ExprId, Node>,
    known: FxHashMap<Node, ExprId>,
    symbols: Table<SymbolId, String>,
    /// What simplification has found so far.
    pub(super) simplifier: Simplifier,
    /// How much rounding error rewriting may cost.
    accuracy: Accuracy,
}

impl Graph {
    /// An empty graph.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// How much rounding error rewriting may cost.
    #[must_use]
    pub fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Chooses how much rounding error rewriting may cost, from now on.
    pub fn set_accuracy(&mut self, accuracy: Accuracy) {
        self.accuracy = accuracy;
    }

    /// Introduces a symbol. Names serve messages and printing; two symbols are never the same.
    pub fn new_symbol(&mut self, name: impl Into<String>) -> SymbolId {
        self.symbols.push(name.into())
    }

    /// The names of the symbols.
    #[must_use]
    pub fn symbols(&self) -> &Table<SymbolId, String> {
        &self.symbols
    }

    /// What stands at `id`.
    #[must_use]
    pub fn node(&self, id: ExprId) -> &Node {
        &self.nodes[id]
    }

    /// The number of distinct expressions built so far.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether nothing has been built.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Stores a node that is already canonical.
    pub(super) fn intern(&mut self, node: Node) -> ExprId {
        match self.known.entry(node) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                let id = self.nodes.push(new.key().clone());
                *new.insert(id)
            }
        }
    }

    /// A number.
    pub fn number(&mut self, value: impl Into<Rational>) -> ExprId {
        self.intern(Node::Number(value.into()))
    }

    /// Zero.
    pub fn zero(&mut self) -> ExprId {
        self.number(Rational::ZERO)
    }

    /// One.
    pub fn one(&mut self) -> ExprId {
        self.number(Rational::ONE)
    }

    /// π.
    pub fn pi(&mut self) -> ExprId {
        self.intern(Node::Pi)
    }

    /// The expression that is just a symbol.
    pub fn symbol(&mut self, symbol: SymbolId) -> ExprId {
        self.intern(Node::Symbol(symbol))
    }

    /// The value of an expression that is a number. Structural: use the zero test to decide
    /// whether an expression vanishes.
    #[must_use]
    pub fn as_number(&self, id: ExprId) -> Option<&Rational> {
        match self.node(id) {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Whether this is literally the number 0 after the identities of construction.
    #[must_use]
    pub fn is_literal_zero(&self, id: ExprId) -> bool {
        self.as_number(id).is_some_and(Rational::is_zero)
    }

    /// The symbol, if the expression is one.
    #[must_use]
    pub fn as_symbol(&self, id: ExprId) -> Option<SymbolId> {
        match self.node(id) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        }
    }

    /// All expressions that `roots` are made of, themselves included, operands first.
    #[must_use]
    pub fn reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        // zeroed memory is free; what is done is in proportion to what is found, not to the graph
        let mut seen = vec![false; self.nodes.len()];
        let mut open: Vec<ExprId> = roots.to_vec();
        let mut found = Vec::new();
        while let Some(id) = open.pop() {
            if !std::mem::replace(&mut seen[id.index()], true) {
                found.push(id);
                open.extend(self.node(id).operands().filter(|operand| !seen[operand.index()]));
            }
        }
        found.sort_unstable();
        found
    }

    /// The symbols that occur in `roots`, in order of their introduction.
    #[must_use]
    pub fn symbols_in(&self, roots: &[ExprId]) -> Vec<SymbolId> {
        let mut found: Vec<SymbolId> =
            self.reachable(roots).into_iter().filter_map(|id| self.as_symbol(id)).collect();
        found.sort_unstable();
        found
    }

    /// Whether any of `symbols` occurs in `expression`.
    #[must_use]
    pub fn depends_on(&self, expression: ExprId, symbols: &[SymbolId]) -> bool {
        self.symbols_in(&[expression]).iter().any(|symbol| symbols.contains(symbol))
    }
}

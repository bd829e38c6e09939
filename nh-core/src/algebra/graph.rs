//! The hash-consed expression graph: every distinct expression is stored once.
//!
//! Nodes are canonical on construction by identities that hold wherever both sides are defined
//! (`sum.rs`, `product.rs`, `transcendental.rs` list them). Operands are created before what is
//! built from them, so ascending ids are a topological order and no pass needs recursion.

use super::constants::Constants;
use super::level::Accuracy;
use super::memory::{Attempts, Cancelling, Simplifier};
use super::node::{Function, Node};
use super::number::Rational;
use super::places::Places;
use super::verdict::Verdict;
use super::visited::Visited;
use crate::id::{ExprId, SymbolId, Table};
use crate::limits;
use rustc_hash::{FxHashMap, FxHashSet, FxHasher};
use std::cell::RefCell;
use std::hash::{Hash, Hasher};
use std::rc::Rc;

/// The expressions of one declaration, and the names that occur in them.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    pub(super) nodes: Table<ExprId, Node>,
    places: Places,
    symbols: Table<SymbolId, String>,
    /// Numbers that have names.
    pub(super) constants: Constants,
    /// What simplification has found so far.
    pub(super) simplifier: Simplifier,
    /// The normal forms that it has read.
    pub(super) attempts: Attempts,
    /// Radicands that stand for what they are when they are multiplied out and divided by a number, with that number.
    pub(super) kept_radicands: FxHashMap<ExprId, (ExprId, Rational)>,
    /// What was found of terms that cancel identically.
    pub(super) cancelling: Cancelling,
    /// How much rounding error rewriting may cost.
    accuracy: Accuracy,
    /// Symbols that are functions of others at all states.
    embedded: Rc<[(SymbolId, ExprId)]>,
    /// Room for terms or factors that are being collected: most are found to be known.
    spare: Vec<Vec<(ExprId, Rational)>>,
    /// The partial derivatives that were taken: momenta are asked for again and again.
    pub(super) partials: FxHashMap<(ExprId, SymbolId), ExprId>,
    /// What the zero test has said.
    pub(super) verdicts: RefCell<FxHashMap<ExprId, Verdict>>,
    /// What vanishes on the reals and by no identity that the field knows.
    pub(super) zeros_by_values: RefCell<FxHashSet<ExprId>>,
    pub(super) visited: RefCell<Visited>,
}

/// What distinguishes sums from products of the same numbers.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum List {
    Sum,
    Product,
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

    /// The coordinates of an embedded base that are functions of the others, and of parameters of a chart.
    #[must_use]
    pub fn embedded(&self) -> Rc<[(SymbolId, ExprId)]> {
        self.embedded.clone()
    }

    /// Says which coordinates are such functions: forms are compared there from now on.
    pub fn set_embedded(&mut self, images: &[(SymbolId, ExprId)]) {
        self.embedded = images.into();
    }

    /// Introduces a symbol. Names serve messages and printing; two symbols are never the same.
    pub fn new_symbol(&mut self, name: impl Into<String>) -> SymbolId {
        self.symbols.push(name.into())
    }

    /// The wanted name, with underscores behind it until no symbol has it: for what texts name beside the
    /// declaration.
    #[must_use]
    pub fn free_name(&self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while self.symbols.iter().any(|taken| *taken == name) {
            name.push('_');
        }
        name
    }

    /// The names of the symbols.
    #[must_use]
    pub fn symbols(&self) -> &Table<SymbolId, String> {
        &self.symbols
    }

    /// What stands at `id`.
    #[must_use]
    #[inline(always)]
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

    /// Stores a node without a list of operands that is already canonical.
    pub(super) fn intern(&mut self, node: Node) -> ExprId {
        let hash = hashed(&node);
        let found = self.places.find(hash, |id| self.nodes[id] == node);
        found.unwrap_or_else(|| self.store(hash, node))
    }

    /// A function of an expression, if that has been built.
    pub(super) fn known_application(&self, function: Function, x: ExprId) -> Option<ExprId> {
        let node = Node::Apply(function, x);
        self.places.find(hashed(&node), |id| self.nodes[id] == node)
    }

    /// Stores a sum that is already canonical.
    pub(super) fn intern_sum<L>(&mut self, constant: Rational, terms: L) -> ExprId
    where
        L: AsRef<[(ExprId, Rational)]> + Into<Rc<[(ExprId, Rational)]>>,
    {
        let hash = hashed(&(List::Sum, &constant, terms.as_ref()));
        let is = |id| matches!(&self.nodes[id], Node::Sum { constant: c, terms: t } if *c == constant && **t == *terms.as_ref());
        match self.places.find(hash, is) {
            Some(known) => known,
            None => self.store(hash, Node::Sum { constant, terms: terms.into() }),
        }
    }

    /// Stores a product that is already canonical.
    pub(super) fn intern_product<L>(&mut self, coefficient: Rational, factors: L) -> ExprId
    where
        L: AsRef<[(ExprId, Rational)]> + Into<Rc<[(ExprId, Rational)]>>,
    {
        let hash = hashed(&(List::Product, &coefficient, factors.as_ref()));
        let is = |id| matches!(&self.nodes[id], Node::Product { coefficient: c, factors: f } if *c == coefficient && **f == *factors.as_ref());
        match self.places.find(hash, is) {
            Some(known) => known,
            None => self.store(hash, Node::Product { coefficient, factors: factors.into() }),
        }
    }

    fn store(&mut self, hash: u32, node: Node) -> ExprId {
        limits::store(1 + node.breadth());
        let id = self.nodes.push(node);
        self.constants.note(id, &self.nodes[id]);
        self.places.insert(hash, id);
        id
    }

    /// An empty list, to be given back.
    pub(super) fn take_spare(&mut self) -> Vec<(ExprId, Rational)> {
        self.spare.pop().unwrap_or_default()
    }

    /// Takes a list back.
    pub(super) fn give_back(&mut self, mut list: Vec<(ExprId, Rational)>) {
        list.clear();
        self.spare.push(list);
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
}

#[allow(clippy::cast_possible_truncation, reason = "half of the bits are enough")]
fn hashed(content: &impl Hash) -> u32 {
    let mut hasher = FxHasher::default();
    content.hash(&mut hasher);
    hasher.finish() as u32
}

//! The hash-consed expression graph: every distinct expression is stored once.
//!
//! Nodes are canonical on construction by identities that hold wherever both sides are defined
//! (`sum.rs`, `product.rs`, `transcendental.rs` list them). Operands are created before what is
//! built from them, so ascending ids are a topological order and no pass needs recursion.

use super::constants::Constants;
use super::level::Accuracy;
use super::memory::{Attempts, Cancelling, Simplifier};
use super::node::Node;
use super::number::Rational;
use super::places::Places;
use super::verdict::Verdict;
use super::visited::Visited;
use crate::id::{ExprId, SymbolId, Table};
use crate::limits;
use rustc_hash::{FxHashMap, FxHasher};
use std::cell::RefCell;
use std::hash::{Hash, Hasher};
use std::rc::Rc;

/// The expressions of one declaration, and the names that occur in them.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Table<ExprId, Node>,
    places: Places,
    symbols: Table<SymbolId, String>,
    /// Numbers that have names.
    pub(super) constants: Constants,
    /// What simplification has found so far.
    pub(super) simplifier: Simplifier,
    /// The normal forms that it has read.
    pub(super) attempts: Attempts,
    /// What was found of terms that cancel identically.
    pub(super) cancelling: Cancelling,
    /// How much rounding error rewriting may cost.
    accuracy: Accuracy,
    /// Room for terms or factors that are being collected: most are found to be known.
    spare: Vec<Vec<(ExprId, Rational)>>,
    /// The partial derivatives that were taken: momenta are asked for again and again.
    pub(super) partials: FxHashMap<(ExprId, SymbolId), ExprId>,
    /// What the zero test has said.
    pub(super) verdicts: RefCell<FxHashMap<ExprId, Verdict>>,
    visited: RefCell<Visited>,
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

    /// Visits the expressions that `roots` are made of, themselves included, each once, for as long as
    /// `visit` wishes to go on.
    pub(super) fn each_reachable(&self, roots: &[ExprId], mut visit: impl FnMut(ExprId) -> bool) {
        let mut visited = self.visited.take();
        let mut steps = 0;
        visited.begin(self.nodes.len(), roots);
        while let Some(id) = visited.next() {
            if !visit(id) {
                break;
            }
            steps += 1 + self.node(id).breadth();
            match self.node(id) {
                Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => {}
                Node::Sum { terms: list, .. } | Node::Product { factors: list, .. } => {
                    list.iter().for_each(|(operand, _)| visited.open(*operand));
                }
                Node::Apply(_, x) => visited.open(*x),
                Node::Apply2(_, x, y) => {
                    visited.open(*x);
                    visited.open(*y);
                }
            }
        }
        self.visited.replace(visited);
        // reading is the quickest of all work
        limits::spend(steps / 4);
    }

    /// All expressions that `roots` are made of, themselves included, operands first.
    #[must_use]
    pub fn reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let mut found = Vec::with_capacity(USUAL);
        self.each_reachable(roots, |id| {
            found.push(id);
            true
        });
        self.visited.borrow_mut().sort(&mut found);
        found
    }

    /// The symbols that occur in `roots`, in order of their introduction.
    #[must_use]
    pub fn symbols_in(&self, roots: &[ExprId]) -> Vec<SymbolId> {
        let mut found = Vec::new();
        self.each_reachable(roots, |id| {
            found.extend(self.as_symbol(id));
            true
        });
        found.sort_unstable();
        found
    }

    /// Whether any of `symbols` occurs in `expression`.
    #[must_use]
    pub fn depends_on(&self, expression: ExprId, symbols: &[SymbolId]) -> bool {
        let mut occurs = false;
        self.each_reachable(&[expression], |id| {
            occurs |= self.as_symbol(id).is_some_and(|symbol| symbols.contains(&symbol));
            !occurs
        });
        occurs
    }
}

/// Room for the distinct expressions of most that are walked through.
const USUAL: usize = 32;

#[allow(clippy::cast_possible_truncation, reason = "half of the bits are enough")]
fn hashed(content: &impl Hash) -> u32 {
    let mut hasher = FxHasher::default();
    content.hash(&mut hasher);
    hasher.finish() as u32
}

//! Walks through the graph, and which nodes they have seen.

use super::graph::Graph;
use super::node::Node;
use crate::id::{ExprId, Id, SymbolId};
use crate::limits;

/// The nodes of one walk at a time. What a walk costs is in proportion to what it finds, not to the graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Visited {
    /// The present walk.
    walk: u32,
    /// The last walk that has seen a node.
    seen: Vec<u32>,
    /// What is yet to be seen.
    open: Vec<ExprId>,
    /// One bit for each node between the first and the last of a walk.
    marks: Vec<u64>,
}

impl Visited {
    /// Begins a walk in a graph of so many nodes.
    pub(super) fn begin(&mut self, nodes: usize, roots: &[ExprId]) {
        self.walk = self.walk.wrapping_add(1);
        if self.walk == 0 {
            // after four thousand million walks
            self.seen.clear();
            self.walk = 1;
        }
        if self.seen.len() < nodes {
            self.seen.resize(nodes, 0);
        }
        self.open.clear();
        self.open.extend_from_slice(roots);
    }

    /// Goes to a node later.
    pub(super) fn open(&mut self, id: ExprId) {
        if self.seen[id.index()] != self.walk {
            self.open.push(id);
        }
    }

    /// The next node that has not been seen.
    pub(super) fn next(&mut self) -> Option<ExprId> {
        while let Some(id) = self.open.pop() {
            if std::mem::replace(&mut self.seen[id.index()], self.walk) != self.walk {
                return Some(id);
            }
        }
        None
    }

    /// Sorts expressions of a walk, each of which occurs once.
    pub(super) fn sort(&mut self, found: &mut Vec<ExprId>) {
        const WORD: usize = u64::BITS as usize;
        // few are sorted as they are, and so are those so far apart that most words would be empty
        const FEW: usize = 8;
        const EMPTY: usize = 16;
        let first = found.iter().min().map_or(0, |id| id.index()) / WORD;
        let last = found.iter().max().map_or(0, |id| id.index()) / WORD;
        if found.len() < FEW || last - first > EMPTY * found.len() {
            found.sort_unstable();
            return;
        }
        self.marks.clear();
        self.marks.resize(last - first + 1, 0);
        for id in found.iter() {
            self.marks[id.index() / WORD - first] |= 1 << (id.index() % WORD);
        }
        found.clear();
        for (index, word) in self.marks.iter().enumerate() {
            let mut left = *word;
            while left != 0 {
                found.push(ExprId::from_index((first + index) * WORD + left.trailing_zeros() as usize));
                left &= left - 1;
            }
        }
    }
}

/// Where a walk goes from an expression.
enum Onward {
    Into,
    Past,
    End,
}

/// Room for the distinct expressions of most that are walked through.
const USUAL: usize = 32;

impl Graph {
    /// Visits the expressions that `roots` are made of, themselves included, each once, for as long as
    /// `visit` wishes to go on.
    pub(super) fn each_reachable(&self, roots: &[ExprId], mut visit: impl FnMut(ExprId) -> bool) {
        let visit = |id| if visit(id) { Onward::Into } else { Onward::End };
        self.walk(roots, visit);
    }

    /// Visits expressions from `roots` on, each once.
    fn walk(&self, roots: &[ExprId], mut visit: impl FnMut(ExprId) -> Onward) {
        let mut visited = self.visited.take();
        let mut steps = 0;
        visited.begin(self.nodes.len(), roots);
        while let Some(id) = visited.next() {
            steps += 1;
            match visit(id) {
                Onward::Into => {}
                Onward::Past => continue,
                Onward::End => break,
            }
            steps += self.node(id).breadth();
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

    /// What `roots` are made of that is not known, themselves included, operands first; what is known is made of what is.
    pub(super) fn reachable_beyond(
        &self,
        roots: &[ExprId],
        is_known: impl Fn(ExprId) -> bool,
    ) -> Vec<ExprId> {
        let mut found = Vec::with_capacity(USUAL);
        self.walk(roots, |id| {
            if is_known(id) {
                return Onward::Past;
            }
            found.push(id);
            Onward::Into
        });
        self.visited.borrow_mut().sort(&mut found);
        found
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

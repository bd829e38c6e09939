//! Which nodes a walk through the graph has seen.

use crate::id::{ExprId, Id};

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

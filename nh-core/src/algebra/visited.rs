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

    /// Sorts what the last walk has found: by looking through all nodes in between, where that is shorter.
    pub(super) fn sort(&self, found: &mut Vec<ExprId>) {
        const SPARSE: usize = 8;
        let first = found.iter().min().map_or(0, |id| id.index());
        let last = found.iter().max().map_or(0, |id| id.index());
        if found.len() < SPARSE || last - first > SPARSE * found.len() {
            found.sort_unstable();
            return;
        }
        found.clear();
        let seen = self.seen[first..=last].iter().enumerate().filter(|(_, walk)| **walk == self.walk);
        found.extend(seen.map(|(index, _)| ExprId::from_index(first + index)));
    }
}

//! The parts of a manifold: where an equation is solved by the root of a square, as x² = 4 is, each sign of the root has
//! a part of its own, and what is asked at the points of one is not known at those of another.

use super::manifold::Manifold;
use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};

/// More parts are not looked at.
const PARTS: usize = 64;

impl Manifold {
    /// This part and the others that were found, each as if it were the only one.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.others)
    }

    /// The images of a part that are not those of all parts.
    pub(crate) fn own_images(&self, part: &Self) -> Vec<(SymbolId, ExprId)> {
        let is_own = |image: &&(SymbolId, ExprId)| !self.parts().all(|other| other.images.contains(image));
        part.images.iter().filter(is_own).copied().collect()
    }

    /// Starts the part where a symbol that was solved for just now has the other root.
    pub(super) fn begin_another(
        &mut self,
        graph: &mut Graph,
        before: &Self,
        (symbol, other): (SymbolId, ExprId),
    ) {
        let mut part = self.alone();
        part.images.clone_from(&before.images);
        part.note_solved(graph, &[symbol]);
        part.insert(graph, symbol, other);
        if part.is_defined(graph, &before.images) {
            self.others.push(part);
        }
    }

    /// Completes the parts that were started, and those that start on the way.
    pub(super) fn complete_others(&mut self, mut completed: impl FnMut(&Self) -> Option<Self>) {
        let mut open = std::mem::take(&mut self.others);
        while let Some(start) = open.pop() {
            if self.others.len() + 1 == PARTS {
                return;
            }
            if let Some(mut part) = completed(&start) {
                open.append(&mut part.others);
                self.others.push(part);
            }
        }
    }

    /// This part alone.
    pub(crate) fn alone(&self) -> Self {
        let mut part = self.clone();
        part.others.clear();
        part
    }

    /// Takes the parts of another manifold to be further ones of this.
    pub(crate) fn add_parts(&mut self, other: &Self) {
        let parts = other.parts().map(Self::alone);
        self.others.extend(parts);
        self.others.truncate(PARTS - 1);
    }
}

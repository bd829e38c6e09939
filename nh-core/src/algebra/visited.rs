//! Walks through the graph, and which nodes they have seen.

use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
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

    /// Sorts expressions of a walk, each of which occurs once.
    pub(super) fn sort(&mut self, found: &mut [ExprId]) {
        const WORD: usize = u64::BITS as usize;
        // few are sorted as they are, and so are those so far apart that most words would be empty
        const FEW: usize = 8;
        const EMPTY: usize = 16;
        let (mut least, mut most, mut place) = (usize::MAX, 0, 0);
        let list: &[ExprId] = found;
        while place < list.len() {
            let index = list[place].index();
            least = if index < least { index } else { least };
            most = if index > most { index } else { most };
            place += 1;
        }
        let (first, last) = (least / WORD, most / WORD);
        if found.len() < FEW || last - first > EMPTY * found.len() {
            sort_few(found);
            return;
        }
        self.marks.clear();
        self.marks.resize(last - first + 1, 0);
        let (list, marks): (&mut [ExprId], &mut [u64]) = (found, &mut self.marks);
        let mut place = 0;
        while place < list.len() {
            let index = list[place].index();
            marks[index / WORD - first] |= 1 << (index % WORD);
            place += 1;
        }
        let (mut next, mut word) = (0, 0);
        while word < marks.len() {
            let mut left = marks[word];
            while left != 0 {
                list[next] = ExprId::from_index((first + word) * WORD + left.trailing_zeros() as usize);
                next += 1;
                left &= left - 1;
            }
            word += 1;
        }
    }
}

/// Sorts by insertion, which is quickest for few.
fn sort_few(list: &mut [ExprId]) {
    if list.len() > 2 * USUAL {
        list.sort_unstable();
        return;
    }
    let mut end = 1;
    while end < list.len() {
        let (id, mut place) = (list[end], end);
        while place > 0 && list[place - 1].index() > id.index() {
            list[place] = list[place - 1];
            place -= 1;
        }
        list[place] = id;
        end += 1;
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
    ///
    /// Written with indices and a stack of its own: most passes begin with a walk, and unoptimised builds take several
    /// calls for whatever is asked of a list.
    fn walk(&self, roots: &[ExprId], mut visit: impl FnMut(ExprId) -> Onward) {
        let mut visited = self.visited.take();
        let mut steps = 0;
        visited.begin(self.nodes.len(), roots);
        let Visited { walk, seen, open, .. } = &mut visited;
        let (walk, seen): (u32, &mut [u32]) = (*walk, seen);
        let mut top = open.len();
        while top > 0 {
            top -= 1;
            let id = open.as_slice()[top];
            if seen[id.index()] == walk {
                continue;
            }
            seen[id.index()] = walk;
            steps += 1;
            match visit(id) {
                Onward::Into => {}
                Onward::Past => continue,
                Onward::End => break,
            }
            let node = self.node(id);
            let pair;
            let list: &[(ExprId, Rational)] = match node {
                Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => continue,
                Node::Sum { terms: list, .. } | Node::Product { factors: list, .. } => {
                    pair = [id; 2];
                    list
                }
                Node::Apply(_, x) => {
                    pair = [*x; 2];
                    &[]
                }
                Node::Apply2(_, x, y) => {
                    pair = [*x, *y];
                    &[]
                }
            };
            let room = top + list.len() + pair.len();
            if open.len() < room {
                open.resize(2 * room, id);
            }
            let open: &mut [ExprId] = open;
            steps += list.len();
            let mut place = 0;
            while place < list.len() {
                let operand = list[place].0;
                if seen[operand.index()] != walk {
                    open[top] = operand;
                    top += 1;
                }
                place += 1;
            }
            if list.is_empty() {
                // a function of one argument has it twice
                steps += 1 + usize::from(pair[0] != pair[1]);
                open[top] = pair[0];
                open[top + 1] = pair[1];
                top += 2;
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
        self.has_symbol(expression, |symbol| symbols.contains(&symbol))
    }

    /// Whether a symbol of some kind occurs.
    pub(crate) fn has_symbol(&self, expression: ExprId, is_wanted: impl Fn(SymbolId) -> bool) -> bool {
        let mut occurs = false;
        self.each_reachable(&[expression], |id| {
            occurs |= self.as_symbol(id).is_some_and(&is_wanted);
            !occurs
        });
        occurs
    }
}

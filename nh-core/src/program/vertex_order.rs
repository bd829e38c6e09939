//! Orders in which the vertices of a straight-line program are eliminated.
//!
//! Each step is a vertex, with its partial derivatives on the edges from its operands. A vertex is eliminated by
//! adding, for every way through it, the product of the two derivatives to the edge that joins its ends. Where
//! only arguments and outputs are left, edges are the entries of the Jacobian (Griewank, Walther, *Evaluating
//! Derivatives*, 2008, chapters 9 and 10). Forward and reverse mode are orders of elimination; so is the one in
//! which the vertex is next that adds the fewest edges.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

/// A vertex: a step, or behind all steps an output.
pub(super) type Vertex = usize;

/// Edges with weights, from operands to results.
#[derive(Clone)]
pub(super) struct Edges<W> {
    /// By result.
    into: Vec<BTreeMap<Vertex, W>>,
    out_of: Vec<BTreeSet<Vertex>>,
}

impl<W: Copy> Edges<W> {
    pub(super) fn new(vertices: usize) -> Self {
        Self { into: vec![BTreeMap::new(); vertices], out_of: vec![BTreeSet::new(); vertices] }
    }

    /// How many vertices there are.
    pub(super) fn len(&self) -> usize {
        self.into.len()
    }

    /// What comes into a vertex, with the weights.
    pub(super) fn operands(&self, vertex: Vertex) -> &BTreeMap<Vertex, W> {
        &self.into[vertex]
    }

    /// Where a vertex leads.
    pub(super) fn results(&self, vertex: Vertex) -> impl Iterator<Item = Vertex> {
        self.out_of[vertex].iter().copied()
    }

    pub(super) fn leads_on(&self, vertex: Vertex) -> bool {
        !self.out_of[vertex].is_empty()
    }

    /// Takes a vertex out: what came into it, and where it went.
    pub(super) fn take(&mut self, vertex: Vertex) -> [Vec<(Vertex, W)>; 2] {
        let into: Vec<(Vertex, W)> = std::mem::take(&mut self.into[vertex]).into_iter().collect();
        for (before, _) in &into {
            self.out_of[*before].remove(&vertex);
        }
        let after = std::mem::take(&mut self.out_of[vertex]).into_iter();
        let out = after.filter_map(|after| Some((after, self.into[after].remove(&vertex)?))).collect();
        [into, out]
    }

    pub(super) fn put(&mut self, before: Vertex, after: Vertex, weight: W) {
        self.into[after].insert(before, weight);
        self.out_of[before].insert(after);
    }

    /// The same edges with other weights.
    pub(super) fn map<V>(&self, weight: impl Fn(W) -> V) -> Edges<V> {
        let map = |into: &BTreeMap<Vertex, W>| into.iter().map(|(before, w)| (*before, weight(*w))).collect();
        Edges { into: self.into.iter().map(map).collect(), out_of: self.out_of.clone() }
    }
}

/// What stands on an edge, as far as costs go: whether it is 1 or −1, so that a product with it is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct IsUnit(pub(super) bool);

impl Edges<IsUnit> {
    /// Eliminates a vertex; the number of operations.
    fn eliminate(&mut self, vertex: Vertex) -> usize {
        let [into, out] = self.take(vertex);
        let mut operations = 0;
        for (before, IsUnit(first)) in &into {
            for (after, IsUnit(second)) in &out {
                let is_new = !self.into[*after].contains_key(before);
                operations += usize::from(!(is_new && (*first || *second)));
                self.put(*before, *after, IsUnit(is_new && *first && *second));
            }
        }
        operations
    }

    /// By how many edges there are more without the vertex, if none of them is there already.
    fn added(&self, vertex: Vertex) -> i64 {
        let [into, out] = [self.into[vertex].len(), self.out_of[vertex].len()]
            .map(|ways| i64::try_from(ways).unwrap_or(i64::MAX));
        into.saturating_mul(out).saturating_sub(into).saturating_sub(out)
    }

    /// The order in which the vertex that adds the fewest edges is next, the last of several; and its operations.
    fn sparing(mut self, inner: &[Vertex]) -> (Vec<Vertex>, usize) {
        let mut order = Vec::with_capacity(inner.len());
        let mut is_left = vec![false; self.into.len()];
        let mut queue = BinaryHeap::with_capacity(inner.len());
        for vertex in inner {
            is_left[*vertex] = true;
            queue.push((Reverse(self.added(*vertex)), *vertex));
        }
        let mut operations = 0;
        while let Some((Reverse(added), vertex)) = queue.pop() {
            if !is_left[vertex] || added != self.added(vertex) {
                continue;
            }
            is_left[vertex] = false;
            order.push(vertex);
            let near: Vec<Vertex> = self.into[vertex]
                .keys()
                .chain(&self.out_of[vertex])
                .copied()
                .filter(|near| is_left[*near])
                .collect();
            operations += self.eliminate(vertex);
            queue.extend(near.into_iter().map(|near| (Reverse(self.added(near)), near)));
        }
        (order, operations)
    }

    /// The operations of an order.
    fn counted(mut self, order: Vec<Vertex>) -> (Vec<Vertex>, usize) {
        let operations = order.iter().map(|vertex| self.eliminate(*vertex)).sum();
        (order, operations)
    }

    /// The order with the fewest operations of those that are tried.
    pub(super) fn cheapest_order(&self, inner: &[Vertex]) -> Vec<Vertex> {
        let orders = [
            self.clone().sparing(inner),
            self.clone().counted(inner.to_vec()),
            self.clone().counted(inner.iter().rev().copied().collect()),
        ];
        let cheapest = orders.into_iter().min_by_key(|(_, operations)| *operations);
        cheapest.map(|(order, _)| order).unwrap_or_default()
    }
}

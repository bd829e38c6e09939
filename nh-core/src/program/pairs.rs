//! Pairs of operands that several sums, or several products, share are computed once.
//!
//! Greedy: the pair with the most users first, then with the smallest ids. Extracting a pair that n
//! terms use saves n − 1 operations, whatever else is extracted.

use super::nary::{Arena, Nary, Term};
use crate::limits;
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Which terms to search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The weight of an operand is its sign.
    Sums,
    /// The weight of an operand is its exponent, which is positive.
    Products,
}

/// Operands of longer lists are paired with so many neighbours only, so that time stays linear.
const WINDOW: usize = 24;

/// Occurrences of pairs that are looked through before the search is given up: what it leaves is
/// right, only not the cheapest. Systems of some dozens of bodies stay below.
const PATIENCE: usize = 1_000_000;

/// Two operands, the smaller first, and whether their signs differ. Both are the same for a square.
type Pair = (Term, Term, bool);

/// What the heap is ordered by: most users, then most constant, then smallest.
type Entry = (usize, Reverse<u8>, Reverse<Pair>);

/// The operands of a term with their weights, in order.
type List = Vec<(Term, i32)>;

/// The lists in which a pair has occurred. Most pairs occur once, for which nothing is allocated.
#[derive(Clone, Default)]
struct Places {
    first: Option<usize>,
    others: Vec<usize>,
}

impl Places {
    fn add(&mut self, index: usize, times: usize) {
        let others = times - usize::from(times > 0 && self.first.is_none());
        self.first = self.first.or((times > 0).then_some(index));
        self.others.extend(std::iter::repeat_n(index, others));
    }

    fn len(&self) -> usize {
        usize::from(self.first.is_some()) + self.others.len()
    }

    /// The lists in order.
    fn distinct(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.first.into_iter().chain(self.others.iter().copied()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

struct Search<'a> {
    arena: &'a mut Arena,
    kind: Kind,
    /// The terms that are searched, with their operands.
    lists: Vec<(Term, List)>,
    /// The lists in which a pair has occurred, as often as it has.
    places: FxHashMap<Pair, Places>,
    heap: BinaryHeap<Entry>,
}

/// Extracts shared pairs until none is left, or the search has taken too long.
pub(super) fn share_pairs(arena: &mut Arena, kind: Kind) {
    let lists = lists(arena, kind);
    let pairs = lists.iter().map(|(_, list)| list.len() * (list.len() + 1).min(2 * WINDOW) / 2).sum();
    let places = FxHashMap::with_capacity_and_hasher(pairs, FxBuildHasher);
    let mut search = Search { arena, kind, lists, places, heap: BinaryHeap::new() };
    for index in 0..search.lists.len() {
        let length = search.lists[index].1.len();
        for first in 0..length {
            limits::spend(WINDOW.min(length - first));
            for second in first..length.min(first + WINDOW) {
                let operands = &search.lists[index].1;
                let (first, second) = (operands[first], operands[second]);
                search.note(index, first, second);
            }
        }
    }
    search.fill_heap();
    let mut patience = PATIENCE;
    while let Some((users, _, Reverse(pair))) = search.heap.pop() {
        let occurrences = search.places.get(&pair).map_or(1, Places::len);
        let Some(left) = patience.checked_sub(occurrences) else { break };
        patience = left;
        limits::spend(occurrences);
        let places = search.places_of(pair);
        let current = places.iter().map(|(_, times)| times).sum();
        if current == users {
            search.extract(pair, &places);
        } else if current > 1 {
            let entry = search.entry(pair, current);
            search.heap.push(entry);
        }
    }
}

fn lists(arena: &Arena, kind: Kind) -> Vec<(Term, List)> {
    let uses = arena.uses();
    let mut lists = Vec::new();
    for term in Arena::live(&uses) {
        match (arena.get(term), kind) {
            // one that has an operand twice stays as it is
            (Nary::Sum(operands), Kind::Sums) if operands.windows(2).all(|two| two[0].0 < two[1].0) => {
                let weight = |negative| if negative { -1 } else { 1 };
                lists.push((term, operands.iter().map(|(o, negative)| (*o, weight(*negative))).collect()));
            }
            (Nary::Product(factors), Kind::Products) => lists.push((term, factors.to_vec())),
            _ => {}
        }
    }
    lists
}

impl Search<'_> {
    /// Two operands of a list as a pair, and how often they form it.
    fn pair(&self, a: (Term, i32), b: (Term, i32)) -> (Pair, usize) {
        let ends = (a.0.min(b.0), a.0.max(b.0));
        match self.kind {
            Kind::Sums => ((ends.0, ends.1, a.1 != b.1), usize::from(a.0 != b.0)),
            Kind::Products => {
                let times = if a.0 == b.0 { a.1 / 2 } else { a.1.min(b.1) };
                ((ends.0, ends.1, false), usize::try_from(times).unwrap_or(0))
            }
        }
    }

    /// Records that list `index` contains two operands; returns how often the pair occurs anywhere.
    fn note(&mut self, index: usize, a: (Term, i32), b: (Term, i32)) -> (Pair, usize) {
        let (pair, times) = self.pair(a, b);
        if times == 0 {
            return (pair, 0);
        }
        let places = self.places.entry(pair).or_default();
        places.add(index, times);
        (pair, places.len())
    }

    /// Puts all pairs with several users on the heap.
    fn fill_heap(&mut self) {
        let several = self.places.iter().filter(|(_, places)| places.len() > 1);
        let entries: Vec<Entry> = several.map(|(pair, places)| self.entry(*pair, places.len())).collect();
        self.heap = entries.into();
    }

    fn entry(&self, pair: Pair, users: usize) -> Entry {
        let varying = u8::from(!self.is_parameter(pair.0)) + u8::from(!self.is_parameter(pair.1));
        (users, Reverse(varying), Reverse(pair))
    }

    fn is_parameter(&self, term: Term) -> bool {
        match self.arena.get(term) {
            Nary::Number(_) | Nary::Pi | Nary::Constant(..) => true,
            Nary::Symbol(symbol) => self.arena.parameters.contains(symbol),
            _ => false,
        }
    }

    /// An operand of a list.
    fn operand(&self, index: usize, operand: Term) -> Option<(Term, i32)> {
        let operands = &self.lists[index].1;
        let position = operands.binary_search_by_key(&operand, |(term, _)| *term).ok()?;
        Some(operands[position])
    }

    /// The lists that contain the pair now, and how often.
    fn places_of(&self, pair: Pair) -> Vec<(usize, usize)> {
        let places = self.places.get(&pair).map(Places::distinct).unwrap_or_default();
        let times = |index: usize| {
            let (found, times) = self.pair(self.operand(index, pair.0)?, self.operand(index, pair.1)?);
            (found == pair && times > 0).then_some((index, times))
        };
        places.into_iter().filter_map(times).collect()
    }

    /// Computes the pair once and replaces it in every list.
    fn extract(&mut self, pair: Pair, places: &[(usize, usize)]) {
        let (whole, sign) = self.whole(pair, places);
        for &(index, times) in places {
            if self.lists[index].0 == whole {
                continue;
            }
            let there = self.operand(index, whole).map_or(0, |(_, weight)| weight);
            let weight = match self.kind {
                // a sum has each operand once
                Kind::Sums if there != 0 => continue,
                Kind::Sums => sign * self.operand(index, pair.0).map_or(1, |(_, weight)| weight),
                Kind::Products => there.saturating_add(i32::try_from(times).unwrap_or(1)),
            };
            let operands = &mut self.lists[index].1;
            match self.kind {
                Kind::Sums => operands.retain(|(operand, _)| *operand != pair.0 && *operand != pair.1),
                Kind::Products => {
                    let times = weight - there;
                    for end in [pair.0, pair.1] {
                        operands.iter_mut().filter(|(o, _)| *o == end).for_each(|(_, e)| *e -= times);
                    }
                    operands.retain(|(operand, exponent)| *exponent > 0 && *operand != whole);
                }
            }
            let position = operands.partition_point(|(operand, _)| *operand < whole);
            operands.insert(position, (whole, weight));
            for other in 0..operands.len().min(WINDOW) {
                let other = self.lists[index].1[other];
                let (pair, users) = self.note(index, other, (whole, weight));
                if users > 1 {
                    let entry = self.entry(pair, users);
                    self.heap.push(entry);
                }
            }
            self.store(index);
        }
    }

    /// The term that is the pair, and its sign: −1 if it is `b − a`.
    fn whole(&mut self, (a, b, opposite): Pair, places: &[(usize, usize)]) -> (Term, i32) {
        // a list that is nothing but the pair stays as it is, and the others use it
        let alone = places.iter().map(|(index, _)| &self.lists[*index]).find(|(_, list)| match self.kind {
            Kind::Sums => list.len() == 2 && list.iter().any(|(_, weight)| *weight > 0),
            Kind::Products => list.iter().map(|(_, exponent)| exponent).sum::<i32>() == 2,
        });
        if let Some((term, list)) = alone {
            return (*term, if self.kind == Kind::Sums { list[0].1 } else { 1 });
        }
        let nary = match self.kind {
            Kind::Sums => Nary::Sum([(a, false), (b, opposite)].into()),
            Kind::Products if a == b => Nary::Product([(a, 2)].into()),
            Kind::Products => Nary::Product([(a, 1), (b, 1)].into()),
        };
        (self.arena.intern(nary), 1)
    }

    /// Writes a list back to the arena.
    fn store(&mut self, index: usize) {
        let (term, operands) = &self.lists[index];
        let nary = match (self.kind, operands.as_slice()) {
            // equal up to the sign to what it uses
            (Kind::Sums, [(only, -1)]) => Nary::Neg(*only),
            (Kind::Sums, [(only, _)]) => Nary::Product([(*only, 1)].into()),
            (Kind::Sums, _) => Nary::Sum(operands.iter().map(|(o, weight)| (*o, *weight < 0)).collect()),
            (Kind::Products, _) => Nary::Product(operands.as_slice().into()),
        };
        self.arena.rewrite(*term, nary);
    }
}

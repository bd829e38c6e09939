//! The rank of a matrix of functions, and where it is less than at most points.
//!
//! Claims of the form "ρ is onto", "the constraints are independent", "S has rank 1" hold at generic points;
//! a reader takes them for claims about all points. Every such rank is therefore asked here, and what is said
//! of it comes with the places where it drops, or with the word that this is not known.

use super::excluded::is_excluded;
use super::manifold::Manifold;
use crate::algebra::{Demand, Facts, Graph, Matrix, Node, Rational, Substitution, Verdict};
use crate::id::{ExprId, SymbolId};

/// The rank at generic points, and where it drops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rank {
    /// The rank at generic points.
    pub generic: usize,
    /// Where it is less.
    pub drops: Drops,
}

/// Where a rank is less than at generic points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Drops {
    /// Nowhere: proved.
    Nowhere,
    /// Where in one of these sets of functions all vanish, and nowhere else; a set may have no common
    /// zero.
    Where(Vec<Vec<ExprId>>),
    /// It was not found out.
    Undecided,
}

/// Where ranks are asked.
#[derive(Clone, Copy, Debug)]
pub struct RankSetting<'a> {
    /// The base or the constraint manifold.
    pub manifold: &'a Manifold,
    /// Functions that vanish on it.
    pub residuals: &'a [ExprId],
    /// What else holds there: facts, identities of embedded coordinates, positions.
    pub holding: &'a [(ExprId, Demand)],
    /// What is known of the ranges of symbols.
    pub facts: &'a Facts,
    /// Symbols that do not change along a motion.
    pub parameters: &'a [SymbolId],
}

/// Minors of more rows are not written down.
const ROWS: usize = 3;
/// More minors are not written down.
const MINORS: usize = 100;
/// Products whose zeros come to more sets than this are not told apart by their factors.
const ALTERNATIVES: usize = 8;
/// Matrices with more operations are not put to this.
const OPERATIONS: u64 = 300;

impl RankSetting<'_> {
    /// The rank of a matrix on the manifold.
    ///
    /// # Errors
    /// The reason, where even the generic rank cannot be decided.
    pub fn rank(&self, graph: &mut Graph, matrix: &Matrix) -> Result<Rank, String> {
        let restricted = self.manifold.restrict_matrix(graph, matrix);
        let generic = graph.generic_rank(&restricted)?;
        let drops = if generic == 0 { Drops::Nowhere } else { self.drops(graph, matrix, generic) };
        Ok(Rank { generic, drops })
    }

    fn drops(&self, graph: &mut Graph, matrix: &Matrix, rank: usize) -> Drops {
        let (matrix, rank) = without_constants(graph, matrix.clone(), rank);
        if rank == 0 {
            return Drops::Nowhere;
        }
        let columns = matrix.first().map_or(0, Vec::len);
        let count = count(matrix.len(), rank).saturating_mul(count(columns, rank));
        if rank > ROWS || graph.operation_count(&matrix.concat()) > OPERATIONS {
            return Drops::Undecided;
        }
        if count > MINORS {
            return if self.is_regular_by_squares(graph, &matrix, rank) {
                Drops::Nowhere
            } else {
                Drops::Undecided
            };
        }
        let Some(minors) = self.minors(graph, &matrix, rank) else { return Drops::Nowhere };
        match self.without_common_factors(graph, &minors) {
            sets if sets.is_empty() => Drops::Nowhere,
            sets => Drops::Where(sets),
        }
    }

    /// The minors that do not vanish identically; `None` if one of them vanishes nowhere.
    fn minors(&self, graph: &mut Graph, matrix: &Matrix, rank: usize) -> Option<Vec<ExprId>> {
        let columns = matrix.first().map_or(0, Vec::len);
        let mut minors: Vec<ExprId> = Vec::new();
        for rows in subsets(matrix.len(), rank) {
            for chosen in subsets(columns, rank) {
                let minor: Matrix = rows
                    .iter()
                    .map(|row| chosen.iter().map(|column| matrix[*row][*column]).collect())
                    .collect();
                let minor = graph.small_determinant(&minor);
                let minor = graph.simplify(minor);
                if self.vanishes(graph, minor) {
                    continue;
                }
                if self.vanishes_nowhere(graph, minor) {
                    return None;
                }
                let negative = graph.formula(-minor);
                if !minors.contains(&minor) && !minors.contains(&negative) {
                    minors.push(minor);
                }
            }
        }
        Some(minors)
    }

    /// Whether a function is 0 at all points. Where functions were solved for the manifold, it may have other
    /// branches than that which was found: then only what vanishes everywhere is said to.
    fn vanishes(&self, graph: &mut Graph, function: ExprId) -> bool {
        if self.residuals.is_empty() {
            self.manifold.zero_test(graph, function).is_zero()
        } else {
            graph.zero_test(function).is_zero()
        }
    }

    /// By its range, or because it is a number on the manifold.
    fn vanishes_nowhere(&self, graph: &mut Graph, expression: ExprId) -> bool {
        graph.vanishes_nowhere(expression, self.facts)
            || (graph.symbols_in(&[expression]).is_empty() && graph.zero_test(expression).is_nonzero())
            || self.constant(graph, expression).is_some_and(|value| {
                graph.vanishes_nowhere(value, self.facts)
                    || graph.zero_test(value).is_nonzero() && graph.symbols_in(&[value]).is_empty()
            })
    }

    /// An equal expression of parameters on the manifold, if there is one.
    fn constant(&self, graph: &mut Graph, expression: ExprId) -> Option<ExprId> {
        self.constant_from(graph, expression, &[0, 1, 2])
    }

    /// The same, with what it is where all that varies is the first of these numbers at which it is defined.
    fn constant_from(&self, graph: &mut Graph, expression: ExprId, numbers: &[i64]) -> Option<ExprId> {
        let restricted = self.manifold.restrict(graph, expression);
        let varying: Vec<SymbolId> = graph
            .symbols_in(&[restricted])
            .into_iter()
            .filter(|symbol| !self.parameters.contains(symbol))
            .collect();
        for number in numbers {
            let value = graph.number(*number);
            let fixed =
                Substitution::new(varying.iter().map(|symbol| (*symbol, value))).apply(graph, restricted);
            if !graph.is_undefined(fixed) {
                let difference = graph.formula(restricted - fixed);
                return (graph.zero_test(difference) == Verdict::Zero).then(|| graph.simplify(fixed));
            }
        }
        None
    }

    /// Whether the sum of the squares of functions vanishes nowhere.
    fn vanish_nowhere_together(&self, graph: &mut Graph, functions: &[ExprId]) -> bool {
        let squares: Vec<(Rational, ExprId)> =
            functions.iter().map(|function| (Rational::ONE, graph.square(*function))).collect();
        let sum = graph.linear_combination(&squares);
        let sum = graph.simplify(sum);
        if self.vanishes_nowhere(graph, sum) {
            return true;
        }
        let restricted = self.manifold.restrict(graph, sum);
        let restricted = graph.simplify(restricted);
        if graph.vanishes_nowhere(restricted, self.facts) {
            return true;
        }
        // where a parameter was solved for, as the radius of a circle, the sum may be a multiple of its square
        self.parameters.iter().any(|symbol| {
            let parameter = graph.symbol(*symbol);
            if !graph.vanishes_nowhere(parameter, self.facts)
                || self.manifold.restrict(graph, parameter) == parameter
            {
                return false;
            }
            // where coordinates are 0 the ratio is 0/0
            let ratio = graph.formula(sum / parameter.square());
            let value = self.constant_from(graph, ratio, &[1, 2]);
            value.is_some_and(|value| graph.vanishes_nowhere(value, self.facts))
        })
    }

    /// Whether the manifold has no point where functions vanish, as far as those that are symbols tell.
    fn is_off_the_manifold(&self, graph: &mut Graph, functions: &[ExprId]) -> bool {
        let zero = graph.zero();
        let symbols: Vec<(SymbolId, ExprId)> =
            functions.iter().filter_map(|function| Some((graph.as_symbol(*function)?, zero))).collect();
        let symbols_vanish = !symbols.is_empty();
        let mut there = Substitution::new(symbols);
        // the other functions are not 0 where these symbols are
        let others = functions.iter().filter(|function| graph.as_symbol(**function).is_none());
        let others: Vec<ExprId> = if symbols_vanish { others.copied().collect() } else { Vec::new() };
        self.residuals.iter().chain(&others).any(|function| {
            let left = there.apply(graph, *function);
            graph.vanishes_nowhere(left, self.facts)
        })
    }

    /// Whether AᵀA has principal minors of the size of the rank whose sum vanishes nowhere: it is the sum of
    /// the squares of all minors of A (Cauchy and Binet).
    fn is_regular_by_squares(&self, graph: &mut Graph, matrix: &Matrix, rank: usize) -> bool {
        let transposed = Graph::transposed(matrix);
        let narrow = if transposed.len() < matrix.len() { transposed } else { matrix.clone() };
        let mut gram = Matrix::new();
        for row in &narrow {
            let mut entries = Vec::with_capacity(narrow.len());
            for other in &narrow {
                let entry = graph.inner_product(row, other);
                entries.push(self.constant(graph, entry).unwrap_or(entry));
            }
            gram.push(entries);
        }
        let mut sum = graph.zero();
        for chosen in subsets(narrow.len(), rank) {
            let minor = graph.small_determinant(&Graph::submatrix(&gram, &chosen));
            sum = graph.formula(sum + minor);
        }
        let sum = graph.simplify(sum);
        self.vanishes_nowhere(graph, sum)
    }

    /// The sets of functions of which one has to vanish together for all minors to vanish.
    fn without_common_factors(&self, graph: &mut Graph, minors: &[ExprId]) -> Vec<Vec<ExprId>> {
        let factors = |graph: &Graph, minor: ExprId| -> Vec<ExprId> {
            match graph.node(minor) {
                Node::Product { factors, .. } => {
                    factors.iter().filter(|(_, e)| !e.is_negative()).map(|(base, _)| *base).collect()
                }
                _ => vec![minor],
            }
        };
        let minors: Vec<ExprId> = minors.iter().map(|minor| graph.without_content(*minor)).collect();
        let mut lists: Vec<Vec<ExprId>> = minors.iter().map(|minor| factors(graph, *minor)).collect();
        for list in &mut lists {
            list.retain(|factor| {
                !self.vanishes_nowhere(graph, *factor) && !graph.has_no_zeros(*factor, self.facts)
            });
        }
        let Some(first) = lists.first().cloned() else { return Vec::new() };
        let common: Vec<ExprId> =
            first.into_iter().filter(|factor| lists.iter().all(|list| list.contains(factor))).collect();
        let mut sets: Vec<Vec<ExprId>> = common
            .iter()
            .filter(|factor| !is_excluded(graph, self.holding, &[**factor]))
            .map(|factor| vec![*factor])
            .collect();
        // what is left of each minor: factors that may vanish, of which one does
        for list in &mut lists {
            list.retain(|factor| !common.contains(factor));
        }
        // a set that contains another vanishes wherever that does
        let needed: Vec<&Vec<ExprId>> = lists
            .iter()
            .enumerate()
            .filter(|(index, list)| {
                !lists.iter().enumerate().any(|(other, smaller)| {
                    let is_smaller =
                        smaller.len() < list.len() || (smaller.len() == list.len() && other < *index);
                    is_smaller && smaller.iter().all(|factor| list.contains(factor))
                })
            })
            .map(|(_, list)| list)
            .collect();
        if needed.iter().any(|list| list.is_empty()) {
            return sets;
        }
        let alternatives = needed.iter().fold(1, |product: usize, list| product.saturating_mul(list.len()));
        let mut candidates: Vec<Vec<ExprId>> = vec![Vec::new()];
        for list in needed {
            if alternatives <= ALTERNATIVES {
                // one factor of each
                let longer = |set: &Vec<ExprId>| -> Vec<Vec<ExprId>> {
                    list.iter().map(|factor| extended(set, *factor)).collect()
                };
                candidates = candidates.iter().flat_map(longer).collect();
            } else {
                let factors: Vec<(ExprId, Rational)> = list.iter().map(|e| (*e, Rational::ONE)).collect();
                let product = graph.product(&factors);
                for set in &mut candidates {
                    set.push(product);
                }
            }
        }
        for candidate in candidates {
            let is_off = self.vanish_nowhere_together(graph, &candidate)
                || self.is_off_the_manifold(graph, &candidate)
                || is_excluded(graph, self.holding, &candidate);
            if is_off {
                continue;
            }
            let set: Vec<ExprId> = candidate.into_iter().map(|factor| without_sign(graph, factor)).collect();
            let is_same =
                |other: &Vec<ExprId>| other.len() == set.len() && set.iter().all(|e| other.contains(e));
            if !sets.iter().any(is_same) {
                sets.push(set);
            }
        }
        // a set with more members than another says nothing new
        let is_needed = |set: &Vec<ExprId>| {
            !sets.iter().any(|other| other.len() < set.len() && other.iter().all(|e| set.contains(e)))
        };
        sets.iter().filter(|set| is_needed(set)).cloned().collect()
    }
}

/// The set with one more member.
fn extended(set: &[ExprId], factor: ExprId) -> Vec<ExprId> {
    let more = (!set.contains(&factor)).then_some(factor);
    set.iter().copied().chain(more).collect()
}

/// The function, or its opposite where that has the shorter text: both have the same zeros.
fn without_sign(graph: &mut Graph, function: ExprId) -> ExprId {
    let opposite = graph.formula(-function);
    if graph.text(opposite).len() < graph.text(function).len() { opposite } else { function }
}

/// The matrix after elimination by entries that are numbers other than zero: what is left has the rank less
/// the number of these, at every point.
fn without_constants(graph: &mut Graph, mut matrix: Matrix, mut rank: usize) -> (Matrix, usize) {
    loop {
        let position = matrix.iter().enumerate().find_map(|(row, entries)| {
            let is_number = |entry: &ExprId| graph.value_of(*entry).is_some_and(|value| !value.is_zero());
            entries.iter().position(is_number).map(|column| (row, column))
        });
        let Some((row, column)) = position else { return (matrix, rank) };
        let pivots = matrix.remove(row);
        for entries in &mut matrix {
            let factor = graph.formula(entries[column] / pivots[column]);
            if !graph.is_literal_zero(factor) {
                for (entry, pivot) in entries.iter_mut().zip(&pivots) {
                    *entry = graph.formula(*entry - factor * pivot);
                }
            }
            entries.remove(column);
        }
        rank = rank.saturating_sub(1);
    }
}

/// The number of subsets, or more than are ever written down.
fn count(of: usize, size: usize) -> usize {
    (0..size).fold(1usize, |product, k| product.saturating_mul(of.saturating_sub(k)) / (k + 1))
}

/// The subsets of a given size, members ascending.
fn subsets(of: usize, size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![Vec::new()];
    }
    let mut found = Vec::new();
    for last in size - 1..of {
        for mut smaller in subsets(last, size - 1) {
            smaller.push(last);
            found.push(smaller);
        }
    }
    found
}

//! Parameters for which the equations do not determine the accelerations in any state, although the emitted
//! ones may have a value: the mass m of a particle that falls divides nothing, since m v̇ = m g is solved by v̇ = g. That
//! such a parameter, or such an expression of parameters, is not zero is a condition that `validate` checks.

use crate::algebra::{Echelon, Facts, FieldPoint, Graph, Matrix, Node, Residue};
use crate::geometry::{Manifold, point_on_zero};
use crate::id::{ExprId, SymbolId};
use crate::model::{Model, Relation};

/// Parameters that may be 0 at the edge of what is assumed of them are also asked in pairs, if they are so few.
const IN_PAIRS: usize = 8;
/// Groups in which parameters are asked first.
const GROUPS: usize = 4;
/// Points on the zeros of an expression that are tried where one has no value.
const POINTS: u64 = 4;
const FIRST_SEED: u64 = 7_001;

/// What must not vanish for a matrix to be regular in some state, and for the declaration to have a value, beside what is
/// `known` not to: the expressions of parameters alone
///
/// - by which the declaration divides, or that are factors of determinants (the candidates),
/// - that all entries of a row have for a factor,
/// - at whose zeros the rank falls: parameters, and differences of the sides of an assumption `a >= b`,
/// - and sums of two parameters that are not negative, where it falls at the zeros of both.
pub fn singular_parameters(
    model: &mut Model,
    facts: &Facts,
    (matrix, manifold): (&Matrix, &Manifold),
    candidates: &[ExprId],
    known: &[ExprId],
) -> Vec<ExprId> {
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let mut asked = Asked { facts, parameters: &parameters, known: known.to_vec(), found: Vec::new() };
    for candidate in candidates {
        asked.add(&mut model.graph, *candidate);
    }
    let edges = edges(model);
    let graph = &mut model.graph;
    for row in matrix {
        for factor in common_factors(graph, row) {
            asked.add(graph, factor);
        }
    }
    let parts: Vec<Matrix> = manifold.parts().map(|part| part.restrict_matrix(graph, matrix)).collect();
    // 1. one parameter
    let occurring = graph.symbols_in(&matrix.concat());
    let mut open: Vec<ExprId> = Vec::new();
    for symbol in parameters.iter().filter(|symbol| occurring.contains(symbol)) {
        let value = graph.symbol(*symbol);
        if asked.is_open(graph, value) {
            open.push(value);
        }
    }
    for value in where_rank_falls(graph, &parts, &open) {
        asked.add(graph, value);
        open.retain(|other| *other != value);
    }
    // 2. a difference
    for edge in edges {
        let is_symbol = graph.as_symbol(edge).is_some();
        if !is_symbol && asked.is_open(graph, edge) && rank_falls(graph, &parts, &[edge]) == Some(true) {
            asked.add(graph, edge);
        }
    }
    // 3. two parameters together
    let sign = |graph: &Graph, value: ExprId| {
        let range = graph.as_symbol(value).and_then(|symbol| facts.symbols.get(&symbol));
        range.and_then(|range| match (range.low == 0.0, range.high == 0.0) {
            (true, _) => Some(1),
            (_, true) => Some(-1),
            _ => None,
        })
    };
    open.retain(|value| sign(graph, *value).is_some());
    for (index, first) in open.iter().enumerate().filter(|_| open.len() <= IN_PAIRS) {
        for second in &open[index + 1..] {
            let both = [*first, *second];
            if rank_falls(graph, &parts, &both) == Some(true) && !asked.follows_at(graph, &both) {
                let is_sum = sign(graph, *first) == sign(graph, *second);
                let (a, b) = (*first, *second);
                let sum = if is_sum { graph.formula(a + b) } else { graph.formula(a - b) };
                asked.found.push(sum);
                asked.known.push(sum);
            }
        }
    }
    asked.found
}

/// The factors that all entries have, and all terms of those that are sums, as they are written.
fn common_factors(graph: &Graph, entries: &[ExprId]) -> Vec<ExprId> {
    let factors_of = |entry: ExprId| match graph.node(entry) {
        Node::Product { factors, .. } => {
            let powers = factors.iter().filter(|(_, exponent)| !exponent.is_negative());
            powers.map(|(base, _)| *base).collect()
        }
        _ => vec![entry],
    };
    let terms_of = |entry: ExprId| match graph.node(entry) {
        Node::Sum { constant, terms } if constant.is_zero() => terms.iter().map(|(term, _)| *term).collect(),
        _ => vec![entry],
    };
    let entries = entries.iter().filter(|entry| !graph.is_literal_zero(**entry));
    let mut terms = entries.flat_map(|entry| terms_of(*entry));
    let mut common: Vec<ExprId> = terms.next().map_or_else(Vec::new, factors_of);
    for term in terms {
        if common.is_empty() {
            break;
        }
        let factors = factors_of(term);
        common.retain(|factor| factors.contains(factor));
    }
    common
}

/// Differences of the sides of assumptions that admit equality.
fn edges(model: &mut Model) -> Vec<ExprId> {
    let graph = &mut model.graph;
    let admitting = model
        .assumptions
        .iter()
        .filter(|fact| matches!(fact.relation, Relation::GreaterOrEqual | Relation::LessOrEqual));
    admitting.map(|fact| graph.formula(fact.left - fact.right)).collect()
}

/// Conditions as they are found.
struct Asked<'f> {
    facts: &'f Facts,
    parameters: &'f [SymbolId],
    /// What does not vanish, those that were found among it.
    known: Vec<ExprId>,
    found: Vec<ExprId>,
}

impl Asked<'_> {
    /// Notes that an expression must not vanish, if that is a condition on the parameters that is not known.
    fn add(&mut self, graph: &mut Graph, candidate: ExprId) {
        if self.is_open(graph, candidate) {
            self.found.push(candidate);
            self.known.push(candidate);
        }
    }

    /// Whether an expression is one of parameters alone that may vanish, as far as is known.
    fn is_open(&self, graph: &mut Graph, candidate: ExprId) -> bool {
        let symbols = graph.symbols_in(&[candidate]);
        !symbols.is_empty()
            && symbols.iter().all(|symbol| self.parameters.contains(symbol))
            && !graph.vanishes_nowhere(candidate, self.facts)
            && !self.known.contains(&candidate)
            && !self.follows_at(graph, &[candidate])
    }

    /// Whether something that does not vanish would, where the expressions do.
    fn follows_at(&self, graph: &mut Graph, zeros: &[ExprId]) -> bool {
        self.known.iter().any(|known| {
            values_on(graph, &vec![vec![*known]], zeros).is_some_and(|values| values[0][0] == Residue::ZERO)
        })
    }
}

/// Those of some parameters at whose zeros the rank of a matrix falls. Where it has full rank although several are 0, it has
/// so where any of these is. So groups are asked before each one is, picked at random, since the equations hardly ever are
/// regular where all masses are 0 or all inertias.
fn where_rank_falls(graph: &mut Graph, parts: &[Matrix], parameters: &[ExprId]) -> Vec<ExprId> {
    let mut places: Vec<usize> = (0..parameters.len()).collect();
    places.sort_by_key(|place| Residue::mixed(FIRST_SEED, *place as u64).word());
    let group = |first| places.iter().skip(first).step_by(GROUPS).map(|place| parameters[*place]).collect();
    let mut left: Vec<Vec<ExprId>> = (0..GROUPS).map(group).collect();
    let mut found = Vec::new();
    while let Some(mut group) = left.pop() {
        if group.is_empty() {
            continue;
        }
        match rank_falls(graph, parts, &group) {
            Some(false) => {}
            Some(true) if group.len() == 1 => found.append(&mut group),
            _ if group.len() > 1 => {
                let second = group.split_off(group.len() / 2);
                left.extend([second, group]);
            }
            _ => {}
        }
    }
    found.sort_unstable();
    found
}

/// Whether a square matrix has less than full rank on every part of a manifold where some expressions vanish; `None` where
/// it has no value there.
fn rank_falls(graph: &mut Graph, parts: &[Matrix], zeros: &[ExprId]) -> Option<bool> {
    for part in parts {
        if Echelon::of(values_on(graph, part, zeros)?).rank() == part.len() {
            return Some(false);
        }
    }
    Some(true)
}

/// A matrix at a point where one expression, or each of several symbols, vanishes.
fn values_on(graph: &mut Graph, matrix: &Matrix, zeros: &[ExprId]) -> Option<Vec<Vec<Residue>>> {
    let entries = matrix.concat();
    for seed in FIRST_SEED..FIRST_SEED + POINTS {
        let mut point = FieldPoint::random(seed);
        for zero in zeros {
            let other = point_on_zero(graph, *zero, seed)?;
            point.chosen.extend(other.chosen);
            point.circle.extend(other.circle);
        }
        if let Ok(values) = graph.evaluate_in_field(&entries, &point) {
            let mut values = values.into_iter();
            return Some(matrix.iter().map(|row| values.by_ref().take(row.len()).collect()).collect());
        }
    }
    None
}

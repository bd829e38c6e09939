//! Regularity: the equations determine the accelerations (CLMM Theorem 3.12, (7.5)).

use super::changed_signature::varies;
use super::dependence::{ONE_PART, place_of, with_all_roots};
use super::evidence::{listed, shown};
use crate::algebra::{Echelon, Facts, FieldPoint, Graph, Matrix, Range, Residue, sample};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{ReducedEquations, SaddleEquations, uncoupled};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// Rows of a matrix that determinants are written out for, and operations in its entries.
const SIZE: usize = 3;
const SHORT: u64 = 300;

/// C_{ab} is non-singular at generic points of the constraint manifold.
pub fn reduced_regularity(
    model: &mut Model,
    equations: &ReducedEquations,
    base: &mut Manifold,
) -> Option<Violation> {
    let names: Vec<String> =
        equations.independent.iter().map(|symbol| model.graph.symbols()[*symbol].clone()).collect();
    let what = "the mass matrix is singular on the constraint distribution: its rank is";
    judge(model, base, &equations.mass, what, |vector| direction(vector, &names))
}

/// The saddle matrix is non-singular at generic points of the constraint manifold.
pub fn saddle_regularity(
    model: &mut Model,
    equations: &SaddleEquations,
    manifold: &mut Manifold,
) -> Option<Violation> {
    let matrix = equations.matrix(&mut model.graph);
    let names: Vec<String> = model.sections.iter().map(|section| section.name.clone()).collect();
    let what = "the equations for accelerations and multipliers are singular: the rank of their matrix is";
    judge(model, manifold, &matrix, what, |vector| direction(vector, &names))
}

/// A motion without inertia.
fn direction(vector: &[Residue], names: &[String]) -> String {
    let moving = vector.iter().zip(names).filter(|(component, _)| **component != Residue::ZERO);
    let moving: Vec<&str> = moving.map(|(_, name)| name.as_str()).collect();
    match moving.as_slice() {
        [only] => format!("the Lagrangian gives the velocity `{only}` no inertia there"),
        [] => "the constraint forces are not determined".into(),
        several => {
            format!(
                "the Lagrangian gives a combination of the velocities {} no inertia there",
                listed(several)
            )
        }
    }
}

/// Whether a matrix is singular on a manifold, or on a part of it. Parts that are too many to be asked become open.
fn judge(
    model: &mut Model,
    manifold: &mut Manifold,
    matrix: &Matrix,
    what: &str,
    evidence: impl Fn(&[Residue]) -> String,
) -> Option<Violation> {
    let origin = model.lagrangian.origin;
    let manifold = &with_all_roots(model, manifold, matrix);
    let mut found = Vec::new();
    for part in manifold.parts() {
        let restricted = part.restrict_matrix(&mut model.graph, matrix);
        match model.graph.generic_rank(&restricted) {
            Ok(rank) => found.push((part, restricted, rank)),
            Err(why) => {
                return Some(Violation {
                    law: Law::Decidable,
                    origin,
                    what: "whether the mass matrix is regular could not be decided".into(),
                    evidence: why,
                    way_out: if manifold.is_whole() {
                        "write the Lagrangian without roots of negative numbers and divisions by zero".into()
                    } else {
                        "write the Lagrangian, and what holds of positions, without roots of negative numbers and \
                         divisions by zero; equations that only touch each other leave no points to try"
                            .into()
                    },
                });
            }
        }
    }
    let size = matrix.len();
    let (part, restricted, rank) = found.iter().find(|(_, _, rank)| *rank < size)?;
    let is_everywhere = found.iter().all(|(_, _, rank)| *rank < size);
    let (place, way_out) = if is_everywhere {
        (String::new(), "give that motion a kinetic energy in the Lagrangian, or constrain it")
    } else {
        (place_of(model, manifold, part), ONE_PART)
    };
    Some(Violation {
        law: Law::Regularity,
        origin,
        what: format!("{what} {rank} of {size}{place}"),
        evidence: without_inertia(&model.graph, restricted, *rank, evidence),
        way_out: way_out.into(),
    })
}

/// A motion that a singular matrix gives no inertia, in words, or an entry that is 0 in disguise.
fn without_inertia(
    graph: &Graph,
    matrix: &Matrix,
    rank: usize,
    evidence: impl Fn(&[Residue]) -> String,
) -> String {
    let rows = graph.matrix_in_field(matrix, |seed| FieldPoint::random(9_000 + seed));
    let echelon = rows.ok().map(Echelon::of).filter(|echelon| echelon.rank() == rank);
    if let Some(vector) = echelon.and_then(|echelon| echelon.kernel_vector(matrix.len())) {
        return evidence(&vector);
    }
    let is_hidden = |entry: &&ExprId| !graph.is_literal_zero(**entry) && graph.zero_test(**entry).is_zero();
    let hidden = matrix.iter().flatten().find(is_hidden);
    hidden.map_or_else(String::new, |entry| format!("{} is 0", shown(graph, *entry)))
}

/// What determinants of the equations tell of where these are singular.
#[derive(Clone, Debug, Default)]
pub struct SingularFactors {
    /// Their factors that may vanish in some state.
    pub varying: Vec<ExprId>,
    /// Their factors that are made of parameters alone.
    pub of_parameters: Vec<ExprId>,
    /// The rows of blocks that vary with the state, and whose determinants are too long to be written out.
    pub long: Vec<Vec<usize>>,
}

/// Where the mass matrix of a regular system is singular all the same, as far as short
/// determinants tell: their factors that may vanish at states of a machine all of whose parameters are
/// positive, or as the facts say. A factor in which parameters occur has to do so for a machine whose mass
/// matrix is positive definite in some other state. Besides, the factors of parameters alone.
pub fn singular_where(
    graph: &mut Graph,
    mass: &Matrix,
    parameters: &[SymbolId],
    facts: &Facts,
) -> SingularFactors {
    let usual = with_positive(facts, parameters);
    let (mut found, mut of_parameters_alone): (Vec<ExprId>, Vec<ExprId>) = (Vec::new(), Vec::new());
    let mut long = Vec::new();
    for block in uncoupled(graph, mass) {
        let inner = Graph::submatrix(mass, &block);
        if block.len() > SIZE || graph.operation_count(&inner.concat()) > SHORT {
            if varies(graph, &inner, parameters) {
                long.push(block);
            }
            continue;
        }
        let determinant = graph.small_determinant(&inner);
        for (base, exponent) in graph.factors(determinant) {
            let symbols = graph.symbols_in(&[base]);
            let of_parameters = |symbol: &SymbolId| parameters.contains(symbol);
            let varies = !symbols.iter().all(of_parameters);
            if !varies && !exponent.is_negative() {
                of_parameters_alone.push(base);
            }
            let harmless = exponent.is_negative()
                || graph.vanishes_nowhere(base, &usual)
                || (symbols.iter().any(of_parameters) && !changes_sign(graph, base, &inner, parameters));
            if varies && !harmless && !found.contains(&base) {
                found.push(base);
            }
        }
    }
    SingularFactors { varying: found, of_parameters: of_parameters_alone, long }
}

/// The same of the saddle matrix, where the mass matrix is not positive definite anyway: with such a one it is singular only
/// where the constraints are dependent.
pub fn saddle_singular_where(
    graph: &mut Graph,
    equations: &SaddleEquations,
    parameters: &[SymbolId],
    facts: &Facts,
) -> SingularFactors {
    // inertias that are parameters are those of some body
    let symbols = graph.symbols_in(&equations.mass.concat());
    if !symbols.is_empty() && symbols.iter().all(|symbol| parameters.contains(symbol)) {
        return SingularFactors::default();
    }
    let usual = with_positive(facts, parameters);
    // larger ones belong to larger blocks of the saddle matrix
    let (short, mut long): (Vec<_>, Vec<_>) =
        uncoupled(graph, &equations.mass).into_iter().partition(|block| block.len() < SIZE);
    long.retain(|block| varies(graph, &Graph::submatrix(&equations.mass, block), parameters));
    let indefinite: Vec<usize> = short
        .into_iter()
        .filter(|block| !is_definite(graph, &equations.mass, block, &usual))
        .flatten()
        .collect();
    if indefinite.is_empty() {
        return SingularFactors { long, ..SingularFactors::default() };
    }
    let saddle = equations.matrix(graph);
    let mut found: Vec<ExprId> = Vec::new();
    for block in uncoupled(graph, &saddle) {
        if !block.iter().any(|row| indefinite.contains(row)) {
            continue;
        }
        let inner = Graph::submatrix(&saddle, &block);
        if block.len() > SIZE + 1 || graph.operation_count(&inner.concat()) > SHORT {
            if varies(graph, &inner, parameters) {
                long.push(block);
            }
            continue;
        }
        let determinant = graph.small_determinant(&inner);
        for (base, exponent) in graph.factors(determinant) {
            let symbols = graph.symbols_in(&[base]);
            let varies = !symbols.iter().all(|symbol| parameters.contains(symbol));
            let is_sure = |graph: &Graph| {
                !symbols.iter().any(|symbol| parameters.contains(symbol))
                    || graph.has_both_signs(base, parameters)
            };
            let harmless = exponent.is_negative() || graph.vanishes_nowhere(base, &usual);
            if varies && !harmless && is_sure(graph) && !found.contains(&base) {
                found.push(base);
            }
        }
    }
    SingularFactors { varying: found, of_parameters: Vec::new(), long }
}

/// The facts about a machine all of whose parameters are positive, unless these say otherwise.
pub(crate) fn with_positive(facts: &Facts, parameters: &[SymbolId]) -> Facts {
    let mut usual = facts.clone();
    for parameter in parameters {
        usual.symbols.entry(*parameter).or_insert(Range::POSITIVE);
    }
    usual
}

/// Whether rows and columns of a matrix are positive definite, as the ranges of its leading minors say.
fn is_definite(graph: &mut Graph, matrix: &Matrix, block: &[usize], facts: &Facts) -> bool {
    (1..=block.len()).all(|size| {
        let minor = graph.small_determinant(&Graph::submatrix(matrix, &block[..size]));
        graph.range(minor, facts).is_positive()
    })
}

/// Sizes of parameters that are tried: powers of two up to one and a half times this, and down to as many.
const SIZES: f64 = 4.0;

/// A number for one of these symbols: of a machine, whose parameters are positive and may be of all sizes, and of one of
/// so many states.
pub(super) fn machine(
    symbols: &[SymbolId],
    parameters: &[SymbolId],
    (machine, of_all_sizes): (u64, bool),
    (states, state): (u64, u64),
    symbol: SymbolId,
) -> f64 {
    let index = symbols.iter().position(|known| *known == symbol).unwrap_or(symbols.len());
    if parameters.contains(&symbol) {
        let size = if of_all_sizes { SIZES * sample(4 * machine + 2, index) } else { 0.0 };
        sample(4 * machine, index) * size.exp2()
    } else {
        4.0 * sample(4 * (states * machine + state) + 2, index)
    }
}

/// Whether a factor of the determinant changes its sign, for some positive parameters, between a state where
/// the mass matrix is positive definite and another.
fn changes_sign(graph: &mut Graph, factor: ExprId, mass: &Matrix, parameters: &[SymbolId]) -> bool {
    const MACHINES: u64 = 16;
    const OF_ALL_SIZES: u64 = 8;
    const STATES: u64 = 8;
    let symbols = graph.symbols_in(&[&[factor], mass.concat().as_slice()].concat());
    let value = |number: u64, state: u64, symbol: SymbolId| {
        // of like size first, then of all sizes
        machine(&symbols, parameters, (number, number >= MACHINES), (STATES, state), symbol)
    };
    let mut minors: Vec<ExprId> = Vec::new();
    let mut next = 0;
    loop {
        // 1. a machine for which the factor has both signs
        let mut evaluator = graph.evaluator(&[factor]);
        let found = (next..MACHINES + OF_ALL_SIZES).find_map(|machine| {
            let (mut states, mut signs) = (Vec::new(), [false; 2]);
            for state in 0..STATES {
                let found = evaluator.at(|symbol| value(machine, state, symbol))[0];
                if found.is_certainly_nonzero() {
                    signs[usize::from(found.value > 0.0)] = true;
                    states.push(state);
                }
            }
            (signs == [true; 2]).then_some((machine, states))
        });
        let Some((machine, states)) = found else { return false };
        // 2. whose mass matrix is definite in one of these states: in another the factor has the other sign
        if minors.is_empty() {
            for size in 1..=mass.len() {
                let leading: Vec<usize> = (0..size).collect();
                minors.push(graph.small_determinant(&Graph::submatrix(mass, &leading)));
            }
        }
        let mut evaluator = graph.evaluator(&minors);
        let is_definite = |state: &u64| {
            let values = evaluator.at(|symbol| value(machine, *state, symbol));
            values.iter().all(|minor| minor.value > 0.0 && minor.is_certainly_nonzero())
        };
        if states.iter().any(is_definite) {
            return true;
        }
        next = machine + 1;
    }
}

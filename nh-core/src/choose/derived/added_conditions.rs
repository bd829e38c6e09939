//! Functions of the motion and of what is declared add no condition: they have a value wherever that which defines
//! them has.
//!
//! What a function divides by is asked where it is 0. Along random lines through all parameters and states it is a
//! quotient of polynomials, found from its values; at the zeros of its numerator the definition has no value either, or
//! the divisor is an added condition. Two parameters that are equal are met like a parameter that is 0. The field has
//! zeros that no real number is: only a divisor that vanishes at real points, too, where the motion has a value and the
//! kinetic energy is definite, is refused. A divisor that is no quotient of polynomials of low degree, as one with roots
//! of the state, stays undecided, and is named.

use super::super::ledger::Proof;
use super::super::proof::{Defect, FIRST_SEED};
use super::definition::is_defined;
use super::divisors::{Lines, Zeros, asked};
use super::place::Place;
use super::real_zeros::RealPoints;
use super::{Allowed, Derived, Images, Motion};
use crate::algebra::{FieldPoint, Graph, Residue};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::LagrangianSystem;

/// Points that are looked at, as far as they have values.
const POINTS: usize = 3;
/// Points that are tried for these.
const SEEDS: u64 = 24;
/// Lines on which zeros are looked for: an irreducible divisor has some on half of them, or more.
const LINES: u64 = 16;
/// Zeros where the definition has no value either, after which no others are looked for.
const ZEROS: usize = 8;

/// What is known of the divisors of a function.
pub(super) enum Added {
    /// It has no value where this is 0, and that which defines it has one.
    Where(String),
    /// That was not decided of these.
    Undecided(Vec<String>),
}

/// A proof with what stayed undecided beside it, unless a condition is added; `asked` is `None` where the question would
/// take too many steps.
pub(super) fn judged(proof: Proof, asked: Option<Added>) -> Result<(Proof, Option<String>), Defect> {
    let doubt = "whether it adds a condition was not decided";
    match asked {
        Some(Added::Where(divisor)) => {
            Err(Defect::Wrong(format!("it has no value where `{divisor}` is 0, and the motion has one")))
        }
        Some(Added::Undecided(divisors)) if divisors.is_empty() => Ok((proof, None)),
        Some(Added::Undecided(divisors)) => {
            let places: Vec<String> = divisors.iter().map(|divisor| format!("{divisor} = 0")).collect();
            Ok((proof, Some(format!("{doubt}: where {}", places.join(", or ")))))
        }
        None => Ok((proof, Some(format!("{doubt}: that would take too many steps")))),
    }
}

/// Asks where a function divides by 0 whether that which defines it has a value.
pub(super) fn added_condition<'a, 's>(
    graph: &Graph,
    claim: &Derived,
    (declared, motion, images): (&[ExprId], Motion, Images),
    system: &LagrangianSystem,
    allowed: &Allowed,
    point: impl Fn(u64) -> FieldPoint,
    at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
) -> Added {
    let none = Added::Undecided(Vec::new());
    let asked = asked(graph, claim, (declared, motion), allowed);
    if asked.is_empty() {
        return none;
    }
    let open = asked.unrecognised(claim, &point, &at);
    if open.is_empty() {
        return none;
    }
    let mut lines = Lines::of(graph, claim, &asked, images);
    let mut real: Option<RealPoints> = None;
    let expressions = (declared, motion, images);
    let mut undecided: Vec<String> = Vec::new();
    for index in open {
        let mut harmless = 0;
        for seed in 0..LINES {
            let zeros = match lines.zeros(index, seed, &at) {
                Zeros::At(zeros) => zeros,
                Zeros::Nowhere => break,
                Zeros::Unknown => {
                    undecided.push(asked.text(graph, index));
                    break;
                }
            };
            let is_added = |zero: &Residue| lines.is_added(claim, index, (seed, *zero), allowed, &at);
            if zeros.iter().any(is_added) {
                let real =
                    real.get_or_insert_with(|| RealPoints::of(graph, claim, expressions, system, allowed));
                if real.has_zero(asked.place(index)) {
                    return Added::Where(asked.text(graph, index));
                }
                break;
            }
            harmless += zeros.len();
            if harmless >= ZEROS {
                break;
            }
        }
    }
    if undecided.is_empty() {
        return none;
    }
    undecided.dedup();
    let parameter = parameter_that_may_not_vanish(claim, &asked.parameters, point, at);
    parameter
        .map_or(Added::Undecided(undecided), |parameter| Added::Where(graph.symbols()[parameter].clone()))
}

/// The first parameter that may be 0 for the motion, and not for the function.
fn parameter_that_may_not_vanish<'a, 's>(
    claim: &Derived,
    parameters: &[SymbolId],
    point: impl Fn(u64) -> FieldPoint,
    at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
) -> Option<SymbolId> {
    parameters.iter().copied().find(|parameter| {
        let mut without_value = 0;
        for seed in FIRST_SEED..FIRST_SEED + SEEDS {
            let mut point = point(seed);
            point.chosen.insert(*parameter, Residue::ZERO);
            let Ok(mut place) = at(point) else { continue };
            if !is_defined(claim, &mut place).unwrap_or(false) {
                continue;
            }
            if claim.procedures().iter().all(|procedure| claim.has_values(&place, procedure)) {
                return false;
            }
            without_value += 1;
            if without_value == POINTS {
                return true;
            }
        }
        false
    })
}

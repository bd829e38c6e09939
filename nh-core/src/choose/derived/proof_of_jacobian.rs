//! Jacobians, alone or beside the function that they differentiate, against derivatives along a direction.

use super::super::proof::Defect;
use super::super::reference::inner;
use super::place::Place;
use crate::algebra::{Direction, Residue};
use crate::id::SymbolId;
use crate::mechanics::Procedure;

/// J u for some u against the derivative along it.
pub(super) fn is_jacobian(
    place: &Place,
    (function, arguments): (&Procedure, &[SymbolId]),
    rows: &[Residue],
) -> Result<bool, Defect> {
    let pass = place.pass();
    let along: Vec<Residue> =
        (0..arguments.len()).map(|k| pass.kernel("direction", &[Residue::of_word(k as u64)])).collect();
    let direction: Direction = arguments.iter().copied().zip(along.iter().copied()).collect();
    let changes = place.slopes(function, &direction)?;
    let rows = rows.chunks(arguments.len().max(1)).map(|row| inner(row, &along));
    Ok(arguments.is_empty() || changes.into_iter().eq(rows))
}

/// The values of the function, then its Jacobian.
pub(super) fn is_linearized(
    place: &Place,
    (function, arguments): (&Procedure, &[SymbolId]),
    found: &[Residue],
) -> Result<bool, Defect> {
    let values = place.run(function)?;
    match found.split_at_checked(values.len()) {
        Some((first, rows)) if first == values => is_jacobian(place, (function, arguments), rows),
        _ => Ok(false),
    }
}

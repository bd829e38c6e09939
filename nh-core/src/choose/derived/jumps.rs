//! Jumps of velocities by impulses, mathematics (50): what they are said to do, in numbers.

use super::super::proof::Defect;
use super::super::reference::inner;
use super::place::{Place, spans};
use crate::algebra::{Direction, Residue, TangentPass};
use crate::id::{ExprId, SymbolId};
use crate::system::ImpactForm;

/// The rows s = Ψ y + b; of each the change r of the velocities of the state with C r = Nᵀ on D, or W r − Ψᵀ in the
/// span of the rows of J and J r = 0; and K = N r.
pub(super) fn is_jump(place: &Place, impact: &ImpactForm, rows: &[ExprId]) -> Result<bool, Defect> {
    let is_reduced = place.reference.is_reduced();
    let velocities: &[SymbolId] =
        if is_reduced { place.reference.state() } else { &place.system().algebroid.velocities };
    let stored = place.run(&impact.jump)?;
    let (count, width) = (rows.len(), velocities.len());
    if stored.len() != count * (1 + width + count) {
        return Ok(false);
    }
    let (approach, rest) = stored.split_at(count);
    let (responses, mobility) = rest.split_at(count * width);
    let responses: Vec<&[Residue]> = responses.chunks(width).collect();
    // the sections along the velocities of the state, and N along these
    let mut sections: Vec<Vec<Residue>> = Vec::new();
    let mut coefficients: Vec<Vec<Residue>> = vec![Vec::new(); count];
    for velocity in velocities {
        let mut along = Direction::from_iter([(*velocity, Residue::ONE)]);
        if is_reduced {
            along = place.with_all_velocities(&along)?;
        }
        let all = &place.system().algebroid.velocities;
        let component = |symbol: &SymbolId| along.get(symbol).copied().unwrap_or(Residue::ZERO);
        sections.push(all.iter().map(component).collect());
        let changes = TangentPass::new(&mut place.pass(), along).duals(rows)?;
        for (row, change) in coefficients.iter_mut().zip(changes) {
            row.push(change.rate);
        }
    }
    let mass = place.mass()?;
    let jacobian = if is_reduced { Vec::new() } else { place.jacobian()? };
    let image =
        |section: &[Residue]| -> Vec<Residue> { mass.iter().map(|row| inner(row, section)).collect() };
    for (response, row) in responses.iter().zip(&coefficients) {
        let mut moved = vec![Residue::ZERO; mass.len()];
        for (section, component) in sections.iter().zip(*response) {
            for (slot, entry) in moved.iter_mut().zip(section) {
                *slot = *slot + *entry * *component;
            }
        }
        let momenta = image(&moved);
        let left: Vec<Residue> =
            sections.iter().zip(row).map(|(section, n)| inner(section, &momenta) - *n).collect();
        let stays = jacobian.iter().all(|constraint| inner(constraint, &moved) == Residue::ZERO);
        let is_pushed = if is_reduced {
            left.iter().all(|entry| *entry == Residue::ZERO)
        } else {
            spans(&jacobian, &[left])
        };
        if !(stays && is_pushed) {
            return Ok(false);
        }
    }
    let is_mobility = coefficients
        .iter()
        .flat_map(|row| responses.iter().map(|response| inner(row, response)))
        .eq(mobility.iter().copied());
    Ok(is_mobility && place.values(rows)? == approach)
}

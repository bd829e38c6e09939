//! Equations that a step keeps by itself, mathematics (37): what they are said to be, in numbers.

use super::super::proof::Defect;
use super::super::reference::inner;
use super::place::Place;
use super::procedure_derivative::solution;
use super::returns::slopes;
use crate::algebra::Residue;
use crate::phase_space::HeldEquations;

/// g, ∂g by the state, and of each the direction ρ(w) or w with W w in the span of the rows of J, J w = 1 in its row.
pub(super) fn are_held(place: &Place, held: &HeldEquations, positions: usize) -> Result<bool, Defect> {
    let stored = place.run(&held.map)?;
    let count = held.functions.len();
    let coordinates = place.coordinates();
    let is_reduced = place.reference.is_reduced();
    let velocities = if is_reduced { place.reference.state() } else { &place.system().algebroid.velocities };
    // coordinates, velocities, and what rests in a correction: auxiliary states
    let state = place.motion.state;
    let resting = vec![Residue::ZERO; state.len().saturating_sub(coordinates.len() + velocities.len())];
    let mut wanted = place.values(&held.functions)?;
    wanted.extend(slopes(place, &held.functions, state)?.into_iter().flatten());
    let (mass, rows) = (place.mass()?, place.jacobian()?);
    let anchor = place.matrix(&place.system().algebroid.anchor.entries)?;
    let none = vec![Residue::ZERO; rows.len()];
    let mut matrix: Vec<Vec<Residue>> = Vec::new();
    for (alpha, row) in mass.iter().enumerate() {
        matrix.push(row.iter().copied().chain(rows.iter().map(|row| row[alpha])).collect());
    }
    matrix.extend(rows.iter().map(|row| [row.as_slice(), &none].concat()));
    for equation in 0..count {
        let row = if equation < positions { equation } else { equation - positions };
        let unit = (0..rows.len()).map(|other| if other == row { Residue::ONE } else { Residue::ZERO });
        let right = vec![Residue::ZERO; mass.len()].into_iter().chain(unit);
        let mut section = solution(&matrix, right)?;
        section.truncate(mass.len());
        let moved: Vec<Residue> = if equation < positions {
            anchor.iter().map(|row| inner(row, &section)).collect()
        } else {
            vec![Residue::ZERO; coordinates.len()]
        };
        wanted.extend(moved);
        if equation < positions {
            wanted.extend(vec![Residue::ZERO; velocities.len()]);
        } else {
            wanted.extend(section);
        }
        wanted.extend(&resting);
    }
    Ok(stored == wanted)
}

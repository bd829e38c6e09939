//! Where what defines a function has a value: at a point, by the declared data and the motion, without the function.

use super::super::proof::Defect;
use super::place::{Place, is_regular_on, rank};
use super::proof_of_bracket::Symplectic;
use super::{Derived, proof_of_connection, proof_of_flow, proof_of_splitting, returns};
use crate::algebra::{Direction, Residue, determinant_in_field};
use crate::id::SymbolId;

/// Whether the motion, and what defines the function, have values.
pub(super) fn is_defined(claim: &Derived, place: &mut Place) -> Result<bool, Defect> {
    let flow = place.flow()?;
    place.values(&place.reference.roots())?;
    match *claim {
        Derived::Jacobian(function, _, arguments) | Derived::Linearized(function, _, arguments) => {
            let pass = place.pass();
            let along = |(k, symbol): (usize, &SymbolId)| {
                (*symbol, pass.kernel("direction", &[Residue::of_word(k as u64)]))
            };
            let along: Direction = arguments.iter().enumerate().map(along).collect();
            place.slopes(function, &along)?;
        }
        Derived::Rates(function, _) => _ = place.slopes(function, &flow)?,
        Derived::Divergence(_, identities) | Derived::Density(_, identities) => {
            proof_of_flow::divergence(place, identities)?;
        }
        Derived::Energy(_) => _ = place.instant.energy()?,
        Derived::Values(form) => _ = form.names.known(place)?.evaluate(form.declared)?,
        Derived::Velocity(_) => {}
        Derived::Sharp(form) => {
            place.slopes(form.energy, &flow)?;
            return is_symplectic(place);
        }
        Derived::Bracket(form) => {
            place.slopes(form.energy, &flow)?;
            place.slopes(form.outputs, &flow)?;
            return is_symplectic(place);
        }
        Derived::Hamiltonian(_, energy) => {
            place.slopes(energy, &flow)?;
            return is_symplectic(place);
        }
        Derived::Christoffel(_) => return proof_of_connection::is_regular(place, false),
        Derived::Connection(..) => return proof_of_connection::is_regular(place, true),
        Derived::Splitting(form) => return proof_of_splitting::is_regular(place, &form),
        Derived::Gyroscopic(form) => _ = proof_of_splitting::gyroscopic(place, &form)?,
        Derived::Power(form) => {
            place.instant.energy()?;
            let mut pass = form.names.known(place)?;
            for force in form.forces {
                pass.evaluate(&[force.value])?;
                pass.evaluate(force.along.as_deref().unwrap_or_default())?;
            }
            let rows = match form.rows {
                _ if form.multipliers.is_none() => return Ok(true),
                Some(rows) => place.matrix(rows)?,
                None => place.jacobian()?,
            };
            return Ok(is_solvable(&place.mass()?, &rows));
        }
        Derived::Momenta(_, sections) => {
            place.momenta(Direction::default())?;
            for (section, gauge) in sections {
                place.values(section)?;
                place.values(gauge.as_slice())?;
            }
        }
        Derived::Residual(_, functions) => _ = place.values(functions)?,
        // a motion may have values where C is singular; a jump has none there
        Derived::Jump(_, rows) => {
            place.values(rows)?;
            return Ok(is_solvable(&place.mass()?, &place.jacobian()?));
        }
        Derived::Projection(_, residuals) => {
            let rows = returns::slopes(place, residuals, &place.system().algebroid.velocities)?;
            return Ok(is_solvable(&place.mass()?, &rows));
        }
        Derived::Return(positions, _, residuals) => {
            let count = positions.count - positions.redundant.len();
            let (_, rows) = returns::pulled_back(place, &positions.residual.outputs[..count])?;
            let mass = place.mass()?;
            let rates = match positions.velocities {
                Some(_) => returns::slopes(place, residuals, &place.system().algebroid.velocities)?,
                None => Vec::new(),
            };
            return Ok(is_solvable(&mass, &rows) && (rates.is_empty() || is_solvable(&mass, &rates)));
        }
        Derived::Normalisation(_, identities) => {
            let rows = returns::independent_slopes(place, identities)?;
            return Ok(determinant_in_field(returns::products(&rows)) != Residue::ZERO);
        }
        Derived::Leapfrog(_) | Derived::Held(..) => {
            return Ok(is_solvable(&place.mass()?, &place.jacobian()?));
        }
        Derived::Variational(form) => {
            let rows = returns::slopes(place, &form.residual.outputs, place.coordinates())?;
            place.momenta(Direction::default())?;
            return Ok(is_solvable(&place.mass()?, &rows));
        }
        Derived::DiscreteMomentum(_) => _ = place.distribution()?,
        Derived::Section(_, claimed) => {
            place.values(claimed)?;
            return Ok(is_regular_on(&place.mass()?, &place.distribution()?));
        }
    }
    Ok(true)
}

/// Whether Ω_L determines fields on D, and C is regular there.
fn is_symplectic(place: &Place) -> Result<bool, Defect> {
    let sections = place.distribution()?;
    Ok(Symplectic::at(place)?.is_regular() && is_regular_on(&place.mass()?, &sections))
}

/// Whether W δ in the span of the rows, with given values of the rows at δ, determines δ.
fn is_solvable(mass: &[Vec<Residue>], rows: &[Vec<Residue>]) -> bool {
    let none = vec![Residue::ZERO; rows.len()];
    let above = mass.iter().enumerate().map(|(alpha, row)| {
        row.iter().copied().chain(rows.iter().map(|row| row[alpha])).collect::<Vec<Residue>>()
    });
    let saddle: Vec<Vec<Residue>> =
        above.chain(rows.iter().map(|row| [row.as_slice(), &none].concat())).collect();
    rank(&saddle) == saddle.len()
}

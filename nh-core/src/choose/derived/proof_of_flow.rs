//! What is said of the motion: divergence and density, Hamilton's equations, solutions over the base, power.

use super::super::proof::{Defect, run};
use super::super::reference::inner;
use super::place::{Place, rank};
use super::proof_of_bracket::on_momenta;
use super::{PowerForm, choose_all};
use crate::algebra::{Direction, Echelon, Residue};
use crate::id::ExprId;
use crate::mechanics::{HamiltonianSide, Procedure};

/// Σ ∂f_i/∂x_i, less the trace of g where (∂_t + Γ) f = g f of functions f of time and place that vanish.
pub(super) fn divergence(place: &Place, vanishing: &[ExprId]) -> Result<Residue, Defect> {
    let motion = place.motion;
    let mut sum = Residue::ZERO;
    let mut along_base = Vec::new();
    for (index, symbol) in motion.state.iter().enumerate() {
        let slopes = place.slopes(motion.derivative, &Direction::from_iter([(*symbol, Residue::ONE)]))?;
        sum = sum + slopes[index];
        along_base.push(slopes);
    }
    if vanishing.is_empty() {
        return Ok(sum);
    }
    let (coordinates, flow) = (place.coordinates(), place.flow()?);
    // ∂_i(∂_tf + Γ f) = ∂_iΓ^m ∂_mf + (∂_t + Γ)(∂_if), of functions that do not follow from others
    let (mut slopes, mut changes) = (Vec::new(), Vec::new());
    for function in vanishing {
        let gradient = place.gradient(*function, coordinates, &flow)?;
        let row: Vec<Residue> = gradient.iter().map(|dual| dual.value).collect();
        if rank(&[slopes.as_slice(), std::slice::from_ref(&row)].concat()) == slopes.len() {
            continue;
        }
        let change = (0..coordinates.len()).map(|i| gradient[i].rate + inner(&row, &along_base[i]));
        changes.push(change.collect::<Vec<Residue>>());
        slopes.push(row);
    }
    let mut trace = Residue::ZERO;
    for (k, change) in changes.iter().enumerate() {
        let column = |i: usize| slopes.iter().map(|row| row[i]).chain([change[i]]).collect::<Vec<Residue>>();
        let echelon = Echelon::of((0..coordinates.len()).map(column).collect());
        trace = trace + echelon.solution(slopes.len()).ok_or(Defect::Here)?[k];
    }
    Ok(sum - trace)
}

/// ∂_tμ + Γ(μ) + μ div Γ = 0.
pub(super) fn is_kept(place: &Place, density: &Procedure, vanishing: &[ExprId]) -> Result<bool, Defect> {
    let change = place.slopes(density, &place.flow()?)?;
    let value = place.run(density)?;
    let divergence = divergence(place, vanishing)?;
    Ok(value.len() == 1 && value[0] != Residue::ZERO && change[0] + value[0] * divergence == Residue::ZERO)
}

/// π at v, v at π, h(π) = E, the rates of x and π along the motion, the bracket and the drift.
pub(super) fn is_hamiltonian(
    place: &Place,
    side: &HamiltonianSide,
    energy: &Procedure,
) -> Result<bool, Defect> {
    let state = place.motion.state;
    let coordinates = state.len() - side.momenta.len();
    let along = place.flow()?;
    let values = place.run(&side.legendre)?;
    let velocities: Vec<Residue> = state[coordinates..].iter().map(|v| place.pass().symbol(*v)).collect();
    let mut wanted: Vec<Residue> = state[..coordinates].iter().map(|x| along[x]).collect();
    wanted.extend(place.slopes(&side.legendre, &along)?);
    // π_a = B^α_a p_α
    let momenta: Vec<Residue> = place.momenta(Direction::default())?.iter().map(|dual| dual.value).collect();
    let projected: Vec<Residue> =
        place.distribution()?.iter().map(|section| inner(section, &momenta)).collect();
    let at_momenta = |procedure: &Procedure| {
        let mut pass = place.pass();
        choose_all(&mut pass, &side.momenta, &values)?;
        run(&mut pass, procedure)
    };
    Ok(values == projected
        && at_momenta(&side.inverse)? == velocities
        && at_momenta(&side.hamiltonian)? == place.run(energy)?
        && at_momenta(&side.equations)? == wanted
        && on_momenta(place, side, energy, at_momenta)?)
}

/// The rates of the velocities, at those that a function of the base gives, are the rates of that function; its
/// momenta are those that are claimed.
pub(super) fn is_solution(place: &Place, lifted: &Procedure, claimed: &[ExprId]) -> Result<bool, Defect> {
    let momenta: Vec<Residue> = place.momenta(Direction::default())?.iter().map(|dual| dual.value).collect();
    let sections = place.distribution()?;
    let projected: Vec<Residue> = sections.iter().map(|section| inner(section, &momenta)).collect();
    let state = place.motion.state;
    let flow = place.flow()?;
    let velocities = &state[state.len() - lifted.outputs.len()..];
    let rates: Vec<Residue> = velocities.iter().map(|velocity| flow[velocity]).collect();
    Ok(projected == place.values(claimed)? && place.slopes(lifted, &flow)? == rates)
}

/// Υ_α y^α of each force, λ_A y^α ∂φ^A/∂y^α of each constraint; their sum is dE/dt + ∂_tL.
pub(super) fn is_power(place: &Place, form: &PowerForm) -> Result<bool, Defect> {
    let powers = place.run(form.power)?;
    let (forces, constraints) = powers.split_at(form.forces.len().min(powers.len()));
    let mut pass = form.names.known(place)?;
    for (value, force) in forces.iter().zip(form.forces) {
        let along = match &force.along {
            Ok(row) => inner(&pass.evaluate(row)?, place.instant.velocity()),
            Err(velocity) => pass.symbol(*velocity),
        };
        if *value != pass.evaluate(&[force.value])?[0] * along {
            return Ok(false);
        }
    }
    if forces.len() != form.forces.len() {
        return Ok(false);
    }
    // dE/dt along the motion
    let flow = place.flow()?;
    let Some(change) = place.slopes(form.energy, &flow)?.first().copied() else { return Ok(false) };
    let system = place.system();
    let by_time = place.gradient(system.lagrangian, &[system.clock.time], &Direction::default())?[0].value;
    let mut total = by_time + change;
    for power in forces.iter().chain(constraints) {
        total = total - *power;
    }
    if total != Residue::ZERO {
        return Ok(false);
    }
    // each multiplier with its row
    let Some(multipliers) = form.multipliers else { return Ok(true) };
    let multipliers = place.run(multipliers)?;
    let rows = match form.rows {
        Some(rows) => place.matrix(rows)?,
        None => place.jacobian()?,
    };
    let worked = rows
        .iter()
        .zip(&multipliers)
        .map(|(row, multiplier)| *multiplier * inner(row, place.instant.velocity()));
    Ok(multipliers.len() <= constraints.len()
        && worked.eq(constraints.iter().copied().take(multipliers.len())))
}

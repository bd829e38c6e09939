//! S = D ∩ V, the lifts to D, and their brackets: mathematics (25), CM section 4.2.

use super::super::proof::Defect;
use super::super::reference::inner;
use super::place::{Place, is_regular_on, rank, spans};
use super::procedure_derivative::solved;
use super::{GyroscopicForm, SplittingForm};
use crate::algebra::{Direction, Dual, Echelon, Residue, TangentPass};
use crate::id::{CoordId, Id};
use crate::mechanics::Procedure;

/// Rows of so many entries each.
fn rows(place: &Place, procedure: Option<&Procedure>, width: usize) -> Result<Vec<Vec<Residue>>, Defect> {
    let Some(procedure) = procedure else { return Ok(Vec::new()) };
    Ok(place.run(procedure)?.chunks(width.max(1)).map(<[Residue]>::to_vec).collect())
}

/// Whether S has its rank here, D has lifts of the unit rates that are named, and the metric is regular on D and on S.
pub(super) fn is_regular(place: &Place, form: &SplittingForm) -> Result<bool, Defect> {
    let s = place.system().algebroid.rank().max(1);
    let distribution = place.distribution()?;
    let anchor = place.matrix(&place.system().algebroid.anchor.entries)?;
    let rates_on_distribution = |coordinates: &[CoordId]| -> Vec<Vec<Residue>> {
        let of_coordinate = |id: &CoordId| {
            distribution.iter().map(|section| inner(&anchor[id.index()], section)).collect::<Vec<Residue>>()
        };
        coordinates.iter().map(of_coordinate).collect()
    };
    // σ = Σ c_a B_a with ẋ = 0 over the coordinates
    let over = rates_on_distribution(form.over);
    let kernel: Vec<Vec<Residue>> = Echelon::of(over).kernel(distribution.len()).collect();
    let section = |components: &Vec<Residue>| -> Vec<Residue> {
        let entry = |alpha: usize| distribution.iter().map(|section| section[alpha]).collect::<Vec<_>>();
        (0..s).map(|alpha| inner(components, &entry(alpha))).collect()
    };
    let shared: Vec<Vec<Residue>> = kernel.iter().map(section).collect();
    // fewer coordinates than are left may have dependent rates at places where all together have not
    let lifted = rates_on_distribution(form.coordinates);
    let are_lifted = form.lifts.is_none() || form.is_embedded || rank(&lifted) == lifted.len();
    let mass = place.mass()?;
    Ok(shared.len() == form.vertical.map_or(0, |vertical| vertical.outputs.len() / s)
        && are_lifted
        && is_regular_on(&mass, &distribution)
        && is_regular_on(&mass, &shared))
}

/// Every function of the splitting.
pub(super) fn holds(place: &Place, form: &SplittingForm) -> Result<bool, Defect> {
    let s = place.system().algebroid.rank();
    let (vertical, lifts) = (rows(place, form.vertical, s)?, rows(place, form.lifts, s)?);
    // 1. S = D ∩ V, by its rank
    let distribution = place.distribution()?;
    let anchor = place.matrix(&place.system().algebroid.anchor.entries)?;
    let over: Vec<Vec<Residue>> = form.over.iter().map(|id| anchor[id.index()].clone()).collect();
    let images = |sections: &[Vec<Residue>]| -> Vec<Vec<Residue>> {
        sections.iter().map(|section| over.iter().map(|row| inner(row, section)).collect()).collect()
    };
    let shared = distribution.len() - rank(&images(&distribution));
    let is_vertical = images(&vertical).iter().flatten().all(|rate| *rate == Residue::ZERO);
    if vertical.len() != shared || rank(&vertical) != shared || !is_vertical {
        return Ok(false);
    }
    // 2. with the lifts it spans D
    let both = [vertical.as_slice(), &lifts].concat();
    if !spans(&distribution, &both) || rank(&both) != distribution.len() {
        return Ok(false);
    }
    // 3. the declared group has these directions
    if !form.group.is_empty() && !spans(&place.matrix(form.group)?, &vertical) {
        return Ok(false);
    }
    // 4. ẋ^λ = δ^λ_κ, unless the coordinates are embedded
    for (kappa, lift) in lifts.iter().enumerate().filter(|_| !form.is_embedded) {
        for (lambda, id) in form.coordinates.iter().enumerate() {
            let unit = if kappa == lambda { Residue::ONE } else { Residue::ZERO };
            if inner(&anchor[id.index()], lift) != unit {
                return Ok(false);
            }
        }
    }
    let sections = (vertical.as_slice(), lifts.as_slice());
    Ok(is_orthogonal(place, form, sections)? && velocities_and_forces(place, form, sections)?)
}

/// The lifts are orthogonal to S where there is a metric, and the locked inertia is that of S.
fn is_orthogonal(
    place: &Place,
    form: &SplittingForm,
    (vertical, lifts): (&[Vec<Residue>], &[Vec<Residue>]),
) -> Result<bool, Defect> {
    let Some(inertia) = form.inertia else { return Ok(true) };
    let mass = place.mass()?;
    let momentum = |section: &[Residue]| mass.iter().map(|row| inner(row, section)).collect::<Vec<Residue>>();
    let mut wanted = Vec::new();
    for section in vertical {
        let momentum = momentum(section);
        if lifts.iter().any(|lift| inner(&momentum, lift) != Residue::ZERO) {
            return Ok(false);
        }
        wanted.extend(vertical.iter().map(|other| inner(&momentum, other)));
    }
    Ok(place.run(inertia)? == wanted)
}

/// [h_κ, h_λ], [h_κ, S_ρ]; P_ρ; y = h_κ ẋ^κ + S_ρ v^ρ; −p([h_κ, h_λ]) ẋ^λ − p([h_κ, S_ρ]) v^ρ.
fn velocities_and_forces(
    place: &Place,
    form: &SplittingForm,
    (vertical, lifts): (&[Vec<Residue>], &[Vec<Residue>]),
) -> Result<bool, Defect> {
    let s = place.system().algebroid.rank();
    // 1. brackets of sections with the derivatives of their components
    let sections = [lifts, vertical].concat();
    let procedures = [form.lifts, form.vertical];
    let along = |section: &[Residue]| -> Result<Vec<Vec<Residue>>, Defect> {
        let direction = place.anchored(section)?;
        let mut found = Vec::new();
        for procedure in procedures.into_iter().flatten() {
            found.extend(place.slopes(procedure, &direction)?.chunks(s.max(1)).map(<[Residue]>::to_vec));
        }
        Ok(found)
    };
    let slopes = sections.iter().map(|section| along(section)).collect::<Result<Vec<_>, Defect>>()?;
    let bracket = |a: usize, b: usize| -> Result<Vec<Residue>, Defect> {
        let mut found = place.contraction(&sections[a], &sections[b])?;
        for (slot, (forth, back)) in found.iter_mut().zip(slopes[a][b].iter().zip(&slopes[b][a])) {
            *slot = *slot + *forth - *back;
        }
        Ok(found)
    };
    let (mut curvature, mut coefficients) = (Vec::new(), Vec::new());
    for kappa in 0..lifts.len() {
        for other in 0..sections.len() {
            let list = if other < lifts.len() { &mut curvature } else { &mut coefficients };
            list.push(bracket(kappa, other)?);
        }
    }
    let is_stored = |procedure: Option<&Procedure>, wanted: &[Residue]| -> Result<bool, Defect> {
        procedure.map_or(Ok(wanted.is_empty()), |procedure| Ok(place.run(procedure)? == wanted))
    };
    if !is_stored(form.curvature, &curvature.concat())?
        || !is_stored(form.coefficients, &coefficients.concat())?
    {
        return Ok(false);
    }
    // 2. momenta and velocities
    let momenta: Vec<Residue> = place.momenta(Direction::default())?.iter().map(|dual| dual.value).collect();
    let along_vertical: Vec<Residue> = vertical.iter().map(|section| inner(section, &momenta)).collect();
    let shares = rows(place, form.velocities, 1)?.concat();
    if !is_stored(form.momenta, &along_vertical)? || shares.len() != vertical.len() {
        return Ok(false);
    }
    let rates: Vec<Residue> = form.coordinates.iter().map(|id| place.instant.rates[id.index()]).collect();
    let speeds = [rates, shares].concat();
    let mut velocity = vec![Residue::ZERO; s];
    for (section, speed) in sections.iter().zip(&speeds) {
        for (slot, component) in velocity.iter_mut().zip(section) {
            *slot = *slot + *component * *speed;
        }
    }
    if velocity != place.instant.velocity() {
        return Ok(false);
    }
    // 3. the force
    let mut force = Vec::new();
    for kappa in 0..lifts.len() {
        let mut sum = Residue::ZERO;
        for (other, speed) in speeds.iter().enumerate() {
            sum = sum - inner(&bracket(kappa, other)?, &momenta) * *speed;
        }
        force.push(sum);
    }
    is_stored(form.force, &force)
}

/// The force of the curvature.
pub(super) fn is_gyroscopic(place: &Place, form: &GyroscopicForm) -> Result<bool, Defect> {
    Ok(place.run(form.force)? == gyroscopic(place, form)?)
}

/// ⟨J, K⟩_i = −p([h_i, h_j]) ẋ^j of a Chaplygin system, with lifts that D and ρ(h_i) = ∂_i determine.
pub(super) fn gyroscopic(place: &Place, form: &GyroscopicForm) -> Result<Vec<Residue>, Defect> {
    let algebroid = &place.system().algebroid;
    let (s, m) = (algebroid.rank(), form.over.len());
    let basis = place.reference.sections();
    // 1. h_i with its derivatives along a direction
    let lifts = |along: &Direction| -> Result<Vec<Vec<Dual>>, Defect> {
        let mut pass = place.pass();
        let mut tangent = TangentPass::new(&mut pass, along.clone());
        let over: Vec<Vec<Dual>> = form
            .over
            .iter()
            .map(|id| tangent.duals(&algebroid.anchor.entries[id.index()]))
            .collect::<Result<_, _>>()?;
        if let Some(sections) = basis {
            let sections: Vec<Vec<Dual>> =
                sections.iter().map(|(_, section)| tangent.duals(section)).collect::<Result<_, _>>()?;
            let matrix: Vec<Vec<Dual>> =
                over.iter().map(|row| sections.iter().map(|section| sum(row, section)).collect()).collect();
            return (0..m)
                .map(|i| {
                    let components = solved(&matrix, &unit(m, i))?;
                    let column =
                        |alpha: usize| sections.iter().map(|section| section[alpha]).collect::<Vec<_>>();
                    Ok((0..s).map(|alpha| sum(&components, &column(alpha))).collect())
                })
                .collect();
        }
        let mut matrix = over;
        for residual in place.reference.residuals() {
            matrix.push(place.gradient(*residual, &algebroid.velocities, along)?);
        }
        (0..m).map(|i| solved(&matrix, &unit(matrix.len(), i))).collect()
    };
    if place.distribution()?.len() != m {
        return Err(Defect::Unknown("the coordinates are embedded: unit rates have no lifts".into()));
    }
    let still = lifts(&Direction::default())?;
    let values: Vec<Vec<Residue>> =
        still.iter().map(|lift| lift.iter().map(|dual| dual.value).collect()).collect();
    let moved = values
        .iter()
        .map(|value| lifts(&place.anchored(value)?))
        .collect::<Result<Vec<Vec<Vec<Dual>>>, Defect>>()?;
    // 2. the force
    let momenta: Vec<Residue> = place.momenta(Direction::default())?.iter().map(|dual| dual.value).collect();
    let mut force = Vec::new();
    for i in 0..m {
        let mut total = Residue::ZERO;
        for (j, id) in form.over.iter().enumerate() {
            let mut bracket = place.contraction(&values[i], &values[j])?;
            for (slot, (forth, back)) in bracket.iter_mut().zip(moved[i][j].iter().zip(&moved[j][i])) {
                *slot = *slot + forth.rate - back.rate;
            }
            total = total - inner(&bracket, &momenta) * place.instant.rates[id.index()];
        }
        force.push(total);
    }
    Ok(force)
}

fn sum(a: &[Dual], b: &[Dual]) -> Dual {
    a.iter().zip(b).fold(Dual::ZERO, |sum, (a, b)| sum + *a * *b)
}

fn unit(size: usize, index: usize) -> Vec<Dual> {
    (0..size).map(|k| if k == index { Dual::constant(Residue::ONE) } else { Dual::ZERO }).collect()
}

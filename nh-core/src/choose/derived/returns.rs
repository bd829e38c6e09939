//! Ways back to constraints, and discrete equations: one linear system each.

use super::super::proof::{Defect, run};
use super::super::reference::inner;
use super::choose_all;
use super::place::{Place, rank, spans};
use super::procedure_derivative::solution;
use crate::algebra::{Direction, Residue};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::phase_space::{StepForm, VariationalForm};
use crate::system::{Embedding, PositionReturn, Projection};

/// A matrix by its rows.
type Rows = Vec<Vec<Residue>>;

fn difference(a: &[Residue], b: &[Residue]) -> Vec<Residue> {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}

fn image(matrix: &[Vec<Residue>], vector: &[Residue]) -> Vec<Residue> {
    matrix.iter().map(|row| inner(row, vector)).collect()
}

/// W (y⁺ − y₀) in the span of the rows of J, J (y⁺ − y) = −φ: the constraints hold after it where they are linear, a
/// point where they hold stays, and what is changed is orthogonal to D in the kinetic metric.
pub(super) fn is_projection(
    place: &Place,
    projection: &Projection,
    residuals: &[ExprId],
) -> Result<bool, Defect> {
    let velocities = &place.system().algebroid.velocities;
    let start: Vec<Residue> =
        (0..velocities.len()).map(|k| place.pass().kernel("start", &[Residue::of_word(k as u64)])).collect();
    let mut pass = place.pass();
    choose_all(&mut pass, &projection.start, &start)?;
    let after = run(&mut pass, &projection.step)?;
    let changes = [difference(&after, &start), difference(&after, place.instant.velocity())];
    leads_back(place, residuals, &changes)
}

/// The same for y⁺ − y from y₀ = y, where there is such a change.
pub(super) fn is_change(
    place: &Place,
    change: Option<&Procedure>,
    residuals: &[ExprId],
) -> Result<bool, Defect> {
    let Some(change) = change else { return Ok(true) };
    let change = place.run(change)?;
    leads_back(place, residuals, &[change.clone(), change])
}

/// W (y⁺ − y₀) in the span of the rows of J, J (y⁺ − y) = −φ.
fn leads_back(
    place: &Place,
    residuals: &[ExprId],
    [from_start, from_here]: &[Vec<Residue>; 2],
) -> Result<bool, Defect> {
    let rows = slopes(place, residuals, &place.system().algebroid.velocities)?;
    let pushed = image(&place.mass()?, from_start);
    let moved = image(&rows, from_here);
    let left =
        moved.iter().zip(place.values(residuals)?).all(|(moved, value)| *moved + value == Residue::ZERO);
    Ok(left && spans(&rows, &[pushed]))
}

pub(super) fn slopes(
    place: &Place,
    functions: &[ExprId],
    symbols: &[SymbolId],
) -> Result<Vec<Vec<Residue>>, Defect> {
    let row = |function: &ExprId| {
        let row = place.gradient(*function, symbols, &Direction::default())?;
        Ok(row.into_iter().map(|dual| dual.value).collect())
    };
    functions.iter().map(row).collect()
}

/// x⁺ − x = ρ(δ), W δ in the span of the rows of A, A δ = −f; with the other constraints where that does not
/// determine δ.
pub(super) fn is_return(
    place: &Place,
    positions: &PositionReturn,
    constraints: usize,
) -> Result<bool, Defect> {
    let count = positions.count - positions.redundant.len();
    let functions = &positions.residual.outputs[..count];
    let (anchor, mut rows) = pulled_back(place, functions)?;
    let s = place.system().algebroid.rank();
    let mut wanted: Vec<Residue> = place.values(functions)?.into_iter().map(|value| -value).collect();
    let mass = place.mass()?;
    let stored = place.run(&positions.step)?;
    let moved = |rows: &[Vec<Residue>], wanted: &[Residue]| -> Result<bool, Defect> {
        let none = vec![Residue::ZERO; rows.len()];
        let mut matrix: Vec<Vec<Residue>> = Vec::new();
        for (alpha, row) in mass.iter().enumerate() {
            matrix.push(row.iter().copied().chain(rows.iter().map(|row| row[alpha])).collect());
        }
        matrix.extend(rows.iter().map(|row| [row.as_slice(), &none].concat()));
        let right = vec![Residue::ZERO; s].into_iter().chain(wanted.iter().copied());
        let mut change = solution(&matrix, right)?;
        change.truncate(s);
        Ok(image(&anchor, &change) == stored)
    };
    match moved(&rows, &wanted) {
        Ok(true) => return Ok(true),
        Ok(false) | Err(Defect::Here) => {}
        Err(defect) => return Err(defect),
    }
    rows.extend(place.jacobian()?.into_iter().take(constraints).skip(count));
    wanted.resize(rows.len(), Residue::ZERO);
    moved(&rows, &wanted)
}

/// ρ, and A = ρ ∂f.
pub(super) fn pulled_back(place: &Place, functions: &[ExprId]) -> Result<(Rows, Rows), Defect> {
    let anchor = place.matrix(&place.system().algebroid.anchor.entries)?;
    let inclines = slopes(place, functions, place.coordinates())?;
    let entry = |incline: &[Residue], alpha: usize| {
        anchor.iter().zip(incline).fold(Residue::ZERO, |sum, (row, slope)| sum + row[alpha] * *slope)
    };
    let s = place.system().algebroid.rank();
    let rows = inclines.iter().map(|incline| (0..s).map(|alpha| entry(incline, alpha)).collect()).collect();
    Ok((anchor, rows))
}

/// The gradients of the identities that do not follow from others.
pub(super) fn independent_slopes(place: &Place, identities: &[ExprId]) -> Result<Rows, Defect> {
    let mut kept = Vec::new();
    for row in slopes(place, identities, place.coordinates())? {
        if rank(&[kept.as_slice(), std::slice::from_ref(&row)].concat()) > kept.len() {
            kept.push(row);
        }
    }
    Ok(kept)
}

/// The products of rows with each other.
pub(super) fn products(rows: &[Vec<Residue>]) -> Rows {
    rows.iter().map(|a| rows.iter().map(|b| inner(a, b)).collect()).collect()
}

/// x⁺ − x in the span of the gradients of the identities, ∂f (x⁺ − x) = −f.
pub(super) fn is_normalised(
    place: &Place,
    embedding: &Embedding,
    identities: &[ExprId],
) -> Result<bool, Defect> {
    let coordinates = place.coordinates();
    let here: Vec<Residue> = coordinates.iter().map(|x| place.pass().symbol(*x)).collect();
    let moved = difference(&place.run(&embedding.step)?, &here);
    let rows = slopes(place, identities, coordinates)?;
    let values = place.values(identities)?;
    // identities that follow from others take no part
    let (mut kept, mut wanted) = (Vec::new(), Vec::new());
    for (row, value) in rows.into_iter().zip(values) {
        if rank(&[kept.as_slice(), std::slice::from_ref(&row)].concat()) > kept.len() {
            kept.push(row);
            wanted.push(-value);
        }
    }
    Ok(image(&kept, &moved) == wanted && spans(&kept, &[moved]))
}

/// W (v⁺ − v⁻) − h ∂L in the span of the rows of J, J (v⁺ + v⁻) = 0: mathematics (26).
pub(super) fn is_leapfrog(place: &Place, form: &StepForm) -> Result<bool, Defect> {
    let before = place.instant.velocity();
    let after = place.run(&form.map)?;
    let length = place.pass().symbol(form.length);
    let slopes = place.gradient(place.system().lagrangian, place.coordinates(), &Direction::default())?;
    let pushed = image(&place.mass()?, &difference(&after, before));
    let left: Vec<Residue> =
        pushed.iter().zip(&slopes).map(|(pushed, slope)| *pushed - length * slope.value).collect();
    let rows = place.jacobian()?;
    let mean: Vec<Residue> = after.iter().zip(before).map(|(a, b)| *a + *b).collect();
    Ok(image(&rows, &mean).iter().all(|entry| *entry == Residue::ZERO) && spans(&rows, &[left]))
}

/// ∂L/∂q and p; W a − r in the span of the rows of G = ∂g, G a = c: mathematics (62).
pub(super) fn is_variational(place: &Place, form: &VariationalForm) -> Result<bool, Defect> {
    let gradient = place.gradient(place.system().lagrangian, place.coordinates(), &Direction::default())?;
    let momenta = place.momenta(Direction::default())?;
    let wanted: Vec<Residue> = gradient.iter().chain(&momenta).map(|dual| dual.value).collect();
    let change = place.run(&form.change)?;
    let (force, rates): (Vec<Residue>, Vec<Residue>) = {
        let given: Vec<Residue> = form.given.iter().map(|symbol| place.pass().symbol(*symbol)).collect();
        let (force, rates) = given.split_at(change.len());
        (force.to_vec(), rates.to_vec())
    };
    let rows = slopes(place, &form.residual.outputs, place.coordinates())?;
    let left = difference(&image(&place.mass()?, &change), &force);
    Ok(place.run(&form.slopes)? == wanted && image(&rows, &change) == rates && spans(&rows, &[left]))
}

/// ⟨p, B_a − h/2 [y, B_a] + h²/12 [y, [y, B_a]]⟩: mathematics (27).
pub(super) fn is_discrete_momentum(place: &Place, form: &StepForm) -> Result<bool, Defect> {
    let momenta: Vec<Residue> = place.momenta(Direction::default())?.iter().map(|dual| dual.value).collect();
    let y = place.instant.velocity();
    let h = place.pass().symbol(form.length);
    let twelve = Residue::of_word(12).inverse().ok_or(Defect::Here)?;
    let mut wanted = Vec::new();
    for section in place.distribution()? {
        let once = place.contraction(y, &section)?;
        let twice = place.contraction(y, &once)?;
        let [p0, p1, p2] = [&section, &once, &twice].map(|section| inner(section, &momenta));
        // 12 p₀ − 6 h p₁ + h² p₂
        let six = Residue::of_word(6);
        wanted.push((Residue::of_word(12) * p0 - six * h * p1 + h * h * p2) * twelve);
    }
    Ok(place.run(&form.map)? == wanted)
}

//! The nonholonomic bracket by the symplectic section: {f, g} = df(X_g), where X_g in 𝒯ᴰD satisfies
//! Ω_L(X_g, Z) = dg(Z) for all Z in 𝒯ᴰD, and Ω_L = −dθ_L with θ_L(σ, τ) = p_α σ^α (CLMM 3.4, 7.2).
//!
//! Nothing of mathematics (15), (17) or (18) is used: neither momenta on D, nor brackets of sections of it.

use super::super::proof::Defect;
use super::super::reference::inner;
use super::place::{Arrow, Place, rank};
use super::procedure_derivative::solution;
use super::{AlmostPoissonForm, BracketForm, choose_all};
use crate::algebra::{Direction, Residue};
use crate::mechanics::{HamiltonianSide, Procedure};

/// Ω_L on a basis of 𝒯ᴰD.
pub(super) struct Symplectic {
    arrows: Vec<Arrow>,
    /// Ω_L(column, row): the matrix that takes components of X_g to dg.
    matrix: Vec<Vec<Residue>>,
}

impl Symplectic {
    pub(super) fn at(place: &Place) -> Result<Self, Defect> {
        let arrows = place.arrows()?;
        let momenta: Vec<Residue> =
            place.momenta(Direction::default())?.into_iter().map(|dual| dual.value).collect();
        let mut matrix = vec![vec![Residue::ZERO; arrows.len()]; arrows.len()];
        for (k, first) in arrows.iter().enumerate() {
            for (l, second) in arrows.iter().enumerate().skip(k + 1) {
                let turned = place.contraction(&first.section, &second.section)?;
                let form = inner(&second.momenta, &first.section) - inner(&first.momenta, &second.section)
                    + inner(&turned, &momenta);
                matrix[l][k] = form;
                matrix[k][l] = -form;
            }
        }
        Ok(Self { arrows, matrix })
    }

    /// Whether it determines the fields of all functions.
    pub(super) fn is_regular(&self) -> bool {
        rank(&self.matrix) == self.matrix.len()
    }

    /// X_g as a direction of the state, from dg along the basis.
    fn field(&self, slopes: &[Residue]) -> Result<Direction, Defect> {
        let components = solution(&self.matrix, slopes.iter().copied())?;
        let mut field = Direction::default();
        for (component, arrow) in components.into_iter().zip(&self.arrows) {
            for (symbol, rate) in &arrow.state {
                let slot = field.entry(*symbol).or_insert(Residue::ZERO);
                *slot = *slot + component * *rate;
            }
        }
        Ok(field)
    }

    /// The derivatives of functions along the basis, a row for each function.
    fn differentials(&self, place: &Place, functions: &Procedure) -> Result<Vec<Vec<Residue>>, Defect> {
        let mut rows = vec![Vec::new(); functions.outputs.len()];
        for arrow in &self.arrows {
            for (row, slope) in rows.iter_mut().zip(place.slopes(functions, &arrow.state)?) {
                row.push(slope);
            }
        }
        Ok(rows)
    }

    /// The fields of functions.
    pub(super) fn fields(&self, place: &Place, functions: &Procedure) -> Result<Vec<Direction>, Defect> {
        self.differentials(place, functions)?.iter().map(|slopes| self.field(slopes)).collect()
    }

    /// The field of a covector on the state.
    fn field_of(&self, covector: &Direction) -> Result<Direction, Defect> {
        let slopes: Vec<Residue> = self.arrows.iter().map(|arrow| pairing(covector, &arrow.state)).collect();
        self.field(&slopes)
    }
}

fn pairing(covector: &Direction, direction: &Direction) -> Residue {
    let terms = covector.iter().filter_map(|(symbol, slope)| Some(*slope * *direction.get(symbol)?));
    terms.fold(Residue::ZERO, |sum, term| sum + term)
}

/// {f_i, f_j}, {f_i, E_L}, and what is left of the rates of the f_i.
pub(super) fn of_outputs(place: &Place, form: &BracketForm) -> Result<bool, Defect> {
    let symplectic = Symplectic::at(place)?;
    let mut wanted = vec![Vec::new(); form.outputs.outputs.len()];
    for field in symplectic.fields(place, form.outputs)? {
        for (row, slope) in wanted.iter_mut().zip(place.slopes(form.outputs, &field)?) {
            row.push(slope);
        }
    }
    let Some(by_energy) = symplectic.fields(place, form.energy)?.into_iter().next() else {
        return Ok(false);
    };
    let with_energy = place.slopes(form.outputs, &by_energy)?;
    let rates = place.slopes(form.outputs, &place.flow()?)?;
    let drift: Vec<Residue> = rates.iter().zip(&with_energy).map(|(rate, moved)| *rate - *moved).collect();
    Ok(place.run(form.bracket)? == wanted.concat()
        && place.run(form.with_energy)? == with_energy
        && place.run(form.drift)? == drift)
}

/// Π on any covector, and ∂E; Π ∂E is the motion.
pub(super) fn sharp(place: &Place, form: &AlmostPoissonForm) -> Result<bool, Defect> {
    let AlmostPoissonForm { gradient, covector, sharp, energy } = form;
    let symplectic = Symplectic::at(place)?;
    let state = place.motion.state;
    // 1. Π
    let any: Vec<Residue> =
        (0..covector.len()).map(|k| place.pass().kernel("covector", &[Residue::of_word(k as u64)])).collect();
    let at = |values: &[Residue]| {
        let mut pass = place.pass();
        choose_all(&mut pass, covector, values)?;
        super::super::proof::run(&mut pass, sharp)
    };
    let field = symplectic.field_of(&state.iter().copied().zip(any.iter().copied()).collect())?;
    let wanted: Vec<Residue> =
        state.iter().map(|symbol| field.get(symbol).copied().unwrap_or(Residue::ZERO)).collect();
    // 2. ∂E
    let mut slopes = Vec::with_capacity(state.len());
    for symbol in state {
        slopes.extend(place.slopes(energy, &Direction::from_iter([(*symbol, Residue::ONE)]))?);
    }
    let stored = place.run(gradient)?;
    // 3. the motion
    Ok(at(&any)? == wanted && stored == slopes && at(&stored)? == place.run(place.motion.derivative)?)
}

/// The matrix of {·, ·} in (x, π), and what Hamilton's equations have beyond it.
pub(super) fn on_momenta(
    place: &Place,
    side: &HamiltonianSide,
    energy: &Procedure,
    at_momenta: impl Fn(&Procedure) -> Result<Vec<Residue>, Defect>,
) -> Result<bool, Defect> {
    let symplectic = Symplectic::at(place)?;
    let coordinates = place.coordinates();
    // (x, π) along a direction of the state
    let along = |direction: &Direction| -> Result<Vec<Residue>, Defect> {
        let mut rates: Vec<Residue> =
            coordinates.iter().map(|x| direction.get(x).copied().unwrap_or(Residue::ZERO)).collect();
        rates.extend(place.slopes(&side.legendre, direction)?);
        Ok(rates)
    };
    let mut columns = Vec::new();
    for x in coordinates {
        let field = symplectic.field_of(&Direction::from_iter([(*x, Residue::ONE)]))?;
        columns.push(along(&field)?);
    }
    for field in symplectic.fields(place, &side.legendre)? {
        columns.push(along(&field)?);
    }
    let n = columns.len();
    let wanted: Vec<Residue> = (0..n * n).map(|entry| columns[entry % n][entry / n]).collect();
    let Some(by_energy) = symplectic.fields(place, energy)?.into_iter().next() else { return Ok(false) };
    let (moved, rates) = (along(&by_energy)?, along(&place.flow()?)?);
    let drift: Vec<Residue> = rates.iter().zip(&moved).map(|(rate, moved)| *rate - *moved).collect();
    Ok(at_momenta(&side.bracket)? == wanted && at_momenta(&side.drift)? == drift)
}

//! Connections by what determines them: a metric, and the torsion.

use super::super::proof::Defect;
use super::super::reference::inner;
use super::place::{Place, is_regular_on, rank};
use super::procedure_derivative::solved;
use crate::algebra::{Dual, FieldPass, Residue, TangentPass};
use crate::mechanics::Procedure;

/// The kinetic metric with its derivatives along the sections of a basis.
struct Metric {
    /// G_{βγ}.
    entries: Vec<Vec<Residue>>,
    /// ρ_α(G_{βγ}), the first index that of the section.
    slopes: Vec<Vec<Vec<Residue>>>,
}

impl Metric {
    /// ∂L/∂y^γ at unit velocities less what it is at rest, where L is quadratic in them.
    fn at(place: &Place) -> Result<Self, Defect> {
        let system = place.system();
        let velocities = &system.algebroid.velocities;
        let s = velocities.len();
        let at_velocity = |unit: Option<usize>, alpha: usize| -> Result<Vec<Dual>, Defect> {
            let mut point = place.point.clone();
            for (beta, velocity) in velocities.iter().enumerate() {
                let value = if unit == Some(beta) { Residue::ONE } else { Residue::ZERO };
                point.chosen.insert(*velocity, value);
            }
            let along = place.anchored(&unit_vector(s, alpha))?;
            let mut pass = FieldPass::new(place.pass().graph(), point, place.division);
            Ok(TangentPass::new(&mut pass, along).gradient(system.lagrangian, velocities)?)
        };
        let (mut entries, mut slopes) = (Vec::new(), Vec::new());
        for alpha in 0..s {
            let at_rest = at_velocity(None, alpha)?;
            let (mut values, mut rates) = (Vec::new(), Vec::new());
            for beta in 0..s {
                let row: Vec<Dual> =
                    at_velocity(Some(beta), alpha)?.into_iter().zip(&at_rest).map(|(p, q)| p - *q).collect();
                values.push(row.iter().map(|dual| dual.value).collect::<Vec<Residue>>());
                rates.push(row.iter().map(|dual| dual.rate).collect());
            }
            entries = values;
            slopes.push(rates);
        }
        Ok(Self { entries, slopes })
    }

    fn product(&self, sigma: &[Residue], tau: &[Residue]) -> Residue {
        sigma.iter().zip(&self.entries).fold(Residue::ZERO, |sum, (s, row)| sum + *s * inner(row, tau))
    }

    /// ρ(σ)(G)(τ, υ).
    fn slope(&self, sigma: &[Residue], tau: &[Residue], upsilon: &[Residue]) -> Residue {
        let of = |rows: &Vec<Vec<Residue>>| {
            tau.iter().zip(rows).fold(Residue::ZERO, |sum, (t, row)| sum + *t * inner(row, upsilon))
        };
        sigma.iter().zip(&self.slopes).fold(Residue::ZERO, |sum, (s, rows)| sum + *s * of(rows))
    }
}

pub(super) fn unit_vector(size: usize, index: usize) -> Vec<Residue> {
    (0..size).map(|k| if k == index { Residue::ONE } else { Residue::ZERO }).collect()
}

/// Symbols in a basis of sections: they keep the metric, and ∇_a b − ∇_b a is the bracket, in the metric.
fn is_metric_without_torsion(
    place: &Place,
    metric: &Metric,
    (sections, rates): (&[Vec<Residue>], &[Vec<Vec<Residue>>]),
    symbols: &[Residue],
) -> Result<bool, Defect> {
    let n = sections.len();
    if symbols.len() != n * n * n {
        return Ok(false);
    }
    let gram: Vec<Vec<Residue>> =
        sections.iter().map(|a| sections.iter().map(|b| metric.product(a, b)).collect()).collect();
    let lowered = |a: usize, b: usize, c: usize| {
        let components = &symbols[(a * n + b) * n..][..n];
        inner(components, &gram[c])
    };
    for a in 0..n {
        for b in 0..n {
            // [a, b] = C(a, b) + ρ(a) b − ρ(b) a
            let mut bracket = place.contraction(&sections[a], &sections[b])?;
            for (slot, (forth, back)) in bracket.iter_mut().zip(rates[a][b].iter().zip(&rates[b][a])) {
                *slot = *slot + *forth - *back;
            }
            for c in 0..n {
                let moved = metric.slope(&sections[a], &sections[b], &sections[c])
                    + metric.product(&rates[a][b], &sections[c])
                    + metric.product(&sections[b], &rates[a][c]);
                let keeps = moved == lowered(a, b, c) + lowered(a, c, b);
                let torsion = lowered(a, b, c) - lowered(b, a, c) - metric.product(&bracket, &sections[c]);
                if !keeps || torsion != Residue::ZERO {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

/// Whether the metric is regular on E, and on D where that is asked for.
pub(super) fn is_regular(place: &Place, on_distribution: bool) -> Result<bool, Defect> {
    let metric = Metric::at(place)?.entries;
    let is_regular = rank(&metric) == metric.len();
    Ok(is_regular && (!on_distribution || is_regular_on(&metric, &place.distribution()?)))
}

/// ∇ on E.
pub(super) fn is_christoffel(place: &Place, symbols: &Procedure) -> Result<bool, Defect> {
    let s = place.system().algebroid.rank();
    let units: Vec<Vec<Residue>> = (0..s).map(|a| unit_vector(s, a)).collect();
    let rest = vec![vec![vec![Residue::ZERO; s]; s]; s];
    is_metric_without_torsion(place, &Metric::at(place)?, (&units, &rest), &place.run(symbols)?)
}

/// ∇̌ on D, in its basis, with the torsion that is projected to D; or P∇ + ∇Q on all of E.
pub(super) fn is_constrained(
    place: &Place,
    connection: &Procedure,
    christoffel: &Procedure,
) -> Result<bool, Defect> {
    let symbols = place.run(connection)?;
    let metric = Metric::at(place)?;
    if let Some(sections) = place.reference.sections() {
        let values = place.distribution()?;
        let mut rates = Vec::new();
        for value in &values {
            let along = place.anchored(value)?;
            let mut row = Vec::new();
            for (_, section) in sections {
                let duals = TangentPass::new(&mut place.pass(), along.clone()).duals(section)?;
                row.push(duals.into_iter().map(|dual| dual.rate).collect());
            }
            rates.push(row);
        }
        return is_metric_without_torsion(place, &metric, (&values, &rates), &symbols);
    }
    let s = metric.entries.len();
    let levi_civita = place.run(christoffel)?;
    if symbols.len() != s * s * s || levi_civita.len() != s * s * s {
        return Ok(false);
    }
    for a in 0..s {
        let normal = normal_projection(place, &metric, a)?;
        for b in 0..s {
            let derivative = &levi_civita[(a * s + b) * s..][..s];
            for c in 0..s {
                let row: Vec<Residue> = normal.iter().map(|column| column[c].value).collect();
                // ∇_a (Q b) = ρ_a(Q b) + (Q b)^d ∇_a d
                let carried = (0..s).fold(normal[b][c].rate, |sum, d| {
                    sum + normal[b][d].value * levi_civita[(a * s + d) * s + c]
                });
                if symbols[(a * s + b) * s + c] != derivative[c] - inner(&row, derivative) + carried {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

/// The columns of Q with their derivatives along a section of the basis: G q = Jᵀμ, J q = J e.
fn normal_projection(place: &Place, metric: &Metric, alpha: usize) -> Result<Vec<Vec<Dual>>, Defect> {
    let s = metric.entries.len();
    let velocities = &place.system().algebroid.velocities;
    let along = place.anchored(&unit_vector(s, alpha))?;
    let mut rows = Vec::new();
    for residual in place.reference.residuals() {
        rows.push(place.gradient(*residual, velocities, &along)?);
    }
    let mut matrix: Vec<Vec<Dual>> = Vec::new();
    for (beta, (values, slopes)) in metric.entries.iter().zip(&metric.slopes[alpha]).enumerate() {
        let own = values.iter().zip(slopes).map(|(value, rate)| Dual { value: *value, rate: *rate });
        matrix.push(own.chain(rows.iter().map(|row| Dual::ZERO - row[beta])).collect());
    }
    for row in &rows {
        matrix.push(row.iter().copied().chain(rows.iter().map(|_| Dual::ZERO)).collect());
    }
    let column = |beta: usize| {
        let right: Vec<Dual> = (0..s).map(|_| Dual::ZERO).chain(rows.iter().map(|row| row[beta])).collect();
        let mut solution = solved(&matrix, &right)?;
        solution.truncate(s);
        Ok(solution)
    };
    (0..s).map(column).collect()
}

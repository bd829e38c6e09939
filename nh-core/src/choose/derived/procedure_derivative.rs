//! Procedures differentiated in numbers: the derivatives of their outputs along a direction.

use super::super::proof::Defect;
use super::super::reference::inner;
use crate::algebra::{Direction, Dual, Echelon, FieldPass, Residue, TangentPass};
use crate::id::SymbolId;
use crate::mechanics::{Definition, Procedure};

/// The outputs of a procedure with their derivatives along a direction.
pub(super) fn tangent(
    pass: &mut FieldPass,
    procedure: &Procedure,
    along: Direction,
) -> Result<Vec<Dual>, Defect> {
    let mut tangent = TangentPass::new(pass, along);
    let twice = || Defect::Wrong("an intermediate result has two values".into());
    for definition in &procedure.definitions {
        let defined: Vec<(SymbolId, Dual)> = match definition {
            Definition::Value { symbol, value } => vec![(*symbol, tangent.duals(&[*value])?[0])],
            Definition::Call { symbol, method, arguments, derivatives } => {
                let duals = tangent.duals(arguments)?;
                let values: Vec<Residue> = duals.iter().map(|dual| dual.value).collect();
                let mut rate = Residue::ZERO;
                for (index, dual) in duals.iter().enumerate().filter(|(_, dual)| dual.rate != Residue::ZERO) {
                    let slope = derivatives.as_ref().and_then(|all| all.get(index));
                    let slope = slope.ok_or_else(|| {
                        Defect::Unknown(format!("the derivative of `{method}` is not known"))
                    })?;
                    rate = rate + tangent.kernel(slope, &values) * dual.rate;
                }
                vec![(*symbol, Dual { value: tangent.kernel(method, &values), rate })]
            }
            Definition::Solve { unknowns, matrix, right } => {
                let rows = matrix.iter().map(|row| tangent.duals(row)).collect::<Result<Vec<_>, _>>()?;
                let duals = solved(&rows, &tangent.duals(right)?)?;
                unknowns.iter().copied().zip(duals).collect()
            }
        };
        for (symbol, dual) in defined {
            if !tangent.choose(symbol, dual) {
                return Err(twice());
            }
        }
    }
    Ok(tangent.duals(&procedure.outputs)?)
}

/// The solution of M x = r with its rate, M ẋ = ṙ − Ṁ x.
///
/// # Errors
/// No value here, where M is singular.
pub(super) fn solved(rows: &[Vec<Dual>], right: &[Dual]) -> Result<Vec<Dual>, Defect> {
    let matrix: Vec<Vec<Residue>> =
        rows.iter().map(|row| row.iter().map(|dual| dual.value).collect()).collect();
    let values = solution(&matrix, right.iter().map(|dual| dual.value))?;
    let moved = rows.iter().zip(right).map(|(row, right)| {
        let rates: Vec<Residue> = row.iter().map(|dual| dual.rate).collect();
        right.rate - inner(&rates, &values)
    });
    let rates = solution(&matrix, moved)?;
    Ok(values.into_iter().zip(rates).map(|(value, rate)| Dual { value, rate }).collect())
}

/// The solution of a square system.
///
/// # Errors
/// No value here, where it is singular.
pub(super) fn solution(
    matrix: &[Vec<Residue>],
    right: impl IntoIterator<Item = Residue>,
) -> Result<Vec<Residue>, Defect> {
    let with = matrix.iter().zip(right).map(|(row, entry)| row.iter().copied().chain([entry]).collect());
    let echelon = Echelon::of(with.collect());
    if echelon.pivots.iter().copied().ne(0..matrix.len()) {
        return Err(Defect::Here);
    }
    Ok(echelon.rows.iter().map(|row| row[matrix.len()]).collect())
}

//! Numbers with which equations may add up to what has no slope where they hold, as those of surfaces that touch do.
//!
//! They are read off the slopes at one real point that is found in floating point, and prove nothing.

use super::eliminated::product;
use super::graph::Graph;
use super::inequalities::Demand;
use super::number::Rational;
use super::real_points::Search;
use crate::id::ExprId;
use crate::limits;

/// The places from which a point is looked for.
const PLACES: u64 = 4;
/// What is left of a slope that depends on others, beside its length: points where equations touch are known to half of the
/// digits.
const LEFT: f64 = 1e-4;
/// The largest denominator of a multiplier.
const DENOMINATOR: i64 = 1000;
/// How near to one it is.
const NEAR: f64 = 1e-6;
/// The work that is spent.
const WORK: u64 = 2_000_000;

impl Graph {
    /// Of equations that hold together at a real point at which their slopes are dependent: for each that depends on those
    /// before it a combination with numbers that has no slope there. None where they are met at a regular point.
    pub(crate) fn combinations_without_slope(
        &mut self,
        equations: &[ExprId],
        demands: &[(ExprId, Demand)],
    ) -> Vec<ExprId> {
        let holding = equations.iter().map(|equation| (*equation, Demand::Zero));
        let all: Vec<(ExprId, Demand)> = holding.chain(demands.iter().copied()).collect();
        if self.are_met_at_a_regular_point(&all) {
            return Vec::new();
        }
        let slopes = limits::attempt(WORK, || {
            let mut search = Search::of(self, &all);
            let point = (0..PLACES).find_map(|place| search.point_from(place))?;
            Some(search.slopes_at(&point))
        });
        let Some(Some(mut slopes)) = slopes else { return Vec::new() };
        slopes.truncate(equations.len());
        let mut found = Vec::new();
        for multipliers in dependencies(&slopes) {
            let numbers: Option<Vec<Rational>> = multipliers.into_iter().map(near_fraction).collect();
            let Some(numbers) = numbers else { continue };
            let terms: Vec<(Rational, ExprId)> = numbers.into_iter().zip(equations.iter().copied()).collect();
            found.push(self.linear_combination(&terms));
        }
        found
    }
}

/// For each row that depends on those before it, numbers with which they add up to nothing, and 1 for itself.
fn dependencies(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    // rows of length 1 at right angles, and of which of the rows they are made
    let mut basis: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    let mut found = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let (mut left, mut made_of) = (row.clone(), vec![0.0; rows.len()]);
        made_of[index] = 1.0;
        for (direction, its) in basis.iter().chain(&basis) {
            let part = product(&left, direction);
            left.iter_mut().zip(direction).for_each(|(x, d)| *x -= part * d);
            made_of.iter_mut().zip(its).for_each(|(x, d)| *x -= part * d);
        }
        let (length, whole) = (product(&left, &left).sqrt(), product(row, row).sqrt());
        if length <= LEFT * whole {
            found.push(made_of);
        } else {
            let scaled = |row: Vec<f64>| row.into_iter().map(|x| x / length).collect();
            basis.push((scaled(left), scaled(made_of)));
        }
    }
    found
}

/// The fraction with the least denominator that a number is near to.
fn near_fraction(number: f64) -> Option<Rational> {
    let near = |denominator: &i64| {
        #[expect(clippy::cast_precision_loss, reason = "a small integer")]
        let scaled = number * *denominator as f64;
        (scaled - scaled.round()).abs() <= NEAR * scaled.abs().max(1.0)
    };
    let denominator = (1..=DENOMINATOR).find(near)?;
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "integers of some digits"
    )]
    let numerator = (number * denominator as f64).round() as i64;
    (numerator.unsigned_abs() < 1 << 40).then(|| Rational::new(numerator, denominator))
}

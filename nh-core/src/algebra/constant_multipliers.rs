//! Numbers with which equations may add up to what has no slope where they hold, as those of surfaces that touch do.
//!
//! They are read off the slopes at one real point that is found in floating point, and prove nothing.

use super::eliminated::product;
use super::graph::Graph;
use super::inequalities::Demand;
use super::number::Rational;
use super::range::Facts;
use super::real_points::Search;
use super::substitute::Substitution;
use crate::id::{ExprId, SymbolId};
use crate::limits;

/// The places from which a point is looked for.
const PLACES: u64 = 4;
/// The places from which machines are looked for, and how many.
const MORE_PLACES: u64 = 6 * PLACES;
const MACHINES: usize = 3;
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
    /// before it a combination with numbers that has no slope there. `None` where they are met at a regular point.
    pub(crate) fn combinations_without_slope(
        &mut self,
        equations: &[ExprId],
        demands: &[(ExprId, Demand)],
    ) -> Option<Vec<ExprId>> {
        let all = together(equations, demands);
        if self.are_met_at_a_regular_point(&all) {
            return None;
        }
        let slopes = limits::attempt(WORK, || {
            let mut search = Search::of(self, &all);
            let point = (0..PLACES).find_map(|place| search.point_from(place))?;
            Some(search.slopes_at(&point))
        });
        let Some(Some(mut slopes)) = slopes else { return Some(Vec::new()) };
        slopes.truncate(equations.len());
        let mut found = Vec::new();
        for multipliers in dependencies(&slopes) {
            let numbers: Option<Vec<Rational>> = multipliers.into_iter().map(near_fraction).collect();
            let Some(numbers) = numbers else { continue };
            let terms: Vec<(Rational, ExprId)> = numbers.into_iter().zip(equations.iter().copied()).collect();
            found.push(self.linear_combination(&terms));
        }
        Some(found)
    }

    /// Numbers of two digits for what does not move, near to real points at which equations hold together: multipliers that
    /// depend on parameters are numbers there. Such as are not as is demanded of them are left out.
    pub(crate) fn numbers_near_points(
        &mut self,
        equations: &[ExprId],
        demands: &[(ExprId, Demand)],
        moving: &[SymbolId],
    ) -> Vec<Vec<(SymbolId, ExprId)>> {
        let mut fixed = self.symbols_in(equations);
        fixed.retain(|symbol| !moving.contains(symbol));
        if fixed.is_empty() {
            return Vec::new();
        }
        let all = together(equations, demands);
        let found = limits::attempt(WORK, || {
            let mut search = Search::of(self, &all);
            let points = (0..MORE_PLACES).filter_map(|place| search.point_from(place)).take(MACHINES);
            let points: Vec<Vec<f64>> = points.collect();
            (search.symbols, points)
        });
        let Some((symbols, points)) = found else { return Vec::new() };
        let mut machines = Vec::new();
        for point in points {
            let number = |symbol: &SymbolId| {
                let index = symbols.iter().position(|known| known == symbol)?;
                Some((*symbol, two_digits(point[index])?))
            };
            let numbers: Option<Vec<(SymbolId, Rational)>> = fixed.iter().map(number).collect();
            let Some(numbers) = numbers else { continue };
            let numbers: Vec<(SymbolId, ExprId)> =
                numbers.into_iter().map(|(symbol, number)| (symbol, self.number(number))).collect();
            if self.are_as_demanded(&numbers, demands) {
                machines.push(numbers);
            }
        }
        machines
    }

    /// Whether what is demanded of fixed symbols alone is so for these numbers.
    fn are_as_demanded(&mut self, numbers: &[(SymbolId, ExprId)], demands: &[(ExprId, Demand)]) -> bool {
        let mut given = Substitution::new(numbers.iter().copied());
        demands.iter().all(|(value, demand)| {
            let value = given.apply(self, *value);
            let range = self.range(value, &Facts::default());
            !self.symbols_in(&[value]).is_empty()
                || match demand {
                    Demand::Positive => range.low > 0.0,
                    Demand::NotNegative => range.low >= 0.0,
                    Demand::Nonzero => range.low > 0.0 || range.high < 0.0,
                    Demand::Zero => false,
                }
        })
    }
}

/// What is demanded, and that equations hold.
fn together(equations: &[ExprId], demands: &[(ExprId, Demand)]) -> Vec<(ExprId, Demand)> {
    let holding = equations.iter().map(|equation| (*equation, Demand::Zero));
    holding.chain(demands.iter().copied()).collect()
}

/// A number rounded to two digits.
fn two_digits(number: f64) -> Option<Rational> {
    let tens = number.abs().log10().floor() - 1.0;
    if !(-9.0..9.0).contains(&tens) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, reason = "two digits, and a power of ten of one")]
    let (digits, tens) = ((number / 10_f64.powf(tens)).round() as i64, tens as i64);
    Some(Rational::from(digits) * Rational::from(10).pow(tens)?)
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

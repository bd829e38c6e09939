//! Linear inequalities over ℚ: whether non-negative multiples of them add up to a contradiction (Farkas'
//! lemma), by the simplex algorithm with Bland's rule, exactly.

use super::number::Rational;
use crate::limits;

/// `Σ coefficients[k] · x_k + constant ≥ 0`, or `> 0`.
#[derive(Clone, Debug)]
pub(super) struct Inequality {
    pub(super) coefficients: Vec<Rational>,
    pub(super) constant: Rational,
    pub(super) strict: bool,
}

/// Pivots after which nothing is said.
const PIVOTS: usize = 200;
/// Entries, most of them 0, that a step of work reads.
const ENTRIES_PER_STEP: usize = 8;

/// Multipliers y ≥ 0 for which Σ y (inequality) is `0 ≥ c` with c < 0 hidden in it, or `0 > 0`. `None`
/// where there are none, or none were found in time.
pub(super) fn contradiction(inequalities: &[Inequality]) -> Option<Vec<Rational>> {
    let used = those_that_balance(inequalities);
    let balanced: Vec<Inequality> = used.iter().map(|index| inequalities[*index].clone()).collect();
    let found = contradiction_of_all(&balanced)?;
    let mut multipliers = vec![Rational::ZERO; inequalities.len()];
    for (index, multiplier) in used.into_iter().zip(found) {
        multipliers[index] = multiplier;
    }
    Some(multipliers)
}

/// Those that can have multipliers. A variable of which all coefficients have one sign excludes those that have it, and
/// one that an equation alone has, the two inequalities that it stands for: their multiples would cancel each other.
fn those_that_balance(inequalities: &[Inequality]) -> Vec<usize> {
    let variables = inequalities.first().map_or(0, |first| first.coefficients.len());
    let mut used: Vec<usize> = (0..inequalities.len()).collect();
    loop {
        let before = used.len();
        for variable in 0..variables {
            limits::spend(used.len() / ENTRIES_PER_STEP);
            let coefficient = |index: &usize| &inequalities[*index].coefficients[variable];
            let with: Vec<usize> =
                used.iter().copied().filter(|index| !coefficient(index).is_zero()).collect();
            let negative = with.iter().filter(|index| coefficient(index).is_negative()).count();
            let is_unbalanced =
                negative == 0 || negative == with.len() || is_an_equation(&with, inequalities);
            if !with.is_empty() && is_unbalanced {
                used.retain(|index| !with.contains(index));
            }
        }
        if used.len() == before {
            return used;
        }
    }
}

/// Whether these are an expression and its negative, neither below 0.
fn is_an_equation(of: &[usize], inequalities: &[Inequality]) -> bool {
    let [one, other] = of else { return false };
    let (one, other) = (&inequalities[*one], &inequalities[*other]);
    let entries =
        |row: &Inequality| row.coefficients.iter().chain([&row.constant]).cloned().collect::<Vec<_>>();
    !one.strict && !other.strict && entries(one).into_iter().zip(entries(other)).all(|(a, b)| a == -b)
}

/// The same, of inequalities that are all looked at.
fn contradiction_of_all(inequalities: &[Inequality]) -> Option<Vec<Rational>> {
    // least Σ y b with Σ y A = 0, Σ y = 1
    let variables = inequalities.first()?.coefficients.len();
    let column =
        |row: &Inequality| row.coefficients.iter().cloned().chain([Rational::ONE]).collect::<Vec<_>>();
    let columns: Vec<Vec<Rational>> = inequalities.iter().map(column).collect();
    let mut right = vec![Rational::ZERO; variables + 1];
    right[variables] = Rational::ONE;
    let cost: Vec<Rational> = inequalities.iter().map(|row| row.constant.clone()).collect();
    let mut tableau = Tableau::feasible(&columns, right)?;
    let (least, multipliers) = tableau.minimise(&cost)?;
    if least.is_negative() {
        return Some(multipliers);
    }
    if !least.is_zero() {
        return None;
    }
    // among those with Σ y b = 0 one that uses a strict inequality
    let balanced: Vec<Vec<Rational>> = columns
        .into_iter()
        .zip(&cost)
        .map(|(mut column, constant)| {
            column.push(constant.clone());
            column
        })
        .collect();
    let mut right = vec![Rational::ZERO; variables + 2];
    right[variables] = Rational::ONE;
    let cost: Vec<Rational> = inequalities
        .iter()
        .map(|row| if row.strict { Rational::MINUS_ONE } else { Rational::ZERO })
        .collect();
    let (least, multipliers) = Tableau::feasible(&balanced, right)?.minimise(&cost)?;
    least.is_negative().then_some(multipliers)
}

/// Equations `Σ_j column_j y_j = right` solved for the basic variables.
struct Tableau {
    rows: Vec<Vec<Rational>>,
    right: Vec<Rational>,
    basis: Vec<usize>,
    /// Variables of the problem; artificial ones stand behind them.
    size: usize,
    pivots: usize,
}

impl Tableau {
    /// A vertex, if there is one.
    fn feasible(columns: &[Vec<Rational>], right: Vec<Rational>) -> Option<Self> {
        let (size, count) = (columns.len(), right.len());
        let rows: Vec<Vec<Rational>> = (0..count)
            .map(|i| {
                let artificial = (0..count).map(|k| if i == k { Rational::ONE } else { Rational::ZERO });
                columns.iter().map(|column| column[i].clone()).chain(artificial).collect()
            })
            .collect();
        let basis = (size..size + count).collect();
        let mut tableau = Self { rows, right, basis, size, pivots: 0 };
        let mut cost = vec![Rational::ZERO; size];
        cost.resize(size + count, Rational::ONE);
        let (least, _) = tableau.minimise(&cost)?;
        least.is_zero().then_some(tableau)
    }

    /// The least value of a cost, and where it is taken.
    fn minimise(&mut self, cost: &[Rational]) -> Option<(Rational, Vec<Rational>)> {
        let price = |variable: usize| cost.get(variable).cloned().unwrap_or(Rational::ZERO);
        let open = cost.len();
        loop {
            let reduced = |variable: usize| {
                self.rows.iter().zip(&self.basis).fold(price(variable), |sum, (row, basic)| {
                    if row[variable].is_zero() { sum } else { sum - price(*basic) * row[variable].clone() }
                })
            };
            let Some(entering) = (0..open).find(|j| !self.basis.contains(j) && reduced(*j).is_negative())
            else {
                break;
            };
            let ratio = |i: usize| {
                let entry = &self.rows[i][entering];
                // an artificial variable that is still basic stays at zero
                let stays = self.basis[i] >= self.size && self.right[i].is_zero() && !entry.is_zero();
                if stays {
                    return Some(Rational::ZERO);
                }
                let positive = !entry.is_zero() && !entry.is_negative();
                positive.then(|| self.right[i].clone() * entry.recip().unwrap_or(Rational::ZERO))
            };
            let leaving = (0..self.rows.len())
                .filter_map(|i| Some((ratio(i)?, self.basis[i], i)))
                .min_by(|a, b| (&a.0, a.1).cmp(&(&b.0, b.1)))?;
            self.pivot(leaving.2, entering);
            self.pivots += 1;
            if self.pivots > PIVOTS {
                return None;
            }
        }
        let mut point = vec![Rational::ZERO; self.size];
        let mut value = Rational::ZERO;
        for (basic, right) in self.basis.iter().zip(&self.right) {
            value = value + price(*basic) * right.clone();
            if let Some(slot) = point.get_mut(*basic) {
                *slot = right.clone();
            }
        }
        Some((value, point))
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let Some(inverse) = self.rows[row][column].recip() else { return };
        limits::spend(self.rows.len() * self.rows[row].len() / ENTRIES_PER_STEP);
        for entry in &mut self.rows[row] {
            *entry = entry.clone() * inverse.clone();
        }
        self.right[row] = self.right[row].clone() * inverse;
        let (leading, leading_right) = (self.rows[row].clone(), self.right[row].clone());
        for other in (0..self.rows.len()).filter(|other| *other != row) {
            let factor = self.rows[other][column].clone();
            if factor.is_zero() {
                continue;
            }
            for (entry, lead) in self.rows[other].iter_mut().zip(&leading) {
                if !lead.is_zero() {
                    *entry = entry.clone() - factor.clone() * lead.clone();
                }
            }
            self.right[other] = self.right[other].clone() - factor * leading_right.clone();
        }
        self.basis[row] = column;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inequality(coefficients: [i64; 3], constant: i64, strict: bool) -> Inequality {
        let coefficients = coefficients.into_iter().map(Rational::from).collect();
        Inequality { coefficients, constant: constant.into(), strict }
    }

    #[test]
    fn contradictions_and_none() {
        // a > b > c > a
        let cycle = [[1, -1, 0], [0, 1, -1], [-1, 0, 1]];
        let strict = cycle.map(|row| inequality(row, 0, true));
        assert!(contradiction(&strict).is_some());
        let weak = cycle.map(|row| inequality(row, 0, false));
        assert!(contradiction(&weak).is_none());
        assert!(contradiction(&strict[..2]).is_none());
        // a + b > 2, a < 1, b < 1
        let sum = [
            inequality([1, 1, 0], -2, true),
            inequality([-1, 0, 0], 1, true),
            inequality([0, -1, 0], 1, true),
        ];
        assert!(contradiction(&sum).is_some());
        // a + b ≥ 2, a ≤ 1, b ≤ 1
        let touching = sum.clone().map(|row| Inequality { strict: false, ..row });
        assert!(contradiction(&touching).is_none());
        // a ≥ 1, a ≤ 0
        let gap = [inequality([1, 0, 0], -1, false), inequality([-1, 0, 0], 0, false)];
        assert!(contradiction(&gap).is_some());
        assert!(contradiction(&[]).is_none());
    }

    #[test]
    fn what_cannot_balance_makes_no_difference() {
        let mut state = 1_u32;
        let mut digit = |size: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            i64::from((state >> 16) % size) - i64::from(size / 2)
        };
        let (mut contradictory, mut fewer) = (0, 0);
        for _ in 0..2000 {
            let mut rows = Vec::new();
            for _ in 0..3 + digit(3) {
                let row = inequality([digit(3), digit(3), digit(3)], digit(5), digit(2) == 0);
                let is_equation = digit(3) == 0;
                rows.push(Inequality { strict: row.strict && !is_equation, ..row.clone() });
                if is_equation {
                    let coefficients = row.coefficients.into_iter().map(|c| -c).collect();
                    rows.push(Inequality { coefficients, constant: -row.constant, strict: false });
                }
            }
            let found = contradiction(&rows);
            assert_eq!(found.is_some(), contradiction_of_all(&rows).is_some(), "{rows:?}");
            fewer += usize::from(those_that_balance(&rows).len() < rows.len());
            let Some(multipliers) = found else { continue };
            contradictory += 1;
            let sum = |entry: fn(&Inequality) -> Vec<Rational>| {
                let terms = rows.iter().zip(&multipliers).map(|(row, y)| {
                    entry(row).into_iter().map(|value| value * y.clone()).collect::<Vec<_>>()
                });
                terms.reduce(|sum, term| sum.into_iter().zip(term).map(|(a, b)| a + b).collect()).unwrap()
            };
            assert!(multipliers.iter().all(|y| !y.is_negative()));
            assert!(sum(|row| row.coefficients.clone()).iter().all(Rational::is_zero));
            let constant = sum(|row| vec![row.constant.clone()]).remove(0);
            let is_strict = rows.iter().zip(&multipliers).any(|(row, y)| row.strict && !y.is_zero());
            assert!(constant.is_negative() || (constant.is_zero() && is_strict));
        }
        assert!(contradictory > 100 && fewer > 500, "{contradictory} {fewer}");
    }
}

//! Demands where equations among them are solved: two spheres are met on a plane, and there each is a circle.
//!
//! Equations are brought to echelon form over the rational numbers, their monomials for unknowns, those of highest
//! degree first. What all monomials of a row have in common is left out where it is not zero. A row that is linear in
//! a symbol which stands in it nowhere else, with a coefficient that is not zero, is solved for that, and the others
//! are multiplied by an even power of the coefficient: no sign changes.

use super::graph::Graph;
use super::inequalities::{Demand, Known};
use super::number::Rational;
use super::polynomial_terms::{Monomial, Terms, multiplied, product_of, sum_of};
use crate::id::ExprId;
use std::cmp::Reverse;
use std::collections::BTreeSet;

/// Demands that are solved among each other; the work grows with their square.
const MOST: usize = 40;

/// A polynomial and what is demanded of it.
pub(super) type Demanded = (Terms, Demand);

/// `symbol = −rest/coefficient`.
struct Solved {
    symbol: ExprId,
    coefficient: (Monomial, Rational),
    rest: Terms,
}

impl Graph {
    /// What the demands are where their equations are solved, as far as these can be; `None` where nothing changes.
    pub(super) fn with_equations_solved(
        &self,
        polynomials: &[Terms],
        demands: impl Iterator<Item = Demand>,
        known: &Known,
    ) -> Option<Vec<Demanded>> {
        let all = polynomials.iter().cloned().zip(demands);
        let (mut equations, mut others): (Vec<Demanded>, Vec<Demanded>) =
            all.partition(|(_, demand)| *demand == Demand::Zero);
        if equations.len() < 2 || equations.len() + others.len() > MOST {
            return None;
        }
        let mut was_solved = false;
        loop {
            let open: Vec<Terms> = equations.iter().map(|(polynomial, _)| polynomial.clone()).collect();
            let mut rows: Vec<Terms> =
                in_echelon_form(open).into_iter().map(|row| without_content(row, known)).collect();
            let found = rows.iter().enumerate().find_map(|(index, row)| {
                let elsewhere =
                    rows.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, row)| row);
                let elsewhere = elsewhere.chain(others.iter().map(|(polynomial, _)| polynomial));
                Some((index, self.solved_for(row, &elsewhere.collect::<Vec<_>>(), known)?))
            });
            let Some((index, solved)) = found else {
                equations = rows.into_iter().map(|row| (row, Demand::Zero)).collect();
                break;
            };
            rows.remove(index);
            let substitute = |polynomial: &Terms| solved.in_place_of_symbol(polynomial);
            equations =
                rows.iter().map(|row| Some((substitute(row)?, Demand::Zero))).collect::<Option<_>>()?;
            for (polynomial, _) in &mut others {
                *polynomial = substitute(polynomial)?;
            }
            was_solved = true;
        }
        equations.extend(others);
        was_solved.then_some(equations)
    }

    /// A row solved for a symbol of which the other polynomials are polynomials too.
    fn solved_for(&self, row: &Terms, others: &[&Terms], known: &Known) -> Option<Solved> {
        let parts: BTreeSet<ExprId> = row.keys().flatten().map(|(part, _)| *part).collect();
        parts.iter().find_map(|symbol| {
            let name = self.as_symbol(*symbol)?;
            let mut with = row.iter().filter(|(monomial, _)| has(monomial, *symbol));
            let (Some((monomial, number)), None) = (with.next(), with.next()) else { return None };
            let coefficient: Monomial = monomial.iter().filter(|(part, _)| part != symbol).cloned().collect();
            let is_linear = monomial.iter().any(|(part, e)| part == symbol && e.is_one());
            let is_regular = coefficient.iter().all(|(part, _)| is_nonzero(*part, known));
            let is_inside = |polynomial: &&Terms| {
                polynomial.keys().flatten().any(|(part, exponent)| {
                    if part == symbol {
                        exponent.to_i64().is_none_or(|e| e < 0)
                    } else {
                        self.depends_on(*part, &[name])
                    }
                })
            };
            if !is_linear || !is_regular || others.iter().chain([&row]).any(is_inside) {
                return None;
            }
            let mut rest = row.clone();
            rest.remove(monomial);
            Some(Solved { symbol: *symbol, coefficient: (coefficient, number.clone()), rest })
        })
    }
}

impl Solved {
    /// A polynomial with the symbol's value in its place, times an even power of the coefficient.
    fn in_place_of_symbol(&self, polynomial: &Terms) -> Option<Terms> {
        let power = |monomial: &Monomial| {
            let found = monomial.iter().find(|(part, _)| *part == self.symbol);
            found.map_or(Some(0), |(_, exponent)| exponent.to_i64())
        };
        let highest = polynomial.keys().map(power).collect::<Option<Vec<i64>>>()?.into_iter().max()?;
        let times = highest + highest % 2;
        let coefficient = Terms::from([(self.coefficient.0.clone(), self.coefficient.1.clone())]);
        let minus_rest: Terms = self.rest.iter().map(|(m, c)| (m.clone(), -c.clone())).collect();
        let mut sum = Terms::new();
        for (monomial, number) in polynomial {
            let degree = power(monomial)?;
            let left: Monomial = monomial.iter().filter(|(part, _)| *part != self.symbol).cloned().collect();
            let mut term = Terms::from([(left, number.clone())]);
            for _ in 0..degree {
                term = multiplied(&term, &minus_rest)?;
            }
            for _ in degree..times {
                term = multiplied(&term, &coefficient)?;
            }
            sum = sum_of(&sum, &term);
        }
        Some(sum)
    }
}

fn has(monomial: &Monomial, part: ExprId) -> bool {
    monomial.iter().any(|(other, _)| *other == part)
}

fn is_nonzero(part: ExprId, known: &Known) -> bool {
    known.get(&part).is_some_and(super::interval::Interval::is_nonzero)
}

/// Σ of the exponents.
fn degree(monomial: &Monomial) -> Rational {
    monomial.iter().fold(Rational::ZERO, |sum, (_, exponent)| sum + exponent.clone())
}

/// Combinations of equations, each with a monomial that is in none of the others.
fn in_echelon_form(equations: Vec<Terms>) -> Vec<Terms> {
    let mut done: Vec<(Monomial, Terms)> = Vec::new();
    for equation in equations {
        let reduced = done.iter().fold(equation, |row, (pivot, by)| without(row, pivot, by));
        let pivot = reduced.keys().filter(|monomial| !monomial.is_empty());
        let Some(pivot) = pivot.max_by_key(|monomial| (degree(monomial), Reverse(*monomial))).cloned() else {
            // 0 = 0 is left out, and a number that is 0 stays, as the contradiction that it is
            if !reduced.is_empty() {
                done.push((Monomial::new(), reduced));
            }
            continue;
        };
        for (_, row) in &mut done {
            *row = without(std::mem::take(row), &pivot, &reduced);
        }
        done.push((pivot, reduced));
    }
    done.into_iter().map(|(_, row)| row).collect()
}

/// A row less what another one has of it at that one's pivot.
fn without(row: Terms, pivot: &Monomial, by: &Terms) -> Terms {
    let (Some(of_row), Some(of_pivot)) = (row.get(pivot), by.get(pivot)) else { return row };
    let Some(inverse) = of_pivot.recip() else { return row };
    let factor = -(of_row.clone() * inverse);
    let scaled: Terms = by.iter().map(|(m, c)| (m.clone(), c.clone() * factor.clone())).collect();
    sum_of(&row, &scaled)
}

/// A row without the factors that are in all of its monomials, where these are not zero.
fn without_content(row: Terms, known: &Known) -> Terms {
    let parts: BTreeSet<ExprId> = row.keys().flatten().map(|(part, _)| *part).collect();
    parts.into_iter().filter(|part| is_nonzero(*part, known)).fold(row, |row, part| {
        let exponent =
            |monomial: &Monomial| monomial.iter().find(|(p, _)| *p == part).map(|(_, e)| e.clone());
        let least =
            row.keys().map(exponent).collect::<Option<Vec<_>>>().and_then(|all| all.into_iter().min());
        let Some(least) = least.filter(|least| !least.is_negative()) else { return row };
        let inverse = vec![(part, -least)];
        row.iter().map(|(monomial, c)| (product_of(monomial, &inverse), c.clone())).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Contradiction;

    /// Two spheres of the radius r at the distance d, d > factor · r > 0, in axes that are turned by (3, 4)/5.
    fn spheres(factor: i64) -> (Graph, Vec<(ExprId, Demand)>) {
        let mut g = Graph::new();
        let [x, y, r, d] = ["x", "y", "r", "d"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let first = g.formula(x * x + y * y - r * r);
        let along = g.linear_combination(&[(5.into(), x), ((-3).into(), d)]);
        let across = g.linear_combination(&[(5.into(), y), ((-4).into(), d)]);
        let second = g.formula(along * along + across * across);
        let square = g.square(r);
        let radius = g.scale(25.into(), square);
        let second = g.formula(second - radius);
        let gap = g.linear_combination(&[(Rational::ONE, d), ((-factor).into(), r)]);
        let demands = vec![
            (r, Demand::Positive),
            (gap, Demand::Positive),
            (first, Demand::Zero),
            (second, Demand::Zero),
        ];
        (g, demands)
    }

    #[test]
    fn spheres_meet_where_they_are_near() {
        let (g, demands) = spheres(2);
        assert_eq!(g.contradiction(&demands), Some(Contradiction::Together));
        let (g, demands) = spheres(1);
        assert_eq!(g.contradiction(&demands), None);
    }

    #[test]
    fn a_coefficient_that_may_be_zero_is_not_divided_by() {
        let mut g = Graph::new();
        let [x, y, a] = ["x", "y", "a"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        // a (x − y) = 0, (x − y)² = 1
        let (gap, one) = (g.formula(x - y), g.one());
        let (product, square) = (g.formula(a * gap), g.formula(gap * gap));
        let unit = g.formula(square - one);
        let demands = [(product, Demand::Zero), (unit, Demand::Zero)];
        assert_eq!(g.contradiction(&demands), None, "a = 0 is left");
        let positive: Vec<_> = demands.into_iter().chain([(a, Demand::Positive)]).collect();
        assert!(g.contradiction(&positive).is_some());
    }
}

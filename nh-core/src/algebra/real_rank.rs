//! Ranks with the roots of real numbers, where the field of the zero test may be mistaken.

use super::ball::{Ball, Bits, NoBall};
use super::enclosure::{Evaluated, Point};
use super::evaluate::Bounded;
use super::exact::{Decision, Form, Number};
use super::graph::Graph;
use super::node::{Function, Node};
use super::number::Rational;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};
use crate::limits;

/// The points at which ranks are looked for with enclosures.
const LOOKS: u64 = 8;

/// The value of a symbol at one of the points with short numbers.
fn sampled(symbols: &[SymbolId], attempt: u64, symbol: SymbolId) -> f64 {
    sample(attempt, symbols.iter().position(|known| *known == symbol).unwrap_or(0))
}

/// The number of rows or of columns, whichever is smaller.
fn full_rank(matrix: &[Vec<ExprId>]) -> usize {
    matrix.len().min(matrix.first().map_or(0, Vec::len))
}

impl Graph {
    /// Whether the field of the zero test may take numbers for independent that are not: roots, and
    /// functions that are not rational on the circle or in exponentials.
    pub(super) fn is_beyond_field(&self, roots: &[ExprId]) -> bool {
        let mut found = false;
        self.each_reachable(roots, |id| {
            found |= self.is_node_beyond_field(id);
            !found
        });
        found
    }

    /// The same of a node, whatever its operands are.
    pub(super) fn is_node_beyond_field(&self, id: ExprId) -> bool {
        match self.node(id) {
            Node::Product { factors, .. } => factors.iter().any(|(_, exponent)| !exponent.is_integer()),
            Node::Pi
            | Node::Apply2(..)
            | Node::Apply(
                Function::Ln
                | Function::Asin
                | Function::Acos
                | Function::Atan
                | Function::Abs
                | Function::Sign,
                _,
            ) => true,
            _ => false,
        }
    }

    /// The rank at generic points of a matrix for which the field found `in_field`.
    pub(super) fn rank_on_reals(&self, matrix: &[Vec<ExprId>], in_field: usize) -> Result<usize, String> {
        // more than all rows or columns there are not: one point shows it, mostly with the digits of floating point
        if in_field == full_rank(matrix) && self.is_full_in_floating_point(matrix) {
            return Ok(in_field);
        }
        if let Some(rank) = self.exact_rank(matrix) {
            return Ok(rank);
        }
        match self.certain_rank(matrix) {
            Some(rank) if rank < in_field => Err(format!(
                "it is {rank} as far as digits tell, and {in_field} as far as identities known here do"
            )),
            _ => Ok(in_field),
        }
    }

    /// The rank at generic points of a matrix that has no values in the field.
    pub(super) fn rank_without_field(&self, matrix: &[Vec<ExprId>]) -> Option<usize> {
        let full = full_rank(matrix);
        if self.is_full_in_floating_point(matrix) {
            return Some(full);
        }
        self.exact_rank(matrix).or_else(|| self.certain_rank(matrix).filter(|rank| *rank == full))
    }

    /// Whether values and bounds on their errors show that the rank is full, at one of some points.
    fn is_full_in_floating_point(&self, matrix: &[Vec<ExprId>]) -> bool {
        let entries: Vec<ExprId> = matrix.iter().flatten().copied().collect();
        let symbols = self.symbols_in(&entries);
        let points = (0..LOOKS).map(|attempt| {
            let symbols = &symbols;
            move |symbol: SymbolId| sampled(symbols, attempt, symbol)
        });
        self.evaluate_each(&entries, points).any(|values| {
            let mut values = values.into_iter();
            is_full(matrix.iter().map(|row| values.by_ref().take(row.len()).collect()).collect())
        })
    }

    /// The rank that is certain from enclosures at some points; `None` where there are none.
    fn certain_rank(&self, matrix: &[Vec<ExprId>]) -> Option<usize> {
        const DIGITS: Bits = 256;
        let entries: Vec<ExprId> = matrix.iter().flatten().copied().collect();
        let symbols = self.symbols_in(&entries);
        let found = (0..LOOKS).filter_map(|attempt| {
            let value = |symbol: SymbolId| {
                Rational::of_f64(sampled(&symbols, attempt, symbol)).unwrap_or(Rational::ONE)
            };
            let evaluated = self.evaluate_exactly(&entries, Point::Given(&value), DIGITS).ok()?;
            let mut balls = evaluated.values.into_iter().map(|value| value.ball);
            rank_of_balls(matrix.iter().map(|row| balls.by_ref().take(row.len()).collect()).collect()).ok()
        });
        found.max()
    }

    /// The rank at random points with the roots of real numbers, where all entries have exact values.
    fn exact_rank(&self, matrix: &[Vec<ExprId>]) -> Option<usize> {
        const POINTS: u64 = 3;
        const TRIED: u64 = 24;
        let (mut rank, mut seen) = (None, 0);
        for seed in 0..TRIED {
            match self.rank_at(matrix, Point::Random { seed, tied: false }) {
                Ok(found) => rank = rank.max(Some(found)),
                Err(NoBall::Undefined) => continue,
                Err(_) => return None,
            }
            seen += 1;
            if seen == POINTS {
                return rank;
            }
        }
        rank
    }

    fn rank_at(&self, matrix: &[Vec<ExprId>], point: Point<'_>) -> Result<usize, NoBall> {
        const MOST_DIGITS: Bits = 1 << 13;
        let entries: Vec<ExprId> = matrix.iter().flatten().copied().collect();
        let mut bits = 128;
        while bits <= MOST_DIGITS {
            match self.evaluate_exactly(&entries, point, bits).and_then(|found| found.rank(matrix, bits)) {
                Err(NoBall::TooWide) => bits *= 2,
                other => return other,
            }
        }
        Err(NoBall::TooWide)
    }
}

impl Evaluated {
    /// The rank of a matrix with these entries, by elimination.
    fn rank(self, matrix: &[Vec<ExprId>], bits: Bits) -> Result<usize, NoBall> {
        let numbers: Result<Vec<Number>, NoBall> = self
            .values
            .into_iter()
            .map(|value| number_of(value.form.ok_or(NoBall::TooLong)?, self.degree, bits))
            .collect();
        let mut numbers = numbers?.into_iter();
        let mut rows: Vec<Vec<Number>> =
            matrix.iter().map(|row| numbers.by_ref().take(row.len()).collect()).collect();
        let columns = rows.first().map_or(0, Vec::len);
        let mut rank = 0;
        for column in 0..columns {
            let mut pivot = None;
            for (row, entries) in rows.iter().enumerate().skip(rank) {
                match entries[column].decided(self.degree) {
                    Decision::Zero => {}
                    Decision::NonZero => pivot = pivot.or(Some(row)),
                    Decision::Digits(_) => return Err(NoBall::TooWide),
                }
            }
            let Some(pivot) = pivot else { continue };
            rows.swap(rank, pivot);
            let leading = rows[rank].clone();
            let inverse = leading[column].power(-1)?;
            for row in rows.iter_mut().skip(rank + 1) {
                let factor = row[column].times(&inverse)?;
                for (entry, lead) in row.iter_mut().zip(&leading) {
                    let product = factor.times(lead)?;
                    *entry = Number::sum(
                        [(Rational::ONE, &*entry), (Rational::MINUS_ONE, &product)].into_iter(),
                        bits,
                    );
                }
            }
            rank += 1;
        }
        Ok(rank)
    }
}

/// The number that a value is.
fn number_of(form: Form, degree: u64, bits: Bits) -> Result<Number, NoBall> {
    if form.is_algebraic() {
        return Ok(form.algebraic);
    }
    match form.decided(degree, bits)? {
        Decision::Zero => Ok(Number::of(&Rational::ZERO, bits)),
        Decision::NonZero => Err(NoBall::TooLong),
        Decision::Digits(_) => Err(NoBall::TooWide),
    }
}

/// Whether the rank is certainly full, by elimination with the largest entry that is left as pivot.
fn is_full(mut rows: Vec<Vec<Bounded>>) -> bool {
    let columns = rows.first().map_or(0, Vec::len);
    let full = rows.len().min(columns);
    let mut done = Vec::with_capacity(full);
    for rank in 0..full {
        let free = (rank..rows.len()).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let candidates =
            free.filter(|(row, column)| !done.contains(column) && rows[*row][*column].is_certainly_nonzero());
        let size = |&(row, column): &(usize, usize)| rows[row][column].value.abs();
        let Some((row, column)) = candidates.max_by(|a, b| size(a).total_cmp(&size(b))) else {
            return false;
        };
        rows.swap(rank, row);
        done.push(column);
        let leading = rows[rank].clone();
        limits::spend((rows.len() - rank) * columns / 8);
        for row in rows.iter_mut().skip(rank + 1) {
            let factor = row[column].over(leading[column]);
            for (entry, lead) in row.iter_mut().zip(&leading) {
                *entry = entry.less_product(factor, *lead);
            }
        }
    }
    true
}

/// A rank that is certain, by elimination.
fn rank_of_balls(mut rows: Vec<Vec<Ball>>) -> Result<usize, NoBall> {
    let columns = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|row| rows[*row][column].is_nonzero()) else { continue };
        rows.swap(rank, pivot);
        let leading = rows[rank].clone();
        let inverse = leading[column].reciprocal()?;
        for row in rows.iter_mut().skip(rank + 1) {
            let factor = row[column].times(&inverse)?;
            for (entry, lead) in row.iter_mut().zip(&leading) {
                *entry = entry.minus(&factor.times(lead)?);
            }
        }
        rank += 1;
    }
    Ok(rank)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identities_of_numbers_lower_the_rank() {
        let mut g = Graph::new();
        let pi = g.pi();
        let fifth = g.scale(Rational::new(1, 5), pi);
        let (cosine, five, one) = (g.cos(fifth), g.number(5), g.one());
        let root = g.sqrt(five);
        let golden = g.add(one, root);
        let four = g.number(4);
        assert_eq!(g.generic_rank(&[vec![one, cosine], vec![four, golden]]), Ok(1));
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        let (square, shifted) = (g.square(x), g.add(golden, x));
        let length = g.sqrt(square);
        assert_eq!(g.generic_rank(&[vec![one, cosine], vec![four, shifted]]), Ok(2));
        assert_eq!(g.generic_rank(&[vec![x, length], vec![length, x]]), Ok(1));
        let half = g.number(Rational::new(1, 2));
        let arc = g.apply(Function::Acos, half);
        let third = g.scale(Rational::new(1, 3), pi);
        let nothing = g.sub(arc, third);
        assert_eq!(g.generic_rank(&[vec![nothing]]), Ok(0));
        let something = g.add(nothing, x);
        assert_eq!(g.generic_rank(&[vec![something]]), Ok(1));
    }
}

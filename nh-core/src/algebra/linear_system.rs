//! Linear systems of expressions, solved block by block.
//!
//! The equations are matched with unknowns and put in block triangular form (strongly connected
//! components of the matching's graph). A block is solved by Cramer's rule with a simplified
//! determinant where it is small, else by elimination. Chains such as trailers decompose into
//! blocks of size one, so that the solution is a chain too.

use super::graph::Graph;
use super::matrix::Matrix;
use crate::count::Count;
use crate::id::ExprId;

/// A solved system, and what it was divided by.
#[derive(Clone, Debug)]
pub struct Solution {
    /// A row for each unknown, a column for each right-hand side.
    pub values: Matrix,
    /// The determinants of the blocks; their product is the determinant up to sign.
    pub divisors: Vec<ExprId>,
    /// The equations and unknowns of each block, each block after those that it needs.
    pub blocks: Vec<(Vec<usize>, Vec<usize>)>,
}

/// Blocks up to this size are solved by Cramer's rule.
const CRAMER: usize = 3;

impl Graph {
    /// Solves `matrix · X = right` (`right` has a column for each system). `None` if the matrix is
    /// structurally singular; otherwise it must be generically regular.
    pub fn solve_linear(&mut self, matrix: &[Vec<ExprId>], right: &[Vec<ExprId>]) -> Option<Solution> {
        let n = matrix.len();
        let nonzero: Vec<Vec<bool>> = matrix
            .iter()
            .map(|row| row.iter().map(|entry| !self.zero_test(*entry).is_zero()).collect())
            .collect();
        // what is 0 by its values alone is no pivot, and is not left out either: in the field it is not 0
        let touches = |(entry, nonzero): (&ExprId, &bool)| *nonzero || !self.vanishes_by_identity(*entry);
        let touching: Vec<Vec<bool>> = matrix
            .iter()
            .zip(&nonzero)
            .map(|(row, nonzero)| row.iter().zip(nonzero).map(touches).collect())
            .collect();
        let blocks = matched_blocks(&nonzero, &touching)?;
        let columns = right.first().map_or(0, Vec::len);
        let zero = self.zero();
        let mut values = vec![vec![zero; columns]; n];
        let mut divisors = Vec::new();
        for (rows, block) in &blocks {
            let inner: Matrix =
                rows.iter().map(|row| block.iter().map(|unknown| matrix[*row][*unknown]).collect()).collect();
            let reduced: Matrix = rows
                .iter()
                .map(|row| {
                    (0..columns)
                        .map(|column| {
                            self.moved_over(&matrix[*row], right[*row][column], block, &values, column)
                        })
                        .collect()
                })
                .collect();
            let solved = self.solve_block(inner, reduced, &mut divisors)?;
            for (unknown, row) in block.iter().zip(solved) {
                values[*unknown].clone_from_slice(&row);
            }
        }
        Some(Solution { values, divisors, blocks })
    }

    /// Solves a system of equations of which some follow from the others; simplified. `None` if they do
    /// not determine the unknowns.
    pub fn solve_overdetermined(&mut self, matrix: &[Vec<ExprId>], right: &[ExprId]) -> Option<Vec<ExprId>> {
        let rows = self.independent_rows(matrix).ok()?;
        let solution = self.solve_by_rows(matrix, right, &rows)?;
        Some(solution.into_iter().map(|value| self.simplify(value)).collect())
    }

    /// The same by given rows, as it comes.
    pub fn solve_by_rows(
        &mut self,
        matrix: &[Vec<ExprId>],
        right: &[ExprId],
        rows: &[usize],
    ) -> Option<Vec<ExprId>> {
        if rows.len() != matrix.first().map_or(0, Vec::len) {
            return None;
        }
        let square: Matrix = rows.iter().map(|row| matrix[*row].clone()).collect();
        let right: Matrix = rows.iter().map(|row| vec![right[*row]]).collect();
        let solution = self.solve_linear(&square, &right)?;
        Some(solution.values.into_iter().map(|row| row[0]).collect())
    }

    /// The right-hand side less the terms of unknowns already known.
    fn moved_over(
        &mut self,
        row: &[ExprId],
        right: ExprId,
        block: &[usize],
        values: &[Vec<ExprId>],
        column: usize,
    ) -> ExprId {
        let mut summands = vec![(1.into(), right)];
        for (unknown, entry) in row.iter().enumerate() {
            if !block.contains(&unknown) && !self.is_literal_zero(*entry) {
                summands.push(((-1).into(), self.mul(*entry, values[unknown][column])));
            }
        }
        self.linear_combination(&summands)
    }

    fn solve_block(&mut self, inner: Matrix, right: Matrix, divisors: &mut Vec<ExprId>) -> Option<Matrix> {
        if inner.len() <= CRAMER {
            Some(self.cramer(&inner, &right, divisors))
        } else {
            self.eliminate(inner, right, divisors)
        }
    }

    fn cramer(&mut self, inner: &[Vec<ExprId>], right: &[Vec<ExprId>], divisors: &mut Vec<ExprId>) -> Matrix {
        let determinant = self.small_determinant(inner);
        divisors.push(determinant);
        let columns = right.first().map_or(0, Vec::len);
        (0..inner.len())
            .map(|unknown| {
                (0..columns)
                    .map(|column| {
                        let replaced: Matrix = inner
                            .iter()
                            .zip(right)
                            .map(|(row, right)| {
                                let mut row = row.clone();
                                row[unknown] = right[column];
                                row
                            })
                            .collect();
                        let numerator = self.small_determinant(&replaced);
                        let quotient = self.div(numerator, determinant);
                        self.simplify(quotient)
                    })
                    .collect()
            })
            .collect()
    }

    /// Gauss–Jordan elimination that prefers pivots that are numbers, then small ones.
    fn eliminate(
        &mut self,
        mut inner: Matrix,
        mut right: Matrix,
        divisors: &mut Vec<ExprId>,
    ) -> Option<Matrix> {
        let n = inner.len();
        let mut row_of = vec![usize::MAX; n];
        let mut used = vec![false; n];
        for _ in 0..n {
            let (row, column) = self.best_pivot(&inner, &used, &row_of)?;
            used[row] = true;
            row_of[column] = row;
            let pivot = inner[row][column];
            divisors.push(pivot);
            for entry in inner[row].iter_mut().chain(&mut right[row]) {
                *entry = self.div(*entry, pivot);
            }
            let (leading, leading_right) = (inner[row].clone(), right[row].clone());
            for other in (0..n).filter(|other| *other != row) {
                let factor = inner[other][column];
                if self.is_literal_zero(factor) {
                    continue;
                }
                let targets =
                    inner[other].iter_mut().zip(&leading).chain(right[other].iter_mut().zip(&leading_right));
                for (entry, lead) in targets {
                    let product = self.mul(factor, *lead);
                    let difference = self.sub(*entry, product);
                    *entry = self.simplify(difference);
                }
            }
        }
        row_of.iter().map(|row| right.get(*row).cloned()).collect()
    }

    fn best_pivot(&self, inner: &[Vec<ExprId>], used: &[bool], row_of: &[usize]) -> Option<(usize, usize)> {
        let mut best: Option<(Count, usize, usize)> = None;
        for (row, entries) in inner.iter().enumerate().filter(|(row, _)| !used[*row]) {
            for (column, entry) in
                entries.iter().enumerate().filter(|(column, _)| row_of[*column] == usize::MAX)
            {
                let cost = if self.as_number(*entry).is_some() {
                    Count::ZERO
                } else {
                    self.operation_count(&[*entry]) + 1
                };
                let better = best.is_none_or(|(least, ..)| cost < least);
                if better && self.is_nonzero(*entry) {
                    best = Some((cost, row, column));
                }
            }
        }
        best.map(|(_, row, column)| (row, column))
    }
}

/// The equations and unknowns of each block of a matrix by where its entries are not 0, each block after those that
/// it needs; `None` where no choice of entries makes the matrix regular.
pub(crate) fn triangular_blocks(pattern: &[Vec<bool>]) -> Option<Vec<(Vec<usize>, Vec<usize>)>> {
    matched_blocks(pattern, pattern)
}

/// The same by the entries that equations may be matched by, and by those that they touch unknowns with.
fn matched_blocks(pattern: &[Vec<bool>], touching: &[Vec<bool>]) -> Option<Vec<(Vec<usize>, Vec<usize>)>> {
    let row_of = perfect_matching(pattern)?;
    let with_rows = |block: Vec<usize>| {
        let mut rows: Vec<usize> = block.iter().map(|unknown| row_of[*unknown]).collect();
        rows.sort_unstable();
        (rows, block)
    };
    Some(blocks(touching, &row_of).into_iter().map(with_rows).collect())
}

/// A row for each column along non-zero entries (augmenting paths).
fn perfect_matching(pattern: &[Vec<bool>]) -> Option<Vec<usize>> {
    fn augment(row: usize, pattern: &[Vec<bool>], seen: &mut [bool], row_of: &mut [Option<usize>]) -> bool {
        for column in 0..row_of.len() {
            if pattern[row][column] && !std::mem::replace(&mut seen[column], true) {
                let free = match row_of[column] {
                    None => true,
                    Some(other) => augment(other, pattern, seen, row_of),
                };
                if free {
                    row_of[column] = Some(row);
                    return true;
                }
            }
        }
        false
    }
    let n = pattern.len();
    let mut row_of = vec![None; n];
    for row in 0..n {
        if !augment(row, pattern, &mut vec![false; n], &mut row_of) {
            return None;
        }
    }
    row_of.into_iter().collect()
}

/// The unknowns in blocks, each after those that its equations need: strongly connected components
/// of "the equation of u contains v", by reachability.
fn blocks(pattern: &[Vec<bool>], row_of: &[usize]) -> Vec<Vec<usize>> {
    let n = row_of.len();
    let mut reaches: Vec<Vec<bool>> = (0..n).map(|u| pattern[row_of[u]].clone()).collect();
    for middle in 0..n {
        let through = reaches[middle].clone();
        for row in &mut reaches {
            if row[middle] {
                for (entry, via) in row.iter_mut().zip(&through) {
                    *entry |= via;
                }
            }
        }
    }
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    let mut placed = vec![false; n];
    while let Some(next) =
        (0..n).find(|u| !placed[*u] && (0..n).all(|v| placed[v] || !reaches[*u][v] || reaches[v][*u]))
    {
        let block: Vec<usize> =
            (0..n).filter(|v| *v == next || (reaches[next][*v] && reaches[*v][next])).collect();
        for unknown in &block {
            placed[*unknown] = true;
        }
        blocks.push(block);
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix times a matrix, less a matrix: every entry vanishes.
    fn solves(g: &mut Graph, matrix: &[Vec<ExprId>], right: &[Vec<ExprId>]) {
        let solution = g.solve_linear(matrix, right).unwrap();
        for (row, right) in matrix.iter().zip(right) {
            for (column, right) in right.iter().enumerate() {
                let unknowns: Vec<ExprId> = solution.values.iter().map(|row| row[column]).collect();
                let product = g.inner_product(row, &unknowns);
                let defect = g.sub(product, *right);
                assert!(g.zero_test(defect).is_zero());
            }
        }
    }

    #[test]
    fn blocks_of_all_sizes() {
        let mut g = Graph::new();
        let symbols: Vec<ExprId> = (0..30)
            .map(|i| {
                let s = g.new_symbol(format!("s{i}"));
                g.symbol(s)
            })
            .collect();
        for n in 1..=5 {
            let dense: Matrix = (0..n).map(|i| (0..n).map(|j| symbols[i * n + j]).collect()).collect();
            let right: Matrix = (0..n).map(|i| vec![symbols[25 + i % 5]]).collect();
            solves(&mut g, &dense, &right);
        }
        // a permuted triangle
        let zero = g.zero();
        let triangle = vec![
            vec![symbols[0], symbols[1], symbols[2]],
            vec![zero, symbols[3], zero],
            vec![symbols[4], symbols[5], zero],
        ];
        let right: Matrix = (0..3).map(|i| vec![symbols[10 + i]]).collect();
        let solution = g.solve_linear(&triangle, &right).unwrap();
        assert_eq!(solution.divisors, [symbols[3], symbols[4], symbols[2]]);
        solves(&mut g, &triangle, &right);
    }

    #[test]
    fn a_rotation_is_one_block_with_determinant_one() {
        let mut g = Graph::new();
        let theta = g.new_symbol("theta");
        let theta = g.symbol(theta);
        let (s, c) = (g.sin(theta), g.cos(theta));
        let minus = g.neg(c);
        let matrix = vec![vec![s, minus], vec![c, s]];
        let (zero, one) = (g.zero(), g.one());
        let right = vec![vec![one, zero], vec![zero, one]];
        let solution = g.solve_linear(&matrix, &right).unwrap();
        assert_eq!(solution.divisors, [one]);
        assert_eq!(solution.values[0][0], s);
    }
}

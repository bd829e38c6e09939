//! Matrices of expressions: generic rank by random points, determinants and linear systems by
//! their block triangular form.
//!
//! No symbolic inverse is formed beyond small blocks that do not decompose.

use super::field::Residue;
use super::graph::Graph;
use super::modular::{FieldPoint, NoValue};
use super::square_points::Radicands;
use crate::id::ExprId;
use crate::limits;

/// Rows of expressions.
pub type Matrix = Vec<Vec<ExprId>>;

/// The reduced echelon form of a matrix over the prime field.
#[derive(Clone, Debug)]
pub struct Echelon {
    /// The reduced rows, leading entries 1.
    pub rows: Vec<Vec<Residue>>,
    /// The column of each leading entry.
    pub pivots: Vec<usize>,
}

impl Echelon {
    /// Eliminates.
    #[must_use]
    pub fn of(mut rows: Vec<Vec<Residue>>) -> Self {
        let columns = rows.first().map_or(0, Vec::len);
        let mut pivots = Vec::new();
        for column in 0..columns {
            let done = pivots.len();
            let Some(row) = (done..rows.len()).find(|row| rows[*row][column] != Residue::ZERO) else {
                continue;
            };
            rows.swap(done, row);
            let Some(inverse) = rows[done][column].inverse() else { continue };
            for entry in &mut rows[done] {
                *entry = *entry * inverse;
            }
            let leading = rows[done].clone();
            limits::spend(rows.len() / 16);
            for (index, other) in rows.iter_mut().enumerate() {
                let factor = other[column];
                if index != done && factor != Residue::ZERO {
                    limits::spend(columns / 8);
                    for (entry, lead) in other.iter_mut().zip(&leading) {
                        *entry = *entry - factor * *lead;
                    }
                }
            }
            pivots.push(column);
        }
        rows.truncate(pivots.len());
        Self { rows, pivots }
    }

    /// The rank.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// A vector that the matrix sends to zero, normalised to 1 at the first free column.
    #[must_use]
    pub fn kernel_vector(&self, columns: usize) -> Option<Vec<Residue>> {
        self.kernel(columns).next()
    }

    /// A basis of the vectors that the matrix sends to zero: one for each free column, 1 there.
    pub fn kernel(&self, columns: usize) -> impl Iterator<Item = Vec<Residue>> {
        let free = (0..columns).filter(|column| !self.pivots.contains(column));
        free.map(move |free| {
            let mut vector = vec![Residue::ZERO; columns];
            vector[free] = Residue::ONE;
            for (row, pivot) in self.rows.iter().zip(&self.pivots) {
                vector[*pivot] = -row[free];
            }
            vector
        })
    }

    /// The solution of linear equations, the column after the unknowns their right side, which is 0 at free
    /// columns; `None` where they contradict each other.
    #[must_use]
    pub fn solution(&self, unknowns: usize) -> Option<Vec<Residue>> {
        if self.pivots.contains(&unknowns) {
            return None;
        }
        let mut solution = vec![Residue::ZERO; unknowns];
        for (row, pivot) in self.rows.iter().zip(&self.pivots) {
            solution[*pivot] = row[unknowns];
        }
        Some(solution)
    }
}

/// The determinant over the prime field.
#[must_use]
pub fn determinant_in_field(mut rows: Vec<Vec<Residue>>) -> Residue {
    let n = rows.len();
    let mut determinant = Residue::ONE;
    for column in 0..n {
        let Some(row) = (column..n).find(|row| rows[*row][column] != Residue::ZERO) else {
            return Residue::ZERO;
        };
        if row != column {
            rows.swap(row, column);
            determinant = -determinant;
        }
        let pivot = rows[column][column];
        determinant = determinant * pivot;
        let Some(inverse) = pivot.inverse() else { return Residue::ZERO };
        let leading = rows[column].clone();
        limits::spend(n / 16);
        for other in rows.iter_mut().skip(column + 1) {
            let factor = other[column] * inverse;
            if factor != Residue::ZERO {
                limits::spend((n - column) / 8);
                for (entry, lead) in other.iter_mut().zip(&leading).skip(column) {
                    *entry = *entry - factor * *lead;
                }
            }
        }
    }
    determinant
}

impl Graph {
    /// The matrix at a point of the field; `point(seed)` is tried until there is a value.
    ///
    /// # Errors
    /// The reason, where no point has a value.
    pub fn matrix_in_field(
        &self,
        matrix: &[Vec<ExprId>],
        point: impl Fn(u64) -> FieldPoint,
    ) -> Result<Vec<Vec<Residue>>, String> {
        let entries: Vec<ExprId> = matrix.iter().flatten().copied().collect();
        for seed in 0..64 {
            match self.evaluate_in_field(&entries, &point(seed)) {
                Ok(values) => {
                    let mut values = values.into_iter();
                    return Ok(matrix.iter().map(|row| values.by_ref().take(row.len()).collect()).collect());
                }
                Err(NoValue::Here) => {}
                Err(NoValue::Ever(reason)) => return Err(reason),
            }
        }
        Err("it has no value at the points tried (a division by zero, or the root of a negative number)"
            .into())
    }

    /// The matrix at a random point of the field: one where the radicands of roots are squares, where points without
    /// regard to them have no value.
    ///
    /// # Errors
    /// The reason, where no point has a value.
    pub(crate) fn matrix_at_random(
        &self,
        matrix: &[Vec<ExprId>],
        start: u64,
    ) -> Result<Vec<Vec<Residue>>, String> {
        self.matrix_in_field(matrix, |seed| FieldPoint::random(start + seed)).or_else(|reason| {
            let entries: Vec<ExprId> = matrix.iter().flatten().copied().collect();
            let radicands = Radicands::of(self, &entries, &[]);
            if radicands.is_empty() {
                return Err(reason);
            }
            self.matrix_in_field(matrix, |seed| radicands.point(self, start + seed))
        })
    }

    /// The rank at generic points.
    ///
    /// The field knows no identities among roots, arcs and logarithms of numbers: where there are any, the
    /// rank is that at points with the roots of real numbers.
    ///
    /// # Errors
    /// The reason, where it cannot be decided.
    pub fn generic_rank(&self, matrix: &[Vec<ExprId>]) -> Result<usize, String> {
        let entries: Vec<ExprId> = matrix.iter().flatten().copied().collect();
        let mut rank = 0;
        for start in [1_000, 2_000] {
            match self.matrix_at_random(matrix, start) {
                Ok(rows) => rank = rank.max(Echelon::of(rows).rank()),
                // such as a root that the field does not have
                Err(reason) => return self.rank_without_field(matrix).ok_or(reason),
            }
        }
        if rank > 0 && self.is_beyond_field(&entries) { self.rank_on_reals(matrix, rank) } else { Ok(rank) }
    }

    /// The first columns of which all are combinations, at generic points.
    ///
    /// # Errors
    /// The reason, where it cannot be decided.
    pub fn independent_columns(&self, matrix: &[Vec<ExprId>]) -> Result<Vec<usize>, String> {
        let rows = self.matrix_at_random(matrix, 3_000)?;
        Ok(Echelon::of(rows).pivots)
    }

    /// The first rows of which all are combinations, at generic points.
    ///
    /// # Errors
    /// The reason, where it cannot be decided.
    pub fn independent_rows(&self, matrix: &[Vec<ExprId>]) -> Result<Vec<usize>, String> {
        self.independent_columns(&Self::transposed(matrix))
    }

    /// The transpose.
    #[must_use]
    pub fn transposed(matrix: &[Vec<ExprId>]) -> Matrix {
        let columns = matrix.first().map_or(0, Vec::len);
        (0..columns).map(|column| matrix.iter().map(|row| row[column]).collect()).collect()
    }

    /// The matrix applied to a vector.
    pub fn image(&mut self, matrix: &[Vec<ExprId>], vector: &[ExprId]) -> Vec<ExprId> {
        let zero = self.zero();
        let present: Vec<usize> = (0..vector.len()).filter(|k| vector[*k] != zero).collect();
        let entries: Vec<ExprId> = present.iter().map(|k| vector[*k]).collect();
        let row = |row: &Vec<ExprId>| present.iter().map(|k| row[*k]).collect::<Vec<_>>();
        matrix.iter().map(row).map(|row| self.inner_product(&row, &entries)).collect()
    }

    /// The identity matrix.
    pub fn identity(&mut self, size: usize) -> Matrix {
        (0..size).map(|index| self.unit_vector(size, index)).collect()
    }

    /// A row of the identity matrix.
    pub fn unit_vector(&mut self, size: usize, index: usize) -> Vec<ExprId> {
        let (zero, one) = (self.zero(), self.one());
        (0..size).map(|other| if other == index { one } else { zero }).collect()
    }

    /// The rows and columns of some indices.
    #[must_use]
    pub fn submatrix(matrix: &[Vec<ExprId>], indices: &[usize]) -> Matrix {
        indices.iter().map(|i| indices.iter().map(|j| matrix[*i][*j]).collect()).collect()
    }

    /// The determinant by expansion along the first row; meant for blocks of size up to four.
    pub fn small_determinant(&mut self, matrix: &[Vec<ExprId>]) -> ExprId {
        match matrix {
            [] => self.one(),
            [row] => row[0],
            _ => {
                let mut summands = Vec::new();
                for column in 0..matrix.len() {
                    let entry = matrix[0][column];
                    if self.is_literal_zero(entry) {
                        continue;
                    }
                    let minor: Matrix = matrix[1..].iter().map(|row| without(row, column)).collect();
                    let minor = self.small_determinant(&minor);
                    let sign = if column % 2 == 0 { 1 } else { -1 };
                    summands.push((sign.into(), self.mul(entry, minor)));
                }
                let sum = self.linear_combination(&summands);
                self.simplify(sum)
            }
        }
    }
}

/// The row with one entry left out.
fn without(row: &[ExprId], column: usize) -> Vec<ExprId> {
    row.iter().enumerate().filter(|(index, _)| *index != column).map(|(_, entry)| *entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generic_rank_sees_identities() {
        let mut g = Graph::new();
        let theta = g.new_symbol("theta");
        let theta = g.symbol(theta);
        let (s, c) = (g.sin(theta), g.cos(theta));
        let minus = g.neg(s);
        let rotation = vec![vec![c, minus], vec![s, c]];
        assert_eq!(g.generic_rank(&rotation), Ok(2));
        let determinant = g.small_determinant(&rotation);
        let one = g.one();
        assert_eq!(determinant, one);
        let (ss, sc) = (g.square(s), g.mul(s, c));
        let cc = g.square(c);
        let projection = vec![vec![cc, sc], vec![sc, ss]];
        assert_eq!(g.generic_rank(&projection), Ok(1));
    }

    #[test]
    fn the_kernel_vector_is_in_the_kernel() {
        let word = Residue::of_word;
        let rows = vec![vec![word(1), word(2), word(3)], vec![word(2), word(4), word(7)]];
        let vector = Echelon::of(rows.clone()).kernel_vector(3).unwrap();
        for row in rows {
            let product = row.iter().zip(&vector).fold(Residue::ZERO, |sum, (a, b)| sum + *a * *b);
            assert_eq!(product, Residue::ZERO);
        }
    }
}

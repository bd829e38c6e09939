//! How the axes of a body lie in those of the body that carries it.

use super::sheet::{Sheet, Square, Vector, mirrored, transposed};
use crate::algebra::{Function, Graph};
use crate::id::ExprId;

/// A rotation E from the axes of a frame to those of the frame that carries it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Turning {
    /// The axes are parallel.
    None,
    /// About one of the axes.
    About { axis: usize, sin: ExprId, cos: ExprId },
    /// About any axis.
    Matrix(Square),
}

impl Turning {
    /// About n, of length 1.
    pub(super) fn about(graph: &mut Graph, n: &Vector, angle: ExprId, matrix: &Square) -> Self {
        let (sin, cos) = (graph.apply(Function::Sin, angle), graph.apply(Function::Cos, angle));
        let moving: Vec<usize> = (0..3).filter(|k| !graph.is_literal_zero(n[*k])).collect();
        if let [axis] = moving.as_slice() {
            let sin = graph.formula(n[*axis] * sin);
            return Self::About { axis: *axis, sin, cos };
        }
        Self::Matrix(*matrix)
    }

    /// E u.
    pub(super) fn inward(&self, sheet: &mut Sheet, u: Vector) -> Vector {
        match self {
            Self::None => u,
            Self::About { axis, sin, cos } => {
                let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut found = u;
                found[i] = sheet.graph.formula(cos * u[i] - sin * u[j]);
                found[j] = sheet.graph.formula(sin * u[i] + cos * u[j]);
                found
            }
            Self::Matrix(e) => sheet.image(e, &u),
        }
    }

    /// Eᵀ u.
    pub(super) fn outward(&self, sheet: &mut Sheet, u: Vector) -> Vector {
        match self {
            Self::None => u,
            Self::About { axis, sin, cos } => {
                let minus = sheet.graph.formula(-sin);
                Self::About { axis: *axis, sin: minus, cos: *cos }.inward(sheet, u)
            }
            Self::Matrix(e) => sheet.image(&transposed(e), &u),
        }
    }

    /// E A Eᵀ. About an axis, the part of A that turns is (a, b) = (A_ii − A_jj, A_ij + A_ji), by twice the angle.
    pub(super) fn of_square(&self, sheet: &mut Sheet, a: &Square) -> Square {
        match self {
            Self::None => *a,
            Self::About { axis, sin, cos } => {
                let (k, i, j) = (*axis, (axis + 1) % 3, (axis + 2) % 3);
                let t = sheet.graph.formula(sin * (a[i][i] - a[j][j]) + cos * (a[i][j] + a[j][i]));
                let t = sheet.named("turned", t);
                let mut found = *a;
                found[i][i] = sheet.graph.formula(a[i][i] - sin * t);
                found[j][j] = sheet.graph.formula(a[j][j] + sin * t);
                found[i][j] = sheet.graph.formula(cos * t - a[j][i]);
                found[j][i] = sheet.graph.formula(cos * t - a[i][j]);
                let row = self.inward(sheet, a[k]);
                let column = self.inward(sheet, transposed(a)[k]);
                for l in [i, j] {
                    (found[k][l], found[l][k]) = (row[l], column[l]);
                }
                found
            }
            Self::Matrix(e) => {
                let zero = sheet.graph.zero();
                let is_round = (0..9).all(|n| {
                    let (i, j) = (n / 3, n % 3);
                    if i == j { a[i][i] == a[0][0] } else { a[i][j] == zero }
                });
                if is_round {
                    return *a;
                }
                let half: Square = std::array::from_fn(|i| {
                    let row = sheet.image(&transposed(a), &e[i]);
                    sheet.named_all("turned", row)
                });
                std::array::from_fn(|i| sheet.image(e, &half[i]))
            }
        }
    }

    /// The same of a symmetric one.
    pub(super) fn of_symmetric(&self, sheet: &mut Sheet, a: &Square) -> Square {
        mirrored(&self.of_square(sheet, a))
    }
}

//! Velocities of a frame along the axes of what carries it, whose accelerations are found along its own axes.
//!
//! What shifts a frame along n, or turns it about n, has in its axes the direction Eᵀ n: three of them span all. With
//! u̇ = Eᵀv̇ for unknowns and forces Eᵀf no inertia has to be turned by E, and v̇ = E u̇ in the end.

use super::inertia::Twist;
use super::motion::Motion;
use super::sheet::{Sheet, Square, Vector, transposed};
use super::tree::{Spin, Tree};
use super::turning::Turning;
use crate::algebra::Matrix;
use crate::id::ExprId;

/// Three velocities that are unknown along other axes: v̇ = E u̇.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OtherAxes {
    /// Which of the velocities of the state.
    pub velocities: [usize; 3],
    /// E, as it is declared.
    pub matrix: Square,
    /// Its entries as intermediate results.
    named: Square,
}

impl OtherAxes {
    /// Those of all frames that turn freely, which move along their own axes from now on.
    pub(super) fn of(sheet: &mut Sheet, tree: &Tree, motions: &mut [Motion], mass: &Matrix) -> Vec<Self> {
        let mut moved = vec![0; mass.len()];
        for (a, _) in motions.iter().flat_map(|motion| &motion.columns) {
            moved[*a] += 1;
        }
        let (zero, one) = (sheet.graph.zero(), sheet.graph.one());
        let none = [zero; 3];
        let is_alone =
            |a: usize| moved[a] == 1 && mass[a].iter().all(|entry| sheet.graph.is_literal_zero(*entry));
        let mut found = Vec::new();
        for (frame, motion) in tree.frames.iter().zip(motions) {
            let (Turning::Matrix(matrix), Spin::Free(free)) = (&frame.turning, &frame.spin) else { continue };
            // what turns it, then what shifts it
            for part in [0, 1] {
                let along = |row: &Vector| {
                    let mut columns = motion.columns.iter().filter(|(a, _)| is_alone(*a));
                    let is_so = |way: &Twist| way[part] == *row && way[1 - part] == none;
                    columns.find(|(_, way)| is_so(way)).map(|(a, _)| *a)
                };
                let [Some(x), Some(y), Some(z)] = [0, 1, 2].map(|k| along(&matrix[k])) else { continue };
                let velocities = [x, y, z];
                for (a, way) in &mut motion.columns {
                    if let Some(k) = velocities.iter().position(|own| own == a) {
                        way[part] = std::array::from_fn(|i| if i == k { one } else { zero });
                    }
                }
                found.push(Self { velocities, matrix: free.matrix, named: *matrix });
            }
        }
        found
    }

    /// Forces along the axes of the carrier, along those of the frame.
    pub(super) fn turn_forces(&self, sheet: &mut Sheet, force: &mut [ExprId]) {
        self.replace(sheet, &transposed(&self.named), force);
    }

    /// Accelerations along the axes of the frame, along those of the carrier.
    pub(super) fn turn_accelerations(&self, sheet: &mut Sheet, accelerations: &mut [ExprId]) {
        self.replace(sheet, &self.named, accelerations);
    }

    fn replace(&self, sheet: &mut Sheet, matrix: &Square, values: &mut [ExprId]) {
        let turned = sheet.image(matrix, &self.velocities.map(|a| values[a]));
        for (a, value) in self.velocities.into_iter().zip(turned) {
            values[a] = value;
        }
    }
}

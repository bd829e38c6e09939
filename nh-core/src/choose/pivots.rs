//! Pivots of definite matrices, recognised by their values at two points.

use crate::algebra::Residue;

/// Whether a quantity is a multiple by a number of another one, at two points.
pub(super) fn is_multiple(a: [Residue; 2], b: [Residue; 2]) -> bool {
    let ratio = || b[0].inverse().and_then(|inverse| (a[0] * inverse).recognised());
    a[0] * b[1] == a[1] * b[0] && ratio().is_some()
}

/// The pivots of the elimination of a definite matrix at two points, in whatever order they are met.
#[derive(Clone)]
pub(super) struct Pivots {
    matrices: [Vec<Vec<Residue>>; 2],
    open: Vec<usize>,
    met: Vec<[Residue; 2]>,
}

impl Pivots {
    pub(super) fn of(matrices: [Vec<Vec<Residue>>; 2]) -> Self {
        let open = (0..matrices[0].len()).collect();
        Self { matrices, open, met: Vec::new() }
    }

    /// Whether a quantity is the next one.
    pub(super) fn are_met(&mut self, value: [Residue; 2]) -> bool {
        if self.is_next(&[value]) {
            self.met.push(value);
            return true;
        }
        // several pivots that are equal, those of equal arms of one body, are one expression: they may be met again
        let mut others = self.clone();
        while others.is_next(&self.met) {
            if others.is_next(&[value]) {
                others.met.push(value);
                *self = others;
                return true;
            }
        }
        false
    }

    /// Eliminates an unknown whose pivot is one of these, if there is such.
    fn is_next(&mut self, values: &[[Residue; 2]]) -> bool {
        let Self { matrices: [first, second], open, .. } = self;
        let is_one =
            |i: &usize| values.iter().any(|value| is_multiple(*value, [first[*i][*i], second[*i][*i]]));
        let Some(position) = open.iter().position(is_one) else { return false };
        let index = open.remove(position);
        eliminate(first, index, open);
        eliminate(second, index, open);
        true
    }
}

/// Whether a quantity is a pivot of a definite matrix, at two points, whatever was eliminated before it: of so many
/// unknowns at most that touch each other, which are tried in every order.
pub(super) fn is_pivot(
    [first, second]: &[Vec<Vec<Residue>>; 2],
    together: usize,
    value: [Residue; 2],
) -> bool {
    (0..first.len()).any(|index| {
        let mut others = touching(first, index);
        others.retain(|other| *other != index);
        others.len() < together && is_pivot_after(first, second, index, &others, value)
    })
}

/// The same where nothing but some of the others was eliminated: in which order does not matter.
fn is_pivot_after(
    first: &[Vec<Residue>],
    second: &[Vec<Residue>],
    index: usize,
    others: &[usize],
    value: [Residue; 2],
) -> bool {
    if is_multiple(value, [first[index][index], second[index][index]]) {
        return true;
    }
    others.iter().enumerate().any(|(k, other)| {
        let (rest, mut left) = (&others[k + 1..], others[k + 1..].to_vec());
        left.push(index);
        let [first, second] = [first, second].map(|matrix| {
            let mut matrix = matrix.to_vec();
            eliminate(&mut matrix, *other, &left);
            matrix
        });
        is_pivot_after(&first, &second, index, rest, value)
    })
}

/// The unknowns that an unknown is coupled with, by entries that are not 0.
fn touching(matrix: &[Vec<Residue>], index: usize) -> Vec<usize> {
    let mut found = vec![index];
    let mut next = 0;
    while let Some(from) = found.get(next).copied() {
        let row = matrix[from].iter().enumerate();
        let new: Vec<usize> = row
            .filter(|(to, entry)| **entry != Residue::ZERO && !found.contains(to))
            .map(|(to, _)| to)
            .collect();
        found.extend(new);
        next += 1;
    }
    found
}

/// The Schur complement: what is left of a matrix for other unknowns when one is eliminated.
fn eliminate(matrix: &mut [Vec<Residue>], index: usize, others: &[usize]) {
    let Some(inverse) = matrix[index][index].inverse() else { return };
    for i in others {
        for j in others {
            let update = matrix[*i][index] * inverse * matrix[index][*j];
            matrix[*i][*j] = matrix[*i][*j] - update;
        }
    }
}

//! In which order the unknowns of a symmetric system are eliminated.

use crate::algebra::Graph;
use crate::count::Count;
use crate::id::ExprId;

/// What an elimination adds to an entry besides what it is made of: a product and a difference.
const UPDATE: u64 = 2;

/// A block in the order of elimination: always that unknown next which is coupled with the fewest
/// others left, so that few entries are filled in, and among these one with the shortest pivot, as
/// earlier eliminations have left it.
///
/// Minimum degree: George and Liu, *The evolution of the minimum degree ordering algorithm*, SIAM
/// Review 31, 1989.
pub(super) fn elimination_order(graph: &Graph, matrix: &[Vec<ExprId>], block: &[usize]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..block.len()).collect();
    // operations of the entries that are not zero
    let length = |i: &usize, j: &usize| {
        let entry = matrix[*i][*j];
        (!graph.is_literal_zero(entry)).then(|| graph.operation_count(&[entry]))
    };
    let mut lengths: Vec<Vec<Option<Count>>> =
        block.iter().map(|i| block.iter().map(|j| length(i, j)).collect()).collect();
    let mut order = Vec::with_capacity(block.len());
    while !left.is_empty() {
        let degree = |i: usize| left.iter().filter(|j| lengths[i][**j].is_some()).count();
        let next = (0..left.len()).min_by_key(|k| (degree(left[*k]), lengths[left[*k]][left[*k]]));
        let next = left.remove(next.unwrap_or(0));
        let row = lengths[next].clone();
        // a_ij − a_ik a_jk / a_kk
        for &i in &left {
            for &j in &left {
                if let (Some(first), Some(second)) = (row[i], row[j]) {
                    let update = if i == j { first } else { first + second };
                    lengths[i][j] = Some(lengths[i][j].unwrap_or(Count::ZERO) + UPDATE + update);
                }
            }
        }
        order.push(block[next]);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pivot_that_was_added_to_is_long() {
        let mut g = Graph::new();
        let [a, b, x] = ["a", "b", "x"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (zero, sum, square) = (g.zero(), g.formula(a + b), g.square(x));
        let product = g.formula(a * square);
        // a ring; the second and the third unknown are masses, the last is longer than both
        let matrix = vec![
            vec![a, x, x, zero],
            vec![x, sum, zero, b],
            vec![x, zero, sum, b],
            vec![zero, b, b, product],
        ];
        // once the first is eliminated all others touch, and the last alone is as it was
        assert_eq!(elimination_order(&g, &matrix, &[0, 1, 2, 3]), [0, 3, 1, 2]);
        // few neighbours come first
        let matrix = vec![vec![a, x, x], vec![x, sum, zero], vec![x, zero, product]];
        assert_eq!(elimination_order(&g, &matrix, &[0, 1, 2]), [1, 0, 2]);
    }

    /// Written out, what dense eliminations leave is three times as long after every step.
    #[test]
    fn dense_matrices_of_any_size_have_an_order() {
        for n in [1, 2, 40, 41, 64, 120] {
            let mut g = Graph::new();
            let entries: Vec<ExprId> = (0..n)
                .map(|k| {
                    let symbol = g.new_symbol(format!("a{k}"));
                    let symbol = g.symbol(symbol);
                    g.sin(symbol)
                })
                .collect();
            let row = |g: &mut Graph, i: usize| entries.iter().map(|e| g.formula(entries[i] * e)).collect();
            let matrix: Vec<Vec<ExprId>> = (0..n).map(|i| row(&mut g, i)).collect();
            let all: Vec<usize> = (0..n).collect();
            let mut order = elimination_order(&g, &matrix, &all);
            order.sort_unstable();
            assert_eq!(order, all);
        }
    }
}

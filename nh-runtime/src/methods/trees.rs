//! Rooted trees, over which order conditions run
//! (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, section II.2).

use std::vec::Vec;

/// A rooted tree τ: its order, its density γ(τ), and the trees that hang from its root, by their numbers.
pub(super) struct Tree {
    pub(super) order: u32,
    pub(super) density: f64,
    pub(super) branches: Vec<usize>,
}

/// All rooted trees up to an order, branches before what they hang from.
pub(super) fn trees(order: u32) -> Vec<Tree> {
    let mut trees = Vec::new();
    for n in 1..=order {
        let mut found = Vec::new();
        let root = Tree { order: 1, density: 1.0, branches: Vec::new() };
        graft(&trees, trees.len(), n, root, &mut found);
        for mut tree in found {
            tree.density *= f64::from(n);
            trees.push(tree);
        }
    }
    trees
}

/// Grafts trees before index `before` on a root, in all ways that give order `n`.
fn graft(trees: &[Tree], before: usize, n: u32, root: Tree, found: &mut Vec<Tree>) {
    if root.order == n {
        found.push(root);
        return;
    }
    for (i, branch) in trees.iter().enumerate().take(before) {
        if root.order + branch.order <= n {
            let mut branches = root.branches.clone();
            branches.push(i);
            let density = root.density * branch.density;
            let larger = Tree { order: root.order + branch.order, density, branches };
            graft(trees, i + 1, n, larger, found);
        }
    }
}

/// The elementary weights Φᵢ(τ) of all trees at every stage, from the weights `grafted(Φ(branch), alone)`
/// that a branch hands on to its root, alone there or not.
pub(super) fn elementary_weights(
    trees: &[Tree],
    stages: usize,
    grafted: impl Fn(&[f64], bool) -> Vec<f64>,
) -> Vec<Vec<f64>> {
    let mut weights: Vec<Vec<f64>> = Vec::new();
    for tree in trees {
        let mut product = std::vec![1.0; stages];
        for branch in &tree.branches {
            let handed_on = grafted(&weights[*branch], tree.branches.len() == 1);
            product.iter_mut().zip(handed_on).for_each(|(product, factor)| *product *= factor);
        }
        weights.push(product);
    }
    weights
}

/// The largest |Σ bᵢ Φᵢ(τ) − expected(τ)| over the trees of an order.
pub(super) fn residual(
    trees: &[Tree],
    weights: &[Vec<f64>],
    order: u32,
    b: &[f64],
    expected: impl Fn(&Tree) -> f64,
) -> f64 {
    let of_order = trees.iter().zip(weights).filter(|(tree, _)| tree.order == order);
    of_order
        .map(|(tree, phi)| (b.iter().zip(phi).map(|(b, phi)| b * phi).sum::<f64>() - expected(tree)).abs())
        .fold(0.0, f64::max)
}

/// Holds up to the order, within the round-off of the coefficients, and not beyond it.
pub(super) fn holds_to(order: u32, round_off: f64, residual: impl Fn(u32) -> f64) {
    for n in 1..=order {
        assert!(residual(n) < round_off, "order {n}: {:e}", residual(n));
    }
    assert!(residual(order + 1) > 1e3 * round_off, "order {}: {:e}", order + 1, residual(order + 1));
}

#[test]
fn there_are_as_many_trees_as_there_should_be() {
    let trees = trees(9);
    let count = |n| trees.iter().filter(|tree| tree.order == n).count();
    assert_eq!((1..=9).map(count).collect::<Vec<_>>(), [1, 1, 2, 4, 9, 20, 48, 115, 286]);
}

//! The order conditions of the tables, over all rooted trees
//! (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, theorem II.2.13).

use std::vec;
use std::vec::Vec;

use super::{
    BogackiShampine3, DormandPrince5, DormandPrince8, Euler1, Heun2, Kutta4, Ralston3, Tableau, Tsitouras5,
    Verner9,
};

type Row = (&'static str, f64, Vec<(&'static str, f64)>);

/// A table as data.
pub(super) trait Coefficients: Tableau {
    /// Name, node and row of each stage.
    fn rows() -> Vec<Row>;
    fn weights() -> Vec<(&'static str, f64)>;
    /// The stages without a weight, as the table lists them.
    fn unweighted() -> Vec<&'static str>;
    /// The name of the derivative at the end.
    fn last() -> &'static str;
    /// The stages that only the dense output needs.
    fn extras() -> Vec<Row>;
    /// The rows of the dense output.
    fn bulges() -> Vec<Vec<(&'static str, f64)>>;
}

/// The weights of the error estimates as data.
pub(super) trait ErrorWeights: Coefficients {
    fn errors() -> Vec<Vec<(&'static str, f64)>>;
}

/// Matrix and nodes; further rows for the derivative at the end and the extra stages.
struct Table {
    names: Vec<&'static str>,
    nodes: Vec<f64>,
    rows: Vec<Vec<(usize, f64)>>,
}

impl Table {
    fn of<P: Coefficients>() -> Self {
        let mut table = Self { names: Vec::new(), nodes: Vec::new(), rows: Vec::new() };
        for (name, node, row) in P::rows() {
            table.push(name, node, &row);
        }
        table.push(P::last(), 1.0, &P::weights());
        for (name, node, row) in P::extras() {
            table.push(name, node, &row);
        }
        table
    }
    fn push(&mut self, name: &'static str, node: f64, row: &[(&'static str, f64)]) {
        let row = self.indexed(row);
        self.names.push(name);
        self.nodes.push(node);
        self.rows.push(row);
    }
    fn indexed(&self, row: &[(&'static str, f64)]) -> Vec<(usize, f64)> {
        let index = |name| self.names.iter().position(|n| *n == name).expect("a stage before");
        row.iter().map(|(name, a)| (index(*name), *a)).collect()
    }
}

/// A rooted tree τ: its order, its density γ(τ), and the elementary weights Φᵢ(τ) and Σⱼ aᵢⱼ Φⱼ(τ).
struct Tree {
    order: u32,
    density: f64,
    weights: Vec<f64>,
    grafted: Vec<f64>,
}

/// All rooted trees up to an order.
fn trees(table: &Table, order: u32) -> Vec<Tree> {
    let mut trees = Vec::new();
    for n in 1..=order {
        let mut found = Vec::new();
        let root = Tree { order: 1, density: 1.0, weights: vec![1.0; table.rows.len()], grafted: Vec::new() };
        graft(&trees, trees.len(), n, root, &mut found);
        for mut tree in found {
            tree.density *= f64::from(n);
            let sum = |row: &Vec<(usize, f64)>| row.iter().map(|(j, a)| a * tree.weights[*j]).sum();
            tree.grafted = table.rows.iter().map(sum).collect();
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
            let weights = root.weights.iter().zip(&branch.grafted).map(|(w, g)| w * g).collect();
            let larger = Tree {
                order: root.order + branch.order,
                density: root.density * branch.density,
                weights,
                grafted: Vec::new(),
            };
            graft(trees, i + 1, n, larger, found);
        }
    }
}

/// The largest |Σ bᵢ Φᵢ(τ) − expected(τ)| over trees of an order.
fn residual(trees: &[Tree], order: u32, weights: &[(usize, f64)], expected: impl Fn(&Tree) -> f64) -> f64 {
    trees
        .iter()
        .filter(|tree| tree.order == order)
        .map(|tree| (weights.iter().map(|(i, b)| b * tree.weights[*i]).sum::<f64>() - expected(tree)).abs())
        .fold(0.0, f64::max)
}

/// Holds up to the order, within the round-off of the coefficients, and not beyond it.
fn holds_to(order: u32, round_off: f64, residual: impl Fn(u32) -> f64) {
    for n in 1..=order {
        assert!(residual(n) < round_off, "order {n}: {:e}", residual(n));
    }
    assert!(residual(order + 1) > 1e3 * round_off, "order {}: {:e}", order + 1, residual(order + 1));
}

/// The solution and the dense output have their orders.
fn check<P: Coefficients>(dense_order: u32, round_off: f64) {
    let table = Table::of::<P>();
    for (row, node) in table.rows.iter().zip(&table.nodes) {
        assert!((row.iter().map(|(_, a)| a).sum::<f64>() - node).abs() < round_off);
    }
    assert_eq!(P::rows().len(), P::STAGES as usize);
    let named: Vec<_> = P::weights().iter().map(|(name, _)| *name).collect();
    let unnamed: Vec<_> =
        P::rows().iter().map(|(name, ..)| *name).filter(|name| !named.contains(name)).collect();
    assert_eq!(unnamed, <P as Coefficients>::unweighted());
    let trees = trees(&table, P::ORDER + 1);
    let weights = table.indexed(&P::weights());
    holds_to(P::ORDER, round_off, |n| residual(&trees, n, &weights, |tree| 1.0 / tree.density));
    let last = table.indexed(&[(P::last(), 1.0)])[0].0;
    for s in [0.1, 0.5, 0.8_f64] {
        // the cubic through both ends, and the bulge
        let smooth = s * s * (3.0 - 2.0 * s);
        let mut weights: Vec<_> = weights.iter().map(|(i, b)| (*i, b * smooth)).collect();
        weights.push((0, s * (1.0 - s) * (1.0 - s)));
        weights.push((last, s * s * (s - 1.0)));
        let mut power = (s * (1.0 - s)).powi(2);
        for row in P::bulges() {
            weights.extend(table.indexed(&row).into_iter().map(|(i, d)| (i, d * power)));
            power *= s;
        }
        let powers = |tree: &Tree| s.powi(i32::try_from(tree.order).unwrap()) / tree.density;
        holds_to(dense_order, 10.0 * round_off, |n| residual(&trees, n, &weights, powers));
    }
}

/// The error weights sum to nothing up to their order.
fn check_errors<P: ErrorWeights>(orders: &[u32], round_off: f64) {
    let table = Table::of::<P>();
    for (weights, order) in P::errors().iter().zip(orders) {
        let name = |name| if name == "last" { P::last() } else { name };
        let weights: Vec<_> = weights.iter().map(|(stage, e)| (name(*stage), *e)).collect();
        let weights = table.indexed(&weights);
        let trees = trees(&table, order + 1);
        holds_to(*order, round_off, |n| residual(&trees, n, &weights, |_| 0.0));
    }
}

#[test]
fn there_are_as_many_trees_as_there_should_be() {
    let trees = trees(&Table::of::<Euler1>(), 9);
    let count = |n| trees.iter().filter(|tree| tree.order == n).count();
    assert_eq!((1..=9).map(count).collect::<Vec<_>>(), [1, 1, 2, 4, 9, 20, 48, 115, 286]);
}

#[test]
fn simple_methods_have_their_orders() {
    check::<Euler1>(1, 1e-16);
    check::<Heun2>(2, 1e-15);
    check::<Ralston3>(3, 1e-15);
    check::<Kutta4>(3, 1e-15);
}

#[test]
fn pairs_have_their_orders() {
    check::<BogackiShampine3>(3, 1e-15);
    check_errors::<BogackiShampine3>(&[2], 1e-15);
    check::<DormandPrince5>(4, 1e-13);
    check_errors::<DormandPrince5>(&[4], 1e-14);
    check::<Tsitouras5>(4, 1e-13);
    check_errors::<Tsitouras5>(&[4], 1e-14);
}

#[test]
fn pairs_of_high_order_have_their_orders() {
    check::<DormandPrince8>(7, 1e-13);
    check_errors::<DormandPrince8>(&[5, 3], 1e-13);
    check::<Verner9>(9, 1e-13);
    check_errors::<Verner9>(&[8], 1e-13);
}

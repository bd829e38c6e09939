//! The order conditions of the tables, over all rooted trees
//! (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, theorem II.2.13).

use std::vec;
use std::vec::Vec;

use super::{
    BogackiShampine3, DormandPrince5, DormandPrince8, Euler1, Heun2, Kutta4, Ralston3, Tableau, Tsitouras5,
    Verner9,
};
use crate::methods::trees::{Tree, elementary_weights, holds_to, residual, trees};

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
    /// The elementary weights of trees.
    fn elementary_weights(&self, trees: &[Tree]) -> Vec<Vec<f64>> {
        elementary_weights(trees, self.rows.len(), |phi, _| {
            self.rows.iter().map(|row| row.iter().map(|(j, a)| a * phi[*j]).sum()).collect()
        })
    }
    /// Weights at all stages.
    fn spread(&self, weights: &[(usize, f64)]) -> Vec<f64> {
        let mut spread = vec![0.0; self.rows.len()];
        for (i, b) in weights {
            spread[*i] += b;
        }
        spread
    }
    fn indexed(&self, row: &[(&'static str, f64)]) -> Vec<(usize, f64)> {
        let index = |name| self.names.iter().position(|n| *n == name).expect("a stage before");
        row.iter().map(|(name, a)| (index(*name), *a)).collect()
    }
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
    let trees = trees(P::ORDER + 1);
    let phi = table.elementary_weights(&trees);
    let check = |order: u32, round_off: f64, weights: &[(usize, f64)], expected: &dyn Fn(&Tree) -> f64| {
        let b = table.spread(weights);
        holds_to(order, round_off, |n| residual(&trees, &phi, n, &b, expected));
    };
    let weights = table.indexed(&P::weights());
    check(P::ORDER, round_off, &weights, &|tree| 1.0 / tree.density);
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
        check(dense_order, 10.0 * round_off, &weights, &powers);
    }
}

/// The error weights sum to nothing up to their order.
fn check_errors<P: ErrorWeights>(orders: &[u32], round_off: f64) {
    let table = Table::of::<P>();
    for (weights, order) in P::errors().iter().zip(orders) {
        let name = |name| if name == "last" { P::last() } else { name };
        let weights: Vec<_> = weights.iter().map(|(stage, e)| (name(*stage), *e)).collect();
        let b = table.spread(&table.indexed(&weights));
        let trees = trees(order + 1);
        let phi = table.elementary_weights(&trees);
        holds_to(*order, round_off, |n| residual(&trees, &phi, n, &b, |_| 0.0));
    }
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

/// Where the method leaves the unit disk on y' = λ y, going along the negative real axis.
fn reach<P: Coefficients>() -> f64 {
    let table = Table::of::<P>();
    let stages = P::rows().len();
    let leaves = |z: f64| {
        // the derivative at the end is taken at the solution, which is the row of the weights
        let mut values: Vec<f64> = Vec::new();
        for row in table.rows.iter().take(stages + 1) {
            values.push(1.0 - z * row.iter().map(|(j, a)| a * values[*j]).sum::<f64>());
        }
        values[stages].abs() > 1.0
    };
    let first = (1_u32..10_000).map(|i| f64::from(i) * 1e-3).find(|z| leaves(*z));
    let (mut inside, mut outside) = (first.unwrap() - 1e-3, first.unwrap());
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if leaves(middle) { outside = middle } else { inside = middle }
    }
    inside
}

#[test]
fn steps_are_held_within_the_stable_interval() {
    fn check<P: Coefficients + super::Pair>(stable: f64) {
        let reach = reach::<P>();
        assert!((reach - stable).abs() < 1e-4 && P::HELD < 0.9 * reach, "{:?}: {reach}", P::default());
    }
    // those of the method alone; the error estimate, which is a method too, holds steps back before
    check::<BogackiShampine3>(2.512_75);
    check::<DormandPrince5>(3.306_57);
    check::<Tsitouras5>(3.506_8);
    check::<DormandPrince8>(6.393_65);
    check::<Verner9>(4.476_2);
}

//! The rotations that a matrix is the product of.

use std::collections::BTreeMap;
use std::rc::Rc;

use nonholonomic_core::algebra::Graph;
use nonholonomic_core::id::ExprId;
use nonholonomic_core::limits;
use nonholonomic_core::model::Turn;

use super::array::{Array, Shape};

/// More turns one after the other than joints in a row: products of products of them would be told apart for ever.
pub(super) const MOST: usize = 64;

/// Matrices that are known to be products of rotations about axes.
#[derive(Debug, Default)]
pub(super) struct Rotations {
    pub(super) known: BTreeMap<Vec<ExprId>, Rc<Vec<Turn>>>,
    /// Matrices that are claimed to be rotations, so that the claim stands once.
    pub(super) claimed: Vec<Vec<ExprId>>,
    /// Products of matrices of which nothing is known.
    pub(super) products: BTreeMap<Vec<ExprId>, [Array; 2]>,
    /// The angular velocities of attitudes that an anchor turns, if it does, and whether they are along the axes of the body.
    pub(super) spins: BTreeMap<Vec<ExprId>, Option<(Array, bool)>>,
    /// The rates of products of rotations, along the axes of what they turn.
    pub(super) rates: BTreeMap<Vec<ExprId>, Vec<Turn>>,
    /// Products of rotations whose rates are velocities of the state.
    pub(super) spinning: Vec<(Vec<Turn>, Vec<ExprId>)>,
}

impl Rotations {
    /// A product of two of them is one; so it is with one of them alone, if the other factor is a rotation.
    pub(super) fn multiplied(&mut self, left: &Array, right: &Array, product: &Array) {
        let cube = Shape::Matrix(3, 3);
        if left.shape != cube || right.shape != cube {
            return;
        }
        if [left, right].iter().all(|factor| !self.known.contains_key(&factor.entries)) {
            self.products.insert(product.entries.clone(), [left.clone(), right.clone()]);
            return;
        }
        self.join(left, right, product);
    }

    /// The factors of a product of two rotations.
    pub(super) fn join(&mut self, left: &Array, right: &Array, product: &Array) {
        let known = [left, right].map(|factor| self.known.get(&factor.entries).cloned());
        let turns = known.into_iter().zip([left, right]).flat_map(|(known, factor)| match known {
            Some(turns) => turns.to_vec(),
            None => vec![Turn { matrix: factor.entries.clone(), about: None }],
        });
        let turns: Vec<Turn> = turns.take(MOST + 1).collect();
        limits::spend(turns.len());
        // a product of so many is a matrix like any other
        let turns = if turns.len() > MOST {
            vec![Turn { matrix: product.entries.clone(), about: None }]
        } else {
            turns
        };
        self.known.insert(product.entries.clone(), Rc::new(turns));
    }

    /// How many of the first factors turn as velocities of the state, with these.
    pub(super) fn spinning(&self, turns: &[Turn]) -> Option<(usize, Vec<ExprId>)> {
        let mut known = self.spinning.iter();
        let (factors, rate) = known.find(|(factors, _)| turns.starts_with(factors))?;
        Some((factors.len(), rate.clone()))
    }

    /// The transposed of one is one.
    pub(super) fn transposed(&mut self, graph: &mut Graph, of: &Array, transposed: &Array) {
        let Some(turns) = self.known.get(&of.entries) else { return };
        let back = turns.iter().rev().map(|turn| Turn {
            matrix: (0..9).map(|k| turn.matrix[3 * (k % 3) + k / 3]).collect(),
            about: turn.about.as_ref().map(|(axis, angle)| (axis.clone(), graph.formula(-angle))),
        });
        let back = Rc::new(back.collect());
        self.known.insert(transposed.entries.clone(), back);
    }
}

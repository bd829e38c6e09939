//! The rotations that a matrix is the product of.

use std::collections::BTreeMap;
use std::rc::Rc;

use nonholonomic_core::algebra::Graph;
use nonholonomic_core::id::ExprId;
use nonholonomic_core::limits;
use nonholonomic_core::model::Turn;

use super::array::{Array, Shape};

/// More turns one after the other than joints in a row: products of products of them would be told apart for ever.
const MOST: usize = 64;

/// Matrices that are known to be products of rotations about axes.
#[derive(Debug, Default)]
pub(super) struct Rotations {
    pub(super) known: BTreeMap<Vec<ExprId>, Rc<Vec<Turn>>>,
    /// Matrices that are claimed to be rotations, so that the claim stands once.
    pub(super) claimed: Vec<Vec<ExprId>>,
}

impl Rotations {
    /// A product of two of them is one; so it is with one of them alone, if the other factor is a rotation.
    pub(super) fn multiplied(&mut self, left: &Array, right: &Array, product: &Array) {
        let cube = Shape::Matrix(3, 3);
        let known = [left, right].map(|factor| self.known.get(&factor.entries).cloned());
        if known.iter().all(Option::is_none) || left.shape != cube || right.shape != cube {
            return;
        }
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

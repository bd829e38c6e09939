//! Points of an embedded base: a form that is right where a quaternion has length 1, say, need not be so elsewhere.

use super::proof::{Defect, has_branches};
use crate::algebra::{Degrees, FieldPass, FieldPoint, Graph};
use crate::id::{ExprId, SymbolId};
use std::rc::Rc;

/// Where the points of proofs lie.
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    /// Coordinates as rational functions of others, and of parameters of a chart.
    images: Rc<[(SymbolId, ExprId)]>,
    division: i64,
}

impl Ground {
    /// The whole of what the base is embedded in.
    pub(crate) fn whole(division: i64) -> Self {
        Self { images: [].into(), division }
    }

    /// The base; `None` where it is no other than the whole, or where there are functions with branches, which are not
    /// followed from one to the other.
    pub(crate) fn base(graph: &Graph, roots: &[ExprId], division: i64) -> Option<Self> {
        let images = graph.embedded();
        (!images.is_empty() && !has_branches(graph, roots)).then_some(Self { images, division })
    }

    /// How angles are divided.
    pub(crate) fn division(&self) -> i64 {
        self.division
    }

    /// The point of it that belongs to one of the whole.
    pub(crate) fn point(&self, graph: &Graph, mut point: FieldPoint) -> Result<FieldPoint, Defect> {
        if !self.images.is_empty() {
            let values: Vec<ExprId> = self.images.iter().map(|(_, image)| *image).collect();
            let values = FieldPass::new(graph, point.clone(), self.division).evaluate(&values)?;
            point.chosen.extend(self.images.iter().map(|(symbol, _)| *symbol).zip(values));
        }
        Ok(point)
    }

    /// What degrees in coordinates are multiplied by in those of the chart: no image has another denominator than
    /// all of them together.
    pub(crate) fn degree(&self, graph: &Graph) -> f64 {
        let mut degrees = Degrees::new(graph, self.division);
        1.0 + self.images.iter().map(|(_, image)| degrees.most(&[*image])).sum::<f64>()
    }

    /// The symbols that a function of the base varies with, in place of these.
    pub(crate) fn variables(&self, graph: &Graph, symbols: Vec<SymbolId>) -> Vec<SymbolId> {
        let mut found = Vec::new();
        for symbol in symbols {
            match self.images.iter().find(|(known, _)| *known == symbol) {
                Some((_, image)) => found.extend(graph.symbols_in(&[*image])),
                None => found.push(symbol),
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}

//! Vectors and matrices of expressions, with the procedure that names them.

use crate::algebra::{Graph, Node, Rational};
use crate::id::ExprId;
use crate::mechanics::Procedure;
use rustc_hash::FxHashMap;

/// Three components.
pub(super) type Vector = [ExprId; 3];
/// Three rows.
pub(super) type Square = [Vector; 3];

/// Where formulas in vectors are written, one intermediate result after the other.
pub(super) struct Sheet<'g> {
    pub(super) graph: &'g mut Graph,
    pub(super) procedure: Procedure,
    names: FxHashMap<ExprId, ExprId>,
}

impl<'g> Sheet<'g> {
    pub(super) fn new(graph: &'g mut Graph) -> Self {
        Self { graph, procedure: Procedure::default(), names: FxHashMap::default() }
    }

    pub(super) fn zero(&mut self) -> Vector {
        [self.graph.zero(); 3]
    }

    /// A value as an intermediate result, unless it is a symbol or a number. Equal ones have one name, and a number in
    /// front stays there, so that what bodies on both sides have of each other cancels.
    pub(super) fn named(&mut self, name: &str, value: ExprId) -> ExprId {
        let (base, number) = match self.graph.node(value) {
            Node::Product { factors, coefficient } if !coefficient.is_one() => {
                let (factors, coefficient) = (factors.clone(), coefficient.clone());
                (self.graph.product(&factors), coefficient)
            }
            _ => (value, Rational::ONE),
        };
        let known = self.names.get(&base).copied();
        let symbol = known.unwrap_or_else(|| self.procedure.define(self.graph, name, base));
        self.names.insert(base, symbol);
        self.graph.scale(number, symbol)
    }

    pub(super) fn named_all(&mut self, name: &str, values: Vector) -> Vector {
        values.map(|value| self.named(name, value))
    }

    pub(super) fn is_zero(&self, values: &Vector) -> bool {
        values.iter().all(|value| self.graph.is_literal_zero(*value))
    }

    pub(super) fn sum(&mut self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|k| self.graph.formula(a[k] + b[k]))
    }

    pub(super) fn difference(&mut self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|k| self.graph.formula(a[k] - b[k]))
    }

    pub(super) fn scaled(&mut self, factor: ExprId, a: Vector) -> Vector {
        a.map(|entry| self.graph.formula(factor * entry))
    }

    pub(super) fn dot(&mut self, a: &Vector, b: &Vector) -> ExprId {
        self.graph.inner_product(a, b)
    }

    pub(super) fn cross(&mut self, a: &Vector, b: &Vector) -> Vector {
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            self.graph.formula(a[i] * b[j] - a[j] * b[i])
        })
    }

    /// A u.
    pub(super) fn image(&mut self, a: &Square, u: &Vector) -> Vector {
        std::array::from_fn(|k| self.dot(&a[k], u))
    }

    /// û, with û w = u × w.
    pub(super) fn hat(&mut self, u: &Vector) -> Square {
        let zero = self.graph.zero();
        let minus = u.map(|entry| self.graph.formula(-entry));
        [[zero, minus[2], u[1]], [u[2], zero, minus[0]], [minus[1], u[0], zero]]
    }

    pub(super) fn simplified(&mut self, values: Vector) -> Vector {
        values.map(|value| self.graph.simplify(value))
    }
}

/// Aᵀ.
pub(super) fn transposed(a: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// With the upper triangle in place of the lower one, too.
pub(super) fn mirrored(a: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i.min(j)][i.max(j)]))
}

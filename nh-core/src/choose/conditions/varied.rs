//! Lines through the field along which one thing varies: a symbol, its sine and cosine, or its exponential. These are
//! algebraically independent, so that what has no factor of its own along any of them has none.

use super::super::proof::{FIRST_SEED, defined};
use crate::algebra::{FieldPoint, Function, Graph, Node, Residue};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;

/// What a divisor is a function of, all else at rest.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Varied {
    Value(SymbolId),
    Angle(SymbolId),
    Exponential(SymbolId),
}

/// The symbols that stand in functions.
pub(super) struct Arguments {
    /// In any.
    angles: Vec<SymbolId>,
    /// In exponentials, those aside that have values of definitions.
    exponents: Vec<SymbolId>,
}

impl Arguments {
    /// Of a procedure, and exponentials of what may not vanish as well.
    pub(super) fn of(graph: &Graph, procedure: &Procedure, declared: &[ExprId]) -> Self {
        let own = procedure.expressions();
        let is_any = |_: Function| true;
        let is_exponential = |function: Function| {
            matches!(function, Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh)
        };
        let named = defined(procedure);
        let mut exponents = arguments(graph, &[&own, declared].concat(), is_exponential);
        exponents.retain(|symbol| !named.contains(symbol));
        Self { angles: arguments(graph, &own, is_any), exponents }
    }

    /// The ways in which a symbol occurs.
    pub(super) fn ways(&self, symbol: SymbolId) -> impl Iterator<Item = Varied> {
        let angle = self.angles.contains(&symbol).then_some(Varied::Angle(symbol));
        let exponential = self.exponents.contains(&symbol).then_some(Varied::Exponential(symbol));
        [Some(Varied::Value(symbol)), angle, exponential].into_iter().flatten()
    }
}

/// The symbols in the arguments of functions of a kind.
fn arguments(graph: &Graph, roots: &[ExprId], is_of_kind: impl Fn(Function) -> bool) -> Vec<SymbolId> {
    let arguments = graph.reachable(roots).into_iter().filter_map(|id| match graph.node(id) {
        Node::Apply(function, x) if is_of_kind(*function) => Some(*x),
        _ => None,
    });
    graph.symbols_in(&arguments.collect::<Vec<_>>())
}

impl Varied {
    /// A point where symbols in functions have chosen places on the circle, and exponentials; the varied one is t.
    pub(super) fn point(self, arguments: &Arguments, t: Residue, seed: u64) -> FieldPoint {
        let mut point = FieldPoint::random(FIRST_SEED - 1 - seed);
        for (k, angle) in arguments.angles.iter().enumerate() {
            let word = Residue::mixed(1_777 + seed, k as u64);
            let u = if matches!(self, Self::Angle(symbol) if symbol == *angle) { t } else { word };
            if let Some(scale) = (Residue::ONE + u * u).inverse() {
                point.circle.insert(*angle, ((Residue::ONE - u * u) * scale, (u + u) * scale));
            }
        }
        for (k, exponent) in arguments.exponents.iter().enumerate() {
            let word = Residue::mixed(2_777 + seed, k as u64);
            let is_varied = matches!(self, Self::Exponential(symbol) if symbol == *exponent);
            point.exponentials.insert(*exponent, if is_varied { t } else { word });
        }
        if let Self::Value(symbol) = self {
            point.chosen.insert(symbol, t);
        }
        point
    }
}

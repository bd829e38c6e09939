//! Where a factor of a product vanishes with another one, and to which order.

use crate::algebra::{Graph, Rational};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use std::cmp::Ordering;

/// How an order compares with another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Same,
    Higher,
}

/// Derivatives that are looked at.
const MOST: i64 = 6;

/// The order to which a function vanishes wherever `inner` does, if it is not lower than `size`.
pub(super) fn order_at_zeros(
    graph: &mut Graph,
    function: ExprId,
    inner: ExprId,
    size: &Rational,
    parameters: &[SymbolId],
) -> Option<Order> {
    let symbols = graph.symbols_in(&[inner]);
    let moving: Vec<SymbolId> = symbols.into_iter().filter(|symbol| !parameters.contains(symbol)).collect();
    let along = *moving.iter().find(|symbol| {
        let slope = graph.partial(inner, **symbol);
        graph.zero_test(slope).is_nonzero()
    })?;
    let zeros = Manifold::where_zero(graph, &[inner], &moving).ok()?;
    let mut derivative = function;
    for order in 0..=MOST {
        let reached = Rational::from(order);
        let there = zeros.restrict(graph, derivative);
        if graph.is_undefined(there) || !zeros.zero_test(graph, derivative).is_zero() {
            return match reached.cmp(size) {
                Ordering::Less => None,
                Ordering::Equal => Some(Order::Same),
                Ordering::Greater => Some(Order::Higher),
            };
        }
        derivative = graph.partial(derivative, along);
    }
    (*size <= Rational::from(MOST)).then_some(Order::Higher)
}

//! Coordinates that lie on a circle, by its angle: on a circle what touches 0 at one point does so across a whole
//! hypersurface of the base.

use crate::algebra::{Graph, Node, Rational, Substitution};
use crate::id::{ExprId, SymbolId};
use crate::model::Model;

/// Puts r cos φ and r sin φ, of new symbols φ, in the place of coordinates x, y with x² + y² = r² for one of the functions
/// that vanish on the base, r² being a number or of parameters; no circle takes a coordinate of another.
pub(super) fn by_angles(model: &mut Model, vanishing: &[ExprId]) -> Vec<(SymbolId, ExprId)> {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut model.graph;
    let mut images: Vec<(SymbolId, ExprId)> = Vec::new();
    for function in vanishing {
        let symbols = graph.symbols_in(&[*function]);
        let (bound, others): (Vec<SymbolId>, Vec<SymbolId>) =
            symbols.into_iter().partition(|symbol| coordinates.contains(symbol));
        let [x, y] = bound[..] else { continue };
        let is_taken = images.iter().any(|(known, _)| *known == x || *known == y);
        if is_taken || !others.iter().all(|symbol| parameters.contains(symbol)) {
            continue;
        }
        let Some(radius) = radius(graph, *function, [x, y]) else { continue };
        // the name says in texts which angle it is
        let name = format!("atan2({}, {})", graph.symbols()[y], graph.symbols()[x]);
        let angle = graph.new_symbol(name);
        let angle = graph.symbol(angle);
        let (cosine, sine) = (graph.cos(angle), graph.sin(angle));
        let (first, second) = (graph.formula(radius * cosine), graph.formula(radius * sine));
        images.extend([(x, first), (y, second)]);
    }
    images
}

/// r, where a function of x and y is k (x² + y² − r²) for a k without them.
fn radius(graph: &mut Graph, function: ExprId, [x, y]: [SymbolId; 2]) -> Option<ExprId> {
    let slopes = [x, y].map(|symbol| graph.partial(function, symbol));
    let twice = graph.partial(slopes[0], x);
    let zero = graph.number(0);
    let at_origin = Substitution::new([(x, zero), (y, zero)]).apply(graph, function);
    let [ex, ey] = [x, y].map(|symbol| graph.symbol(symbol));
    let squares = graph.formula(ex * ex + ey * ey);
    let rest = graph.formula(function - at_origin - twice * squares / 2);
    let is_of_both = graph.symbols_in(&[twice]).iter().any(|symbol| *symbol == x || *symbol == y);
    if is_of_both || graph.zero_test(twice).is_zero() || !graph.zero_test(rest).is_zero() {
        return None;
    }
    let square = graph.formula(-at_origin * 2 / twice);
    let square = graph.simplify(square);
    Some(root(graph, square))
}

/// A root of a square, of either sign: an angle may be counted from the other side.
fn root(graph: &mut Graph, square: ExprId) -> ExprId {
    let Node::Product { coefficient, factors } = graph.node(square).clone() else {
        return graph.sqrt(square);
    };
    let halved: Vec<(ExprId, Rational)> =
        factors.iter().map(|(base, exponent)| (*base, exponent.clone() * Rational::new(1, 2))).collect();
    let (number, rest) = (graph.number(coefficient), graph.product(&halved));
    let number = graph.sqrt(number);
    graph.formula(number * rest)
}

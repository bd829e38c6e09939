//! What vanishes where position constraints hold that are solved for no coordinate, as `sin(x) = 0` is: they give the value
//! of a function, whatever its argument is.

use crate::algebra::{Function, Graph, Node, Rational, Substitution};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};

/// The largest multiple of an angle that is written in sines and cosines of the angle.
const MULTIPLE: i64 = 8;

/// Whether an expression vanishes wherever the unsolved functions do, by the values that these give to functions in them.
/// `false` says nothing.
pub(super) fn vanishes_where_unsolved(
    graph: &mut Graph,
    value: ExprId,
    (manifold, unsolved): (&Manifold, &[ExprId]),
) -> bool {
    manifold.parts().all(|part| {
        let value = part.restrict(graph, value);
        let unsolved: Vec<ExprId> = unsolved.iter().map(|function| part.restrict(graph, *function)).collect();
        ways(graph, &unsolved, value).into_iter().all(|mut way| {
            let value = way.apply(graph, value);
            graph.zero_test(value).is_zero()
        })
    })
}

/// Substitutions of which one holds at each point where the functions vanish.
fn ways(graph: &mut Graph, functions: &[ExprId], value: ExprId) -> Vec<Substitution> {
    let mut ways = vec![Substitution::new([])];
    for function in functions {
        let Some((node, given)) = given_value(graph, *function) else { continue };
        let angle = match *graph.node(node) {
            Node::Apply(kind @ (Function::Sin | Function::Cos), x) => {
                graph.as_symbol(x).map(|symbol| (symbol, kind))
            }
            _ => None,
        };
        let Some((symbol, kind)) = angle else {
            for way in &mut ways {
                way.insert_node(node, given);
            }
            continue;
        };
        // the other one of sine and cosine, with both signs
        let one = graph.one();
        let root = graph.formula((one - given.square()).sqrt());
        let mut both = Vec::new();
        for way in ways {
            for other in [root, graph.formula(-root)] {
                let (cos, sin) = if kind == Function::Sin { (other, given) } else { (given, other) };
                let mut way = way.clone();
                insert_multiples(graph, &mut way, (symbol, value), (cos, sin));
                both.push(way);
            }
        }
        ways = both;
    }
    ways
}

/// The only function in a sum that is neither in the rest of it nor multiplied by anything but a number, and the value that
/// it has where the sum vanishes.
fn given_value(graph: &mut Graph, function: ExprId) -> Option<(ExprId, ExprId)> {
    let terms: Vec<(ExprId, Rational)> = match graph.node(function) {
        Node::Sum { terms, .. } => terms.to_vec(),
        _ => vec![(function, Rational::ONE)],
    };
    terms.into_iter().find_map(|(term, factor)| {
        let Node::Apply(..) = graph.node(term) else { return None };
        let rest = graph.linear_combination(&[(Rational::ONE, function), (-factor.clone(), term)]);
        let own = graph.symbols_in(&[term]);
        let is_apart = !graph.depends_on(rest, &own);
        is_apart.then(|| Some((term, graph.scale(-factor.recip()?, rest)))).flatten()
    })
}

/// Puts the values of sines and cosines of multiples of an angle that occur for them.
fn insert_multiples(
    graph: &mut Graph,
    way: &mut Substitution,
    (symbol, value): (SymbolId, ExprId),
    (cos, sin): (ExprId, ExprId),
) {
    let angle = graph.symbol(symbol);
    let (mut cos_of, mut sin_of) = (cos, sin);
    let occurring = graph.reachable(&[value]);
    for multiple in 1..=MULTIPLE {
        let of = graph.scale(Rational::from(multiple), angle);
        for (function, image) in [(Function::Cos, cos_of), (Function::Sin, sin_of)] {
            let node = graph.apply(function, of);
            if occurring.contains(&node) {
                way.insert_node(node, image);
            }
        }
        // the addition theorems
        (cos_of, sin_of) =
            (graph.formula(cos_of * cos - sin_of * sin), graph.formula(sin_of * cos + cos_of * sin));
    }
}

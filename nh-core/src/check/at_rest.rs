//! Roots of forces that have no slope where they vanish, while the forces have one: the drag `-c*|v|*v` at rest.

use super::declared::differentiated;
use crate::algebra::{Facts, Graph, Node, Rational, Substitution};
use crate::id::ExprId;
use crate::model::Model;

/// Whether the derivatives of the equations have values where an expression vanishes of which roots are taken: it is
/// a sum of squares, its root stands in forces and rates of auxiliary states alone, and what is multiplied by the root in them
/// vanishes with it. Accelerations are linear in the forces, so that the same holds of them.
pub(super) fn has_slopes_at_rest(model: &mut Model, facts: &Facts, square: ExprId) -> bool {
    let Some(small) = squared(&model.graph, square, facts) else { return false };
    let mut elsewhere: Vec<ExprId> = differentiated(model).into_iter().map(|(_, value, _)| value).collect();
    elsewhere.push(model.lagrangian.value);
    elsewhere.extend(&model.shortened);
    if has_root(&model.graph, &elsewhere, square) {
        return false;
    }
    let forces = model.forces.iter().map(|force| force.value);
    let given: Vec<ExprId> = forces.chain(model.auxiliary.iter().map(|state| state.value)).collect();
    let graph = &mut model.graph;
    given
        .into_iter()
        .all(|value| !has_root(graph, &[value], square) || vanishes(graph, value, square, &small))
}

/// The bases of a sum of squares, each times what is positive.
fn squared(graph: &Graph, expression: ExprId, facts: &Facts) -> Option<Vec<ExprId>> {
    let single = [(expression, Rational::ONE)];
    let (constant, terms) = match graph.node(expression) {
        Node::Sum { constant, terms } => (constant.clone(), terms.iter().cloned().collect::<Vec<_>>()),
        _ => (Rational::ZERO, single.to_vec()),
    };
    let base = |term: ExprId| {
        let mut found = None;
        for (base, exponent) in graph.factors(term) {
            let range = graph.range(base, facts);
            let is_even = exponent.is_integer() && !exponent.has_odd_numerator();
            if range.is_positive() || (is_even && range.nonzero) {
                continue;
            }
            if exponent != Rational::from(2) || found.is_some() {
                return None;
            }
            found = Some(base);
        }
        found
    };
    if !constant.is_zero() {
        return None;
    }
    terms.into_iter().map(|(term, factor)| if factor.is_negative() { None } else { base(term) }).collect()
}

/// Whether roots of an expression are taken.
fn has_root(graph: &Graph, values: &[ExprId], square: ExprId) -> bool {
    graph.reachable(values).into_iter().any(|id| match graph.node(id) {
        Node::Product { factors, .. } => {
            factors.iter().any(|(base, exponent)| *base == square && !exponent.is_integer())
        }
        _ => false,
    })
}

/// Whether ∂value/∂√s is 0 where s and what it is a sum of squares of are.
fn vanishes(graph: &mut Graph, value: ExprId, square: ExprId, small: &[ExprId]) -> bool {
    let name = graph.free_name("s");
    let symbol = graph.new_symbol(name);
    let s = graph.symbol(symbol);
    let mut in_s = Substitution::new([]);
    in_s.insert_node(square, s);
    let value = in_s.apply(graph, value);
    let by_s = graph.partial(value, symbol);
    let root = graph.sqrt(s);
    let by_root = graph.formula(by_s * root);
    if graph.divisors(&[by_root]).contains(&s) {
        return false;
    }
    let zero = graph.zero();
    let mut at_rest = Substitution::new([(symbol, zero)]);
    for base in small {
        at_rest.insert_node(*base, zero);
    }
    let rest = at_rest.apply(graph, by_root);
    graph.zero_test(rest).is_zero()
}

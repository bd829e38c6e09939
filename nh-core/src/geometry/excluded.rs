//! Whether what holds excludes that functions vanish together.

use crate::algebra::{Demand, Function, Graph, Node, Substitution};
use crate::id::ExprId;

/// Whether no real point satisfies what holds where all functions are 0.
pub(crate) fn is_excluded(graph: &mut Graph, holding: &[(ExprId, Demand)], functions: &[ExprId]) -> bool {
    let mut demands = graph.related_demands(holding, functions);
    // what is known of parameters alone is in the facts
    if !demands.iter().any(|(_, demand)| *demand == Demand::Zero) {
        return false;
    }
    demands.extend(functions.iter().map(|function| (*function, Demand::Zero)));
    if graph.contradiction(&demands).is_some() {
        return true;
    }
    // a symbol that is 0 is put into all the rest anyway
    let is_sum = |function: &ExprId| matches!(graph.node(*function), Node::Sum { .. });
    let solved = if functions.iter().any(is_sum) { without_solved(graph, &demands, functions) } else { None };
    if solved.is_some_and(|solved| graph.contradiction(&solved).is_some()) {
        return true;
    }
    let cases = cases_of_circles(graph, functions);
    cases.len() > 1
        && cases.into_iter().all(|case| graph.contradiction(&[demands.clone(), case].concat()).is_some())
}

/// The demands where functions that contain a symbol with a number for coefficient are solved for it; `None` where none does.
fn without_solved(
    graph: &mut Graph,
    demands: &[(ExprId, Demand)],
    functions: &[ExprId],
) -> Option<Vec<(ExprId, Demand)>> {
    let (mut left, mut found) = (demands.to_vec(), false);
    let mut open = functions.to_vec();
    while let Some(function) = open.pop() {
        let solution = graph.symbols_in(&[function]).into_iter().find_map(|symbol| {
            let form = graph.linear_form(function, &[symbol]).ok()?;
            let coefficient = form.coefficients[0];
            let is_number = graph.as_number(coefficient).is_some_and(|number| !number.is_zero());
            is_number.then(|| (symbol, graph.formula(-form.rest / coefficient)))
        });
        let Some(solution) = solution else { continue };
        found = true;
        let mut substitution = Substitution::new([solution]);
        for other in &mut open {
            *other = substitution.apply(graph, *other);
        }
        for (other, _) in &mut left {
            *other = substitution.apply(graph, *other);
        }
    }
    found.then_some(left)
}

/// What holds besides where functions vanish, one case or the other: where a cosine is 0 the sine is 1 or −1.
fn cases_of_circles(graph: &mut Graph, functions: &[ExprId]) -> Vec<Vec<(ExprId, Demand)>> {
    const CIRCLES: usize = 3;
    let partners = functions.iter().filter_map(|id| match graph.node(*id) {
        Node::Apply(Function::Sin, angle) => Some((Function::Cos, *angle)),
        Node::Apply(Function::Cos, angle) => Some((Function::Sin, *angle)),
        _ => None,
    });
    let partners: Vec<(Function, ExprId)> = partners.take(CIRCLES).collect();
    let one = graph.one();
    let mut cases = vec![Vec::new()];
    for (function, angle) in partners {
        let partner = graph.apply(function, angle);
        let ends = [graph.formula(partner - one), graph.formula(partner + one)];
        let with = |case: &Vec<(ExprId, Demand)>| {
            ends.map(|end| case.iter().copied().chain([(end, Demand::Zero)]).collect::<Vec<_>>())
        };
        cases = cases.iter().flat_map(with).collect();
    }
    cases
}

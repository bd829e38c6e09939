//! Declared expressions in jets.

use ::f256::{consts::PI, f256};
use nonholonomic_core::algebra::{Function, Graph, Node};
use nonholonomic_core::id::{ExprId, SymbolId};
use std::collections::BTreeMap;

use crate::jet::Jet;
use crate::numbers::exact;

/// The values of expressions; NaN where the reference has no such function.
pub(crate) fn evaluate(
    graph: &Graph,
    roots: &[ExprId],
    variables: usize,
    value: impl Fn(SymbolId) -> Jet,
) -> Vec<Jet> {
    let mut known: BTreeMap<ExprId, Jet> = BTreeMap::new();
    let constant = |value: f256| Jet::constant(value, variables);
    for id in graph.reachable(roots) {
        let jet = match graph.node(id) {
            Node::Number(number) => constant(exact(number)),
            Node::Pi => constant(PI),
            Node::Constant(index) => constant(exact(&graph.constants()[*index].value)),
            Node::Symbol(symbol) => value(*symbol),
            Node::Sum { constant: number, terms } => {
                let mut sum = constant(exact(number));
                for (term, coefficient) in terms.iter() {
                    sum.add_scaled(exact(coefficient), &known[term]);
                }
                sum
            }
            Node::Product { coefficient, factors } => {
                let mut product = constant(exact(coefficient));
                for (factor, exponent) in factors.iter() {
                    product = product.times(&known[factor].power(exponent));
                }
                product
            }
            Node::Apply(function, x) => apply(*function, &known[x]).unwrap_or_else(|| constant(f256::NAN)),
            Node::Apply2(..) => constant(f256::NAN),
        };
        known.insert(id, jet);
    }
    roots.iter().map(|root| known[root].clone()).collect()
}

fn apply(function: Function, x: &Jet) -> Option<Jet> {
    let [sin, cos] = match function {
        Function::Sin | Function::Cos => x.sin_cos(),
        Function::Exp => return Some(x.exponential()),
        Function::Ln => return Some(x.logarithm()),
        Function::Atan => return Some(x.atan()),
        _ => return None,
    };
    Some(if function == Function::Sin { sin } else { cos })
}

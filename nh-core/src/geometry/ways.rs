//! Simpler functions one of which vanishes where another does.

use crate::algebra::{Demand, Function, Graph, Node, Rational};
use crate::id::{ExprId, SymbolId};

/// Functions one of which vanishes where another does.
pub(super) struct Ways {
    pub(super) functions: Vec<ExprId>,
    /// Whether it vanishes wherever one of them does.
    pub(super) is_exact: bool,
}

/// A product vanishes where a factor does, and `F(u) = c` says `u = F⁻¹(c)`.
pub(super) fn ways_to_vanish(graph: &mut Graph, function: ExprId, unknowns: &[SymbolId]) -> Option<Ways> {
    let simple = graph.simplify(function);
    [function, simple].into_iter().find_map(|form| {
        let Node::Product { factors, .. } = graph.node(form).clone() else {
            return argument(graph, form, unknowns);
        };
        let varying = factors
            .iter()
            .filter(|(base, exponent)| !exponent.is_negative() && graph.depends_on(*base, unknowns));
        let bases: Vec<ExprId> = varying.map(|(base, _)| *base).collect();
        // factors that vanish nowhere have no part
        let some: Vec<ExprId> = bases
            .iter()
            .copied()
            .filter(|base| graph.contradiction(&[(*base, Demand::Zero)]).is_none())
            .collect();
        let is_simpler = some.len() > 1 || some.len() < bases.len();
        (is_simpler && !some.is_empty()).then_some(Ways { functions: some, is_exact: true })
    })
}

/// The argument of the only function of unknowns in a sum, less the value that the function takes there.
fn argument(graph: &mut Graph, function: ExprId, unknowns: &[SymbolId]) -> Option<Ways> {
    let terms: Vec<(ExprId, Rational)> = match graph.node(function) {
        Node::Sum { terms, .. } => terms.to_vec(),
        _ => vec![(function, Rational::ONE)],
    };
    terms.iter().find_map(|(term, factor)| {
        if !graph.depends_on(*term, unknowns) {
            return None;
        }
        let rest = graph.linear_combination(&[(Rational::ONE, function), (-factor.clone(), *term)]);
        // a root may be left of the rest
        if matches!(graph.node(*term), Node::Apply(..)) && graph.depends_on(rest, unknowns) {
            return None;
        }
        let value = graph.scale(-factor.recip()?, rest);
        let (argument, value) = inverse(graph, *term, value)?;
        let mut functions = vec![graph.formula(argument - value)];
        // an even function has each value twice
        if is_even(graph, *term) {
            functions.push(graph.formula(argument + value));
        }
        Some(Ways { functions, is_exact: false })
    })
}

fn is_even(graph: &Graph, term: ExprId) -> bool {
    match graph.node(term) {
        Node::Apply(Function::Cosh, _) => true,
        Node::Product { factors, .. } => factors.iter().any(|(_, exponent)| !exponent.has_odd_numerator()),
        _ => false,
    }
}

/// `u` and `F⁻¹(c)` for an invertible function `F(u)` with the value c.
fn inverse(graph: &mut Graph, term: ExprId, value: ExprId) -> Option<(ExprId, ExprId)> {
    Some(match graph.node(term).clone() {
        Node::Apply(Function::Exp, u) => (u, graph.apply(Function::Ln, value)),
        Node::Apply(Function::Ln, u) => (u, graph.apply(Function::Exp, value)),
        Node::Apply(Function::Asin, u) => (u, graph.sin(value)),
        Node::Apply(Function::Acos, u) => (u, graph.cos(value)),
        Node::Apply(Function::Atan, u) => (u, graph.tan(value)),
        Node::Apply(function @ (Function::Sinh | Function::Cosh), u) => {
            let one = if function == Function::Sinh { graph.one() } else { graph.number(-1) };
            let root = graph.formula((value.square() + one).sqrt());
            let exponential = graph.formula(value + root);
            (u, graph.apply(Function::Ln, exponential))
        }
        Node::Apply(Function::Tanh, u) => {
            let one = graph.one();
            let ratio = graph.formula((one + value) / (one - value));
            let twice = graph.apply(Function::Ln, ratio);
            (u, graph.scale(Rational::new(1, 2), twice))
        }
        Node::Product { coefficient, factors } => {
            let [(base, exponent)] = &factors[..] else { return None };
            if exponent.is_negative() || (exponent.is_integer() && graph.as_symbol(*base).is_some()) {
                return None;
            }
            let (base, degree) = (*base, exponent.recip()?);
            let value = graph.scale(coefficient.recip()?, value);
            (base, graph.pow(value, degree))
        }
        _ => return None,
    })
}

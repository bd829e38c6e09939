//! Every declared expression is defined, and smooth where it is differentiated.

use super::evidence::shown;
use crate::algebra::{Facts, Function, Function2, Graph, Node};
use crate::id::{ExprId, Origin};
use crate::model::{Kinematics, Model};
use crate::violation::{Law, Violation};

/// No division by the number 0, no root or logarithm of what is never positive; no `abs`, `sign`, `min` or `max` in the Lagrangian, the
/// constraints, the anchor or the brackets.
#[must_use]
pub fn declared_expressions(model: &Model) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (what, value, origin) in differentiated(model) {
        violations.extend(undefined(&model.graph, what, value, origin));
        violations.extend(nowhere_real(&model.graph, what, value, origin));
        violations.extend(not_smooth(&model.graph, what, value, origin));
    }
    let forces = model.forces.iter().map(|force| ("force", force.value, force.origin));
    let outputs = model.outputs.iter().map(|output| ("output", output.value, output.origin));
    for (what, value, origin) in forces.chain(outputs) {
        violations.extend(undefined(&model.graph, what, value, origin));
        violations.extend(nowhere_real(&model.graph, what, value, origin));
    }
    violations
}

/// The expressions that are differentiated.
pub(super) fn differentiated(model: &Model) -> Vec<(&'static str, ExprId, Origin)> {
    let mut list = vec![("Lagrangian", model.lagrangian.value, model.lagrangian.origin)];
    list.extend(model.constraints.iter().map(|c| ("constraint", c.residual, c.origin)));
    list.extend(model.brackets.iter().map(|b| ("bracket", b.value, b.origin)));
    match &model.kinematics {
        Kinematics::Tangent => {}
        Kinematics::Anchor(lines) => list.extend(lines.iter().map(|line| ("anchor", line.rate, line.origin))),
        Kinematics::Coframe(rows) => list.extend(rows.iter().map(|row| ("velocity", row.value, row.origin))),
    }
    list
}

fn undefined(graph: &Graph, what: &str, value: ExprId, origin: Origin) -> Option<Violation> {
    graph.is_undefined(value).then(|| Violation {
        law: Law::Defined,
        origin,
        what: format!("this {what} is not defined: it divides by zero, or takes ln(0)"),
        evidence: shown(graph, value),
        way_out: "a denominator or an argument is 0 after simplification; write one that is not".into(),
    })
}

/// A root of something negative everywhere, a logarithm of something positive nowhere, an `asin` or
/// `acos` of something beyond 1.
fn nowhere_real(graph: &Graph, what: &str, value: ExprId, origin: Origin) -> Option<Violation> {
    let range = |argument: ExprId| graph.range(argument, &Facts::default());
    let evidence = graph.reachable(&[value]).into_iter().find_map(|id| match graph.node(id) {
        Node::Product { factors, .. } => {
            let (base, exponent) = factors
                .iter()
                .find(|(base, exponent)| !exponent.is_integer() && (range(*base).high < 0.0))?;
            Some(format!("{} is negative, and is raised to the power {exponent}", shown(graph, *base)))
        }
        Node::Apply(Function::Ln, argument) if range(*argument).high < 0.0 => {
            Some(format!("{} is negative, and has no logarithm", shown(graph, *argument)))
        }
        Node::Apply(function @ (Function::Asin | Function::Acos), argument)
            if range(*argument).low > 1.0 || range(*argument).high < -1.0 =>
        {
            Some(format!("`{}` takes values from -1 to 1, not {}", function.name(), shown(graph, *argument)))
        }
        _ => None,
    })?;
    Some(Violation {
        law: Law::Defined,
        origin,
        what: format!("this {what} has no real value anywhere"),
        evidence,
        way_out: "correct the sign, or the range; a real odd root of -x is written `-(x^(1/3))`".into(),
    })
}

fn not_smooth(graph: &Graph, what: &str, value: ExprId, origin: Origin) -> Option<Violation> {
    let name = graph.reachable(&[value]).into_iter().find_map(|id| match graph.node(id) {
        Node::Apply(function @ (Function::Abs | Function::Sign), _) => Some(function.name()),
        Node::Apply2(function @ (Function2::Min | Function2::Max), ..) => Some(function.name()),
        _ => None,
    })?;
    Some(Violation {
        law: Law::Smooth,
        origin,
        what: format!("this {what} is not smooth: it uses `{name}`"),
        evidence: format!("`{name}` has no derivative where its branches meet, and the equations need one"),
        way_out: "use a smooth expression, such as sqrt(x^2 + eps^2) for abs(x); `abs`, `sign`, `min` and \
                  `max` are at home in `forces` and `outputs`"
            .into(),
    })
}

//! The equations of motion as lines of text.

use super::{combination, shown};
use crate::algebra::Graph;
use crate::compile::Derived;
use crate::id::{ConstraintId, ExprId, Id};
use crate::model::Model;

/// One line for each kinematic and each dynamic equation, for each dependent velocity, and for each auxiliary
/// state; the constants.
#[must_use]
pub(crate) fn equations_of_motion(model: &Model, derived: &Derived<'_>) -> Vec<String> {
    let graph = &model.graph;
    let rates = match derived {
        Derived::Adapted { equations, .. } => &equations.rates,
        Derived::Projected { equations, .. } => &equations.rates,
    };
    let mut lines: Vec<String> = model
        .coordinates
        .iter()
        .zip(rates)
        .map(|(coordinate, rate)| format!("der({}) = {}", coordinate.name, shown(graph, *rate)))
        .collect();
    match derived {
        Derived::Adapted { equations, distribution, kept } => {
            let names: Vec<&str> =
                kept.independent.iter().map(|symbol| graph.symbols()[*symbol].as_str()).collect();
            for (row, force) in equations.mass.iter().zip(&equations.force) {
                lines.push(format!("{} = {}", accelerations(graph, row, &names), shown(graph, *force)));
            }
            for section in &distribution.dependent {
                let value = shown(graph, equations.velocity[section.index()]);
                lines.push(format!("{} = {value}", model.sections[*section].name));
            }
            for (symbol, value) in &kept.eliminated {
                lines.push(format!("{} = {}", graph.symbols()[*symbol], shown(graph, *value)));
            }
        }
        Derived::Projected { equations, .. } => {
            let names: Vec<&str> = model.sections.iter().map(|section| section.name.as_str()).collect();
            for (alpha, (row, force)) in equations.mass.iter().zip(&equations.force).enumerate() {
                let reactions = reactions(model, &equations.jacobian, alpha);
                let left = accelerations(graph, row, &names);
                let right = match (graph.is_literal_zero(*force), reactions.strip_prefix(" + ")) {
                    (true, Some(alone)) => alone.to_owned(),
                    _ => format!("{}{reactions}", shown(graph, *force)),
                };
                lines.push(format!("{left} = {right}"));
            }
            for (row, bias) in equations.jacobian.iter().zip(&equations.bias) {
                lines.push(format!("{} = {}", accelerations(graph, row, &names), shown(graph, *bias)));
            }
        }
    }
    for state in &model.auxiliary {
        lines.push(format!("der({}) = {}", state.name, shown(graph, state.value)));
    }
    let constants = super::constants(graph);
    if !constants.is_empty() {
        lines.push(format!("where {}", constants.join(", ")));
    }
    lines
}

/// `(m)*der(v1) + …`.
fn accelerations(graph: &Graph, row: &[ExprId], names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("der({name})")).collect();
    combination(graph, row, &names)
}

/// ` + (…)*lambda_name` for each constraint.
fn reactions(model: &Model, jacobian: &[Vec<ExprId>], alpha: usize) -> String {
    let mut text = String::new();
    for (index, row) in
        jacobian.iter().enumerate().filter(|(_, row)| !model.graph.is_literal_zero(row[alpha]))
    {
        let constraint = model.constraints.get(ConstraintId::from_index(index));
        let name = constraint.and_then(|c| c.label.clone()).unwrap_or_else(|| format!("{}", index + 1));
        let multiplier = model.graph.free_name(&format!("lambda_{name}"));
        text.extend([" + (", &shown(&model.graph, row[alpha]), ")*", &multiplier]);
    }
    text
}

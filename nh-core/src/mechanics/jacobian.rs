//! Exact derivatives of generated functions with respect to their arguments.

use super::procedure::{Definition, Procedure};
use crate::algebra::{Derivation, Graph};
use crate::id::{ExprId, SymbolId};

/// What keeps a function from being differentiated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotDifferentiable {
    /// The method of the user's on which a derivative is missing.
    pub method: String,
}

/// The derivatives of all outputs with respect to all `arguments`, row by row: one row for each
/// output. Intermediate results are differentiated one by one, so that they stay shared.
///
/// # Errors
/// Where an output depends on an argument through a method of the user's whose derivative is missing.
pub fn jacobian(
    graph: &mut Graph,
    procedure: &Procedure,
    arguments: &[SymbolId],
) -> Result<Procedure, NotDifferentiable> {
    let mut result = procedure.clone();
    let mut columns: Vec<Vec<ExprId>> = Vec::with_capacity(arguments.len());
    for argument in arguments {
        let mut along = Derivation::partial(graph, *argument);
        for definition in &procedure.definitions {
            differentiate(graph, definition, &mut along, &mut result)?;
        }
        columns.push(along.apply_all(graph, &procedure.outputs));
    }
    result.outputs = Graph::transposed(&columns).concat();
    Ok(result)
}

/// The derivatives of all outputs along a direction: how fast each argument changes, as an expression.
///
/// # Errors
/// As [`jacobian`].
pub fn derivative_along(
    graph: &mut Graph,
    procedure: &Procedure,
    direction: impl IntoIterator<Item = (SymbolId, ExprId)>,
) -> Result<Procedure, NotDifferentiable> {
    let mut result = procedure.clone();
    let mut along = Derivation::new(direction);
    for definition in &procedure.definitions {
        differentiate(graph, definition, &mut along, &mut result)?;
    }
    result.outputs = along.apply_all(graph, &procedure.outputs);
    Ok(result)
}

/// Σ ∂f_i/∂x_i of a vector field whose component i is output i, along argument i.
///
/// # Errors
/// As [`jacobian`].
pub fn divergence(
    graph: &mut Graph,
    field: &Procedure,
    arguments: &[SymbolId],
) -> Result<Procedure, NotDifferentiable> {
    let mut result = field.clone();
    let mut terms = Vec::with_capacity(arguments.len());
    for (argument, output) in arguments.iter().zip(&field.outputs) {
        let mut along = Derivation::partial(graph, *argument);
        for definition in &field.definitions {
            differentiate(graph, definition, &mut along, &mut result)?;
        }
        terms.push(along.apply(graph, *output));
    }
    result.outputs = vec![graph.sum(&terms)];
    Ok(result)
}

/// Adds the derivative of an intermediate result, and makes it known to the derivation.
fn differentiate(
    graph: &mut Graph,
    definition: &Definition,
    along: &mut Derivation,
    result: &mut Procedure,
) -> Result<(), NotDifferentiable> {
    match definition {
        Definition::Value { symbol, value } => {
            let change = along.apply(graph, *value);
            let name = format!("d_{}", graph.symbols()[*symbol]);
            let change = result.define(graph, &name, change);
            along.insert(*symbol, change);
        }
        // ∂ self.f(a, b) = self.f₁(a, b) ∂a + self.f₂(a, b) ∂b
        Definition::Call { symbol, method, arguments, derivatives } => {
            let mut change = graph.zero();
            for (index, argument) in arguments.iter().enumerate() {
                let inner = along.apply(graph, *argument);
                if graph.is_literal_zero(inner) {
                    continue;
                }
                let Some(derivative) = derivatives.as_ref().and_then(|all| all.get(index)) else {
                    return Err(NotDifferentiable { method: method.clone() });
                };
                let outer = result.call(graph, derivative, arguments);
                change = graph.formula(change + outer * inner);
            }
            if !graph.is_literal_zero(change) {
                let name = format!("d_{}", graph.symbols()[*symbol]);
                let change = result.define(graph, &name, change);
                along.insert(*symbol, change);
            }
        }
        // M x = r: M ∂x = ∂r − ∂M x
        Definition::Solve { unknowns, matrix, right } => {
            let solution: Vec<ExprId> = unknowns.iter().map(|symbol| graph.symbol(*symbol)).collect();
            let mut changed = Vec::with_capacity(right.len());
            for (row, entry) in matrix.iter().zip(right) {
                let moved = along.apply_all(graph, row);
                let moved = graph.inner_product(&moved, &solution);
                let change = along.apply(graph, *entry);
                changed.push(graph.formula(change - moved));
            }
            if changed.iter().all(|change| graph.is_literal_zero(*change)) {
                return Ok(());
            }
            let names: Vec<String> =
                unknowns.iter().map(|symbol| format!("d_{}", graph.symbols()[*symbol])).collect();
            let changes: Vec<SymbolId> = names.into_iter().map(|name| graph.new_symbol(name)).collect();
            for (unknown, change) in unknowns.iter().zip(&changes) {
                let change = graph.symbol(*change);
                along.insert(*unknown, change);
            }
            result.definitions.push(Definition::Solve {
                unknowns: changes,
                matrix: matrix.clone(),
                right: changed,
            });
        }
    }
    Ok(())
}

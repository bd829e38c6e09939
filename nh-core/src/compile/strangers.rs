//! Symbols in a function that are none of its arguments: velocities that the constraints determine, whose
//! coefficients vanish identically where the algebra did not see it.

use super::proved::fence;
use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure};
use crate::system::System;
use crate::violation::{Law, Violation};
use std::collections::BTreeSet;

/// The system with nothing in its functions but what these are called with.
///
/// # Errors
/// What a function depends on that is not known where it is called.
pub(super) fn without_strangers(mut system: System) -> Result<System, Vec<Violation>> {
    let model = &system.model;
    let state = system.state();
    let parameters = model.parameters.iter().map(|parameter| parameter.symbol);
    let inputs = model.inputs.iter().map(|input| input.symbol);
    let mut known: BTreeSet<SymbolId> =
        state.into_iter().chain(parameters).chain(inputs).chain([model.time]).collect();
    known.extend(system.projection.iter().flat_map(|projection| &projection.start));
    let mut functions: Vec<(&str, &mut Procedure)> = vec![("derivative", &mut system.derivative)];
    functions.extend(system.linearized.as_mut().map(|linearized| ("jacobian", linearized)));
    let listed = system.functions.iter_mut();
    functions.extend(listed.map(|function| (function.signature.name, &mut function.procedure)));
    if let Some(projection) = &mut system.projection {
        functions.push(("project", &mut projection.step));
    }
    if let Some(positions) = &mut system.positions {
        functions.push(("project", &mut positions.step));
        functions.extend(positions.velocities.as_mut().map(|velocities| ("return_to_positions", velocities)));
        functions.push(("derivative", &mut positions.pivots));
        if let Some(slopes) = &mut positions.slopes {
            functions.push(("jacobian", &mut slopes.positions));
            functions.extend(slopes.velocities.as_mut().map(|by| ("jacobian", by)));
        }
        functions.push(("assemble", &mut positions.assembly.positions.procedure));
        functions.push(("assemble", &mut positions.assembly.velocities.procedure));
    }
    for impact in &mut system.impacts {
        functions.extend(impact.procedures().map(|procedure| ("impact", procedure)));
    }
    let graph = &mut system.model.graph;
    let mut broken = Vec::new();
    for (what, function) in functions {
        if let Err(stranger) = introduce(graph, function, &known) {
            broken.push(Violation {
                law: Law::Decidable,
                origin: system.model.origin,
                what: format!("`{what}` could not be written in the variables of the state"),
                evidence: format!(
                    "whether it depends on `{}` could not be decided",
                    graph.symbols()[stranger]
                ),
                way_out: "keep other velocities by `independent`, or write the constraints expanded".into(),
            });
        }
    }
    fence(broken)?;
    Ok(system)
}

/// Takes strangers out of a procedure.
///
/// # Errors
/// One that something depends on.
fn introduce(
    graph: &mut Graph,
    function: &mut Procedure,
    known: &BTreeSet<SymbolId>,
) -> Result<(), SymbolId> {
    let mut known = known.clone();
    for definition in &mut function.definitions {
        match definition {
            Definition::Value { symbol, value } => {
                *value = freed(graph, *value, &known)?;
                known.insert(*symbol);
            }
            Definition::Call { symbol, arguments, .. } => {
                for argument in arguments {
                    *argument = freed(graph, *argument, &known)?;
                }
                known.insert(*symbol);
            }
            Definition::Solve { unknowns, matrix, right } => {
                for entry in matrix.iter_mut().flatten().chain(right) {
                    *entry = freed(graph, *entry, &known)?;
                }
                known.extend(unknowns.iter());
            }
        }
    }
    for output in &mut function.outputs {
        *output = freed(graph, *output, &known)?;
    }
    Ok(())
}

/// The expression in known symbols alone: where the others vanish, if it is proved to be the same.
fn freed(graph: &mut Graph, value: ExprId, known: &BTreeSet<SymbolId>) -> Result<ExprId, SymbolId> {
    let occurring = graph.symbols_in(&[value]);
    let strangers: Vec<SymbolId> = occurring.into_iter().filter(|symbol| !known.contains(symbol)).collect();
    let Some(first) = strangers.first() else { return Ok(value) };
    let without = graph.at_zero(value, &strangers);
    let difference = graph.formula(value - without);
    let is_same = !graph.is_undefined(without) && graph.zero_test(difference).is_zero();
    if is_same { Ok(without) } else { Err(*first) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cancels_is_taken_out_and_what_does_not_is_named() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (ex, ey) = (g.symbol(x), g.symbol(y));
        let (sin, cos) = (g.sin(ex), g.cos(ex));
        // cos x (y sin x + 1) − sin x · y cos x
        let (one, product) = (g.one(), g.formula(ey * sin));
        let (first, second) = (
            g.formula(cos * (product + one)),
            g.product(&[(sin, 1.into()), (ey, 1.into()), (cos, 1.into())]),
        );
        let value = g.formula(first - second);
        let known = BTreeSet::from([x]);
        assert_eq!(freed(&mut g, value, &known), Ok(cos));
        let mut function = Procedure::of(vec![value, product]);
        assert_eq!(introduce(&mut g, &mut function, &known), Err(y));
    }
}

//! What is given along a motion: results of methods of the user's, and the rates of auxiliary states.
//!
//! Both are symbols to the algebra, and intermediate results of what is generated.

use super::velocities_of_state::in_state;
use crate::algebra::{Graph, Substitution};
use crate::check::Motion;
use crate::choose::Given;
use crate::id::SymbolId;
use crate::mechanics::{Definition, Procedure};
use crate::model::Model;

/// What is given, in quasi-velocities, each after what occurs in it.
pub(crate) fn given(model: &mut Model, motion: &mut Motion) -> Vec<Given> {
    let graph = &mut model.graph;
    let calls = model.calls.iter().map(|call| Given::Call {
        symbol: call.symbol,
        method: call.method.clone(),
        arguments: motion.rates.apply_all(graph, &call.arguments),
        derivatives: call.derivatives.clone(),
    });
    let mut found: Vec<Given> = calls.collect();
    let rates = model
        .auxiliary
        .iter()
        .map(|state| Given::Rate { symbol: state.rate, value: motion.rates.apply(graph, state.value) });
    found.extend(rates);
    in_order(graph, found)
}

/// The same as intermediate results in the variables of the state; the outputs are the rates of auxiliary states.
pub(super) fn definitions(
    model: &mut Model,
    motion: &mut Motion,
    restriction: &mut Substitution,
) -> Procedure {
    let mut procedure = Procedure::default();
    for given in given(model, motion) {
        let graph = &mut model.graph;
        procedure.definitions.push(match given {
            Given::Call { symbol, method, arguments, derivatives } => {
                let arguments = arguments.iter().map(|value| in_state(graph, motion, restriction, *value));
                Definition::Call { symbol, method, arguments: arguments.collect(), derivatives }
            }
            Given::Rate { symbol, value } => {
                Definition::Value { symbol, value: in_state(graph, motion, restriction, value) }
            }
        });
    }
    let Model { graph, auxiliary, .. } = model;
    procedure.outputs = auxiliary.iter().map(|state| graph.symbol(state.rate)).collect();
    procedure
}

/// The auxiliary states.
pub(super) fn auxiliary_states(model: &Model) -> Vec<SymbolId> {
    model.auxiliary.iter().map(|state| state.symbol).collect()
}

/// Each after those that occur in it: that there is no circle was checked.
fn in_order(graph: &Graph, mut open: Vec<Given>) -> Vec<Given> {
    let mut ordered = Vec::with_capacity(open.len());
    while !open.is_empty() {
        let waiting: Vec<SymbolId> = open.iter().map(Given::symbol).collect();
        let is_ready = |given: &Given| !graph.symbols_in(&given.roots()).iter().any(|s| waiting.contains(s));
        let (ready, rest): (Vec<Given>, Vec<Given>) = open.into_iter().partition(is_ready);
        if ready.is_empty() {
            ordered.extend(rest);
            break;
        }
        ordered.extend(ready);
        open = rest;
    }
    ordered
}

//! The rates of auxiliary states are given by other things than themselves.

use crate::id::{ExprId, SymbolId};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// No rate ż, and no result of a method, goes round in a circle: ż₁ = ż₂ + …, ż₂ = ż₁ + ….
#[must_use]
pub fn rates_in_a_circle(model: &Model) -> Vec<Violation> {
    let rates = model.auxiliary.iter().map(|state| (state.rate, vec![state.value]));
    let calls = model.calls.iter().map(|call| (call.symbol, call.arguments.clone()));
    let mut open: Vec<(SymbolId, Vec<ExprId>)> = rates.chain(calls).collect();
    // what depends on nothing that is open is settled
    loop {
        let waiting: Vec<SymbolId> = open.iter().map(|(symbol, _)| *symbol).collect();
        let before = open.len();
        open.retain(|(_, roots)| model.graph.symbols_in(roots).iter().any(|symbol| waiting.contains(symbol)));
        if open.len() == before {
            break;
        }
    }
    let circle: Vec<&crate::model::AuxiliaryDecl> =
        model.auxiliary.iter().filter(|state| open.iter().any(|(symbol, _)| *symbol == state.rate)).collect();
    let Some(first) = circle.first() else { return Vec::new() };
    let names: Vec<String> = circle.iter().map(|state| format!("`der({})`", state.name)).collect();
    vec![Violation {
        law: Law::Auxiliary,
        origin: first.origin,
        what: format!("the rate of `{}` depends on itself", first.name),
        evidence: format!("these are given by one another: {}", names.join(", ")),
        way_out: "solve for the rates, and write each of them in the states".into(),
    }]
}

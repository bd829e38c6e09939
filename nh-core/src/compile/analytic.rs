//! Taylor series are derived only where there are any.

use std::collections::BTreeSet;

use crate::algebra::{Function, Function2, Graph, Node};
use crate::check::evidence::shown;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure};
use crate::model::Request;
use crate::system::System;
use crate::violation::{Law, Violation};

/// Refuses `emit { taylor }` where the derivative is not analytic in the state and the time.
///
/// What changes between steps only, a function of parameters and inputs, may be anything.
pub(super) fn check(system: &System) -> Result<(), Violation> {
    let Some((_, origin)) = system.model.requests.iter().find(|(request, _)| *request == Request::Taylor)
    else {
        return Ok(());
    };
    let mut varying: BTreeSet<SymbolId> = system.state().into_iter().collect();
    varying.insert(system.model.time);
    let Some(obstacle) = obstacle(&system.model.graph, &system.derivative, varying) else { return Ok(()) };
    Err(Violation {
        law: Law::Analytic,
        origin: *origin,
        what: "the equations have no Taylor series".into(),
        evidence: obstacle.evidence,
        way_out: format!("{}, or leave `taylor` out", obstacle.way_out),
    })
}

struct Obstacle {
    evidence: String,
    way_out: &'static str,
}

/// The first thing that an output depends on and that is not analytic where it varies.
fn obstacle(graph: &Graph, procedure: &Procedure, mut varying: BTreeSet<SymbolId>) -> Option<Obstacle> {
    let needed = procedure.depends_on(graph, &procedure.outputs);
    for definition in &procedure.definitions {
        let (defined, operands): (&[SymbolId], Vec<ExprId>) = match definition {
            Definition::Value { symbol, value } => (std::slice::from_ref(symbol), vec![*value]),
            Definition::Call { symbol, arguments, .. } => (std::slice::from_ref(symbol), arguments.clone()),
            Definition::Solve { unknowns, matrix, right } => {
                (unknowns, matrix.iter().flatten().chain(right).copied().collect())
            }
        };
        let changes = graph.symbols_in(&operands).iter().any(|symbol| varying.contains(symbol));
        if !changes || !defined.iter().any(|symbol| needed.contains(symbol)) {
            continue;
        }
        if let Definition::Call { method, .. } = definition {
            return Some(Obstacle {
                evidence: format!(
                    "a force calls `self.{method}`, which is no formula, with arguments that change during a step"
                ),
                way_out: "write the force as a formula",
            });
        }
        if let Some(found) = kink(graph, &operands, &varying) {
            return Some(found);
        }
        varying.extend(defined);
    }
    kink(graph, &procedure.outputs, &varying)
}

/// The first function with a kink or a jump in some expressions.
fn kink(graph: &Graph, roots: &[ExprId], varying: &BTreeSet<SymbolId>) -> Option<Obstacle> {
    let smooth = "write a smooth function in its place, say `sqrt(v^2 + e^2)` for `abs(v)` and `tanh(v / e)` for `sign(v)`";
    graph.reachable(roots).into_iter().find_map(|id| {
        let where_it_breaks = match graph.node(id) {
            Node::Apply(Function::Abs, of) => format!("has a kink where `{}` is zero", shown(graph, *of)),
            Node::Apply(Function::Sign, of) => format!("jumps where `{}` is zero", shown(graph, *of)),
            Node::Apply2(Function2::Min | Function2::Max, ..) => {
                "has a kink where its arguments are equal".to_owned()
            }
            _ => return None,
        };
        let changes = graph.symbols_in(&[id]).iter().any(|symbol| varying.contains(symbol));
        changes.then(|| Obstacle {
            evidence: format!("they contain `{}`, which {where_it_breaks}", shown(graph, id)),
            way_out: smooth,
        })
    })
}

//! Functions with numbers for the constants, where that is shorter.

use crate::algebra::{Graph, Substitution};
use crate::choose::{Contender, Decision, Fate, cheapest, fate, prove_equal};
use crate::count::Count;
use crate::mechanics::{Definition, Procedure};
use crate::system::System;

/// Procedures with more operations are left as they are derived.
const SHORT: u64 = 160;

/// Derivations keep constants apart; in short functions the numbers that they come to may do better.
pub(super) fn in_numbers(system: &mut System) {
    let graph = &mut system.model.graph;
    if graph.constants().is_empty() {
        return;
    }
    let functions = system.functions.iter_mut().map(|function| &mut function.procedure);
    for function in [&mut system.derivative].into_iter().chain(&mut system.linearized).chain(functions) {
        if function.length(graph) <= SHORT {
            system.ledger.decisions.extend(shorten(graph, function));
        }
    }
}

/// The cheapest, if it is another one and proved to compute the same.
fn shorten(graph: &mut Graph, function: &mut Procedure) -> Option<Decision> {
    let numbers = function.in_numbers(graph, false);
    let simplified = function.in_numbers(graph, true);
    let forms = [function.clone(), numbers, simplified];
    let best = cheapest(graph, &forms);
    if best == 0 {
        return None;
    }
    let form = ["with names", "in numbers", "in numbers, simplified"][best];
    let fate = fate(prove_equal(graph, function, &forms[best]));
    if matches!(fate, Fate::Chosen(_)) {
        *function = forms.into_iter().nth(best).unwrap_or_default();
    }
    let contenders = vec![Contender { form, cost: None, rounding: None, fate }];
    Some(Decision { site: "constants", contenders, limits: Vec::new() })
}

impl Procedure {
    fn length(&self, graph: &Graph) -> Count {
        graph.operation_count(&self.values(graph))
    }

    /// With numbers for the constants, and for what is made of them alone.
    fn in_numbers(&self, graph: &mut Graph, simplified: bool) -> Self {
        let mut known = Substitution::new([]);
        let image = |graph: &mut Graph, known: &mut Substitution, value| {
            let value = graph.in_numbers(value);
            let value = known.apply(graph, value);
            if simplified { graph.simplify(value) } else { value }
        };
        let mut result = self.with_outputs(Vec::new());
        result.definitions.clear();
        for definition in &self.definitions {
            result.definitions.push(match definition {
                Definition::Value { symbol, value } => {
                    let value = image(graph, &mut known, *value);
                    if graph.as_number(value).is_some() || graph.as_symbol(value).is_some() {
                        known.insert(*symbol, value);
                        continue;
                    }
                    Definition::Value { symbol: *symbol, value }
                }
                Definition::Call { symbol, method, arguments, derivatives } => Definition::Call {
                    symbol: *symbol,
                    method: method.clone(),
                    arguments: arguments.iter().map(|value| image(graph, &mut known, *value)).collect(),
                    derivatives: derivatives.clone(),
                },
                Definition::Solve { unknowns, matrix, right } => Definition::Solve {
                    unknowns: unknowns.clone(),
                    matrix: matrix
                        .iter()
                        .map(|row| row.iter().map(|value| image(graph, &mut known, *value)).collect())
                        .collect(),
                    right: right.iter().map(|value| image(graph, &mut known, *value)).collect(),
                },
            });
        }
        let outputs: Vec<_> = self.outputs.iter().map(|value| image(graph, &mut known, *value)).collect();
        result.outputs = outputs;
        result
    }
}

//! What functions that are asked for beside the motion have in common: the variables of the state, the bracket, the
//! gradient of the energy, and when their outputs are written out.

use super::given;
use super::proved::{Derived, Proved};
use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{
    Definiteness, Definition, LagrangianSystem, NonholonomicBracket, NotDifferentiable, Procedure,
    definiteness, energy,
};
use crate::model::{Model, Request};
use crate::violation::{Law, Violation};

/// Where something is asked for.
pub(super) fn asked(model: &Model, request: Request) -> Option<Origin> {
    model.requests.iter().find(|(asked, _)| *asked == request).map(|(_, origin)| *origin)
}

/// How mass matrices are judged in this declaration.
pub(super) fn judge(proved: &Proved) -> impl Fn(&Graph, &Matrix) -> Definiteness + use<> {
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let facts = proved.facts.clone();
    move |graph, matrix| definiteness(graph, matrix, &parameters, &facts)
}

/// The same for what is solved beside the motion: what that cannot divide by everywhere, nothing beside it divides by.
pub(super) fn judge_beside(proved: &Proved) -> impl Fn(&Graph, &Matrix) -> Definiteness + use<> {
    let (judge, is_pivoted) = (judge(proved), proved.is_pivoted);
    move |graph, matrix| if is_pivoted { Definiteness::Unknown } else { judge(graph, matrix) }
}

/// The velocities of the state.
pub(super) fn state_velocities(proved: &Proved, derived: &Derived<'_>) -> Vec<SymbolId> {
    match derived {
        Derived::Adapted { kept, .. } => kept.independent.clone(),
        Derived::Projected { .. } => proved.system.algebroid.velocities.clone(),
    }
}

/// The coordinates and velocities of the state.
pub(super) fn state(proved: &Proved, derived: &Derived<'_>) -> Vec<SymbolId> {
    let mut symbols = proved.system.algebroid.anchor.coordinates.clone();
    symbols.extend(state_velocities(proved, derived));
    symbols
}

/// All that the state consists of.
pub(super) fn whole_state(proved: &Proved, derived: &Derived<'_>) -> Vec<SymbolId> {
    let mut symbols = state(proved, derived);
    symbols.extend(given::auxiliary_states(&proved.model));
    symbols
}

/// The calls of the user's methods, in the variables of the state.
pub(super) fn calls_of(derivative: &Procedure) -> Vec<Definition> {
    let is_call = |definition: &&Definition| matches!(definition, Definition::Call { .. });
    derivative.definitions.iter().filter(is_call).cloned().collect()
}

/// The nonholonomic bracket in the variables of the state: mathematics (15).
pub(super) fn nonholonomic_bracket(proved: &mut Proved, derived: &Derived<'_>) -> NonholonomicBracket {
    let (graph, system) = (&mut proved.model.graph, &proved.system);
    match derived {
        Derived::Adapted { distribution, equations, .. } => {
            NonholonomicBracket::adapted(graph, system, distribution, equations)
        }
        Derived::Projected { residuals, equations } => {
            NonholonomicBracket::projected(graph, system, residuals, equations)
        }
    }
}

/// Expressions with more operations than this are left as the procedure computes them.
const SHORT: u64 = 240;

/// The procedure with its outputs written out and simplified, where they are short.
pub(super) fn shortened(graph: &mut Graph, procedure: Procedure) -> Procedure {
    if graph.operation_count(&procedure.outputs) > SHORT || procedure.calls() {
        return procedure;
    }
    let written_out = procedure.written_out(graph);
    if graph.operation_count(&written_out) > 2 * SHORT {
        return procedure;
    }
    let simplified = graph.simplify_all(&written_out);
    let accurate =
        simplified.iter().zip(&written_out).all(|(short, long)| graph.error_growth(*short, *long) <= 4.0);
    if accurate && graph.operation_count(&simplified) <= SHORT {
        Procedure::of(simplified)
    } else {
        procedure
    }
}

/// A method of the user's that would have to be differentiated.
pub(super) fn not_differentiable(
    NotDifferentiable { method }: NotDifferentiable,
    origin: Origin,
) -> Violation {
    Violation {
        law: Law::Hamiltonian,
        origin,
        what: "this needs derivatives that are not known".into(),
        evidence: format!("`self.{method}` is no formula, and is called with arguments that change"),
        way_out: format!("give its derivatives in `derivative {{ {method}: […]; }}`"),
    }
}

/// ∂E_L in the variables of the state.
pub(super) fn energy_gradient(
    graph: &mut Graph,
    system: &LagrangianSystem,
    derived: &Derived<'_>,
    arguments: &[SymbolId],
) -> Vec<ExprId> {
    let mut function = energy(graph, system);
    if let Derived::Adapted { distribution, .. } = derived {
        function = distribution.restriction(graph, &system.algebroid.velocities).apply(graph, function);
    }
    let slopes: Vec<ExprId> = arguments.iter().map(|symbol| graph.partial(function, *symbol)).collect();
    slopes.into_iter().map(|slope| graph.simplify(slope)).collect()
}

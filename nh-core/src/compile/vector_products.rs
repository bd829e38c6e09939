//! Products of the Jacobian of the motion with vectors, from either side, at the cost of a few derivatives.

use super::differentiated::{BY_EXPRESSIONS, BY_RESIDUALS, BY_STEPS, favourite};
use crate::algebra::Graph;
use crate::choose::{Defect, Fate, prove_product};
use crate::id::{Origin, SymbolId};
use crate::limits::attempt;
use crate::mechanics::{NotDifferentiable, Procedure, derivative_along, jacobian};
use crate::model::Request;
use crate::program::{Systems, Wanted, accumulated};
use crate::system::{Side, System, VectorProduct};
use crate::violation::{Law, Violation};

/// What one proof may take.
const WORK: u64 = 4_000_000;

/// The products that are asked for, each proved.
///
/// # Errors
/// Where a method of the user's has no derivative; a product that is something else.
pub(super) fn derive(system: &mut System) -> Result<(), Vec<Violation>> {
    let asked = [(Request::JacobianProduct, Side::Right), (Request::AdjointProduct, Side::Left)].map(
        |(asked, side)| {
            let request = system.model.requests.iter().find(|(request, _)| *request == asked);
            request.map(|(_, origin)| (side, *origin))
        },
    );
    for (side, origin) in asked.into_iter().flatten() {
        let product = product(system, side, origin).map_err(|violation| vec![violation])?;
        system.products.push(product);
    }
    Ok(())
}

fn product(system: &mut System, side: Side, origin: Origin) -> Result<VectorProduct, Violation> {
    let inputs = system.model.inputs.iter().map(|input| input.symbol);
    let arguments: Vec<SymbolId> = system.state().into_iter().chain(inputs).collect();
    let parameters: Vec<SymbolId> =
        system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let function = &system.derivative;
    let graph = &mut system.model.graph;
    let (length, letter) = match side {
        Side::Right => (arguments.len(), "w"),
        Side::Left => (function.outputs.len(), "p"),
    };
    let vector: Vec<SymbolId> = (0..length).map(|k| graph.new_symbol(format!("{letter}{k}"))).collect();
    let ways = ways(graph, function, (&arguments, &parameters), (side, &vector));
    let ways = ways.map_err(|NotDifferentiable { method }| Violation {
        law: Law::Force,
        origin,
        what: "the product with the Jacobian cannot be derived".into(),
        evidence: format!("a force calls `self.{method}`, which is no formula, with arguments that change"),
        way_out: format!(
            "give its derivatives in `derivative {{ {method}: […]; }}`, or leave `{}` out",
            side.word()
        ),
    })?;
    let (procedure, mut decision) = favourite(graph, ways, side.word());
    let product = VectorProduct { side, vector, procedure };
    let proof = attempt(WORK, || prove_product(graph, function, &arguments, &product));
    let fate = match proof.unwrap_or_else(|| Err(Defect::Unknown("that would take too many steps".into()))) {
        Ok(proof) => Fate::Chosen(proof),
        Err(Defect::Wrong(reason)) => return Err(is_something_else(side, origin, &reason)),
        Err(defect) => {
            decision.limits.push(format!("not proved: {defect}"));
            system.ledger.decisions.push(decision);
            return Ok(product);
        }
    };
    decision.contenders.iter_mut().take(1).for_each(|best| best.fate = fate.clone());
    system.ledger.decisions.push(decision);
    Ok(product)
}

/// The ways to a product, each with its name.
fn ways(
    graph: &mut Graph,
    function: &Procedure,
    (arguments, parameters): (&[SymbolId], &[SymbolId]),
    (side, vector): (Side, &[SymbolId]),
) -> Result<Vec<(&'static str, Procedure)>, NotDifferentiable> {
    let wanted = match side {
        Side::Right => Wanted::AlongDirection(vector),
        Side::Left => Wanted::OfWeightedSum(vector),
    };
    let mut ways = Vec::new();
    for (name, systems) in [(BY_RESIDUALS, Systems::All), (BY_STEPS, Systems::Pivoted)] {
        if let Some(found) = accumulated(graph, function, (arguments, parameters), systems, wanted)? {
            ways.push((name, found));
        }
    }
    if ways.is_empty() {
        let components: Vec<_> = vector.iter().map(|symbol| graph.symbol(*symbol)).collect();
        ways.push((
            BY_EXPRESSIONS,
            match side {
                Side::Right => derivative_along(graph, function, arguments.iter().copied().zip(components))?,
                Side::Left => {
                    let rows = jacobian(graph, function, arguments)?;
                    let columns = (0..arguments.len()).map(|column| {
                        let column: Vec<_> =
                            rows.outputs.iter().copied().skip(column).step_by(arguments.len()).collect();
                        graph.inner_product(&column, &components)
                    });
                    let columns = columns.collect();
                    rows.with_outputs(columns)
                }
            },
        ));
    }
    Ok(ways)
}

fn is_something_else(side: Side, origin: Origin, reason: &str) -> Violation {
    Violation {
        law: Law::Decidable,
        origin,
        what: format!("`{}` was not derived as what its definition says", side.word()),
        evidence: format!("compared in exact numbers with the derivative of the motion: {reason}"),
        way_out: "leave it out; this is a defect of the derivation, please report it".into(),
    }
}

//! What a step of the variational method with position constraints is made of, mathematics (62).

use super::discrete::{conservative, refusal};
use super::on_request::{asked, judge};
use super::proved::{Derived, Proved};
use crate::algebra::Matrix;
use crate::check::evidence::shown;
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{Procedure, SaddleEquations, saddle_equations};
use crate::model::{Kinematics, Request};
use crate::phase_space::{PhaseSpace, VariationalForm};
use crate::violation::Violation;

/// Why it is refused, in one sentence for all reasons.
const WHAT: &str =
    "the variational method needs a system on TQ that moves by L and position constraints alone";

/// The form, if it is asked for.
pub(super) fn derive(
    proved: &mut Proved,
    derived: &Derived<'_>,
    found: &mut PhaseSpace,
) -> Result<(), Vec<Violation>> {
    if let Some(origin) = asked(&proved.model, Request::Rattle) {
        found.variational = Some(variational(proved, derived, origin)?);
    }
    Ok(())
}

/// ∂L/∂q and ∂L/∂q̇, g, and a with W a − r in the span of the rows of G = ∂g and G a = c, at a point of Q.
fn variational(
    proved: &mut Proved,
    derived: &Derived<'_>,
    origin: Origin,
) -> Result<VariationalForm, Vec<Violation>> {
    conservative(proved, origin, WHAT)?;
    let elsewhere = "leave it out; `DiscreteGradient` keeps the energy of such systems";
    if !matches!(proved.model.kinematics, Kinematics::Tangent) || !proved.model.frame.is_empty() {
        let way_out =
            "declare it by its coordinates alone, without `basis`, `velocities` and `frame`; or leave it out";
        return Err(refusal(origin, WHAT, "the velocities are not those of the coordinates".into(), way_out));
    }
    let positions: Vec<ExprId> = proved.model.positions.iter().map(|position| position.value).collect();
    let mass = match derived {
        Derived::Projected { equations, residuals } if residuals.len() <= positions.len() => {
            equations.mass.clone()
        }
        Derived::Adapted { .. } if proved.constraints.residuals.is_empty() => {
            saddle_equations(&mut proved.model.graph, &proved.system, &[]).mass
        }
        Derived::Adapted { .. } if proved.constraints.residuals.len() <= positions.len() => {
            let way_out = "keep all velocities with `formulation { projected }`, or leave it out";
            return Err(refusal(origin, WHAT, "the state has reduced velocities".into(), way_out));
        }
        _ => {
            let evidence = "there are constraints on velocities, which have no discrete Lagrangian".into();
            return Err(refusal(origin, WHAT, evidence, elsewhere));
        }
    };
    let judge = judge(proved);
    let graph = &mut proved.model.graph;
    let system = &proved.system;
    let velocities = &system.algebroid.velocities;
    let coordinates = &system.algebroid.anchor.coordinates;
    if let Some(entry) = mass.iter().flatten().find(|entry| graph.depends_on(**entry, velocities)) {
        let evidence =
            format!("the kinetic energy is not quadratic: ∂²L/∂q̇² has the entry {}", shown(graph, *entry));
        return Err(refusal(origin, WHAT, evidence, elsewhere));
    }
    let mut slopes: Vec<ExprId> = Vec::with_capacity(2 * coordinates.len());
    for coordinate in coordinates {
        let slope = graph.partial(system.lagrangian, *coordinate);
        slopes.push(graph.simplify(slope));
    }
    slopes.extend(system.momenta(graph));
    let jacobian: Matrix = positions
        .iter()
        .map(|position| {
            let row = coordinates.iter().map(|coordinate| {
                let slope = graph.partial(*position, *coordinate);
                graph.simplify(slope)
            });
            row.collect()
        })
        .collect();
    let given: Vec<SymbolId> = (0..coordinates.len() + positions.len())
        .map(|place| graph.new_symbol(format!("given_{place}")))
        .collect();
    let values: Vec<ExprId> = given.iter().map(|symbol| graph.symbol(*symbol)).collect();
    let (force, bias) = values.split_at(coordinates.len());
    let (force, bias, rates) = (force.to_vec(), bias.to_vec(), Vec::new());
    let mut change = Procedure::default();
    let (after, _) = SaddleEquations { mass, force, jacobian, bias, rates }.solve(graph, judge, &mut change);
    change.outputs = after;
    Ok(VariationalForm { slopes: Procedure::of(slopes), residual: Procedure::of(positions), given, change })
}

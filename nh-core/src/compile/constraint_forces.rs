//! The forces of constraint on D: λ_A, and λ_A Φ^A_α.

use super::proved::{Proved, nothing_proved};
use super::velocities_of_state::requested;
use crate::algebra::{Graph, Matrix};
use crate::choose::{Claim, Contender, Decision, Fate, Reference, Regular, fate, prove};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Definition, Procedure, ReducedEquations, definiteness, reaction_forces};
use crate::model::Request;
use crate::violation::Violation;

/// Forces of constraint are differences of inertial and applied forces, which may cancel. Where the
/// accelerations put in and simplified give short expressions with no more rounding error, these
/// are evaluated instead.
fn without_cancellation(graph: &mut Graph, procedure: &Procedure) -> Option<Procedure> {
    const SHORT: u64 = 100;
    let written_out = procedure.written_out(graph);
    if graph.operation_count(&written_out) > 2 * SHORT {
        return None;
    }
    let simplified = graph.simplify_all(&written_out);
    let accurate =
        simplified.iter().zip(&written_out).all(|(short, long)| graph.error_growth(*short, *long) <= 1.0);
    if !accurate || graph.operation_count(&simplified) > SHORT {
        return None;
    }
    let mut short = Procedure::of(simplified);
    let is_call = |definition: &&Definition| matches!(definition, Definition::Call { .. });
    short.definitions.extend(procedure.definitions.iter().filter(is_call).cloned());
    Some(short)
}

/// If they are asked for, or do work: λ and λ_A Φ^A_α from δL_α − Υ_α = λ_A Φ^A_α, mathematics (7), at the accelerations found.
///
/// # Errors
/// Where they could not be proved to be that.
pub(super) fn constraint_forces(
    proved: &mut Proved,
    reference: &Reference,
    (distribution, equations): (&ConstraintDistribution, &ReducedEquations),
    derivative: &Procedure,
    work: &[ExprId],
) -> Result<(Procedure, Procedure), Vec<Violation>> {
    let asked = [Request::Multipliers, Request::Reactions].map(|request| requested(&proved.model, request));
    if asked == [false; 2] && work.iter().all(|work| proved.model.graph.is_literal_zero(*work)) {
        return Ok(Default::default());
    }
    let accelerations = &derivative.outputs[proved.model.coordinates.len()..];
    let graph = &mut proved.model.graph;
    // 1. δL_α − Υ_α
    let reactions = reaction_forces(graph, &proved.system, distribution, accelerations);
    // 2. the dependent rows determine λ
    let annihilator = &distribution.constraints.annihilator;
    let matrix: Vec<Vec<ExprId>> = distribution
        .dependent
        .iter()
        .map(|section| annihilator.iter().map(|row| row[section.index()]).collect())
        .collect();
    let right: Vec<Vec<ExprId>> =
        distribution.dependent.iter().map(|section| vec![reactions[section.index()]]).collect();
    let solved = graph.solve_linear(&matrix, &right).map(|solution| solution.values).unwrap_or_default();
    let multipliers = solved.into_iter().map(|row| row[0]).collect();
    // the same with numerical pivoting
    let unknowns: Vec<SymbolId> =
        (0..matrix.len()).map(|index| graph.new_symbol(format!("lambda{index}"))).collect();
    let mut pivoted = derivative.with_outputs(unknowns.iter().map(|symbol| graph.symbol(*symbol)).collect());
    let right = right.concat();
    pivoted.definitions.push(Definition::Solve { unknowns, matrix, right });
    let [multipliers, reactions] = [multipliers, reactions].map(|outputs| derivative.with_outputs(outputs));
    let site = Site { name: "multipliers", motion: derivative, rows: Some(annihilator), equations };
    let multipliers = proved_forces(proved, reference, &site, (multipliers, Some(pivoted)))?;
    let site = Site { name: "reactions", motion: derivative, rows: None, equations };
    let reactions = proved_forces(proved, reference, &site, (reactions, None))?;
    Ok((multipliers, reactions))
}

/// Forces of constraint that are asked for: λ_A along the rows Φ^A, or all of λ_A Φ^A.
struct Site<'s> {
    name: &'static str,
    motion: &'s Procedure,
    rows: Option<&'s Matrix>,
    /// The equations that were proved.
    equations: &'s ReducedEquations,
}

/// Forces without needless cancellation, or else as they are derived, whichever is proved first and divides by
/// nothing that may vanish; at last with numerical pivoting.
fn proved_forces(
    proved: &mut Proved,
    reference: &Reference,
    site: &Site,
    (derived, pivoted): (Procedure, Option<Procedure>),
) -> Result<Procedure, Vec<Violation>> {
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let ReducedEquations { mass, definitions, .. } = site.equations;
    let graph = &mut proved.model.graph;
    let definiteness = definiteness(graph, mass, &parameters, &proved.facts);
    let (jacobian, facts) = (&Matrix::new(), &proved.facts);
    let parameters = &parameters;
    let regular =
        Regular { reference, definitions, mass, definiteness, jacobian, turned: &[], parameters, facts };
    let short = without_cancellation(graph, &derived);
    let mut decision = Decision { site: site.name, ..Decision::default() };
    let forms = [("written out", short), ("by the accelerations", Some(derived)), ("with pivoting", pivoted)];
    for (form, procedure) in forms.into_iter().filter_map(|(form, procedure)| Some((form, procedure?))) {
        let claim = match site.rows {
            Some(rows) => Claim::Multipliers(site.motion, &procedure, Some(rows)),
            None => Claim::Reactions(site.motion, &procedure),
        };
        let mut fate = fate(prove(graph, reference, &claim));
        if let Fate::Chosen(_) = fate
            && form != "with pivoting"
            && let Some(divisor) = regular.added_beside(graph, &procedure, site.motion)
        {
            fate = Fate::adds(graph, divisor);
        }
        let is_admitted = matches!(fate, Fate::Chosen(_));
        decision.contenders.push(Contender { form, cost: None, rounding: None, fate });
        if is_admitted {
            proved.ledger.decisions.push(decision);
            return Ok(procedure);
        }
    }
    proved.ledger.decisions.push(decision);
    Err(nothing_proved(proved.model.origin, &proved.ledger))
}

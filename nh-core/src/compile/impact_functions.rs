//! Jumps of velocities: what an impact knows of itself at a state.

use super::proved::Proved;
use crate::algebra::{Graph, Matrix, Substitution};
use crate::check::Impact;
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definiteness, Procedure, SaddleEquations, definiteness, kinetic_metric};
use crate::system::ImpactForm;

/// Whether a mass matrix may be divided by.
type Judge<'a> = dyn Fn(&Graph, &Matrix) -> Definiteness + 'a;

/// The impacts in the velocities v of D: C (v⁺ − v⁻) = Nᵀμ with N = ΨB, mathematics (50).
pub(super) fn adapted(
    proved: &mut Proved,
    restriction: &mut Substitution,
    distribution: &ConstraintDistribution,
) -> Vec<ImpactForm> {
    if proved.impacts.is_empty() {
        return Vec::new();
    }
    let mass = kinetic_metric(&mut proved.model.graph, &proved.system, &distribution.sections());
    let mass = mass.iter().map(|row| restriction.apply_all(&mut proved.model.graph, row)).collect();
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let facts = proved.facts.clone();
    let judge = |graph: &Graph, matrix: &Matrix| definiteness(graph, matrix, &parameters, &facts);
    jumps(proved, restriction, &on_distribution(mass, Matrix::new()), &judge)
}

/// The impacts in all velocities: W (y⁺ − y⁻) − Jᵀλ = Ψᵀμ, J (y⁺ − y⁻) = 0.
pub(super) fn projected(
    proved: &mut Proved,
    equations: &SaddleEquations,
    judge: &Judge<'_>,
) -> Vec<ImpactForm> {
    let kept = on_distribution(equations.mass.clone(), equations.jacobian.clone());
    jumps(proved, &mut Substitution::new([]), &kept, judge)
}

/// What is to be solved for each row.
fn on_distribution(mass: Matrix, jacobian: Matrix) -> SaddleEquations {
    SaddleEquations { mass, force: Vec::new(), jacobian, bias: Vec::new(), rates: Vec::new() }
}

fn jumps(
    proved: &mut Proved,
    restriction: &mut Substitution,
    equations: &SaddleEquations,
    judge: &Judge<'_>,
) -> Vec<ImpactForm> {
    let impacts = proved.impacts.clone();
    impacts.iter().map(|impact| jump(proved, restriction, (equations, judge), impact)).collect()
}

fn jump(
    proved: &mut Proved,
    restriction: &mut Substitution,
    (equations, judge): (&SaddleEquations, &Judge<'_>),
    impact: &Impact,
) -> ImpactForm {
    let is_homogeneous = is_homogeneous(proved, impact);
    let coordinates: Vec<SymbolId> = proved.model.coordinates.iter().map(|c| c.symbol).collect();
    let graph = &mut proved.model.graph;
    let mut procedure = Procedure::default();
    let approach: Vec<ExprId> = impact
        .rows
        .iter()
        .map(|row| {
            let form = restriction.apply(graph, row.form);
            graph.simplify(form)
        })
        .collect();
    let bias = vec![graph.zero(); equations.jacobian.len()];
    let responses: Matrix = impact
        .rows
        .iter()
        .map(|row| {
            let pushed =
                SaddleEquations { force: row.coefficients.clone(), bias: bias.clone(), ..equations.clone() };
            pushed.solve(graph, judge, &mut procedure).0
        })
        .collect();
    let mut mobility: Matrix = Vec::new();
    for (a, row) in impact.rows.iter().enumerate() {
        let entries = responses.iter().enumerate().map(|(b, response)| {
            // K is symmetric
            if b < a {
                return mobility[b][a];
            }
            let entry = graph.inner_product(&row.coefficients, response);
            procedure.define(graph, "mobility", entry)
        });
        let entries = entries.collect();
        mobility.push(entries);
    }
    procedure.outputs = approach
        .into_iter()
        .chain(responses.into_iter().flatten())
        .chain(mobility.into_iter().flatten())
        .collect();
    let gaps: Vec<ExprId> = impact.rows.iter().filter_map(|row| row.position).collect();
    let mut terms = Vec::new();
    for gap in &gaps {
        for coordinate in &coordinates {
            let (slope, value) = (graph.partial(*gap, *coordinate), graph.symbol(*coordinate));
            terms.push(graph.formula(slope * value));
        }
    }
    let mut seen = 0;
    let place = |row: &crate::check::ImpactRow| {
        row.position.map(|_| {
            seen += 1;
            seen - 1
        })
    };
    let zero = graph.zero();
    ImpactForm {
        label: impact.label.clone(),
        names: impact.rows.iter().map(|row| row.name.clone()).collect(),
        places: impact.rows.iter().map(place).collect(),
        unilateral: impact.rows.iter().map(|row| row.is_unilateral).collect(),
        is_homogeneous,
        gaps: Procedure::of(gaps),
        terms: Procedure::of(terms),
        restitution: Procedure::of(vec![impact.restitution.unwrap_or(zero)]),
        jump: procedure,
    }
}

/// Whether nothing moves by itself: the rows and the constraints vanish with the velocities.
fn is_homogeneous(proved: &mut Proved, impact: &Impact) -> bool {
    let Proved { model, system, constraints, base, .. } = proved;
    let graph = &mut model.graph;
    let zero = graph.zero();
    let mut at_rest = Substitution::new(system.algebroid.velocities.iter().map(|velocity| (*velocity, zero)));
    let drift = constraints.linear.iter().flat_map(|linear| linear.drift.iter().copied());
    let own: Vec<ExprId> = impact.rows.iter().map(|row| at_rest.apply(graph, row.form)).collect();
    own.into_iter().chain(drift).all(|bias| base.zero_test(graph, bias).is_zero())
}

//! The constraints: linear in the velocities, independent, and fewer than the sections.

use super::evidence::{listed, shown};
use super::kinematics::Motion;
use crate::algebra::{Echelon, FieldPoint, Graph, Matrix, NotLinear};
use crate::geometry::{Algebroid, LinearConstraints};
use crate::id::{ConstraintId, ExprId, Id};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// Reads Φ off the constraints and proves its rows independent.
///
/// # Errors
/// Constraints of a shape that cannot be treated, dependent or inconsistent ones, and as many as
/// there are sections.
pub fn linear_constraints(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: &Algebroid,
) -> Result<LinearConstraints, Vec<Violation>> {
    let mut constraints = LinearConstraints { annihilator: Vec::new(), drift: Vec::new() };
    let mut violations = Vec::new();
    for id in model.constraints.ids() {
        match linear_row(model, motion, algebroid, id) {
            Ok((row, drift)) => {
                constraints.annihilator.push(row);
                constraints.drift.push(drift);
            }
            Err(violation) => violations.push(violation),
        }
    }
    if violations.is_empty() {
        violations.extend(dependent(model, &constraints));
    }
    if violations.is_empty()
        && !model.constraints.is_empty()
        && model.constraints.len() >= model.sections.len()
    {
        violations.push(too_many(model));
    }
    if violations.is_empty() { Ok(constraints) } else { Err(violations) }
}

/// How a constraint is called in messages.
pub(super) fn name_of(model: &Model, id: ConstraintId) -> String {
    match &model.constraints[id].label {
        Some(label) => format!("`{label}`"),
        None => format!("constraint {}", id.index() + 1),
    }
}

fn linear_row(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: &Algebroid,
    id: ConstraintId,
) -> Result<(Vec<ExprId>, ExprId), Violation> {
    let declaration = model.constraints[id].clone();
    let name = name_of(model, id);
    let blame = |what: String, evidence: String, way_out: String| Violation {
        law: Law::Constraint,
        origin: declaration.origin,
        what,
        evidence,
        way_out,
    };
    let graph = &mut model.graph;
    let residual = motion.rates.apply(graph, declaration.residual);
    if graph.zero_test(residual).is_zero() {
        return Err(blame(
            format!("{name} says nothing: its two sides are equal"),
            String::new(),
            "leave it out".into(),
        ));
    }
    let form = match graph.linear_form(residual, &algebroid.velocities) {
        Ok(form) => form,
        Err(NotLinear::Curved(..)) => {
            return Err(blame(
                format!(
                    "{name} is not linear in the velocities; nonlinear constraints are not supported yet"
                ),
                shown(graph, residual),
                "write a constraint that is linear in the velocities".into(),
            ));
        }
        Err(NotLinear::Unknown(why)) => {
            return Err(blame(
                format!("{name} could not be decided to be linear in the velocities"),
                why,
                "write it as a sum of velocities with coefficients on the base".into(),
            ));
        }
    };
    if form.coefficients.iter().all(|coefficient| graph.zero_test(*coefficient).is_zero()) {
        return Err(position_constraint(model, algebroid, residual, &name, declaration.origin));
    }
    let row = form.coefficients.into_iter().map(|coefficient| graph.simplify(coefficient)).collect();
    let drift = if graph.zero_test(form.rest).is_zero() { graph.zero() } else { graph.simplify(form.rest) };
    Ok((row, drift))
}

/// A constraint on the base alone: its derivative is what a velocity constraint would say.
fn position_constraint(
    model: &mut Model,
    algebroid: &Algebroid,
    residual: ExprId,
    name: &str,
    origin: crate::id::Origin,
) -> Violation {
    let graph = &mut model.graph;
    let velocity = algebroid.velocity(graph);
    let derivative = algebroid.along(graph, &velocity, model.time).apply(graph, residual);
    let derivative = graph.simplify(derivative);
    let vanishes = graph.zero_test(derivative).is_zero();
    let (evidence, way_out) = if vanishes {
        (
            format!("`{}` is the same at all times", shown(graph, residual)),
            "it holds always or never; leave it out".to_owned(),
        )
    } else {
        (
            format!("its derivative is {} = 0", shown(graph, derivative)),
            "constrain the velocities: write the derivative, and start on the surface".to_owned(),
        )
    };
    Violation {
        law: Law::Constraint,
        origin,
        what: format!("{name} has no velocities in it: it constrains positions"),
        evidence,
        way_out,
    }
}

fn too_many(model: &Model) -> Violation {
    let last = model.constraints.iter().last().map_or(model.origin, |constraint| constraint.origin);
    let (constraints, sections) = (model.constraints.len(), model.sections.len());
    Violation {
        law: Law::Independence,
        origin: last,
        what: format!(
            "as many independent constraints as sections ({constraints} of {sections}): nothing can move"
        ),
        evidence: "the constraint distribution has rank 0".into(),
        way_out: "leave a constraint out, or add the velocities that it leaves free".into(),
    }
}

/// The first constraint that follows from those before it, or contradicts them.
fn dependent(model: &mut Model, constraints: &LinearConstraints) -> Option<Violation> {
    let rows = &constraints.annihilator;
    let mut rank = 0;
    for count in 1..=rows.len() {
        let found = match model.graph.generic_rank(&rows[..count]) {
            Ok(found) => found,
            Err(why) => return Some(undecided(model, &why)),
        };
        if found == rank {
            return Some(dependency(model, constraints, count - 1));
        }
        rank = found;
    }
    None
}

fn undecided(model: &Model, why: &str) -> Violation {
    Violation {
        law: Law::Decidable,
        origin: model.constraints.iter().next().map_or(model.origin, |constraint| constraint.origin),
        what: "whether the constraints are independent could not be decided".into(),
        evidence: why.into(),
        way_out: "write them without roots of negative numbers and divisions by zero".into(),
    }
}

/// Shows the combination of earlier constraints that a dependent one is.
fn dependency(model: &mut Model, constraints: &LinearConstraints, index: usize) -> Violation {
    let id = ConstraintId::from_index(index);
    let name = name_of(model, id);
    let combination = combination(&mut model.graph, constraints, index);
    let names: Vec<String> = (0..index).map(|i| name_of(model, ConstraintId::from_index(i))).collect();
    let graph = &mut model.graph;
    let terms: Vec<String> = combination
        .iter()
        .flatten()
        .zip(&names)
        .filter(|(coefficient, _)| !graph.is_literal_zero(**coefficient))
        .map(|(coefficient, name)| format!("({})·{name}", shown(graph, *coefficient)))
        .collect();
    let evidence = if terms.is_empty() {
        format!("it is a combination of {}", listed(&names))
    } else {
        format!("{name} = {}", terms.join(" + "))
    };
    let drifts: Vec<ExprId> = constraints.drift[..index].to_vec();
    let contradiction = combination.and_then(|coefficients| {
        let combined = graph.inner_product(&coefficients, &drifts);
        let left_over = graph.sub(constraints.drift[index], combined);
        let left_over = graph.simplify(left_over);
        (!graph.zero_test(left_over).is_zero()).then_some(left_over)
    });
    let (what, evidence, way_out) = match contradiction {
        None => (
            format!("{name} follows from the constraints before it"),
            evidence,
            "leave it out: the constraints of a system are independent",
        ),
        Some(left_over) => (
            format!("{name} contradicts the constraints before it"),
            format!("in the velocities {evidence}, but then {} = 0 is left", shown(graph, left_over)),
            "change or leave out one of them",
        ),
    };
    Violation {
        law: Law::Independence,
        origin: model.constraints[id].origin,
        what,
        evidence,
        way_out: way_out.into(),
    }
}

/// The coefficients c with Φ^index = Σ c_A Φ^A over earlier rows.
fn combination(graph: &mut Graph, constraints: &LinearConstraints, index: usize) -> Option<Vec<ExprId>> {
    let earlier = &constraints.annihilator[..index];
    let sampled = graph.matrix_in_field(earlier, |seed| FieldPoint::random(8_000 + seed)).ok()?;
    let columns = Echelon::of(sampled).pivots;
    let matrix: Matrix =
        columns.iter().map(|column| earlier.iter().map(|row| row[*column]).collect()).collect();
    let right: Matrix = columns.iter().map(|column| vec![constraints.annihilator[index][*column]]).collect();
    let solution = graph.solve_linear(&matrix, &right)?;
    Some(solution.values.into_iter().map(|row| graph.simplify(row[0])).collect())
}

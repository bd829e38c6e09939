//! Dependent constraints, with the dependency shown.

use super::evidence::{counted, listed, name_of, shown};
use crate::algebra::{Demand, Graph, Matrix};
use crate::geometry::Manifold;
use crate::id::{ConstraintId, ExprId, Id, SymbolId};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// The first constraint whose row (of Φ, or of ∂φ/∂y) is a combination of those before it on the
/// manifold, or on a part of it; with `drift` a contradiction is told from a redundancy. Parts that are too many to be
/// asked become open.
pub(super) fn dependent_rows(
    model: &mut Model,
    rows: &Matrix,
    drift: Option<&[ExprId]>,
    asked: &mut Manifold,
) -> Option<Violation> {
    let manifold = &with_all_roots(model, asked, rows);
    let parts: Vec<&Manifold> = manifold.parts().collect();
    let mut found = Vec::with_capacity(parts.len());
    for part in &parts {
        match first_dependent(&mut model.graph, rows, part) {
            Ok(dependent) => found.push(dependent),
            Err(why) => return Some(undecided(model, &why)),
        }
    }
    let ill_posed = found.iter().position(Option::is_some)?;
    let Dependent { index, is_zero } = found[ill_posed]?;
    Some(if found.iter().any(Option::is_none) {
        let id = ConstraintId::from_index(index);
        let place = place_of(model, manifold, parts[ill_posed]);
        let says =
            if is_zero { "says nothing about velocities" } else { "follows from the constraints before it" };
        Violation {
            law: Law::Independence,
            origin: model.constraints[id].origin,
            what: format!("{} {says}{place}", name_of(model, id)),
            evidence: PARTS.into(),
            way_out: ONE_PART.into(),
        }
    } else if is_zero {
        degenerate_constraint(model, index)
    } else {
        dependency(model, rows, drift, index)
    })
}

/// A manifold with the parts where roots have the other sign, as far as a matrix may be another one there. Those that are
/// too many to be asked become open parts of the manifold.
pub(crate) fn with_all_roots(model: &mut Model, manifold: &mut Manifold, matrix: &Matrix) -> Manifold {
    let mut all = manifold.clone();
    let open = all.without_open_parts();
    if all.add_parts_of_roots_in(&mut model.graph, &matrix.concat()) {
        manifold.leave_open(all.without_open_parts());
        let demands = where_they_hold(model);
        all.keep_parts_with_points(&mut model.graph, &demands);
    }
    all.leave_open(open);
    all
}

/// What is required of real points where the constraints hold.
pub(super) fn where_they_hold(model: &mut Model) -> Vec<(ExprId, Demand)> {
    let mut demands = super::assumptions::on_the_base(model);
    demands.extend(model.positions.iter().map(|position| (position.value, Demand::Zero)));
    demands
}

/// A row that depends on those before it.
#[derive(Clone, Copy)]
struct Dependent {
    index: usize,
    /// Whether all of it is zero.
    is_zero: bool,
}

/// The first such row on a part of a manifold.
fn first_dependent(graph: &mut Graph, rows: &Matrix, part: &Manifold) -> Result<Option<Dependent>, String> {
    let restricted = part.restrict_matrix(graph, rows);
    if graph.generic_rank(&restricted) == Ok(rows.len()) {
        return Ok(None);
    }
    let mut rank = 0;
    for index in 0..restricted.len() {
        let found = graph.generic_rank(&restricted[..=index])?;
        if found == rank {
            let is_zero = restricted[index].iter().all(|entry| graph.zero_test(*entry).is_zero());
            return Ok(Some(Dependent { index, is_zero }));
        }
        rank = found;
    }
    Ok(None)
}

/// Why a question is asked several times.
pub(super) const PARTS: &str = "the constraints hold on several parts, and a system is well-posed on all of \
                                them, or it is refused";
/// What to do where one part is ill-posed.
pub(super) const ONE_PART: &str =
    "write the constraint of the part that is meant, as `x = a` instead of `x^2 = a^2`";

/// ` where x = -2`.
pub(super) fn place_of(model: &Model, manifold: &Manifold, part: &Manifold) -> String {
    let images = equations_of(model, manifold, part.images());
    if images.is_empty() {
        " on a part of where they hold".into()
    } else {
        format!(" where {}", listed(&images))
    }
}

/// `x = -2`, for the images that not all parts have.
fn equations_of(model: &Model, manifold: &Manifold, images: &[(SymbolId, ExprId)]) -> Vec<String> {
    let own = manifold.own_images(images).into_iter();
    own.map(|(symbol, image)| format!("{} = {}", model.graph.symbols()[symbol], shown(&model.graph, image)))
        .collect()
}

/// Where constraints may hold without having been asked there, a line for each part, as far as they are few.
pub(crate) fn not_asked(model: &Model, manifold: &Manifold) -> Vec<String> {
    const LINES: usize = 4;
    const EQUATIONS: usize = 6;
    let graph = &model.graph;
    let parts = manifold.open_parts();
    let open = parts.iter().take(LINES).map(|part| {
        let mut equations = equations_of(model, manifold, &part.images);
        let functions = part.functions.iter().filter(|function| !graph.is_literal_zero(**function));
        equations.extend(functions.map(|function| format!("{} = 0", shown(graph, *function))));
        let further = equations.len().saturating_sub(EQUATIONS);
        equations.truncate(EQUATIONS);
        equations.extend((further > 0).then(|| counted(further, "equation more", "equations more")));
        let place =
            if equations.is_empty() { "elsewhere".into() } else { format!("where {}", listed(&equations)) };
        format!("the constraints may hold as well {place}: nothing was asked there")
    });
    let mut lines: Vec<String> = open.collect();
    let further = parts.len().saturating_sub(LINES);
    if further > 0 {
        let parts = counted(further, "part", "parts");
        lines.push(format!("the constraints may hold on {parts} more, where nothing was asked"));
    }
    lines
}

/// A constraint whose derivative vanishes where it holds, such as a square.
fn degenerate_constraint(model: &Model, index: usize) -> Violation {
    let id = ConstraintId::from_index(index);
    let name = name_of(model, id);
    Violation {
        law: Law::Independence,
        origin: model.constraints[id].origin,
        what: format!(
            "{name} exerts no force: its derivative with respect to the velocities vanishes where it holds"
        ),
        evidence: format!("all ∂φ/∂y are 0 on {} = 0", shown(&model.graph, model.constraints[id].residual)),
        way_out: "write it without the power, as `a = b` instead of `(a - b)^2 = 0`".into(),
    }
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

/// The way out where a constraint follows from others. An entry of a vector equation cannot be left out by itself.
pub(super) fn left_out(model: &Model, id: ConstraintId) -> String {
    let constraint = &model.constraints[id];
    if !constraint.is_entry {
        return "leave it out: the constraints of a system are independent".into();
    }
    let before = model.constraints.iter().take(id.index());
    let entry = before.filter(|other| other.is_entry && other.origin == constraint.origin).count();
    format!(
        "it is entry {entry} of this equation, counted from 0: leave that entry out, by parts of both sides such as \
         `(…)[0..2]`, or write an equation for each of the others"
    )
}

/// Shows the combination of earlier constraints that a dependent one is.
fn dependency(model: &mut Model, rows: &Matrix, drift: Option<&[ExprId]>, index: usize) -> Violation {
    let id = ConstraintId::from_index(index);
    let name = name_of(model, id);
    let combination = combination(&mut model.graph, &rows[..index], &rows[index]);
    let names: Vec<String> = (0..index).map(|i| name_of(model, ConstraintId::from_index(i))).collect();
    let evidence = in_words(&model.graph, &name, combination.as_deref(), &names);
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let assumed = super::assumptions::on_the_base(model);
    let demands = |left_over: ExprId| [assumed.as_slice(), &[(left_over, Demand::Zero)]].concat();
    let graph = &mut model.graph;
    let contradiction = combination.zip(drift).and_then(|(coefficients, drift)| {
        let combined = graph.inner_product(&coefficients, &drift[..index]);
        let left_over = graph.formula(drift[index] - combined);
        let left_over = graph.simplify(left_over);
        (!graph.zero_test(left_over).is_zero()).then_some(left_over)
    });
    let (what, evidence, way_out) = match contradiction {
        None => (format!("{name} follows from the constraints before it"), evidence, left_out(model, id)),
        Some(left_over) if graph.contradiction(&demands(left_over)).is_none() => (
            format!(
                "{name} agrees with the constraints before it only where {} = 0",
                shown(graph, left_over)
            ),
            format!("as far as velocities go, {evidence}"),
            if graph.depends_on(left_over, &coordinates) {
                "change or leave out one of them; what constrains positions is written in `holonomic`"
            } else {
                "change or leave out one of them"
            }
            .to_owned(),
        ),
        Some(left_over) => (
            format!("{name} contradicts the constraints before it"),
            format!("as far as velocities go, {evidence}; then {} = 0 is left", shown(graph, left_over)),
            "change or leave out one of them".to_owned(),
        ),
    };
    Violation { law: Law::Independence, origin: model.constraints[id].origin, what, evidence, way_out }
}

/// The combination of earlier rows that a row is, as text.
pub(super) fn combination_shown(model: &mut Model, rows: &Matrix, earlier: &[usize], index: usize) -> String {
    let before: Matrix = earlier.iter().map(|row| rows[*row].clone()).collect();
    let combination = combination(&mut model.graph, &before, &rows[index]);
    let names: Vec<String> =
        earlier.iter().map(|row| name_of(model, ConstraintId::from_index(*row))).collect();
    let name = name_of(model, ConstraintId::from_index(index));
    in_words(&model.graph, &name, combination.as_deref(), &names)
}

/// The combination of some rows that another is, as text.
pub(super) fn combination_of(
    graph: &mut Graph,
    before: &[Vec<ExprId>],
    row: &[ExprId],
    names: &[String],
    name: &str,
) -> String {
    let combination = combination(graph, before, row);
    in_words(graph, name, combination.as_deref(), names)
}

/// `c = (x)*a + b`.
fn in_words(graph: &Graph, name: &str, combination: Option<&[ExprId]>, names: &[String]) -> String {
    let terms: Vec<String> = combination
        .into_iter()
        .flatten()
        .zip(names)
        .filter(|(coefficient, _)| !graph.is_literal_zero(**coefficient))
        .map(|(coefficient, name)| match graph.as_number(*coefficient) {
            Some(number) if number.is_one() => name.clone(),
            _ => format!("({})*{name}", shown(graph, *coefficient)),
        })
        .collect();
    if terms.is_empty() {
        return format!("it is a combination of {}", listed(names));
    }
    format!("{name} = {}", terms.join(" + "))
}

/// The coefficients c with `row` = Σ c_A Φ^A over earlier rows.
fn combination(graph: &mut Graph, earlier: &[Vec<ExprId>], row: &[ExprId]) -> Option<Vec<ExprId>> {
    graph.solve_overdetermined(&Graph::transposed(earlier), row)
}

/// The first of some vectors that is a combination of those before it, and what there is to say.
pub(super) fn dependent_columns(graph: &Graph, vectors: &Matrix) -> Option<(usize, String)> {
    let mut rank = 0;
    for count in 1..=vectors.len() {
        match graph.generic_rank(&vectors[..count]) {
            Ok(found) if found > rank => rank = found,
            Ok(_) => return Some((count - 1, format!("their span has rank {rank} only"))),
            Err(why) => return Some((count - 1, format!("their rank could not be decided: {why}"))),
        }
    }
    None
}

//! The kinematic equations ẋ^i = ρ^i_α y^α, mathematics (1).

use super::evidence::{counted, shown};
use crate::algebra::{Graph, Matrix, NotLinear, Substitution};
use crate::geometry::Anchor;
use crate::id::{ExprId, Id, Origin, SymbolId};
use crate::model::{AnchorDecl, Kinematics, Located, Model};
use crate::violation::{Law, Violation};

/// The anchor, and what the rates ẋ^i stand for.
#[derive(Clone, Debug)]
pub struct Motion {
    /// ρ.
    pub anchor: Anchor,
    /// Puts ρ^i_α y^α for ẋ^i.
    pub rates: Substitution,
    /// α^k_j, where the quasi-velocities were declared by a coframe.
    pub coframe: Option<Matrix>,
    /// What the inverses of the coframe and of the frame are divided by.
    pub divisors: Vec<ExprId>,
    /// Declared velocities whose sections the frame has replaced, with their row of Ψ: the
    /// component of each section of the new basis along the replaced one.
    pub replaced: Vec<(SymbolId, Vec<ExprId>)>,
    /// Sections with a name that are not in the basis, with their components in it.
    pub named: Vec<(SymbolId, Vec<ExprId>)>,
    /// Declared velocities that stay in the basis of the frame with another value, and what they were, in the new ones.
    pub shifted: Vec<(SymbolId, ExprId)>,
}

/// Reads the anchor off the declaration.
///
/// # Errors
/// An anchor line or a coframe that is not linear and homogeneous, depends on more than the base,
/// or is not invertible.
pub fn kinematics(model: &mut Model) -> Result<Motion, Vec<Violation>> {
    match model.kinematics.clone() {
        Kinematics::Tangent => Ok(tangent(model)),
        Kinematics::Anchor(lines) => declared_anchor(model, &lines),
        Kinematics::Coframe(rows) => inverted_coframe(model, &rows),
    }
}

fn coordinates(model: &Model) -> Vec<SymbolId> {
    model.coordinates.iter().map(|coordinate| coordinate.symbol).collect()
}

fn velocities(model: &Model) -> Vec<SymbolId> {
    model.sections.iter().map(|section| section.symbol).collect()
}

/// E = TM with its coordinate frame.
fn tangent(model: &mut Model) -> Motion {
    let n = model.coordinates.len();
    let entries = model.graph.identity(n);
    let anchor = Anchor { entries, coordinates: coordinates(model), rank: model.sections.len() };
    Motion {
        anchor,
        rates: Substitution::new([]),
        coframe: None,
        divisors: Vec::new(),
        replaced: Vec::new(),
        named: Vec::new(),
        shifted: Vec::new(),
    }
}

fn declared_anchor(model: &mut Model, lines: &[AnchorDecl]) -> Result<Motion, Vec<Violation>> {
    let velocities = velocities(model);
    let mut entries: Matrix = vec![Vec::new(); model.coordinates.len()];
    let mut violations = Vec::new();
    for line in lines {
        let name = model.coordinates[line.coordinate].name.clone();
        let subject = format!("the anchor line of `{name}`");
        match homogeneous_row(model, line.rate, &velocities, &subject, line.origin, Law::Anchor) {
            Ok(row) => entries[line.coordinate.index()] = row,
            Err(violation) => violations.push(violation),
        }
    }
    for (id, coordinate) in model.coordinates.iter_ids() {
        if !lines.iter().any(|line| line.coordinate == id) {
            violations.push(Violation {
                law: Law::Anchor,
                origin: coordinate.origin,
                what: format!("the anchor has no line for the coordinate `{}`", coordinate.name),
                evidence: "the kinematic equations give the rate of every base coordinate".into(),
                way_out: format!(
                    "add `der({0}) = …;`, or `der({0}) = 0;` if it never changes",
                    coordinate.name
                ),
            });
        }
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    let anchor = Anchor { entries, coordinates: coordinates(model), rank: model.sections.len() };
    let rates = rate_substitution(model, &anchor);
    Ok(Motion {
        anchor,
        rates,
        coframe: None,
        divisors: Vec::new(),
        replaced: Vec::new(),
        named: Vec::new(),
        shifted: Vec::new(),
    })
}

/// The coefficients of an expression that must be linear and homogeneous in `variables`, with
/// coefficients on the base.
fn homogeneous_row(
    model: &mut Model,
    expression: ExprId,
    variables: &[SymbolId],
    subject: &str,
    origin: Origin,
    law: Law,
) -> Result<Vec<ExprId>, Violation> {
    let blame =
        |what: String, evidence: String, way_out: String| Violation { law, origin, what, evidence, way_out };
    let (variable, nonlinear, drift) = match law {
        Law::Coframe => (
            "the rates der(x)",
            "a coframe is linear in the rates; a nonlinear relation belongs in `constraints`",
            "a quasi-velocity vanishes with the rates; a drift belongs in an affine constraint",
        ),
        _ => (
            "the velocities",
            "an anchor is a linear map; a velocity with a nonlinear relation belongs in `constraints`",
            "a drift belongs in an affine constraint, or in a base coordinate of its own",
        ),
    };
    let graph = &mut model.graph;
    let form = graph.linear_form(expression, variables).map_err(|error| match error {
        NotLinear::Curved(first, second) => {
            let (first, second) = (&graph.symbols()[first], &graph.symbols()[second]);
            let term = if first == second { format!("{first}^2") } else { format!("{first}*{second}") };
            blame(
                format!("{subject} is not linear in {variable}"),
                format!("{} has a term like {term}", shown(graph, expression)),
                nonlinear.into(),
            )
        }
        NotLinear::Unknown(why) => blame(
            format!("{subject} could not be decided to be linear in {variable}"),
            why,
            format!("write it as a sum of {variable} with coefficients on the base"),
        ),
    })?;
    let rest = graph.zero_test(form.rest);
    if !rest.is_zero() {
        return Err(blame(
            format!("{subject} is not homogeneous in {variable}"),
            format!("where {variable} are 0 it is {}", shown(graph, form.rest)),
            drift.into(),
        ));
    }
    let base: Vec<SymbolId> = model
        .coordinates
        .iter()
        .map(|coordinate| coordinate.symbol)
        .chain(model.parameters.iter().map(|parameter| parameter.symbol))
        .collect();
    let graph = &model.graph;
    if let Some(stranger) = graph.symbols_in(&form.coefficients).into_iter().find(|s| !base.contains(s)) {
        let name = &graph.symbols()[stranger];
        return Err(blame(
            format!("{subject} depends on `{name}`"),
            "its coefficients are functions on the base: of the base coordinates and the parameters".into(),
            format!("make `{name}` a parameter or a base coordinate"),
        ));
    }
    Ok(form.coefficients)
}

fn rate_substitution(model: &mut Model, anchor: &Anchor) -> Substitution {
    let symbols = velocities(model);
    let velocity: Vec<ExprId> = symbols.iter().map(|symbol| model.graph.symbol(*symbol)).collect();
    let rates = anchor.vector_field(&mut model.graph, &velocity);
    Substitution::new(model.coordinates.iter().map(|coordinate| coordinate.rate).zip(rates))
}

/// w^k = α^k_j ẋ^j is inverted: ρ = β = α⁻¹ (CNS section 3).
fn inverted_coframe(model: &mut Model, rows: &[Located]) -> Result<Motion, Vec<Violation>> {
    let variables: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.rate).collect();
    let names: Vec<String> = model.sections.iter().map(|section| section.name.clone()).collect();
    let mut coframe: Matrix = Vec::new();
    let mut violations = Vec::new();
    for (row, name) in rows.iter().zip(&names) {
        let subject = format!("the quasi-velocity `{name}`");
        match homogeneous_row(model, row.value, &variables, &subject, row.origin, Law::Coframe) {
            Ok(coefficients) => coframe.push(coefficients),
            Err(violation) => violations.push(violation),
        }
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    // names may stand beside it in a declaration in error
    if coframe.len() != variables.len() || names.len() != variables.len() {
        return Err(vec![not_square(model, coframe.len())]);
    }
    let graph = &mut model.graph;
    let n = coframe.len();
    let identity = graph.identity(n);
    let regular = match graph.generic_rank(&coframe) {
        Ok(rank) => rank == n,
        Err(why) => return Err(vec![undecided(model, &why)]),
    };
    let solution = if regular { model.graph.solve_linear(&coframe, &identity) } else { None };
    let Some(solution) = solution else { return Err(vec![singular_coframe(model, &coframe)]) };
    let anchor = Anchor { entries: solution.values, coordinates: coordinates(model), rank: n };
    let rates = rate_substitution(model, &anchor);
    Ok(Motion {
        anchor,
        rates,
        coframe: Some(coframe),
        divisors: solution.divisors,
        replaced: Vec::new(),
        named: Vec::new(),
        shifted: Vec::new(),
    })
}

fn not_square(model: &Model, found: usize) -> Violation {
    let wanted = model.coordinates.len();
    Violation {
        law: Law::Coframe,
        origin: model.origin,
        what: format!(
            "the coframe is not square: {} for {}",
            counted(found, "quasi-velocity", "quasi-velocities"),
            counted(wanted, "base coordinate", "base coordinates")
        ),
        evidence: "quasi-velocities by a coframe are as many as the rates der(x)".into(),
        way_out: "declare one quasi-velocity for each base coordinate, or use `basis` and `anchor`".into(),
    }
}

fn undecided(model: &Model, why: &str) -> Violation {
    Violation {
        law: Law::Decidable,
        origin: model.origin,
        what: "whether the coframe is invertible could not be decided".into(),
        evidence: why.into(),
        way_out: "write the quasi-velocities without roots of negative numbers and divisions by zero".into(),
    }
}

fn singular_coframe(model: &mut Model, coframe: &[Vec<ExprId>]) -> Violation {
    let graph: &Graph = &model.graph;
    let rank = graph.generic_rank(coframe).unwrap_or(0);
    let blamed = (1..=coframe.len())
        .find(|count| graph.generic_rank(&coframe[..*count]).is_ok_and(|rank| rank < *count))
        .map_or(0, |count| count - 1);
    let (name, origin) = model
        .sections
        .iter()
        .nth(blamed)
        .map_or((String::new(), model.origin), |section| (section.name.clone(), section.origin));
    Violation {
        law: Law::Coframe,
        origin,
        what: "the coframe is not invertible: the rates do not follow from the quasi-velocities".into(),
        evidence: format!(
            "`{name}` is a combination of the quasi-velocities before it; the rank is {rank} of {}",
            coframe.len()
        ),
        way_out: "choose quasi-velocities that are linearly independent in the rates der(x)".into(),
    }
}

//! The velocities that levels of momenta leave to the state.
//!
//! On a level σ^α p_α = μ of a momentum that is conserved, σ in D, the sections B'_κ = ∂ŷ/∂v^κ of the
//! velocities ŷ(x, v) that the level leaves free lie in D, so that the force balance (8) along them is
//! Routh's equation for v^κ; along σ it says that the momentum is conserved, which holds on the level.
//!
//! Which velocities are solved for follows the rule of the constraints: those of a pivot that vanishes
//! nowhere, or those that the declaration does not name as independent. Else the state keeps all of them: the
//! motion keeps the levels by itself, and the way back to the constraints knows of them.

use super::proved::Level;
use super::proved::Proved;
use crate::algebra::{Graph, Matrix};
use crate::check::{eliminations, zeros};
use crate::geometry::independent_velocities::{Choice, NoChoice, judge, search};
use crate::geometry::{ConstraintDistribution, Manifold, MomentumLevel, PivotSetting};
use crate::id::{ExprId, Id, SectionId, SymbolId};
use crate::mechanics::{Definiteness, definiteness, kinetic_metric};
use crate::violation::{Law, Violation};

/// D on the levels.
pub(super) struct Leveled {
    /// The velocities that are left.
    pub(super) kept: ConstraintDistribution,
    /// Expressions of parameters that must not vanish.
    pub(super) conditions: Vec<ExprId>,
    /// What the report says of the choice.
    pub(super) remark: String,
}

/// φ^A and σ^α p_α − μ: what vanishes where the constraints and the levels hold.
///
/// # Errors
/// A level that follows from the constraints and the levels before it.
pub(super) fn residuals(proved: &mut Proved) -> Result<Vec<ExprId>, Vec<Violation>> {
    let mut residuals = proved.constraints.residuals.clone();
    if proved.levels.is_empty() {
        return Ok(residuals);
    }
    let manifold = manifold(proved);
    let graph = &mut proved.model.graph;
    let slopes = |graph: &mut Graph, residual: ExprId| -> Vec<ExprId> {
        let velocities = proved.system.algebroid.velocities.iter();
        velocities.map(|symbol| graph.partial(residual, *symbol)).collect()
    };
    let mut rows: Matrix = residuals.iter().map(|residual| slopes(graph, *residual)).collect();
    for level in &proved.levels {
        rows.push(slopes(graph, level.residual));
        residuals.push(level.residual);
        if manifold.independent_rows(graph, &rows).is_ok_and(|rows| rows.len() < residuals.len()) {
            return Err(not_independent(level, rows.len() == 1));
        }
    }
    Ok(residuals)
}

/// A level that determines nothing.
fn not_independent(level: &Level, alone: bool) -> Vec<Violation> {
    let (what, evidence) = if alone {
        ("no velocity", "it does not depend on any where the constraints hold")
    } else {
        ("no further velocity", "where the constraints hold, it follows from what is declared before it")
    };
    blame(
        level,
        format!("the momentum of `{}` determines {what}", level.name),
        evidence.into(),
        "leave it out",
    )
}

/// How the equations are derived on the levels.
pub(super) enum OnLevels {
    /// In a basis of D, with the velocities that the levels determine solved for.
    Adapted(Box<Leveled>),
    /// With the levels as constraints, since no velocity can be solved for wherever they are independent.
    Projected {
        /// What the report says of it.
        reason: String,
    },
}

/// The velocities that the levels leave.
///
/// # Errors
/// Momenta that are not affine in the velocities, or that do not depend on them independently; no choice
/// where the declaration leaves no other formulation.
pub(super) fn on_levels(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
) -> Result<OnLevels, Vec<Violation>> {
    let levels = proved.levels.clone();
    let Some(first) = levels.first() else {
        let (kept, conditions, remark) = (distribution.clone(), Vec::new(), String::new());
        return Ok(OnLevels::Adapted(Box::new(Leveled { kept, conditions, remark })));
    };
    if proved.model.orthonormal.is_some() {
        let evidence = "on a level the velocities that are left have a kinetic energy of their own".into();
        return Err(blame(first, "`routh` beside `orthonormal`".into(), evidence, "keep one of the two"));
    }
    let found = momenta_on_distribution(proved, distribution)?;
    let choice = match chosen(proved, distribution, &found)? {
        Ok(choice) => choice,
        Err(tried) => return without_choice(proved, first, &tried),
    };
    let eliminated = velocities(distribution, &choice.dependent);
    for symbol in &eliminated {
        let graph = &proved.model.graph;
        if proved.system.forces_along(*symbol).any(|force| !graph.zero_test(force).is_zero()) {
            return Err(blame(
                first,
                format!("a force acts along `{}`, which leaves the state", graph.symbols()[*symbol]),
                "with `distribution` it is known along the spanning sections alone".into(),
                "give that force along declared sections",
            ));
        }
    }
    let graph = &mut proved.model.graph;
    let Some(kept) = distribution.on_levels(graph, &found, &eliminated) else {
        let what = format!("the levels could not be solved for {}", quoted(graph, &eliminated));
        return Err(blame(first, what, String::new(), "name other velocities in `independent { … }`"));
    };
    let remark = remark(graph, &choice, &eliminated);
    Ok(OnLevels::Adapted(Box::new(Leveled { kept, conditions: choice.conditions, remark })))
}

fn blame(level: &Level, what: String, evidence: String, way_out: &str) -> Vec<Violation> {
    vec![Violation { law: Law::Symmetry, origin: level.origin, what, evidence, way_out: way_out.into() }]
}

fn velocities(distribution: &ConstraintDistribution, positions: &[SectionId]) -> Vec<SymbolId> {
    positions.iter().map(|id| distribution.independent[id.index()]).collect()
}

fn quoted(graph: &Graph, symbols: &[SymbolId]) -> String {
    let names: Vec<String> = symbols.iter().map(|symbol| format!("`{}`", graph.symbols()[*symbol])).collect();
    names.join(", ")
}

/// The momenta of the levels as functions on D, each independent of those before it.
fn momenta_on_distribution(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
) -> Result<Vec<MomentumLevel>, Vec<Violation>> {
    let symbols = proved.system.algebroid.velocities.clone();
    let graph = &mut proved.model.graph;
    let mut found: Vec<MomentumLevel> = Vec::new();
    for level in &proved.levels {
        let name = &level.name;
        let momentum = MomentumLevel::of(graph, distribution, level.residual, &symbols).map_err(|why| {
            blame(
                level,
                format!("the momentum of `{name}` could not be solved for a velocity"),
                why,
                "with `formulation { projected }` all velocities are kept, and the level is a constraint",
            )
        })?;
        found.push(momentum);
        let rows: Matrix = found.iter().map(|momentum| momentum.coefficients.clone()).collect();
        if proved.positions.manifold.independent_rows(graph, &rows).is_ok_and(|rows| rows.len() < found.len())
        {
            return Err(not_independent(level, found.len() == 1));
        }
    }
    Ok(found)
}

/// The velocities to solve the levels for, by position in D; where none will do, why.
fn chosen(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    levels: &[MomentumLevel],
) -> Result<Result<Choice, String>, Vec<Violation>> {
    let own = own_velocities(proved, distribution);
    let metric = metric(proved, distribution);
    let is_definite = is_definite(proved, &metric);
    let mut conditions = Vec::new();
    if !is_definite {
        match apart_from_levels(proved, distribution, &metric, levels.len()) {
            Some(more) => conditions = more,
            None => return Ok(Err("the kinetic metric along their sections may be singular".into())),
        }
    }
    let parameters: Vec<SymbolId> = proved.model.parameters.iter().map(|p| p.symbol).collect();
    let graph = &mut proved.model.graph;
    let rows: Matrix = levels.iter().map(|level| level.coefficients.clone()).collect();
    let on_base = proved.positions.manifold.restrict_matrix(graph, &rows);
    let facts = &proved.facts;
    let setting = PivotSetting { annihilator: &rows, on_base: &on_base, parameters: &parameters, facts };
    let origin = proved.levels.first().map_or(proved.model.origin, |level| level.origin);
    let undecided = |why: String| {
        vec![Violation {
            law: Law::Decidable,
            origin,
            what: "the levels could not be solved for any velocities".into(),
            evidence: why,
            way_out: "write the Lagrangian without roots of negative numbers and divisions by zero".into(),
        }]
    };
    let with = |choice: Choice| Choice { conditions: [choice.conditions, conditions].concat(), ..choice };
    // 1. the velocities that the declaration names
    let rank = distribution.rank();
    if let Some(named) = proved.model.independent.as_ref().filter(|named| named.len() < rank) {
        let is_kept = |a: &usize| named.iter().any(|(symbol, _)| *symbol == distribution.independent[*a]);
        let gone: Vec<SectionId> = (0..rank).filter(|a| !is_kept(a)).map(SectionId::from_index).collect();
        let judged = judge(graph, &setting, &gone).map_err(undecided)?;
        return judged.map(|choice| Ok(with(choice))).ok_or_else(|| {
            let gone = quoted(graph, &velocities(distribution, &gone));
            vec![Violation {
                law: Law::Choice,
                origin: named.first().map_or(origin, |(_, origin)| *origin),
                what: "these velocities are not independent on the levels".into(),
                evidence: format!("the levels do not determine {gone}"),
                way_out: "name others, or leave `independent` out and let them be chosen".into(),
            }]
        });
    }
    // 2. those of the σ themselves: their kinetic energies vanish only where the mass matrix is singular
    if is_definite
        && own.len() == levels.len()
        && let Some(choice) = judge(graph, &setting, &own).map_err(undecided)?
    {
        return Ok(Ok(Choice { breaks_down: Vec::new(), ..choice }));
    }
    // 3. others, by the rule. Where the levels are dependent the motion goes on: no pivot may vanish there
    let found = search(graph, &setting, &own, rank).map_err(undecided)?;
    let found = found.and_then(|choice| match choice.rank_drops.first() {
        Some(factor) => Err(NoChoice { tried: vec![(choice.dependent, *factor)] }),
        None => Ok(with(choice)),
    });
    let names = |positions: &[SectionId]| quoted(graph, &velocities(distribution, positions));
    Ok(found.map_err(|failure| eliminations(graph, &failure, names)))
}

/// The velocities of D that belong to sections σ of levels, by position.
fn own_velocities(proved: &mut Proved, distribution: &ConstraintDistribution) -> Vec<SectionId> {
    let graph = &mut proved.model.graph;
    let mut found = Vec::new();
    for level in &proved.levels {
        let along = distribution.components(graph, &level.section).unwrap_or_default();
        let is_own = |a: &usize| (0..along.len()).all(|b| (*a == b) != graph.is_literal_zero(along[b]));
        found.extend((0..along.len()).find(is_own).map(SectionId::from_index));
    }
    found.sort_unstable();
    found
}

/// The kinetic metric C on D.
fn metric(proved: &mut Proved, distribution: &ConstraintDistribution) -> Matrix {
    let graph = &mut proved.model.graph;
    let metric = kinetic_metric(graph, &proved.system, &distribution.sections());
    let mut restriction = distribution.restriction(graph, &proved.system.algebroid.velocities);
    metric.iter().map(|row| restriction.apply_all(graph, row)).collect()
}

/// Whether it is definite for physical parameters.
fn is_definite(proved: &Proved, metric: &Matrix) -> bool {
    let parameters: Vec<SymbolId> = proved.model.parameters.iter().map(|p| p.symbol).collect();
    definiteness(&proved.model.graph, metric, &parameters, &proved.facts) == Definiteness::Definite
}

/// The sections ∂ŷ/∂v^κ are orthogonal to the σ, and span D with them where the metric ⟨σ, τ⟩ of the levels is
/// regular: the expressions of parameters that must not vanish for that; `None` where others may.
fn apart_from_levels(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    metric: &Matrix,
    count: usize,
) -> Option<Vec<ExprId>> {
    let parameters: Vec<SymbolId> = proved.model.parameters.iter().map(|p| p.symbol).collect();
    let graph = &mut proved.model.graph;
    let mut sections = Matrix::new();
    for level in &proved.levels {
        sections.push(distribution.components(graph, &level.section)?);
    }
    let mut gram = Matrix::new();
    for section in &sections {
        let momentum = graph.image(metric, section);
        let row = graph.image(&sections, &momentum);
        gram.push(row.into_iter().map(|entry| graph.simplify(entry)).collect());
    }
    let on_base = proved.positions.manifold.restrict_matrix(graph, &gram);
    let facts = &proved.facts;
    let setting = PivotSetting { annihilator: &gram, on_base: &on_base, parameters: &parameters, facts };
    let all: Vec<SectionId> = (0..count).map(SectionId::from_index).collect();
    let choice = judge(graph, &setting, &all).ok()??;
    (choice.breaks_down.is_empty() && choice.rank_drops.is_empty()).then_some(choice.conditions)
}

/// The projected formulation, where no velocity can be solved for; a refusal where that is excluded.
fn without_choice(proved: &Proved, level: &Level, tried: &str) -> Result<OnLevels, Vec<Violation>> {
    let what = "no choice of velocities on the levels is valid everywhere";
    let Proved { model, .. } = proved;
    let named = model.independent.as_ref().filter(|named| named.len() < model.sections.len());
    let excluded = match (&model.distribution, model.formulation, named) {
        (None, None, None) => return Ok(OnLevels::Projected { reason: format!("{what}: {tried}") }),
        (Some(_), ..) => "beside `distribution` there is no projected formulation",
        (_, Some(_), _) => "the declaration asks for the adapted formulation",
        (.., Some(_)) => "the declaration names the velocities of the state",
    };
    Err(vec![Violation {
        law: Law::Choice,
        origin: level.origin,
        what: what.into(),
        evidence: format!("{tried}; {excluded}"),
        way_out:
            "name the velocities that the levels leave in `independent { … }` and accept where they break \
                  down, or leave the choice of the formulation out"
                .into(),
    }])
}

/// Where the levels are dependent, and where the choice that the declaration makes breaks down.
fn remark(graph: &Graph, choice: &Choice, eliminated: &[SymbolId]) -> String {
    let gone = quoted(graph, eliminated);
    let breaks_down = match choice.breaks_down.as_slice() {
        [] => String::new(),
        factors => {
            format!("; the levels are solved for {gone}, which breaks down where {}", zeros(graph, factors))
        }
    };
    let dependent = match choice.rank_drops.as_slice() {
        [] => String::new(),
        factors => format!("; the levels are dependent where {}", zeros(graph, factors)),
    };
    breaks_down + &dependent
}

/// The constraint manifold with the levels on it.
pub(super) fn manifold(proved: &mut Proved) -> Manifold {
    let velocities = &proved.system.algebroid.velocities;
    let graph = &mut proved.model.graph;
    let mut manifold = proved.constraints.manifold(graph, velocities);
    for level in &proved.levels {
        let residual = manifold.restrict(graph, level.residual);
        if let Ok(on_level) = Manifold::where_zero(graph, &[residual], velocities) {
            manifold.extend(graph, &on_level);
        }
    }
    manifold
}

/// The same levels in another description of the same distribution.
pub(super) fn again(
    proved: &mut Proved,
    described: &ConstraintDistribution,
    eliminated: &[(SymbolId, ExprId)],
) -> ConstraintDistribution {
    if eliminated.is_empty() {
        return described.clone();
    }
    let velocities = &proved.system.algebroid.velocities;
    let graph = &mut proved.model.graph;
    let residuals = proved.levels.iter().map(|level| level.residual);
    let levels: Result<Vec<MomentumLevel>, String> =
        residuals.map(|residual| MomentumLevel::of(graph, described, residual, velocities)).collect();
    let eliminated: Vec<SymbolId> = eliminated.iter().map(|(symbol, _)| *symbol).collect();
    let found = levels.ok().and_then(|levels| described.on_levels(graph, &levels, &eliminated));
    found.unwrap_or_else(|| described.clone())
}

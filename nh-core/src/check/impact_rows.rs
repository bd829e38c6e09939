//! Impacts: rows that are linear in the velocities, and say at the instant what the constraints do not, mathematics (50).

use super::assumptions::{demand, on_the_base};
use super::constraints::Constraints;
use super::evidence::shown;
use super::formulation::Chosen;
use super::impact_independence::dependent;
use super::kinematics::Motion;
use super::positions::Positions;
use crate::algebra::{Demand, NotLinear};
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::LagrangianSystem;
use crate::model::{ImpactDecl, ImpactRowDecl, Model, PositionDecl};
use crate::violation::{Law, Violation};

/// An impact whose rows are independent on the constraints.
#[derive(Clone, Debug)]
pub struct Impact {
    /// Its label.
    pub label: String,
    /// What acts.
    pub rows: Vec<ImpactRow>,
    /// e, where one is given.
    pub restitution: Option<ExprId>,
}

/// A row of an impact.
#[derive(Clone, Debug)]
pub struct ImpactRow {
    /// What it is called.
    pub name: String,
    /// Ψ y + b, in the velocities of the basis.
    pub form: ExprId,
    /// h, for a row on positions.
    pub position: Option<ExprId>,
    /// Whether it pushes and never pulls.
    pub is_unilateral: bool,
    /// Its coefficients along the velocities of the state: N = Ψ B, or Ψ.
    pub coefficients: Vec<ExprId>,
    /// Where it stands.
    pub origin: Origin,
}

/// Rows that are tried in all combinations at run time.
const MOST_ROWS: usize = 6;

/// Where impacts happen: the system between them.
#[derive(Debug)]
pub struct Between<'a> {
    /// How it moves.
    pub motion: &'a mut Motion,
    /// Its Lagrangian.
    pub system: &'a LagrangianSystem,
    /// What holds through the jump.
    pub constraints: &'a Constraints,
    /// Where it can be.
    pub positions: &'a Positions,
    /// The velocities of the state.
    pub chosen: &'a Chosen,
}

/// Reads the rows, and proves that they are independent of each other and of the constraints where they act.
///
/// # Errors
/// Rows that are not linear in the velocities, say nothing, or follow from others; inequalities between velocities;
/// coefficients of restitution outside 0 … 1; systems whose masses change with the velocities.
pub fn impacts(model: &mut Model, between: &mut Between) -> Result<Vec<Impact>, Vec<Violation>> {
    let declared = model.impacts.clone();
    let Some(first) = declared.first() else { return Ok(Vec::new()) };
    if let Some(violation) = not_at_all(model, between, first.origin) {
        return Err(vec![violation]);
    }
    let mut violations = Vec::new();
    let mut found = Vec::new();
    for declaration in &declared {
        match impact(model, between, declaration) {
            Ok(impact) => found.push(impact),
            Err(more) => violations.extend(more),
        }
    }
    if violations.is_empty() { Ok(found) } else { Err(violations) }
}

pub(super) fn refused(origin: Origin, what: String, evidence: String, way_out: &str) -> Violation {
    Violation { law: Law::Impact, origin, what, evidence, way_out: way_out.into() }
}

/// Systems for which no jump is defined.
fn not_at_all(model: &mut Model, between: &Between, origin: Origin) -> Option<Violation> {
    if !model.routh.is_empty() {
        return Some(refused(
            origin,
            "`impacts` is not derived beside `routh`".into(),
            "an impulse changes the momenta that `routh` holds".into(),
            "leave one of them out",
        ));
    }
    if between.constraints.linear.is_none() {
        return Some(refused(
            origin,
            "`impacts` is not derived beside constraints that are not linear in the velocities".into(),
            "what they permit changes with the velocity while it jumps".into(),
            "leave one of them out",
        ));
    }
    let graph = &mut model.graph;
    let velocities = &between.system.algebroid.velocities;
    let momenta = between.system.momenta(graph);
    momenta.into_iter().find_map(|momentum| {
        let curved = graph.linear_form(momentum, velocities).err()?;
        let evidence = match curved {
            NotLinear::Curved(..) => format!("the momentum {} is not linear in them", shown(graph, momentum)),
            NotLinear::Unknown(why) => why,
        };
        Some(refused(
            origin,
            "`impacts` asks for masses that do not change with the velocities".into(),
            evidence,
            "leave it out, or write a Lagrangian that is quadratic in the velocities",
        ))
    })
}

fn impact(
    model: &mut Model,
    between: &mut Between,
    declaration: &ImpactDecl,
) -> Result<Impact, Vec<Violation>> {
    let label = &declaration.label;
    let count = declaration.rows.len();
    if count > MOST_ROWS {
        let violation = refused(
            declaration.origin,
            format!(
                "`{label}` has {count} rows, more than the {MOST_ROWS} that are tried in all combinations"
            ),
            String::new(),
            "tell those apart that cannot act at the same instant: items of their own",
        );
        return Err(vec![violation]);
    }
    let mut violations: Vec<Violation> = Vec::new();
    let mut rows = Vec::new();
    for (index, row) in declaration.rows.iter().enumerate() {
        match read(model, between, declaration.row_name(index), *row) {
            Ok(row) => rows.push(row),
            Err(violation) => violations.push(violation),
        }
    }
    if violations.is_empty() {
        violations.extend(restitution(model, declaration, &rows));
    }
    if violations.is_empty() {
        violations.extend(never_open(model, label, &rows));
    }
    if violations.is_empty() {
        violations.extend(dependent(model, between, &rows));
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    let restitution = declaration.restitution.map(|restitution| restitution.value);
    Ok(Impact { label: label.clone(), rows, restitution })
}

/// Takes a row apart.
fn read(
    model: &mut Model,
    between: &mut Between,
    name: String,
    row: ImpactRowDecl,
) -> Result<ImpactRow, Violation> {
    let ImpactRowDecl { value, is_unilateral, origin } = row;
    let velocities: Vec<SymbolId> = between.system.algebroid.velocities.clone();
    let (mut restriction, along) = match between.chosen {
        Chosen::Adapted { distribution, .. } => {
            (distribution.restriction(&model.graph, &velocities), distribution.independent.clone())
        }
        Chosen::Projected { .. } => (crate::algebra::Substitution::new([]), velocities.clone()),
    };
    let rates = model.coordinates.iter().map(|coordinate| coordinate.rate);
    let moving: Vec<SymbolId> = rates.chain(along.iter().copied()).chain(velocities).collect();
    let in_basis = between.motion.rates.apply(&mut model.graph, value);
    let occurring = model.graph.symbols_in(&[value, in_basis]);
    let is_position = !occurring.iter().any(|symbol| moving.contains(symbol));
    if is_unilateral && !is_position {
        let evidence =
            format!("{} changes with the velocities, and jumps itself", shown(&model.graph, value));
        return Err(refused(
            origin,
            format!("`{name}` is an inequality between velocities"),
            evidence,
            "write `=` for what holds after the jump, or the gap between positions: `h >= 0`",
        ));
    }
    if let (true, Some(state)) = (is_position, auxiliary(model, &occurring)) {
        return Err(refused(
            origin,
            format!("`{name}` relates positions and the auxiliary state `{state}`"),
            "whether a gap closes would depend on the rate of that state".into(),
            "make it a base coordinate with a constraint",
        ));
    }
    let form = if is_position {
        let position = PositionDecl { label: None, value, is_entry: false, origin };
        let form = position.velocity_form(&mut model.graph, &model.coordinates, model.time).residual;
        between.motion.rates.apply(&mut model.graph, form)
    } else {
        in_basis
    };
    let graph = &mut model.graph;
    let restricted = restriction.apply(graph, form);
    let read = graph.linear_form(restricted, &along).map_err(|error| {
        let evidence = match error {
            NotLinear::Curved(..) => format!("{} is not", shown(graph, form)),
            NotLinear::Unknown(why) => why,
        };
        refused(
            origin,
            format!("`{name}` is not linear in the velocities"),
            evidence,
            "write rows that are: an impulse acts along their coefficients",
        )
    })?;
    let coefficients = read.coefficients.into_iter().map(|entry| graph.simplify(entry)).collect();
    let position = is_position.then_some(value);
    if is_position && cannot(model, &[(value, Demand::Zero)]) {
        return Err(refused(
            origin,
            format!("`{name}` is never met: its two sides are equal nowhere"),
            format!("{} is not 0 at any real positions", shown(&model.graph, value)),
            "correct it, or leave it out",
        ));
    }
    Ok(ImpactRow { name, form, position, is_unilateral, coefficients, origin })
}

/// Whether no positions that the system can have are as demanded, for parameters as they are assumed.
fn cannot(model: &mut Model, demanded: &[(ExprId, Demand)]) -> bool {
    let mut demands = on_the_base(model);
    demands.extend(model.positions.iter().map(|position| (position.value, Demand::Zero)));
    let values: Vec<ExprId> = demanded.iter().map(|(value, _)| *value).collect();
    demands = model.graph.related_demands(&demands, &values);
    demands.extend(demanded);
    model.graph.contradiction(&demands).is_some()
}

/// Gaps of one item that are open together nowhere: the system would have no place to be.
fn never_open(model: &mut Model, label: &str, rows: &[ImpactRow]) -> Option<Violation> {
    let gaps: Vec<(ExprId, Demand)> = rows
        .iter()
        .filter(|row| row.is_unilateral)
        .filter_map(|row| Some((row.position?, Demand::NotNegative)))
        .collect();
    let origin = rows.iter().rev().find(|row| row.is_unilateral)?.origin;
    cannot(model, &gaps).then(|| {
        refused(
            origin,
            format!("the gaps of `{label}` are nowhere open together"),
            "there is no position at which all of these inequalities hold".into(),
            "correct a sign, or leave one of them out",
        )
    })
}

/// The first auxiliary state among some symbols.
fn auxiliary(model: &Model, symbols: &[SymbolId]) -> Option<String> {
    model.auxiliary.iter().find(|state| symbols.contains(&state.symbol)).map(|state| state.name.clone())
}

/// A coefficient of restitution that is none.
fn restitution(model: &mut Model, declaration: &ImpactDecl, rows: &[ImpactRow]) -> Option<Violation> {
    let e = declaration.restitution?;
    let label = &declaration.label;
    if rows.iter().all(|row| row.position.is_none()) {
        return Some(refused(
            e.origin,
            format!("`{label}` is about velocities alone, and has a coefficient of restitution"),
            "rows on velocities hold after the jump: nothing bounces".into(),
            "leave `with restitution` out",
        ));
    }
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let mut demands: Vec<(ExprId, Demand)> = Vec::new();
    for assumption in model.assumptions.clone() {
        demands.push(demand(&mut model.graph, &assumption));
    }
    let graph = &mut model.graph;
    let known = graph.symbols_in(&[e.value]);
    if let Some(stranger) = known.into_iter().find(|symbol| !parameters.contains(symbol)) {
        let stranger = graph.symbols()[stranger].clone();
        return Some(refused(
            e.origin,
            format!("the coefficient of restitution of `{label}` depends on `{stranger}`"),
            "the loss of energy is known for a coefficient that is the same before and after the jump".into(),
            "write a number or an expression of parameters",
        ));
    }
    let one = graph.one();
    let below = graph.formula(one - e.value);
    demands.extend([(e.value, Demand::NotNegative), (below, Demand::NotNegative)]);
    graph.contradiction(&demands)?;
    let evidence = format!("{} is not from 0 to 1", shown(graph, e.value));
    Some(refused(
        e.origin,
        format!("the coefficient of restitution of `{label}` is outside 0 … 1"),
        evidence,
        "0 lands, 1 loses no energy",
    ))
}

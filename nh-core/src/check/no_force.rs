//! Constraints that exert no force: where they hold their derivative vanishes, and no multiplier says what keeps them.

use super::assumptions::on_the_base;
use super::domain::{Condition, conditions, holds};
use super::evidence::{name_of, shown};
use super::parts_of_positions::vanishing_factors;
use crate::algebra::{Demand, Facts, Graph, Node, Rational, Substitution};
use crate::geometry::{Algebroid, Manifold};
use crate::id::{ConstraintId, ExprId, Id, SymbolId};
use crate::model::{Model, PositionDecl};
use crate::violation::{Law, Violation};

/// An equation whose derivative vanishes where it holds, as that of a square does.
pub(super) fn position_without_force(model: &mut Model, index: usize) -> Option<Violation> {
    let PositionDecl { value, origin, .. } = model.positions[index];
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    let (evidence, way_out) = without_slope(&mut model.graph, value, &coordinates)
        .or_else(|| Some((touching_the_base(model, value)?, WITHOUT_TOUCHING)))?;
    let name = name_of(model, ConstraintId::from_index(index));
    Some(Violation {
        law: Law::Independence,
        origin,
        what: format!("{name} exerts no force: its derivative vanishes where it holds"),
        evidence,
        way_out: way_out.into(),
    })
}

/// Position constraints that hold together where they touch alone, as the sphere x^2 + y^2 + z^2 = 1 and the plane z = 1 do:
/// independent ones leave room of more dimensions.
pub(super) fn touching_each_other(model: &mut Model, manifold: &Manifold) -> Option<Violation> {
    let demands = on_the_base(model);
    let radicand = manifold.touching(&mut model.graph, &demands)?;
    let evidence = format!(
        "solved for coordinates they contain the root of {}, which is positive nowhere: they hold where it is 0 alone, \
         and constraints that are independent leave more room",
        shown(&model.graph, radicand)
    );
    touch(model, evidence)
}

/// Position constraints of which multiples add up to a function of one sign, or to a power. Three bars that are as long
/// together as their pins are apart say so.
pub(super) fn touching_as_multiples(model: &mut Model) -> Option<Violation> {
    let values: Vec<ExprId> = model.positions.iter().map(|position| position.value).collect();
    let why = multiples_without_slope(model, &values)?;
    touch(model, format!("multiples of them add up to what has no slope: {why}"))
}

/// Why functions have dependent derivatives wherever they are 0, in words: multiples of them add up to a function of one
/// sign, or to a power, which has none where it is 0.
pub(super) fn multiples_without_slope(model: &mut Model, functions: &[ExprId]) -> Option<String> {
    let demands = on_the_base(model);
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    let graph = &mut model.graph;
    let combinations = graph.combinations_without_slope(functions, &demands).unwrap_or_default();
    if let Some(why) = one_without_slope(graph, combinations, &coordinates) {
        return Some(why);
    }
    // multipliers may depend on parameters: these are numbers then, more than once, as they may touch by chance
    let mut found = Vec::new();
    for numbers in graph.numbers_near_points(functions, &demands, &coordinates) {
        let words = numbers
            .iter()
            .map(|(symbol, number)| format!("{} = {}", graph.symbols()[*symbol], shown(graph, *number)));
        let words = words.collect::<Vec<_>>().join(", ");
        let mut given = Substitution::new(numbers);
        let functions = given.apply_all(graph, functions);
        let demands: Vec<(ExprId, Demand)> =
            demands.iter().map(|(value, demand)| (given.apply(graph, *value), *demand)).collect();
        let combinations = graph.combinations_without_slope(&functions, &demands)?;
        if let Some(why) = one_without_slope(graph, combinations, &coordinates) {
            found.push(format!("for {words}, and for other numbers that were tried, {why}"));
        }
    }
    (found.len() > 1).then(|| found.swap_remove(0))
}

/// Why one of some combinations has no slope where it is 0.
fn one_without_slope(
    graph: &mut Graph,
    combinations: Vec<ExprId>,
    coordinates: &[SymbolId],
) -> Option<String> {
    let (why, _) = combinations.into_iter().find_map(|combination| {
        let combination = graph.simplify(combination);
        // of a product one factor may be 0 with a slope, and another without
        let is_asked = vanishing_factors(graph, combination, coordinates) == 1;
        is_asked.then(|| without_slope(graph, combination, coordinates))?
    })?;
    Some(why)
}

/// That position constraints touch.
fn touch(model: &Model, evidence: String) -> Option<Violation> {
    Some(Violation {
        law: Law::Independence,
        origin: model.positions.last()?.origin,
        what: "the position constraints touch where they hold: their derivatives are dependent there".into(),
        evidence,
        way_out: "correct one of them, or write what they leave, one equation for each: `x = 0; y = 0;`"
            .into(),
    })
}

/// A constraint whose derivative with respect to the velocities vanishes where it holds, as that of a square does.
pub(super) fn constraint_without_force(
    model: &mut Model,
    algebroid: &Algebroid,
    residuals: &[ExprId],
) -> Option<Violation> {
    let graph = &mut model.graph;
    let found = residuals.iter().map(|residual| without_slope(graph, *residual, &algebroid.velocities));
    let (index, (evidence, way_out)) = found.enumerate().find_map(|(index, why)| Some((index, why?)))?;
    let id = ConstraintId::from_index(index);
    Some(Violation {
        law: Law::Independence,
        origin: model.constraints[id].origin,
        what: format!(
            "{} exerts no force: its derivative with respect to the velocities vanishes where it holds",
            name_of(model, id)
        ),
        evidence,
        way_out: way_out.into(),
    })
}

/// That a function has one sign on the embedded base, in words: where it is 0 the base touches a level of it, as the plane
/// z = 1 does the sphere, and motions on the base have no rate of it.
fn touching_the_base(model: &mut Model, function: ExprId) -> Option<String> {
    let holding: Vec<(ExprId, Demand)> =
        model.identities.iter().map(|identity| (identity.value, Demand::Zero)).collect();
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut model.graph;
    let related = graph.related_demands(&holding, &[function]);
    let asked = related.iter().map(|(identity, _)| *identity).chain([function]);
    if related.is_empty() || asked.into_iter().any(|each| has_an_end(graph, each)) {
        return None;
    }
    let negative = graph.formula(-function);
    let (_, never) = [(function, "positive"), (negative, "negative")].into_iter().find(|(side, _)| {
        let demands = [related.as_slice(), &[(*side, Demand::Positive)]].concat();
        graph.symbols_in(&[*side]).iter().any(|symbol| !parameters.contains(symbol))
            && graph.contradiction(&demands).is_some()
    })?;
    let function = shown(graph, function);
    Some(format!(
        "{function} is nowhere {never} on the embedded base: where it is 0, motions on the base have no rate of it"
    ))
}

/// Where a function has no slope although it vanishes, in words: a power has none where its base is 0, and what has one
/// sign, as 1 - cos(x) and sums of squares have, has none where it touches 0. Symbols move that are not fixed.
pub(super) fn without_slope(
    graph: &mut Graph,
    function: ExprId,
    moving: &[SymbolId],
) -> Option<(String, &'static str)> {
    if let Some(base) = base_of_power(graph, function, moving) {
        let (function, base) = (shown(graph, function), shown(graph, base));
        return Some((format!("{function} vanishes with its derivatives where {base} = 0"), WITHOUT_POWER));
    }
    let varying = varying_factors(graph, function, moving);
    if has_an_end(graph, varying) {
        return None;
    }
    let mut fixed = graph.symbols_in(&[varying]);
    fixed.retain(|symbol| !moving.contains(symbol));
    if graph.has_both_signs(varying, &fixed) {
        return None;
    }
    let negative = graph.formula(-varying);
    let sides = [(varying, "positive"), (negative, "negative")];
    let (_, never) = sides.into_iter().find(|(side, _)| {
        graph.range(*side, &Facts::default()).high <= 0.0
            || graph.contradiction(&[(*side, Demand::Positive)]).is_some()
    })?;
    Some((
        format!("{} is nowhere {never}: where it is 0, so are its derivatives", shown(graph, varying)),
        ONE_BY_ONE,
    ))
}

/// Whether a function may end where a root or an arc does: there it may vanish with a slope, as sqrt(x) does.
fn has_an_end(graph: &Graph, function: ExprId) -> bool {
    let ends = |(_, condition): &(ExprId, Condition)| {
        !matches!(condition, Condition::Nonzero(_)) && !holds(graph, *condition, &Facts::default())
    };
    graph.reachable(&[function]).into_iter().any(|id| conditions(graph, id, 1).iter().any(ends))
}

/// The function without factors of fixed symbols alone.
fn varying_factors(graph: &mut Graph, function: ExprId, moving: &[SymbolId]) -> ExprId {
    let Node::Product { factors, .. } = graph.node(function).clone() else { return function };
    let varying: Vec<(ExprId, Rational)> =
        factors.iter().filter(|(base, _)| graph.depends_on(*base, moving)).cloned().collect();
    graph.product(&varying)
}

/// The base of a factor that vanishes to a higher order than the first, where it may vanish as symbols move.
fn base_of_power(graph: &mut Graph, function: ExprId, moving: &[SymbolId]) -> Option<ExprId> {
    let simple = graph.simplify(function);
    [function, simple].into_iter().find_map(|form| {
        let Node::Product { factors, .. } = graph.node(form) else { return None };
        let powers = factors
            .iter()
            .filter(|(base, exponent)| *exponent > Rational::ONE && graph.depends_on(*base, moving));
        powers.map(|(base, _)| *base).find(|base| graph.contradiction(&[(*base, Demand::Zero)]).is_none())
    })
}

/// What to write in the place of a power.
const WITHOUT_POWER: &str = "write it without the power, as `a = b` instead of `(a - b)^2 = 0`";
/// What to do where a level touches the base.
const WITHOUT_TOUCHING: &str = "correct it: it leaves points alone at which the base is touched, which multipliers cannot hold; \
     or declare a base that is what is left";
/// What to write in the place of a sum of squares.
const ONE_BY_ONE: &str =
    "write what it says, one equation for each: `a = 0; b = 0;` instead of `a^2 + b^2 = 0`";

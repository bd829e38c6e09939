//! Every declared expression is defined somewhere, and smooth where it is differentiated.

use super::assumptions::{demand, on_the_base};
use super::circles::by_angles;
use super::domain::{Condition, conditions};
use super::evidence::{listed, shown};
use super::smoothness::{not_continuous, not_smooth};
use crate::algebra::{Demand, Facts, Function2, Graph, Node, Rational, Substitution, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, Origin};
use crate::model::{Kinematics, Model};
use crate::violation::{Law, Violation};

/// No division by what is 0 everywhere, no root, logarithm or inverse sine of what is nowhere in their
/// domain, for parameters as they are assumed; no `abs`, `sign`, `min` or `max`, open or in disguise, in what is
/// differentiated and in sections, and no jumps in what is carried along motions.
#[must_use]
pub fn declared_expressions(model: &mut Model, facts: &Facts) -> Vec<Violation> {
    let mut violations = Vec::new();
    let differentiated = differentiated(model);
    let others = evaluated(model);
    let assumptions = model.assumptions.clone();
    let mut demands: Vec<_> = assumptions.iter().map(|fact| demand(&mut model.graph, fact)).collect();
    // anything follows from a contradiction, which is reported by itself
    if model.graph.contradiction(&demands).is_some() {
        demands.clear();
    }
    let assumed = Premises { demands, place: "" };
    let mut unreal: Vec<ExprId> = Vec::new();
    for (what, value, origin) in differentiated.iter().chain(&others).copied() {
        let place = Place { what, value, origin };
        let found = undefined(&model.graph, place)
            .or_else(|| vanishing(&mut model.graph, place, &Manifold::whole(), ""))
            .or_else(|| nowhere_real(&mut model.graph, facts, place, &assumed));
        unreal.extend(found.iter().map(|_| value));
        violations.extend(found);
    }
    let has_values = |(_, value, _): &(&str, ExprId, Origin)| !unreal.contains(value);
    for (what, value, origin) in differentiated.into_iter().chain(sections(model)).filter(has_values) {
        violations.extend(not_smooth(model, facts, what, value, origin));
    }
    for (what, value, origin) in carried_along(model) {
        violations.extend(not_continuous(model, facts, what, value, origin));
    }
    violations
}

/// The same where the identities of an embedded base hold, and position constraints once they are solved: no
/// division by what is 0 everywhere there, no root or logarithm of what is nowhere in their domain there.
#[must_use]
pub fn declared_on(model: &mut Model, facts: &Facts, base: &Manifold, holding: &[ExprId]) -> Vec<Violation> {
    if base.is_whole() && holding.is_empty() {
        return Vec::new();
    }
    let rough = rough_on_circles(model, facts, holding);
    let declared = differentiated(model).into_iter().chain(evaluated(model));
    let mut demands = on_the_base(model);
    demands.extend(holding.iter().map(|value| (*value, Demand::Zero)));
    let place =
        if holding.is_empty() { " on the embedded base" } else { " where the position constraints hold" };
    let premises = Premises { demands, place };
    let graph = &mut model.graph;
    let undefined = declared.filter_map(|(what, value, origin)| {
        let place = Place { what, value, origin };
        vanishing(graph, place, base, premises.place).or_else(|| nowhere_real(graph, facts, place, &premises))
    });
    undefined.chain(rough).collect()
}

/// What is differentiated and not smooth in the angles of circles on which coordinates lie.
fn rough_on_circles(model: &mut Model, facts: &Facts, holding: &[ExprId]) -> Vec<Violation> {
    let identities = model.identities.iter().map(|identity| identity.value);
    let vanishing: Vec<ExprId> = identities.chain(holding.iter().copied()).collect();
    let angles = by_angles(model, &vanishing);
    if angles.is_empty() {
        return Vec::new();
    }
    let mut on_circles = Substitution::new(angles.iter().copied());
    let restricted: Vec<_> = differentiated(model)
        .into_iter()
        .map(|(what, value, origin)| (what, value, on_circles.apply(&mut model.graph, value), origin))
        .collect();
    let moved = restricted.into_iter().filter(|(_, value, restricted, _)| value != restricted);
    moved.filter_map(|(what, _, value, origin)| not_smooth(model, facts, what, value, origin)).collect()
}

/// What holds wherever an expression is asked for its values.
struct Premises {
    demands: Vec<(ExprId, Demand)>,
    /// In words; nothing for the whole base.
    place: &'static str,
}

/// An expression, what it is called, and where it stands.
#[derive(Clone, Copy)]
struct Place {
    what: &'static str,
    value: ExprId,
    origin: Origin,
}

/// The expressions that are differentiated.
pub(super) fn differentiated(model: &Model) -> Vec<(&'static str, ExprId, Origin)> {
    let mut list = vec![("Lagrangian", model.lagrangian.value, model.lagrangian.origin)];
    list.extend(model.positions.iter().map(|p| ("position constraint", p.value, p.origin)));
    list.extend(model.constraints.iter().map(|c| ("constraint", c.residual, c.origin)));
    let rows = model.impacts.iter().flat_map(|impact| &impact.rows);
    list.extend(rows.map(|row| ("row of an impact", row.value, row.origin)));
    list.extend(model.brackets.iter().map(|b| ("bracket", b.value, b.origin)));
    match &model.kinematics {
        Kinematics::Tangent => {}
        Kinematics::Anchor(lines) => list.extend(lines.iter().map(|line| ("anchor", line.rate, line.origin))),
        Kinematics::Coframe(rows) => list.extend(rows.iter().map(|row| ("velocity", row.value, row.origin))),
    }
    list
}

/// The other expressions of the declaration.
fn evaluated(model: &Model) -> Vec<(&'static str, ExprId, Origin)> {
    let mut list: Vec<(&'static str, ExprId, Origin)> = Vec::new();
    list.extend(model.forces.iter().map(|force| ("force", force.value, force.origin)));
    list.extend(model.auxiliary.iter().map(|state| ("rate", state.value, state.origin)));
    list.extend(model.outputs.iter().map(|output| ("output", output.value, output.origin)));
    let restitutions = model.impacts.iter().filter_map(|impact| impact.restitution);
    list.extend(restitutions.map(|e| ("coefficient of restitution", e.value, e.origin)));
    list.extend(carried_along(model));
    list.extend(sections(model));
    list.extend(model.identities.iter().map(|identity| ("identity", identity.value, identity.origin)));
    list.extend(model.dropped.iter().map(|dropped| ("expression", dropped.value, dropped.origin)));
    list.extend(model.routh.iter().map(|level| ("level", level.level, level.origin)));
    let arguments = |call: &crate::model::MethodCall| {
        let origin = call.origin;
        call.arguments.clone().into_iter().map(move |argument| ("argument", argument, origin))
    };
    list.extend(model.calls.iter().flat_map(arguments));
    for assumption in &model.assumptions {
        for side in [assumption.left, assumption.right] {
            list.push(("side of an assumption", side, assumption.origin));
        }
    }
    list
}

/// What is claimed of motions: it has a rate along them, and no jumps.
fn carried_along(model: &Model) -> Vec<(&'static str, ExprId, Origin)> {
    let claims = model.claims.iter().map(|claim| ("first integral", claim.value, claim.origin));
    let volume = model.volume.iter().filter_map(|claim| Some(("density", claim.density?, claim.origin)));
    claims.chain(volume).collect()
}

/// Sections of E and of its dual, with the functions that belong to them.
fn sections(model: &Model) -> Vec<(&'static str, ExprId, Origin)> {
    let mut list: Vec<(&'static str, ExprId, Origin)> = Vec::new();
    for symmetry in &model.symmetries {
        list.push(("symmetry", symmetry.value, symmetry.origin));
        list.extend(symmetry.gauge.map(|gauge| ("function behind `up to`", gauge, symmetry.origin)));
    }
    let momenta = model.hamilton_jacobi.iter().flat_map(|claim| &claim.components);
    list.extend(momenta.map(|(_, momentum)| ("momentum", momentum.value, momentum.origin)));
    list.extend(model.frame.iter().map(|section| ("section", section.value, section.origin)));
    list
}

fn undefined(graph: &Graph, place: Place) -> Option<Violation> {
    let Place { what, value, origin } = place;
    graph.is_undefined(value).then(|| Violation {
        law: Law::Defined,
        origin,
        what: format!("this {what} is not defined: it divides by zero, or takes ln(0)"),
        evidence: shown(graph, value),
        way_out: "a denominator or an argument is 0 after simplification; write one that is not".into(),
    })
}

/// A divisor, or the argument of a logarithm, that is zero everywhere by an identity.
fn vanishing(graph: &mut Graph, place: Place, base: &Manifold, on: &str) -> Option<Violation> {
    let Place { what, value, origin } = place;
    for id in graph.reachable(&[value]) {
        if let Node::Apply2(Function2::Atan2, y, x) = *graph.node(id)
            && base.zero_test(graph, y).is_zero()
            && base.zero_test(graph, x).is_zero()
        {
            return Some(Violation {
                law: Law::Defined,
                origin,
                what: format!("this {what} is defined nowhere: the point (0, 0) has no angle"),
                evidence: format!("both arguments of {} are 0", shown(graph, id)),
                way_out: "write arguments of `atan2` that are not both 0 everywhere".into(),
            });
        }
        for (divisor, condition) in conditions(graph, id, 0) {
            let is_divisor = matches!(condition, Condition::Nonzero(_) | Condition::Positive(_));
            if !is_divisor
                || graph.as_symbol(divisor).is_some()
                || graph.vanishes_nowhere(divisor, &Facts::default())
            {
                continue;
            }
            let logarithm = matches!(graph.node(id), Node::Apply(..));
            let verdict = base.zero_test(graph, divisor);
            if verdict.is_zero() {
                let does = if logarithm { "takes the logarithm of 0" } else { "divides by 0" };
                return Some(Violation {
                    law: Law::Defined,
                    origin,
                    what: format!("this {what} is defined nowhere: it {does}"),
                    evidence: format!("{} is 0 everywhere{on}", shown(graph, divisor)),
                    way_out: "write a denominator, or an argument, that is not".into(),
                });
            }
            if let Verdict::Unknown(why) = verdict
                && graph.symbols_in(&[divisor]).is_empty()
            {
                return Some(Violation {
                    law: Law::Decidable,
                    origin,
                    what: format!("whether this {what} divides by zero could not be decided"),
                    evidence: format!("{}: {why}", shown(graph, divisor)),
                    way_out: "write the number in a simpler form".into(),
                });
            }
        }
    }
    None
}

/// A root of something negative everywhere, a logarithm of something positive nowhere, an `asin` or
/// `acos` of something beyond 1; or several that exclude each other.
fn nowhere_real(graph: &mut Graph, facts: &Facts, place: Place, premises: &Premises) -> Option<Violation> {
    /// Conditions that are taken together.
    const TOGETHER: usize = 12;
    let Place { what, value, origin } = place;
    let (assumed, on) = (&premises.demands, premises.place);
    let mut all: Vec<(ExprId, Demand)> = assumed.clone();
    let mut texts: Vec<String> = Vec::new();
    let violation = |what: String, evidence: String| Violation {
        law: Law::Defined,
        origin,
        what,
        evidence,
        way_out: "correct the sign, or the range; a real odd root of -x is written `-(x^(1/3))`".into(),
    };
    for id in graph.reachable(&[value]) {
        for (argument, condition) in conditions(graph, id, 0) {
            let demands = demands(graph, argument, condition);
            // a square root of a sum of squares is left alone: only what has signs is asked about
            let is_open = matches!(condition, Condition::Positive(_));
            let is_signed = is_open || matches!(condition, Condition::NotNegative(_));
            let holds_anyway = !on.is_empty() && is_signed && graph.range(argument, facts).is_not_negative();
            if demands.is_empty() || holds_anyway {
                continue;
            }
            let near =
                if on.is_empty() { assumed.clone() } else { graph.related_demands(assumed, &[argument]) };
            let own: Vec<(ExprId, Demand)> = near.into_iter().chain(demands.clone()).collect();
            if graph.contradiction(&own).is_some() {
                let by_itself = graph.contradiction(&demands).is_some();
                let as_assumed =
                    if by_itself || !on.is_empty() { "" } else { ", for parameters as they are assumed" };
                let evidence = never(graph, id, argument) + as_assumed;
                // the root of -x^2 has a value at 0, and none around it
                let edges = demands.iter().map(|(expression, wanted)| match wanted {
                    Demand::Positive if !is_open => (*expression, Demand::NotNegative),
                    _ => (*expression, *wanted),
                });
                let closed: Vec<_> = assumed.iter().copied().chain(edges).collect();
                let has = if graph.contradiction(&closed).is_some() {
                    "no real value anywhere"
                } else {
                    "real values on no open set"
                };
                return Some(violation(format!("this {what} has {has}{on}"), evidence));
            }
            for (expression, _) in &demands {
                texts.push(format!("{} > 0", shown(graph, *expression)));
            }
            all.extend(demands);
        }
    }
    let several = (2..=TOGETHER).contains(&texts.len());
    if !several || graph.contradiction(&all).is_none() {
        return None;
    }
    let evidence = format!("it asks for {}, which exclude each other", listed(&texts));
    Some(violation(format!("this {what} has no real value anywhere{on}"), evidence))
}

/// What a condition demands at the points of an open set; of numbers, at all.
fn demands(graph: &mut Graph, argument: ExprId, condition: Condition) -> Vec<(ExprId, Demand)> {
    let varies = !graph.symbols_in(&[argument]).is_empty();
    let inside = if varies { Demand::Positive } else { Demand::NotNegative };
    match condition {
        Condition::Nonzero(_) | Condition::NotBothZero(..) => Vec::new(),
        Condition::Positive(e) => vec![(e, Demand::Positive)],
        Condition::NotNegative(e) if varies && graph.zero_test(e).is_zero() => Vec::new(),
        Condition::NotNegative(e) => vec![(e, inside)],
        Condition::InUnitInterval(e) | Condition::InsideUnitInterval(e) => {
            let one = graph.one();
            let (below, above) = (graph.formula(one - e), graph.formula(one + e));
            // what is 1 everywhere by an identity has its arc
            let within: Vec<_> = [below, above].into_iter().map(|side| (side, inside)).collect();
            within.into_iter().filter(|(side, _)| !varies || !graph.zero_test(*side).is_zero()).collect()
        }
    }
}

/// Why a node has no real value.
fn never(graph: &Graph, id: ExprId, argument: ExprId) -> String {
    let range = graph.range(argument, &Facts::default());
    let sign = if range.high < 0.0 { "is negative" } else { "is never positive" };
    let text = shown(graph, argument);
    match graph.node(id) {
        Node::Apply(crate::algebra::Function::Ln, _) => format!("{text} {sign}, and has no logarithm"),
        Node::Apply(function, _) => format!("`{}` takes values from -1 to 1, not {text}", function.name()),
        Node::Product { factors, .. } => {
            let exponent = factors.iter().find(|(base, _)| *base == argument).map(|(_, exponent)| exponent);
            let exponent = exponent.cloned().unwrap_or(Rational::ONE);
            format!("{text} {sign}, and is raised to the power {exponent}")
        }
        _ => text,
    }
}

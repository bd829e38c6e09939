//! What kind of system it is.

use super::suggestion_line::validity;
use super::{combination, section_names, shown, suggestion};
use crate::algebra::Graph;
use crate::check::evidence::{counted, listed, places};
use crate::check::{BrokenLaws, LesserPart, Positions, not_asked, points_shown, undecided};
use crate::compile::{Derived, Proved};
use crate::findings::{Closure, Findings, FirstIntegral, Integrable, LongBlock, SingularPlace};
use crate::geometry::independent_velocities::Choice;
use crate::geometry::{Drops, Involution, Rank};
use crate::id::{CoordId, ExprId, SymbolId};
use crate::model::{Kinematics, Model};

/// The classification, a line for each property.
pub(super) fn lines(
    proved: &Proved,
    derived: &Derived<'_>,
    findings: &Findings,
    reason: &str,
) -> Vec<String> {
    let Proved { model, facts, .. } = proved;
    let mut lines = vec![algebroid(proved)];
    lines.extend(shifted(proved));
    lines.extend(structure_equations(proved));
    lines.extend(positions(model, &proved.positions));
    lines.extend(proved.chart.as_ref().map(|choice| chart(model, choice)));
    lines.push(constraints(proved, derived, findings.closure));
    if findings.integrable == Integrable::Yes {
        lines.push(
            "they are integrable: equations between positions have these as their rates, and are kept by every run \
             where they are written in `holonomic`"
                .into(),
        );
    }
    lines.extend(proved.constraints.dropped.iter().cloned());
    lines.extend(not_asked(model, proved.constraints.generic()));
    let (name, size) = match derived {
        Derived::Adapted { kept, .. } => ("adapted", kept.rank()),
        Derived::Projected { .. } => ("projected", model.sections.len()),
    };
    let coordinates = model.coordinates.len();
    let (coordinates, velocities) =
        (counted(coordinates, "coordinate", "coordinates"), counted(size, "velocity", "velocities"));
    let auxiliary = match model.auxiliary.len() {
        0 => String::new(),
        count => format!(", with {}", counted(count, "auxiliary state", "auxiliary states")),
    };
    lines.push(format!("formulation: {name}, {coordinates} and {velocities}{auxiliary}; {reason}"));
    lines.extend(findings.suggested.as_ref().map(|suggested| suggestion(model, suggested)));
    lines.extend(findings.held_forces.iter().map(|along| {
        format!("the force along {along} does not act on the motion: D leads nowhere along it")
    }));
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    for SingularPlace { factor, exists } in &findings.singular_mass {
        let of_parameters = model.graph.depends_on(*factor, &parameters);
        let what = match derived {
            Derived::Adapted { .. } => "the mass matrix is",
            Derived::Projected { .. } => "the equations are",
        };
        let whom = if of_parameters { format!("for some parameters {what}") } else { what.to_owned() };
        let text = shown(&model.graph, *factor);
        lines.push(match (exists, text.contains('…')) {
            (true, false) => format!("{whom} singular where {text} = 0"),
            (true, true) => format!("{whom} singular in some states; the condition is too long to be shown"),
            (false, false) => {
                format!("{what} singular if {text} = 0 in some state; whether it is in any was not decided")
            }
            (false, true) => format!("whether {what} singular in some state was not decided"),
        });
    }
    lines.extend(long_blocks(&findings.long_blocks, derived));
    if undecided(model, facts) {
        let doubt = "whether the assumptions can hold together was not decided: no parameters were found that satisfy \
                     all of them, and no contradiction";
        lines.push(doubt.into());
    }
    if findings.no_state_is_known {
        lines.push(no_state_is_known(proved));
    }
    for condition in &findings.domain {
        lines.push(format!("the equations have a value only where {}", condition.stated(&model.graph)));
    }
    for condition in &findings.of_derivatives.unless {
        let stated = condition.stated(&model.graph);
        lines.push(format!(
            "derivatives of the equations, which `emit` asks for, may have no value unless {stated}"
        ));
    }
    for divisor in &findings.chart_divisors {
        let text = shown(&model.graph, *divisor);
        lines.push(format!("the quasi-velocities are a chart only where {text} != 0"));
    }
    lines
}

/// What is known of equations whose determinants are too long to be written out.
fn long_blocks(blocks: &[LongBlock], derived: &Derived<'_>) -> Vec<String> {
    let what = match derived {
        Derived::Adapted { .. } => "the mass matrix",
        Derived::Projected { .. } => "the matrix of accelerations and multipliers",
    };
    let singular = blocks.iter().filter(|block| block.is_singular).map(|block| {
        format!(
            "for some parameters {what} is singular in some states: eigenvalues of its block of {} coupled rows change \
             their sign",
            block.rows
        )
    });
    let open: Vec<String> =
        blocks.iter().filter(|block| !block.is_singular).map(|block| block.rows.to_string()).collect();
    let open = (!open.is_empty()).then(|| {
        let which = if open.len() == 1 { "the block" } else { "blocks" };
        format!(
            "in which states {what} may be singular was not asked of {which} of {} coupled rows",
            open.join(" and ")
        )
    });
    singular.chain(open).collect()
}

/// That nothing contradicts the equations, and nothing is known to satisfy them.
fn no_state_is_known(Proved { model, constraints, .. }: &Proved) -> String {
    let (what, equations) = match (constraints.linear.is_some(), model.positions.is_empty()) {
        (false, _) => ("real positions and velocities", "the constraints"),
        (true, false) => ("real positions", "the position constraints"),
        (true, true) => ("real values of the coordinates", "the identities of the embedded base"),
    };
    let assumed = if model.assumptions.is_empty() { "" } else { ", for parameters as they are assumed," };
    format!(
        "whether {what} satisfy {equations}{assumed} was not decided: none were found, and no contradiction"
    )
}

/// The kind of algebroid.
fn algebroid(proved: &Proved) -> String {
    let Proved { model, kind, .. } = proved;
    let (n, s, dimension) = (model.coordinates.len(), model.sections.len(), kind.dimension);
    let embedded = if dimension == n { String::new() } else { format!(", embedded in {n} coordinates") };
    let name = if proved.broken_laws.is_none() {
        name_of_kind(proved)
    } else if n == 0 {
        "an almost Lie algebra".into()
    } else {
        "an almost Lie algebroid".into()
    };
    format!("algebroid: {name}, rank {s} over a base of dimension {dimension}{embedded}")
}

/// Velocities with a declared name that the frame gives another value: its sections take the place of others.
fn shifted(Proved { model, motion, .. }: &Proved) -> Vec<String> {
    let line = |(symbol, was): &(SymbolId, ExprId)| {
        let name = &model.graph.symbols()[*symbol];
        format!(
            "`{name}` is the velocity along {name} in the basis of the frame: that in the declared basis is {}",
            shown(&model.graph, *was)
        )
    };
    motion.shifted.iter().map(line).collect()
}

/// Which of the structure equations hold where none is demanded.
fn structure_equations(proved: &Proved) -> Vec<String> {
    if !proved.model.almost {
        return Vec::new();
    }
    let BrokenLaws { homomorphism, jacobi } = &proved.broken_laws;
    let first = match homomorphism {
        None => "the anchor is a homomorphism of brackets, (2)".to_owned(),
        Some(evidence) => format!("(2) does not hold: {evidence}"),
    };
    let second = match (homomorphism, jacobi) {
        (None, None) => "the Jacobi identity, (3), holds: it is a Lie algebroid all the same".to_owned(),
        (Some(_), None) => {
            "the Jacobi identity, (3), holds for the sections of the basis, not for all, since (2) does not"
                .to_owned()
        }
        (_, Some(evidence)) => format!("(3) does not hold: {evidence}"),
    };
    [first, second].into_iter().map(|line| format!("declared almost: {line}")).collect()
}

/// By the rank of the anchor, with the places where it drops.
fn name_of_kind(proved: &Proved) -> String {
    let Proved { model, kind, .. } = proved;
    let (s, dimension) = (model.sections.len(), kind.dimension);
    if model.coordinates.is_empty() {
        return "a Lie algebra".into();
    }
    let action = if kind.is_action { "action Lie algebroid" } else { "Lie algebroid" };
    let article = if kind.is_action { "an" } else { "a" };
    let Some(anchor) = &kind.anchor else { return format!("{article} {action}") };
    let rank = anchor.generic;
    let nonzero = match &anchor.drops {
        Drops::Nowhere => String::new(),
        Drops::Undecided => " at generic points (whether everywhere was not decided)".into(),
        Drops::Where(_) => places(&model.graph, &anchor.drops)
            .map_or_else(String::new, |places| format!(", but not where {places}")),
    };
    if rank == dimension && rank == s {
        let frame = match (&model.kinematics, kind.commutes) {
            (Kinematics::Tangent, true) if model.frame.is_empty() => "in its coordinate frame",
            (_, true) => "in a holonomic frame: all brackets vanish",
            (_, false) => "in an anholonomic frame",
        };
        let coframe =
            if matches!(model.kinematics, Kinematics::Coframe(_)) { ", by its coframe" } else { "" };
        let singular = match places(&model.graph, &anchor.drops) {
            None if nonzero.is_empty() => return format!("the tangent bundle TM {frame}{coframe}"),
            None => return format!("the tangent bundle TM {frame}{coframe}{nonzero}"),
            Some(places) => places,
        };
        return if model.brackets_declared {
            format!("{article} {action} with an anchor that is one to one and onto, but not where {singular}")
        } else {
            format!("the tangent bundle TM {frame}{coframe}, which is singular where {singular}")
        };
    }
    if rank == 0 {
        return "a bundle of Lie algebras: the anchor is 0".into();
    }
    if rank == dimension {
        let isotropy = s - rank;
        return format!("a transitive {action} with isotropy of rank {isotropy}{nonzero}");
    }
    if rank == s {
        return format!("{article} {action} with an injective anchor{nonzero}: orbits of dimension {rank}");
    }
    format!("{article} {action} with orbits of dimension {rank}{nonzero}")
}

/// The position constraints: how many, what was left out, and what was not solved.
fn positions(model: &Model, positions: &Positions) -> Vec<String> {
    if model.positions.is_empty() {
        return Vec::new();
    }
    let count = model.positions.len();
    let mut lines = vec![format!("position constraints: {count}, whose rates are among the constraints")];
    lines.extend(positions.dropped.iter().cloned());
    for position in &positions.redundant {
        let name = position.label.as_ref().map_or("an equation without a label".into(), |l| format!("`{l}`"));
        lines.push(format!("{name} follows from the other position constraints: it has no multiplier"));
    }
    if let Some(part) = &positions.part {
        let unsolved = positions.unsolved.len();
        lines.push(format!(
            "which of them are independent was asked at {} where all hold; what else is said to hold there was \
             asked without {unsolved} of them, which could not be solved for coordinates or parameters",
            points_shown(part)
        ));
        lines.extend(elsewhere(positions));
        return lines;
    }
    lines.extend(elsewhere(positions));
    for value in &positions.unsolved {
        lines.push(format!(
            "no points were found where {} = 0: what is said to hold there was asked without it",
            shown(&model.graph, *value)
        ));
    }
    lines
}

/// Parts of N that are not meant, a line for each.
fn elsewhere(positions: &Positions) -> impl Iterator<Item = String> {
    let meant = positions.jacobian.len();
    positions.elsewhere.iter().map(move |LesserPart { place, rank }| {
        let place = place.as_deref().unwrap_or(" on another part of the base");
        format!(
            "they hold as well{place}, with {rank} of the rates independent there: what is said is said of the part \
             where {meant} are"
        )
    })
}

/// The chart that the declaration names, and where it is one.
fn chart(model: &Model, choice: &Choice<CoordId>) -> String {
    let is_free = |id: &CoordId| !choice.dependent.contains(id);
    let names: Vec<&str> =
        model.coordinates.ids().filter(is_free).map(|id| model.coordinates[id].name.as_str()).collect();
    format!("independent coordinates: {}, as named; {}", listed(&names), validity(model, choice))
}

fn constraints(proved: &Proved, derived: &Derived<'_>, closure: Option<Closure>) -> String {
    let Proved { model, constraints: declared, .. } = proved;
    let (count, spanned) = (model.constraints.len(), model.distribution.as_ref().map(Vec::len));
    let dependent = dependent(model, proved.constraint_rank.as_ref());
    let kind = match &declared.linear {
        None => "nonlinear",
        Some(linear) if linear.drift.iter().all(|drift| model.graph.zero_test(*drift).is_zero()) => "linear",
        Some(_) => "affine",
    };
    let what = match (count, spanned) {
        (_, Some(sections)) => format!("constraints: D is the span of {sections} sections{dependent}"),
        (0, None) => return "constraints: none".into(),
        (_, None) => format!("constraints: {count}, {kind} in the velocities{dependent}"),
    };
    // the fields of closed sections are in involution where (2) holds
    let is_integrable = proved.broken_laws.homomorphism.is_none();
    let holonomic = match (closure, is_integrable) {
        (Some(Closure::Decided(Involution::Closed)), true) => {
            let constant = constant_coordinates(model, derived);
            format!("; D is closed under the bracket (holonomic){constant}")
        }
        (Some(Closure::Decided(Involution::Closed)), false) => {
            format!("; D is closed under the bracket{}", constant_coordinates(model, derived))
        }
        (Some(Closure::Decided(open)), _) => {
            // with a drift, or as time passes, it is the bracket with these that leads out of D
            let with = match (open, kind) {
                (Involution::NotClosedInTime, "affine") => " with the drift",
                (Involution::NotClosedInTime, _) => ", as it changes with the time,",
                _ => "",
            };
            let nonholonomic = if is_integrable { " (nonholonomic)" } else { "" };
            format!("; D{with} is not closed under the bracket{nonholonomic}")
        }
        (Some(Closure::Undecided) | None, _) => String::new(),
    };
    format!("{what}{holonomic}")
}

/// Where the constraints are dependent.
fn dependent(model: &Model, rank: Option<&Rank>) -> String {
    match rank.map(|rank| &rank.drops) {
        Some(Drops::Nowhere) => String::new(),
        Some(drops @ Drops::Where(_)) => places(&model.graph, drops)
            .map_or_else(String::new, |places| format!("; they are dependent where {places}")),
        Some(Drops::Undecided) | None => {
            "; they are independent at generic points, where else was not decided".into()
        }
    }
}

/// The integrals of a holonomic D that are coordinates.
fn constant_coordinates(model: &Model, derived: &Derived<'_>) -> String {
    let Derived::Adapted { equations, .. } = derived else { return String::new() };
    let constant: Vec<&str> = model
        .coordinates
        .iter()
        .zip(&equations.rates)
        .filter(|(_, rate)| model.graph.zero_test(**rate).is_zero())
        .map(|(coordinate, _)| coordinate.name.as_str())
        .collect();
    if constant.is_empty() { String::new() } else { format!("; constant: {}", constant.join(", ")) }
}

/// The title above what is conserved: impacts change velocities.
pub(super) fn title_of_conserved(model: &Model) -> &'static str {
    if model.impacts.is_empty() { "Conserved quantities" } else { "Conserved between impacts" }
}

/// What is constant along motions that go round a point, whose angle jumps.
const TURNS: &str = ", up to whole turns of its angle";

/// That a claim is proved, and where.
fn proved_of(graph: &Graph, claim: &FirstIntegral) -> String {
    let places: Vec<String> = claim.domain.iter().map(|condition| condition.stated(graph)).collect();
    let mut text = "proved".to_owned();
    if !places.is_empty() {
        text.extend([" for motions along which it has a value: ", &listed(&places)]);
    }
    if claim.has_turns {
        text += TURNS;
    }
    text
}

/// What is conserved by the theorems that need no search.
pub(super) fn conserved(proved: &Proved, findings: &Findings) -> Vec<String> {
    let model = &proved.model;
    let claims = model.claims.iter().zip(&findings.claims);
    let mut lines: Vec<String> = claims
        .map(|(claim, found)| format!("{} (claimed, and {})", claim.name, proved_of(&model.graph, found)))
        .collect();
    if findings.keeps_energy {
        let reason =
            "CLMM Theorems 3.4 and 7.6: L does not depend on time, no power of constraints and forces";
        let turns = if findings.has_turns { TURNS } else { "" };
        lines.push(format!("the energy{turns} ({reason})"));
    }
    lines.extend(findings.moving_energy.as_ref().map(|section| {
        let section = combination(&model.graph, section, &section_names(model));
        let turns = if findings.has_turns { TURNS } else { "" };
        let [energy, along, momentum] = ["E", "xi", "p"].map(|name| model.graph.free_name(name));
        format!(
            "the moving energy {energy} - {along}.{momentum} with {along} = {section}{turns} (Fassò, Sansonetto)"
        )
    }));
    lines
}

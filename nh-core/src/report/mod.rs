//! What was derived, as text: the `REPORT` of a system, and the equations in its documentation.

mod classification;
mod equations;
mod hamiltonian;
mod impact_lines;
pub mod latex;
pub mod line_breaks;
mod reduction_kind;
mod routhian;
mod suggestion_line;
mod symmetry;

use crate::algebra::{Facts, Graph, Node};
use crate::compile::{Derived, Proved};
use crate::findings::Findings;
use crate::id::{ExprId, Id};
use crate::mechanics::LagrangianSystem;
use crate::model::Model;
use crate::units;

pub(crate) use equations::equations_of_motion;
pub(crate) use hamiltonian::hamiltonian_lines;
pub(crate) use suggestion_line::suggestion;

/// Longest expression shown, in bytes.
const SHOWN: usize = 400;

fn shown(graph: &Graph, expression: ExprId) -> String {
    graph.text_within(expression, SHOWN)
}

/// The report of a derived system: what the stages found, printed.
pub(crate) fn report(
    proved: &Proved,
    derived: &Derived<'_>,
    findings: &Findings,
    reason: &str,
    conditions: &[ExprId],
    more: Vec<(&str, Vec<String>)>,
) -> String {
    let impacts = impact_lines::lines(proved);
    let (model, system) = (&proved.model, &proved.system);
    let mut classification = classification::lines(proved, derived, findings, reason);
    classification.extend(reduction_kind::name(proved, &findings.reduced));
    let splitting = reduction_kind::quantities(model, &findings.reduced);
    let symmetries = symmetry::lines(proved, &findings.symmetries);
    let routh = routhian::lines(&model.graph, findings);
    let mut conserved = classification::conserved(proved, findings);
    conserved.extend(symmetry::conserved(&model.graph, &findings.conserved_momenta));
    let mut text = format!("{}\n", model.name);
    let mut section = |title: &str, lines: Vec<String>| {
        if !lines.is_empty() {
            text.extend(["\n", title, "\n"]);
            for line in lines {
                text.extend(["  ", &line, "\n"]);
            }
        }
    };
    section("Classification", classification);
    section("Constants", constants(&model.graph));
    section("Units", units::lines(&model.units));
    section("Unused parameters", unused(&model.idle));
    section("Unused inputs", unused(&model.idle_inputs));
    section("Conditions on the parameters", nonzero(&model.graph, conditions));
    section("Anchor (kinematic equations)", anchor(model, system));
    section("Structure functions", structure_functions(model, system));
    section("Constraint distribution", distribution(model, derived));
    section("Splitting of D", splitting);
    section("Mass matrix", mass_matrix(proved, derived));
    section("Routh reduction", routh);
    section("Equations of motion", equations_of_motion(model, derived));
    section("Impacts", impacts);
    section("Symmetries", symmetries);
    section(classification::title_of_conserved(model), conserved);
    for (title, lines) in more {
        section(title, lines);
    }
    text
}

fn nonzero(graph: &Graph, conditions: &[ExprId]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for condition in conditions {
        let line = format!("{} != 0", shown(graph, *condition));
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}

fn unused(names: &[String]) -> Vec<String> {
    names.iter().map(|name| format!("{name} stands in no expression")).collect()
}

/// `m = 13/10`
pub(super) fn constants(graph: &Graph) -> Vec<String> {
    graph.constants().iter().map(|constant| format!("{} = {}", constant.name, constant.value)).collect()
}

fn section_names(model: &Model) -> Vec<String> {
    model.sections.iter().map(|section| section.name.clone()).collect()
}

/// `coefficient*name + …`, with signs in front.
fn combination(graph: &Graph, coefficients: &[ExprId], names: &[String]) -> String {
    let mut text = String::new();
    for (coefficient, name) in coefficients.iter().zip(names) {
        if graph.is_literal_zero(*coefficient) {
            continue;
        }
        let (negative, magnitude) = match graph.as_number(*coefficient) {
            Some(number) if number.abs().is_one() => (number.is_negative(), name.clone()),
            Some(number) => (number.is_negative(), format!("{}*{name}", number.abs())),
            None => (false, format!("({})*{name}", shown(graph, *coefficient))),
        };
        text.push_str(match (text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        text.push_str(&magnitude);
    }
    if text.is_empty() { "0".into() } else { text }
}

fn anchor(model: &Model, system: &LagrangianSystem) -> Vec<String> {
    let names = section_names(model);
    let rows = system.algebroid.anchor.entries.iter();
    model
        .coordinates
        .iter()
        .zip(rows)
        .map(|(coordinate, row)| {
            format!("der({}) = {}", coordinate.name, combination(&model.graph, row, &names))
        })
        .collect()
}

fn structure_functions(model: &Model, system: &LagrangianSystem) -> Vec<String> {
    let names = section_names(model);
    let structure = &system.algebroid.structure;
    let lines: Vec<String> = structure
        .nonzero(&model.graph)
        .map(|(alpha, beta, components)| {
            let value = combination(&model.graph, components, &names);
            format!("[{}, {}] = {value}", names[alpha.index()], names[beta.index()])
        })
        .collect();
    let mut lines = if lines.is_empty() { vec!["all brackets vanish".into()] } else { lines };
    lines.extend(unseen(model, system));
    lines
}

/// Sections that the anchor does not see: what no line says of their brackets was taken to be 0.
fn unseen(model: &Model, system: &LagrangianSystem) -> Option<String> {
    let is_listed = |name: &str| {
        let symbol = model.sections.iter().find(|section| section.name == name).map(|section| section.symbol);
        model.brackets.iter().any(|bracket| {
            let pair = [bracket.left, bracket.right].map(|section| model.sections[section].symbol);
            symbol.is_some_and(|symbol| pair.contains(&symbol))
        })
    };
    let anchor = &system.algebroid.anchor;
    if model.coordinates.is_empty() || model.almost {
        return None;
    }
    let names: Vec<String> = section_names(model)
        .into_iter()
        .enumerate()
        .filter(|(alpha, _)| anchor.entries.iter().all(|row| model.graph.is_literal_zero(row[*alpha])))
        .map(|(_, name)| name)
        .filter(|name| !is_listed(name))
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "the anchor does not see {}: brackets and components along it that no line gives are 0",
            names.join(", ")
        )
    })
}

fn distribution(model: &Model, derived: &Derived<'_>) -> Vec<String> {
    let names = section_names(model);
    match derived {
        Derived::Adapted { distribution, .. } if distribution.constraints.annihilator.is_empty() => {
            Vec::new()
        }
        Derived::Adapted { distribution, .. } => (0..distribution.rank())
            .map(|a| {
                let name = &model.graph.symbols()[distribution.independent[a]];
                let section = distribution.section(a);
                format!("along {name}: {}", combination(&model.graph, &section, &names))
            })
            .collect(),
        Derived::Projected { residuals, .. } => {
            residuals.iter().map(|residual| format!("{} = 0", shown(&model.graph, *residual))).collect()
        }
    }
}

fn mass_matrix(proved: &Proved, derived: &Derived<'_>) -> Vec<String> {
    let Proved { model, facts, .. } = proved;
    let (matrix, names): (_, Vec<String>) = match derived {
        Derived::Adapted { equations, kept, .. } => (
            &equations.mass,
            kept.independent.iter().map(|symbol| model.graph.symbols()[*symbol].clone()).collect(),
        ),
        Derived::Projected { equations, .. } => (&equations.mass, section_names(model)),
    };
    let (mut lines, mut negative) = (Vec::new(), Vec::new());
    for (a, row) in matrix.iter().enumerate() {
        for (b, entry) in row.iter().enumerate().skip(a) {
            if !model.graph.is_literal_zero(*entry) {
                lines.push(format!("({}, {}): {}", names[a], names[b], shown(&model.graph, *entry)));
            }
        }
        if is_negative(&model.graph, row[a], facts) {
            negative.push(format!("({0}, {0})", names[a]));
        }
    }
    if !negative.is_empty() {
        let entries = negative.join(", ");
        lines.push(format!(
            "negative everywhere: {entries}; L is the kinetic energy less the potential energy"
        ));
    }
    lines
}

/// Whether an expression is negative by what is known of the parameters; asked of those that have a minus in front.
fn is_negative(graph: &Graph, expression: ExprId, facts: &Facts) -> bool {
    let has_minus = match graph.node(expression) {
        Node::Number(value) => value.is_negative(),
        Node::Product { coefficient, .. } => coefficient.is_negative(),
        Node::Sum { terms, .. } => terms.iter().any(|(_, coefficient)| coefficient.is_negative()),
        _ => false,
    };
    let range = has_minus.then(|| graph.range(expression, facts));
    range.is_some_and(|range| range.nonzero && range.high <= 0.0)
}

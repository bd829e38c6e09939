//! What is derived: D, the mass matrix, the equations of motion, momenta and what is conserved.

use std::fmt::Write;

use super::line::{Equation, Line, Typeset, display};
use super::{Page, below, equation, equations, items};
use crate::compile::{Derived, Proved};
use crate::findings::{Findings, Rate};
use crate::id::{ConstraintId, ExprId, Id, SymbolId};
use crate::mechanics::Definition;
use crate::report::classification;

/// Rows of accelerations up to this width are written out; wider ones have names for the entries of the mass matrix.
const WRITTEN_OUT: usize = 18_000;

/// The parts with their titles; those with nothing in them are empty.
pub(super) fn parts(
    page: &Page<'_>,
    proved: &Proved,
    derived: &Derived<'_>,
    findings: &Findings,
    conditions: &[ExprId],
) -> Vec<(&'static str, String)> {
    let motion = match derived {
        Derived::Adapted { .. } => "Equations of motion, (8)",
        Derived::Projected { .. } => "Equations of motion, (9)",
    };
    vec![
        ("Conditions on the parameters", nonzero(page, conditions)),
        ("Distribution", distribution(page, derived)),
        ("Mass matrix", mass_matrix(page, derived)),
        (motion, equations_of_motion(page, derived)),
        ("Routh reduction, (22)", routh(page, findings)),
        ("Impacts, (50)", impacts(page, proved)),
        ("Symmetries and momenta, (11), (12)", symmetries(page, proved, findings)),
        (classification::title_of_conserved(page.model), conserved(page, proved, findings)),
    ]
}

fn nonzero(page: &Page<'_>, conditions: &[ExprId]) -> String {
    let mut shown: Vec<String> = Vec::new();
    for condition in conditions {
        let tex = format!(r"${} \ne 0$", page.formula(*condition).joined().tex);
        if !shown.contains(&tex) {
            shown.push(tex);
        }
    }
    if shown.is_empty() { String::new() } else { format!("{}.\n", shown.join(", ")) }
}

/// The sections of D that the velocities of the state belong to.
fn distribution(page: &Page<'_>, derived: &Derived<'_>) -> String {
    let Derived::Adapted { distribution, .. } = derived else { return String::new() };
    let page = &page.shared_by(distribution.independent.len() * page.model.sections.len() / 4);
    if distribution.constraints.annihilator.is_empty() {
        return String::new();
    }
    let names = page.sections();
    let lines = distribution.independent.iter().enumerate().map(|(a, symbol)| {
        equation(&below(r"X", &page.symbol(*symbol)), page.combination(&distribution.section(a), &names))
    });
    equations(lines.collect())
}

/// The letter of the mass matrix, its rows, and the velocities that they belong to.
fn masses<'d>(page: &Page<'_>, derived: &Derived<'d>) -> (&'static str, &'d [Vec<ExprId>], Vec<SymbolId>) {
    match derived {
        Derived::Adapted { equations, kept, .. } => ("C", &equations.mass, kept.independent.clone()),
        Derived::Projected { equations, .. } => {
            ("W", &equations.mass, page.model.sections.iter().map(|section| section.symbol).collect())
        }
    }
}

fn entry(letter: &str, a: usize, b: usize, size: usize) -> Typeset {
    let comma = if size > 9 { "," } else { "" };
    let (a, b) = (a.min(b) + 1, a.max(b) + 1);
    Typeset::new(format!("{letter}_{{{a}{comma}{b}}}"), 1_700)
}

fn mass_matrix(page: &Page<'_>, derived: &Derived<'_>) -> String {
    let (letter, rows, velocities) = masses(page, derived);
    let size = rows.len();
    let page = &page.shared_by(size * (size + 1) / 2);
    let mut lines = Vec::new();
    for (a, row) in rows.iter().enumerate() {
        for (b, value) in row.iter().enumerate().skip(a).filter(|(_, value)| !page.is_zero(**value)) {
            lines.push(equation(&entry(letter, a, b, size), page.formula(*value)));
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let velocities: Vec<String> = velocities.iter().map(|symbol| page.symbol(*symbol).tex).collect();
    let numbers = format!("The velocities are numbered in the order ${}$; ", velocities.join("$, $"));
    let others = if lines.len() < size * (size + 1) / 2 { "other entries are 0.\n" } else { "" };
    format!("{numbers}${letter}$ is symmetric, with the entries\n{}{others}", equations(lines))
}

fn equations_of_motion(page: &Page<'_>, derived: &Derived<'_>) -> String {
    let page = &page.shared_by(page.model.coordinates.len() + page.model.sections.len());
    let rates = match derived {
        Derived::Adapted { equations, .. } => &equations.rates,
        Derived::Projected { equations, .. } => &equations.rates,
    };
    let rates = page.model.coordinates.iter().zip(rates);
    let rates = rates.map(|(x, rate)| equation(&page.rate(x.symbol), page.formula(*rate)));
    // a rate that is a velocity by its name says nothing
    let rates = rates.filter(|line| line.left.clone().joined() != line.right.clone().joined()).collect();
    let (letter, rows, velocities) = masses(page, derived);
    let (mut lines, mut beside) = (Vec::new(), Vec::new());
    match derived {
        Derived::Adapted { equations, distribution, kept } => {
            for (a, force) in equations.force.iter().enumerate() {
                let left = accelerations(page, (letter, rows), a, &velocities);
                lines.push(Equation { left, right: page.formula(*force) });
            }
            for section in &distribution.dependent {
                let symbol = page.model.sections.get(*section).map(|section| page.symbol(section.symbol));
                let value = equations.velocity.get(section.index());
                let pair = symbol.zip(value);
                beside.extend(pair.map(|(symbol, value)| equation(&symbol, page.formula(*value))));
            }
            for (symbol, value) in &kept.eliminated {
                beside.push(equation(&page.symbol(*symbol), page.formula(*value)));
            }
            for definition in &equations.definitions.definitions {
                if let Definition::Value { symbol, value } = definition {
                    beside.push(equation(&page.symbol(*symbol), page.formula(*value)));
                }
            }
        }
        Derived::Projected { equations, .. } => {
            let accelerated: Vec<Typeset> = velocities.iter().map(|symbol| page.rate(*symbol)).collect();
            for (alpha, force) in equations.force.iter().enumerate() {
                let left = accelerations(page, (letter, rows), alpha, &velocities);
                let right = with_reactions(page, &equations.jacobian, alpha, *force);
                lines.push(Equation { left, right });
            }
            for (row, bias) in equations.jacobian.iter().zip(&equations.bias) {
                lines
                    .push(Equation { left: page.combination(row, &accelerated), right: page.formula(*bias) });
            }
        }
    }
    let auxiliary = page.model.auxiliary.iter();
    beside.extend(auxiliary.map(|z| equation(&page.rate(z.symbol), page.formula(z.value))));
    [rates, lines, beside].map(equations).concat()
}

/// A row of the mass matrix times the accelerations.
fn accelerations(
    page: &Page<'_>,
    (letter, rows): (&str, &[Vec<ExprId>]),
    a: usize,
    velocities: &[SymbolId],
) -> Line {
    let rates: Vec<Typeset> = velocities.iter().map(|symbol| page.rate(*symbol)).collect();
    let row = rows.get(a).map_or(&[][..], Vec::as_slice);
    let line = page.combination(row, &rates);
    if line.width() <= WRITTEN_OUT {
        return line;
    }
    let mut line = Line::default();
    for (b, rate) in rates.iter().enumerate().filter(|(b, _)| !page.is_zero(row[*b])) {
        if !line.is_empty() {
            line.may_break(0, "");
            line.write(" + ", 1_300);
        }
        line.push(&entry(letter, a, b, rows.len()));
        line.write(r"\,", 170);
        line.push(rate);
    }
    line
}

/// f_α + λ_A J^A_α.
fn with_reactions(page: &Page<'_>, jacobian: &[Vec<ExprId>], alpha: usize, force: ExprId) -> Line {
    let (mut coefficients, mut names) = (Vec::new(), Vec::new());
    for (index, row) in jacobian.iter().enumerate() {
        let constraint = page.model.constraints.get(ConstraintId::from_index(index));
        let label = constraint.and_then(|constraint| constraint.label.clone());
        let label = label.unwrap_or_else(|| (index + 1).to_string());
        coefficients.push(row[alpha]);
        names.push(below(r"\lambda", &super::Name::of(&label).label()));
    }
    let reactions = page.combination(&coefficients, &names);
    if coefficients.iter().all(|value| page.is_zero(*value)) {
        return page.formula(force);
    }
    if page.is_zero(force) {
        return reactions;
    }
    let mut line = page.formula(force);
    line.may_break(0, "");
    if !reactions.begins_with("-") {
        line.write(" + ", 1_300);
    }
    line.append(reactions, 0);
    line
}

fn routh(page: &Page<'_>, findings: &Findings) -> String {
    let levels = findings.levels.iter().map(|level| {
        let mut right = page.formula(level.momentum);
        right.may_break(0, "");
        right.write(" = ", 1_400);
        right.append(page.formula(level.value), 0);
        equation(&below("p", &super::Name::of(&level.name).label()), right)
    });
    let routhian = findings.routhian.map(|value| equation(&Typeset::new("R", 800), page.formula(value)));
    equations(levels.chain(routhian).collect())
}

fn impacts(page: &Page<'_>, proved: &Proved) -> String {
    let mut text = String::new();
    for impact in &proved.impacts {
        let mut lines = Vec::new();
        for row in &impact.rows {
            let label = super::Name::of(&row.name).label();
            if let Some(gap) = row.position {
                let mut right = page.formula(gap);
                right.write(if row.is_unilateral { r" \ge 0" } else { " = 0" }, 1_900);
                lines.push(equation(&below("h", &label), right));
            }
            lines.push(equation(&below(r"\psi", &label), page.formula(row.form)));
        }
        if let Some(restitution) = impact.restitution {
            let label = super::Name::of(&impact.label).label();
            lines.push(equation(&below("e", &label), page.formula(restitution)));
        }
        text.push_str(&display(lines));
    }
    if text.is_empty() {
        return text;
    }
    let legend = "Gaps $h$, the velocities $\\psi$ that jump, and coefficients of restitution $e$:\n";
    format!("{legend}{text}")
}

fn symmetries(page: &Page<'_>, proved: &Proved, findings: &Findings) -> String {
    let names = page.sections();
    let mut text = String::new();
    for symmetry in &findings.symmetries {
        let label = super::Name::of(&symmetry.name).label();
        let (section, momentum) = (below(r"\sigma", &label), below("p", &label));
        let rate = below(r"\dot{p}", &label);
        let mut lines = vec![
            equation(&section, page.combination(&symmetry.section, &names)),
            equation(&momentum, page.formula(symmetry.momentum)),
        ];
        match symmetry.rate {
            Some(Rate::Zero) => lines.push(equation(&rate, Line::of(&Typeset::new("0", 500)))),
            Some(Rate::Of(value)) => lines.push(equation(&rate, page.formula(value))),
            None => {}
        }
        _ = write!(
            text,
            "{}: {}.\n{}",
            super::words::escaped(&symmetry.name),
            super::words::escaped(symmetry.kind),
            display(lines)
        );
    }
    let cyclic = proved.symmetries.cyclic.iter();
    let cyclic: Vec<String> =
        cyclic.filter_map(|id| Some(page.symbol(page.model.coordinates.get(*id)?.symbol).tex)).collect();
    if !cyclic.is_empty() {
        _ = writeln!(text, "Cyclic coordinates, each left to a quadrature: ${}$.", cyclic.join("$, $"));
    }
    text
}

fn conserved(page: &Page<'_>, proved: &Proved, findings: &Findings) -> String {
    let momenta = findings
        .conserved_momenta
        .iter()
        .map(|(name, value)| equation(&below("p", &super::Name::of(name).label()), page.formula(*value)));
    items(&classification::conserved(proved, findings)) + &equations(momenta.collect())
}

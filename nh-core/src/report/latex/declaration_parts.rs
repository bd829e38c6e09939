//! What is declared: variables, the algebroid, the Lagrangian, constraints, forces.

use std::fmt::Write;

use super::expression::numeral;
use super::line::{Equation, Line, Typeset};
use super::names::Names;
use super::{Page, below, equation, equations, items, labelled, words};
use crate::compile::Proved;
use crate::id::{ExprId, SymbolId};
use crate::model::{Assumption, Attitude, ForceDirection, Inertia, Model, Relation};
use crate::units::Unit;

/// Names that are listed without dots.
const LISTED: usize = 12;

/// The parts with their titles; those with nothing in them are empty.
pub(super) fn parts(page: &Page<'_>, proved: &Proved) -> Vec<(&'static str, String)> {
    vec![
        ("Variables and parameters", variables(page)),
        (r"Anchor: $\dot{x}^i = \rho^i_\alpha y^\alpha$", anchor(page, proved)),
        (r"Brackets: $[e_\alpha, e_\beta] = C^\gamma_{\alpha\beta} e_\gamma$", brackets(page, proved)),
        ("Frame", frame(page)),
        ("Bodies", bodies(page)),
        (
            "Lagrangian",
            equations(vec![equation(&Typeset::new("L", 700), page.formula(page.model.lagrangian.value))]),
        ),
        ("Constraints", constraints(page)),
        ("Forces", forces(page)),
        ("Auxiliary states", auxiliary(page)),
        ("Outputs", outputs(page)),
    ]
}

/// Names with their units, by what they are.
fn variables(page: &Page<'_>) -> String {
    let Model { coordinates, sections, parameters, inputs, auxiliary, graph, .. } = page.model;
    let constants = graph.constants();
    let named = constants.iter_ids().map(|(id, constant)| {
        let name = page.names.constant(id).typeset();
        format!("${} = {}$", name.tex, numeral(&constant.value).tex)
    });
    let kinds: [(&str, Vec<(&str, SymbolId)>); 5] = [
        ("coordinates", coordinates.iter().map(|x| (x.name.as_str(), x.symbol)).collect()),
        ("velocities", sections.iter().map(|x| (x.name.as_str(), x.symbol)).collect()),
        ("auxiliary states", auxiliary.iter().map(|x| (x.name.as_str(), x.symbol)).collect()),
        ("inputs", inputs.iter().map(|x| (x.name.as_str(), x.symbol)).collect()),
        ("parameters", parameters.iter().map(|x| (x.name.as_str(), x.symbol)).collect()),
    ];
    let mut text = String::new();
    let mut line = |kind: &str, names: Vec<String>| {
        if !names.is_empty() {
            _ = writeln!(text, "\\item {kind}: {}", names.join(", "));
        }
    };
    for (kind, names) in kinds {
        line(kind, listed(page, &names));
    }
    line("constants", named.collect());
    line("assumed", page.model.assumptions.iter().map(|fact| assumption(page, fact)).collect());
    if text.is_empty() { text } else { format!("\\begin{{itemize}}\n{text}\\end{{itemize}}\n") }
}

/// A fact about parameters.
fn assumption(page: &Page<'_>, fact: &Assumption) -> String {
    let [left, right] = [fact.left, fact.right].map(|side| page.formula(side).joined().tex);
    let relation = match fact.relation {
        Relation::Less => "<",
        Relation::LessOrEqual => r"\le",
        Relation::Greater => ">",
        Relation::GreaterOrEqual => r"\ge",
        Relation::NotEqual => r"\ne",
    };
    format!("${left} {relation} {right}$")
}

/// Names with units; of many, the first and the last.
fn listed(page: &Page<'_>, names: &[(&str, SymbolId)]) -> Vec<String> {
    let shown = |(name, symbol): &(&str, SymbolId)| {
        let tex = page.symbol(*symbol).tex;
        let unit = page.model.units.iter().find(|quantity| quantity.name == *name);
        match unit.map(|quantity| &quantity.unit) {
            Some(Unit::Known(unit)) => format!("${tex}$ (${}$)", words::unit(unit)),
            Some(Unit::Free) | None => format!("${tex}$"),
        }
    };
    match names {
        [first @ .., last] if names.len() > LISTED => {
            let mut list: Vec<String> = first.iter().take(LISTED - 2).map(shown).collect();
            list.extend([r"\dots".to_owned(), shown(last)]);
            list
        }
        _ => names.iter().map(shown).collect(),
    }
}

fn anchor(page: &Page<'_>, proved: &Proved) -> String {
    let page = &page.shared_by(page.model.coordinates.len());
    let names: Vec<Typeset> = page.model.sections.iter().map(|section| page.symbol(section.symbol)).collect();
    let rows = page.model.coordinates.iter().zip(&proved.system.algebroid.anchor.entries);
    let lines = rows.map(|(x, row)| equation(&page.rate(x.symbol), page.combination(row, &names)));
    // a rate that is a velocity by its name says nothing
    equations(lines.filter(|line| line.left.clone().joined() != line.right.clone().joined()).collect())
}

fn brackets(page: &Page<'_>, proved: &Proved) -> String {
    let names = page.sections();
    let pairs = proved.system.algebroid.structure.nonzero(&page.model.graph);
    let lines = pairs.filter_map(|(alpha, beta, components)| {
        let symbol = |section| {
            page.model.sections.get(section).map(|section| below("e", &page.symbol(section.symbol)))
        };
        let (first, second) = (symbol(alpha)?, symbol(beta)?);
        let left =
            Typeset::new(format!("[{}, {}]", first.tex, second.tex), first.width + second.width + 1_100);
        Some(equation(&left, page.combination(components, &names)))
    });
    let shown = equations(lines.collect());
    if shown.is_empty() { "All brackets vanish.\n".into() } else { shown }
}

/// The declared frame, in the sections of the basis that it stands on.
fn frame(page: &Page<'_>) -> String {
    let Model { graph, frame, sections, .. } = page.model;
    let declared = frame.iter().flat_map(|section| graph.symbols_in(&[section.value]));
    let others = others(page.model);
    let declared = declared.filter(|symbol| !others.contains(symbol));
    let velocities: Vec<SymbolId> = declared.chain(sections.iter().map(|section| section.symbol)).collect();
    let names: &Names = &page.names.as_sections(&velocities);
    let of_sections = Page { names, ..*page };
    let line = |section: &crate::model::FrameDecl| {
        equation(&below("e", &page.symbol(section.symbol)), of_sections.formula(section.value))
    };
    equations(frame.iter().map(line).collect())
}

/// What is no velocity.
fn others(model: &Model) -> Vec<SymbolId> {
    let coordinates = model.coordinates.iter().map(|x| x.symbol);
    let parameters = model.parameters.iter().map(|x| x.symbol);
    coordinates.chain(parameters).chain([model.time]).collect()
}

/// Mass, inertia, place and attitude of each body.
fn bodies(page: &Page<'_>) -> String {
    let page = &page.shared_by(12 * page.model.bodies.len());
    let mut lines = Vec::new();
    for (index, body) in page.model.bodies.iter().enumerate() {
        let index = Typeset::new((index + 1).to_string(), 500);
        let mut line = |letter: &str, right: Line| lines.push(equation(&below(letter, &index), right));
        line("m", page.formula(body.mass));
        match &body.inertia {
            Inertia::None => {}
            Inertia::Isotropic(value) => line("I", page.formula(*value)),
            Inertia::Diagonal(values) => line("I", page.tuple(values, r"\operatorname{diag}")),
            Inertia::Full(values) => line("I", page.matrix(values, 3)),
        }
        line("p", page.tuple(&body.position, ""));
        match &body.attitude {
            Attitude::None => {}
            Attitude::Angle(angle) => line(r"\alpha", page.formula(*angle)),
            Attitude::Turns(turns) => {
                let mut product = Line::default();
                for turn in turns {
                    product.may_break(0, "");
                    product.append(page.matrix(&turn.matrix, 3), 1);
                }
                line("R", product);
            }
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let legend =
        "Mass $m$, inertia $I$ about the centre of mass, which is at $p$, attitude $R$ or angle $\\alpha$:\n";
    format!("{legend}{}", equations(lines))
}

fn constraints(page: &Page<'_>) -> String {
    let page = &page.shared_by(page.model.positions.len() + page.model.constraints.len());
    let label = |letter: &str, label: &Option<String>, number: usize| match label {
        Some(label) => labelled(letter, label),
        None => labelled(letter, &(number + 1).to_string()),
    };
    let vanishing = |left: &Typeset, value: ExprId| {
        let mut right = page.formula(value);
        right.may_break(0, "");
        right.write(" = 0", 1_900);
        equation(left, right)
    };
    let mut lines: Vec<Equation> = Vec::new();
    for (number, position) in page.model.positions.iter().enumerate() {
        lines.push(vanishing(&label("f", &position.label, number), position.value));
    }
    for (number, constraint) in page.model.constraints.iter().enumerate() {
        lines.push(vanishing(&label(r"\phi", &constraint.label, number), constraint.residual));
    }
    let mut text = equations(lines);
    if let Some(sections) = &page.model.distribution {
        let names: Vec<String> =
            sections.iter().map(|(symbol, _)| below("e", &page.symbol(*symbol)).tex).collect();
        _ = writeln!(text, "$D$ is spanned by ${}$.", names.join("$, $"));
    }
    if !page.model.constraints.is_empty() {
        text.push_str(
            "A multiplier $\\lambda_A$ acts as $+\\lambda_A\\,\\partial\\phi^A/\\partial y^\\alpha$ on the right-hand \
             side of the equations of motion.\n",
        );
    }
    text
}

fn forces(page: &Page<'_>) -> String {
    let line = |force: &crate::model::ForceDecl| {
        let left = match force.direction {
            ForceDirection::Section(symbol) => below(r"\Upsilon", &page.symbol(symbol)),
            ForceDirection::Coordinate(id) => {
                let symbol = page.model.coordinates.get(id).map(|x| page.symbol(x.symbol));
                below("Q", &symbol.unwrap_or_default())
            }
        };
        equation(&left, page.formula(force.value))
    };
    equations(page.model.forces.iter().map(line).collect())
}

fn auxiliary(page: &Page<'_>) -> String {
    let lines = page.model.auxiliary.iter().map(|z| equation(&page.rate(z.symbol), page.formula(z.value)));
    equations(lines.collect())
}

fn outputs(page: &Page<'_>) -> String {
    let page = &page.shared_by(page.model.outputs.len());
    let lines = page.model.outputs.iter().map(|y| equation(&page.name(&y.name), page.formula(y.value)));
    let mut text = equations(lines.collect());
    let claims: Vec<Equation> = page
        .model
        .claims
        .iter()
        .map(|claim| equation(&page.name(&claim.name), page.formula(claim.value)))
        .collect();
    if !claims.is_empty() {
        text.push_str("Claimed to be conserved, and proved:\n");
        text.push_str(&equations(claims));
    }
    if let Some(volume) = page.model.volume.and_then(|claim| claim.density) {
        text.push_str("A volume with this density is claimed to be invariant, and proved:\n");
        text.push_str(&equations(vec![equation(&Typeset::new(r"\mu", 600), page.formula(volume))]));
    }
    let idle = page.model.idle.iter().chain(&page.model.idle_inputs);
    let unused = idle.map(|name| format!("{name} stands in no expression")).collect::<Vec<_>>();
    text + &items(&unused)
}

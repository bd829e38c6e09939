//! That the anchor is a homomorphism of brackets, mathematics (2), and which line is wrong where it is none.

use super::evidence::{listed, shown};
use super::structure_equations::{COMPARED, REPORTED, defect_text, origin_of_pair};
use crate::algebra::Graph;
use crate::geometry::{Algebroid, Manifold, hamel};
use crate::id::{CoordId, ExprId, Id, Origin, SectionId};
use crate::limits;
use crate::model::{Kinematics, Model};
use crate::violation::{Law, Violation};

/// Work that looking for one wrong sign may take.
const WORK: u64 = 2_000_000;

/// A pair of sections, the coordinates along which it breaks (2), and how.
struct Broken {
    pair: [SectionId; 2],
    along: Vec<usize>,
    violation: Violation,
}

/// The rows of the anchor that are one line of the declaration.
struct Line {
    origin: Origin,
    rows: Vec<usize>,
}

/// Mathematics (2) for all pairs: one error for one mistake, as far as that is known.
pub(super) fn homomorphism(model: &mut Model, algebroid: &Algebroid, base: &Manifold) -> Vec<Violation> {
    let broken = pairs(model, algebroid, base, REPORTED * COMPARED);
    if let (Some(first), true) = (broken.first(), broken.len() > 1 && !model.brackets.is_empty()) {
        let wrong = limits::attempt(WORK, || wrong_sign(model, algebroid, base, &broken)).flatten();
        let wrong = wrong.or_else(|| only_line(model, &broken));
        if let Some((origin, remark)) = wrong {
            let way_out = "correct this line, or the brackets where it is right; or write `almost;` if an almost Lie \
                           algebroid is meant";
            return vec![Violation {
                origin,
                what: format!("the anchor is not a homomorphism of brackets on {}", names(model, &broken)),
                evidence: format!("{}{remark}", first.violation.evidence),
                way_out: way_out.into(),
                ..first.violation.clone()
            }];
        }
    }
    if let ([first, _, ..], true) = (broken.as_slice(), model.brackets.is_empty()) {
        // which vector field leaves the span of the others is not known
        let what = format!("the anchor is not a homomorphism of brackets on {}", names(model, &broken));
        return vec![Violation { what, ..first.violation.clone() }];
    }
    let mut told: Vec<Violation> = Vec::new();
    for Broken { violation, .. } in broken {
        // the brackets of a known algebra stand at one place
        if !told.iter().any(|known| known.origin == violation.origin) {
            told.push(violation);
        }
    }
    told.truncate(REPORTED);
    told
}

/// At most so many violations of mathematics (2), a pair each.
pub(super) fn broken_pairs(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
    most: usize,
) -> Vec<Violation> {
    pairs(model, algebroid, base, most).into_iter().map(|broken| broken.violation).collect()
}

/// `the pair [a, b]`, `the pairs [a, b], [a, c] and others`.
fn names(model: &Model, broken: &[Broken]) -> String {
    let name = |broken: &Broken| {
        let [a, b] = broken.pair.map(|section| model.sections[section].name.as_str());
        format!("[{a}, {b}]")
    };
    let mut names: Vec<String> = broken.iter().take(REPORTED).map(name).collect();
    if broken.len() > REPORTED {
        names.push("others".to_owned());
    }
    format!("the pairs {}", listed(&names))
}

/// The lines of the anchor.
fn lines(model: &Model) -> Vec<Line> {
    let Kinematics::Anchor(declared) = &model.kinematics else { return Vec::new() };
    let mut lines: Vec<Line> = Vec::new();
    for line in declared {
        let row = line.coordinate.index();
        match lines.iter_mut().find(|known| known.origin == line.origin) {
            Some(known) => known.rows.push(row),
            None => lines.push(Line { origin: line.origin, rows: vec![row] }),
        }
    }
    lines
}

/// The line in which another sign makes the anchor a homomorphism, and what may have that sign.
fn wrong_sign(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
    broken: &[Broken],
) -> Option<(Origin, String)> {
    for line in lines(model) {
        let is_there = |section: &SectionId| {
            let entry = |row: &usize| algebroid.anchor.entries[*row][section.index()];
            line.rows.iter().any(|row| !model.graph.is_literal_zero(entry(row)))
        };
        let sections: Vec<SectionId> = algebroid.sections().filter(is_there).collect();
        let alone = sections.iter().map(|section| vec![*section]);
        let changes: Vec<Vec<SectionId>> = std::iter::once(sections.clone()).chain(alone).collect();
        let mut found: Vec<String> = Vec::new();
        for changed in changes {
            let mut other = algebroid.clone();
            for (row, section) in line.rows.iter().flat_map(|row| changed.iter().map(move |s| (*row, *s))) {
                let entry = &mut other.anchor.entries[row][section.index()];
                *entry = model.graph.formula(-*entry);
            }
            let heals =
                |model: &mut Model, pair: [SectionId; 2]| of_pair(model, &other, base, pair).is_none();
            if broken.iter().all(|broken| heals(model, broken.pair))
                && pairs(model, &other, base, 1).is_empty()
            {
                found.push(match changed.as_slice() {
                    [only] if sections.len() > 1 => format!("`{}`", model.sections[*only].name),
                    _ => "the right-hand side".to_owned(),
                });
            }
        }
        found.dedup();
        if !found.is_empty() {
            let remark = format!("; with the other sign of {} in this line it is one", found.join(" or of "));
            return Some((line.origin, remark));
        }
    }
    None
}

/// The line that all pairs are broken along.
fn only_line(model: &Model, broken: &[Broken]) -> Option<(Origin, String)> {
    let lines = lines(model);
    let mut here =
        lines.iter().filter(|line| broken.iter().any(|b| b.along.iter().any(|row| line.rows.contains(row))));
    match (here.next(), here.next()) {
        (Some(line), None) if lines.len() > 1 => Some((line.origin, "; so it is along no other line".into())),
        _ => None,
    }
}

/// At most so many pairs that break mathematics (2): `ρ^j_α ∂_jρ^i_β − ρ^j_β ∂_jρ^i_α = ρ^i_γ C^γ_{αβ}`.
fn pairs(model: &mut Model, algebroid: &Algebroid, base: &Manifold, most: usize) -> Vec<Broken> {
    let mut found = Vec::new();
    if algebroid.anchor.coordinates.is_empty() {
        return found;
    }
    for alpha in algebroid.sections() {
        for beta in algebroid.sections().filter(|beta| alpha < *beta) {
            if found.len() == most {
                return found;
            }
            found.extend(of_pair(model, algebroid, base, [alpha, beta]));
        }
    }
    found
}

fn of_pair(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
    [alpha, beta]: [SectionId; 2],
) -> Option<Broken> {
    let graph = &mut model.graph;
    let commutator = hamel::commutator(graph, &algebroid.anchor, alpha, beta);
    let bracket = bracket_of(graph, algebroid, alpha, beta);
    let image = algebroid.anchor.vector_field(graph, &bracket);
    let (mut along, mut first) = (Vec::new(), None);
    for (index, (left, right)) in commutator.into_iter().zip(image).enumerate() {
        let defect = graph.formula(left - right);
        let verdict = base.zero_test(graph, defect);
        if verdict.is_zero() {
            continue;
        }
        along.push(index);
        first.get_or_insert((index, left, right, defect, verdict));
    }
    let (index, left, right, defect, verdict) = first?;
    let (left, right, defect) = (graph.simplify(left), graph.simplify(right), graph.simplify(defect));
    let (a, b) = (&model.sections[alpha].name, &model.sections[beta].name);
    let x = &model.coordinates[CoordId::from_index(index)].name;
    let graph = &model.graph;
    let evidence = format!(
        "along `{x}`: [rho({a}), rho({b})] is {}, but rho([{a}, {b}]) is {}; the difference {}",
        shown(graph, left),
        shown(graph, right),
        defect_text(graph, defect, &verdict, base),
    );
    let derivable = model.brackets.is_empty();
    let way_out = if derivable {
        "no bracket of the declared sections exists: their vector fields do not close; \
         add the missing section to the basis, or declare the `brackets` of an almost Lie algebroid"
            .to_owned()
    } else {
        format!(
            "correct the bracket [{a}, {b}] or the anchor; where the anchor is injective, leave `brackets` \
             out and they are derived; or write `almost;` if an almost Lie algebroid is meant"
        )
    };
    let violation = Violation {
        law: Law::Homomorphism,
        origin: origin_of_pair(model, alpha, beta),
        what: format!("the anchor is not a homomorphism of brackets on the pair [{a}, {b}]"),
        evidence,
        way_out,
    };
    Some(Broken { pair: [alpha, beta], along, violation })
}

fn bracket_of(graph: &mut Graph, algebroid: &Algebroid, alpha: SectionId, beta: SectionId) -> Vec<ExprId> {
    algebroid.sections().map(|gamma| algebroid.structure.get(graph, gamma, alpha, beta)).collect()
}

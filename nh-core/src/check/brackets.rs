//! The structure functions: declared, or derived from the anchor.

use super::evidence::{listed, shown};
use super::kinematics::Motion;
use crate::algebra::{Echelon, FieldPoint, Graph, Matrix, NotLinear, Residue};
use crate::geometry::{Manifold, StructureFunctions, hamel};
use crate::id::{ExprId, Id, Origin, SectionId, SymbolId};
use crate::model::{BracketDecl, Kinematics, Model};
use crate::violation::{Law, Violation};
use std::collections::{BTreeMap, BTreeSet};

/// C^γ_{αβ}: of E = TM all zero, of a coframe by (4), declared, or derived from the anchor by (2).
///
/// # Errors
/// Brackets that are malformed, contradict each other, or are needed and missing.
pub fn structure_functions(
    model: &mut Model,
    motion: &Motion,
    base: &Manifold,
) -> Result<StructureFunctions, Vec<Violation>> {
    let rank = model.sections.len();
    let mut structure = StructureFunctions::commuting(rank);
    if matches!(model.kinematics, Kinematics::Tangent) {
        return if model.brackets_declared {
            Err(vec![brackets_of_coordinates(model)])
        } else {
            Ok(structure)
        };
    }
    let mut seen: BTreeMap<Pair, (Vec<ExprId>, BracketDecl)> = BTreeMap::new();
    let mut violations = Vec::new();
    for declaration in model.brackets.clone() {
        match components(model, &declaration) {
            Ok(components) => {
                if let Err(violation) = record(model, &mut structure, &mut seen, &declaration, components) {
                    violations.push(violation);
                }
            }
            Err(violation) => violations.push(violation),
        }
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    // where nothing has to agree with the anchor, what is not declared is 0
    if !(model.almost && model.brackets_declared) {
        let open = unlisted(model, &seen);
        derived(model, motion, base, &open, &mut structure).map_err(|violation| vec![violation])?;
    }
    Ok(structure)
}

/// Two sections, the first before the second.
type Pair = (SectionId, SectionId);

/// The pairs without a line. Known algebras give those of all of their sections.
fn unlisted(model: &Model, seen: &BTreeMap<Pair, (Vec<ExprId>, BracketDecl)>) -> Vec<Pair> {
    let section =
        |symbol: SymbolId| model.sections.iter_ids().find(|(_, s)| s.symbol == symbol).map(|(id, _)| id);
    let mut blocks: BTreeMap<Origin, BTreeSet<SectionId>> = BTreeMap::new();
    for bracket in model.brackets.iter().filter(|bracket| bracket.known.is_some()) {
        let block = blocks.entry(bracket.origin).or_default();
        block.extend([bracket.left, bracket.right]);
        block.extend(model.graph.symbols_in(&[bracket.value]).into_iter().filter_map(section));
    }
    let ids: Vec<SectionId> = model.sections.ids().collect();
    let pairs = ids.iter().enumerate().flat_map(|(index, a)| ids[index + 1..].iter().map(move |b| (*a, *b)));
    let is_known = |(a, b): &Pair| blocks.values().any(|block| block.contains(a) && block.contains(b));
    pairs.filter(|pair| !seen.contains_key(pair) && !is_known(pair)).collect()
}

/// The brackets of some pairs as the coframe or the anchor determines them.
fn derived(
    model: &mut Model,
    motion: &Motion,
    base: &Manifold,
    pairs: &[Pair],
    structure: &mut StructureFunctions,
) -> Result<(), Violation> {
    if pairs.is_empty() {
        return Ok(());
    }
    if let Some(coframe) = &motion.coframe {
        let (frame, coordinates) = (&motion.anchor.entries, &motion.anchor.coordinates);
        let all = hamel::from_coframe(&mut model.graph, coframe, frame, coordinates);
        if !model.brackets_declared {
            *structure = all;
            return Ok(());
        }
        for (alpha, beta) in pairs {
            let graph = &mut model.graph;
            let components = structure_row(graph, &all, *alpha, *beta);
            structure.set(graph, *alpha, *beta, components);
        }
        return Ok(());
    }
    if model.coordinates.is_empty() {
        // the anchor says nothing
        return if model.brackets_declared { Ok(()) } else { Err(missing(model, motion, &[], &[])) };
    }
    let graph = &mut model.graph;
    let column = |section: SectionId| motion.anchor.entries.iter().map(move |row| row[section.index()]);
    let visible: Vec<SectionId> = model
        .sections
        .ids()
        .filter(|section| column(*section).any(|entry| !base.zero_test(graph, entry).is_zero()))
        .collect();
    match hamel::from_anchor(graph, &motion.anchor, &visible, pairs, structure) {
        Ok(true) => Ok(()),
        Ok(false) => {
            // (2) has a solution, 0, where the commutator vanishes; elsewhere it has several
            let moving = moving(model, motion, base, pairs);
            if moving.is_empty() && model.brackets_declared {
                return Ok(());
            }
            Err(missing(model, motion, &visible, &moving))
        }
        Err(why) => Err(Violation {
            law: Law::Decidable,
            origin: model.origin,
            what: "whether the brackets follow from the anchor could not be decided".into(),
            evidence: why,
            way_out: "declare them in `brackets { … }`".into(),
        }),
    }
}

/// The components of `[e_α, e_β]`.
fn structure_row(
    graph: &mut Graph,
    structure: &StructureFunctions,
    alpha: SectionId,
    beta: SectionId,
) -> Vec<ExprId> {
    let sections = (0..structure.rank()).map(SectionId::from_index);
    sections.map(|gamma| structure.get(graph, gamma, alpha, beta)).collect()
}

/// The pairs whose brackets the anchor sends to motions of the base, so that they are not 0.
fn moving(model: &mut Model, motion: &Motion, base: &Manifold, pairs: &[Pair]) -> Vec<String> {
    let graph = &mut model.graph;
    let mut found = Vec::new();
    for (alpha, beta) in pairs {
        let commutator = hamel::commutator(graph, &motion.anchor, *alpha, *beta);
        if commutator.iter().any(|component| base.zero_test(graph, *component).is_nonzero()) {
            found.push(format!("[{}, {}]", model.sections[*alpha].name, model.sections[*beta].name));
        }
    }
    found
}

fn brackets_of_coordinates(model: &Model) -> Violation {
    Violation {
        law: Law::Brackets,
        origin: model.brackets.first().map_or(model.origin, |bracket| bracket.origin),
        what: "brackets are declared, but the sections are the coordinate fields, which commute".into(),
        evidence: "without `basis` or `velocities` the bundle is TM with the frame ∂/∂x".into(),
        way_out: "leave `brackets` out, or declare a `basis` with its `anchor`".into(),
    }
}

/// Brackets are needed, and the anchor does not determine them; these pairs are not 0.
fn missing(model: &Model, motion: &Motion, visible: &[SectionId], moving: &[String]) -> Violation {
    /// Pairs that are named.
    const NAMED: usize = 12;
    let names: Vec<&str> = model.sections.iter().map(|section| section.name.as_str()).collect();
    let evidence = if model.coordinates.is_empty() {
        format!("there are no base coordinates, so nothing is known of the brackets of {}", listed(&names))
    } else {
        kernel_evidence(model, motion, visible)
    };
    let how = "declare them, for example `brackets so(3) { … }` or `brackets { [a, b] = …; }`";
    let shown: Vec<&str> = moving.iter().take(NAMED).map(String::as_str).collect();
    let more = match moving.len() - shown.len() {
        0 => String::new(),
        rest => format!(" and {rest} more"),
    };
    let what = if model.brackets_declared {
        format!("brackets are missing, and not derivable from the anchor: {}{more}", shown.join(", "))
    } else {
        "the brackets are needed: they are neither declared nor derivable from the anchor".into()
    };
    // `brackets { }` is offered only where the anchor does not contradict it: by (2) the images of sections that
    // commute do
    let way_out = match shown.as_slice() {
        [] => format!("{how}; `brackets {{ }}` says that all vanish"),
        [first, ..] if model.brackets_declared => format!(
            "give each of them a line, `{first} = …;`: the anchor sends it to a motion of the base, so that it is \
             not 0; pairs without a line that it sends to 0 are 0"
        ),
        _ => format!(
            "{how}; a line is needed for {}{more}, which the anchor sends to motions of the base; other pairs \
             without a line are 0",
            shown.join(", ")
        ),
    };
    Violation { law: Law::Brackets, origin: model.origin, what, evidence, way_out }
}

/// A combination of sections that the anchor sends to zero, though none of them.
fn kernel_evidence(model: &Model, motion: &Motion, visible: &[SectionId]) -> String {
    let columns: Matrix = motion
        .anchor
        .entries
        .iter()
        .map(|row| visible.iter().map(|section| row[section.index()]).collect())
        .collect();
    let vector = model
        .graph
        .matrix_in_field(&columns, |seed| FieldPoint::random(7_000 + seed))
        .ok()
        .and_then(|rows| Echelon::of(rows).kernel_vector(visible.len()));
    let involved: Vec<&str> = vector
        .map(|vector| {
            let involved = vector.iter().zip(visible).filter(|(c, _)| **c != Residue::ZERO);
            involved.map(|(_, section)| model.sections[*section].name.as_str()).collect()
        })
        .unwrap_or_default();
    format!("a combination of {} moves no base coordinate", listed(&involved))
}

/// The components of one declared bracket.
fn components(model: &mut Model, declaration: &BracketDecl) -> Result<Vec<ExprId>, Violation> {
    let velocities: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
    let pair = pair_text(model, declaration);
    let blame = |what: String, evidence: String, way_out: &str| Violation {
        law: Law::Brackets,
        origin: declaration.origin,
        what,
        evidence,
        way_out: way_out.into(),
    };
    let base: Vec<SymbolId> = model
        .coordinates
        .iter()
        .map(|coordinate| coordinate.symbol)
        .chain(model.parameters.iter().map(|parameter| parameter.symbol))
        .collect();
    let graph: &mut Graph = &mut model.graph;
    let form = graph.linear_form(declaration.value, &velocities).map_err(|error| {
        let evidence = match error {
            NotLinear::Curved(..) => {
                format!("{} is not linear in the sections", shown(graph, declaration.value))
            }
            NotLinear::Unknown(why) => why,
        };
        blame(
            format!("the bracket {pair} is not a section"),
            evidence,
            "write it as a sum of sections with coefficients on the base, such as `2*e1 - x*e2`",
        )
    })?;
    if !graph.zero_test(form.rest).is_zero() {
        let evidence = format!("the term {} is not multiplied by a section", shown(graph, form.rest));
        return Err(blame(
            format!("the bracket {pair} is not a section"),
            evidence,
            "write it as a sum of sections with coefficients on the base, such as `2*e1 - x*e2`",
        ));
    }
    if let Some(stranger) = graph.symbols_in(&form.coefficients).into_iter().find(|s| !base.contains(s)) {
        return Err(blame(
            format!("the bracket {pair} depends on `{}`", graph.symbols()[stranger]),
            "structure functions are functions on the base: of the base coordinates and the parameters"
                .into(),
            "use base coordinates and parameters only",
        ));
    }
    if declaration.left == declaration.right {
        let nonzero = form.coefficients.iter().any(|c| !graph.zero_test(*c).is_zero());
        if nonzero {
            return Err(blame(
                format!("the bracket {pair} of a section with itself is not zero"),
                format!("it is declared as {}", shown(graph, declaration.value)),
                "a bracket is antisymmetric; leave this line out",
            ));
        }
    }
    Ok(form.coefficients)
}

fn pair_text(model: &Model, declaration: &BracketDecl) -> String {
    format!("[{}, {}]", model.sections[declaration.left].name, model.sections[declaration.right].name)
}

/// Stores a bracket, unless the pair has been given another value before.
fn record(
    model: &mut Model,
    structure: &mut StructureFunctions,
    seen: &mut BTreeMap<Pair, (Vec<ExprId>, BracketDecl)>,
    declaration: &BracketDecl,
    components: Vec<ExprId>,
) -> Result<(), Violation> {
    let (left, right) = (declaration.left, declaration.right);
    let ordered = if left < right { (left, right) } else { (right, left) };
    let graph = &mut model.graph;
    let oriented: Vec<ExprId> =
        if left <= right { components } else { components.into_iter().map(|c| graph.formula(-c)).collect() };
    if let Some((earlier, first)) = seen.get(&ordered) {
        let same = earlier.iter().zip(&oriented).all(|(a, b)| {
            let difference = graph.formula(a - b);
            graph.zero_test(difference).is_zero()
        });
        if !same {
            let before = match first.known {
                Some(algebra) => format!(
                    "by {algebra} as {} = {}",
                    pair_text(model, first),
                    shown(&model.graph, first.value)
                ),
                None => format!("as {} = {}", pair_text(model, first), shown(&model.graph, first.value)),
            };
            let pair = pair_text(model, declaration);
            return Err(Violation {
                law: Law::Brackets,
                origin: declaration.origin,
                what: format!("the bracket {pair} is given twice, with different values"),
                evidence: format!("here {}, before {before}", shown(&model.graph, declaration.value)),
                way_out: "keep one of them; the mirrored pair follows by antisymmetry".into(),
            });
        }
        return Ok(());
    }
    structure.set(graph, ordered.0, ordered.1, oriented.clone());
    seen.insert(ordered, (oriented, declaration.clone()));
    debug_assert!(ordered.1.index() < structure.rank());
    Ok(())
}

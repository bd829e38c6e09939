//! The structure functions: declared, or derived from the anchor.

use super::evidence::{listed, shown};
use super::kinematics::Motion;
use crate::algebra::{Echelon, FieldPoint, Graph, NotLinear, Residue};
use crate::geometry::{StructureFunctions, hamel};
use crate::id::{ExprId, Id, SectionId, SymbolId};
use crate::model::{BracketDecl, Kinematics, Model};
use crate::violation::{Law, Violation};
use std::collections::BTreeMap;

/// C^γ_{αβ}: of E = TM all zero, of a coframe by (4), declared, or derived from an injective
/// anchor by (2).
///
/// # Errors
/// Brackets that are malformed, contradict each other, or are needed and missing.
pub fn structure_functions(model: &mut Model, motion: &Motion) -> Result<StructureFunctions, Vec<Violation>> {
    let rank = model.sections.len();
    if !model.brackets_declared {
        return derived(model, motion).map_err(|violation| vec![violation]);
    }
    if matches!(model.kinematics, Kinematics::Tangent) {
        return Err(vec![brackets_of_coordinates(model)]);
    }
    let mut structure = StructureFunctions::commuting(rank);
    let mut seen: BTreeMap<(SectionId, SectionId), (Vec<ExprId>, BracketDecl)> = BTreeMap::new();
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
    if violations.is_empty() { Ok(structure) } else { Err(violations) }
}

fn derived(model: &mut Model, motion: &Motion) -> Result<StructureFunctions, Violation> {
    let rank = model.sections.len();
    // a single section commutes with itself
    if matches!(model.kinematics, Kinematics::Tangent) || rank < 2 {
        return Ok(StructureFunctions::commuting(rank));
    }
    if let Some(coframe) = &motion.coframe {
        let (frame, coordinates) = (&motion.anchor.entries, &motion.anchor.coordinates);
        return Ok(hamel::from_coframe(&mut model.graph, coframe, frame, coordinates));
    }
    match hamel::from_injective_anchor(&mut model.graph, &motion.anchor, rank) {
        Ok(Some(structure)) => Ok(structure),
        Ok(None) => Err(missing(model, motion)),
        Err(why) => Err(Violation {
            law: Law::Decidable,
            origin: model.origin,
            what: "whether the brackets follow from the anchor could not be decided".into(),
            evidence: why,
            way_out: "declare them in `brackets { … }`".into(),
        }),
    }
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

/// Brackets are needed, and the anchor does not determine them.
fn missing(model: &mut Model, motion: &Motion) -> Violation {
    let way_out = bracket_advice(model, motion);
    let names: Vec<&str> = model.sections.iter().map(|section| section.name.as_str()).collect();
    let evidence = if model.coordinates.is_empty() {
        format!("there are no base coordinates, so nothing is known of the brackets of {}", listed(&names))
    } else {
        kernel_evidence(model, motion, &names)
    };
    Violation {
        law: Law::Brackets,
        origin: model.origin,
        what: "the brackets are needed: they are neither declared nor derivable from the anchor".into(),
        evidence,
        way_out,
    }
}

/// `brackets { }` is offered only where the anchor does not contradict it: by (2) the images of sections that
/// commute do.
fn bracket_advice(model: &mut Model, motion: &Motion) -> String {
    let sections: Vec<(SectionId, String)> =
        model.sections.iter_ids().map(|(id, section)| (id, section.name.clone())).collect();
    let graph = &mut model.graph;
    let moving = sections.iter().enumerate().find_map(|(index, (alpha, first))| {
        sections[index + 1..].iter().find_map(|(beta, second)| {
            let commutator = hamel::commutator(graph, &motion.anchor, *alpha, *beta);
            let is_moving = commutator.iter().any(|component| graph.zero_test(*component).is_nonzero());
            is_moving.then(|| format!("[{first}, {second}]"))
        })
    });
    let how = "declare them, for example `brackets so(3) { … }` or `brackets { [a, b] = …; }`";
    match moving {
        None => format!("{how}; `brackets {{ }}` says that all vanish"),
        Some(pair) => format!("{how}; {pair} is not 0, since the anchor sends it to a motion of the base"),
    }
}

/// A combination of sections that the anchor sends to zero.
fn kernel_evidence(model: &Model, motion: &Motion, names: &[&str]) -> String {
    let vector = model
        .graph
        .matrix_in_field(&motion.anchor.entries, |seed| FieldPoint::random(7_000 + seed))
        .ok()
        .and_then(|rows| Echelon::of(rows).kernel_vector(names.len()));
    let involved: Vec<&str> = vector
        .map(|vector| {
            vector.iter().zip(names).filter(|(c, _)| **c != Residue::ZERO).map(|(_, name)| *name).collect()
        })
        .unwrap_or_default();
    match involved.as_slice() {
        [only] => format!("the anchor does not see `{only}`: it moves no base coordinate"),
        several => format!("a combination of {} moves no base coordinate", listed(several)),
    }
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
    seen: &mut BTreeMap<(SectionId, SectionId), (Vec<ExprId>, BracketDecl)>,
    declaration: &BracketDecl,
    components: Vec<ExprId>,
) -> Result<(), Violation> {
    let (left, right) = (declaration.left, declaration.right);
    let ordered = if left < right { (left, right) } else { (right, left) };
    let graph = &mut model.graph;
    let oriented: Vec<ExprId> =
        if left <= right { components } else { components.into_iter().map(|c| graph.neg(c)).collect() };
    if let Some((earlier, first)) = seen.get(&ordered) {
        let same = earlier.iter().zip(&oriented).all(|(a, b)| {
            let difference = graph.sub(*a, *b);
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

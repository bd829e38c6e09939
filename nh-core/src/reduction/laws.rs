//! The laws of a morphism of Lie algebroids, mathematics (13) and (14), CLMM 2.3.

use super::assuming;
use super::bundle_map::BundleMap;
use super::inclusion;
use super::side::Side;
use crate::algebra::{Derivation, Matrix, Verdict};
use crate::check::evidence::{name_of, not_zero, shown};
use crate::compile::Proved;
use crate::id::{ConstraintId, ExprId, Id, Origin, SectionId};
use crate::violation::{Law, Violation};

/// At most so many broken instances of one law are reported.
const REPORTED: usize = 3;

/// The proof of a law: what it finds broken.
type Proof = fn(&mut Side, &Side, &BundleMap) -> Vec<Violation>;

/// The target's embedded base is reached, (13), (14), and, if that `is_asked`, the map is onto on the fibres. What a
/// later law says means little where an earlier one is broken.
pub(super) fn of_the_map(
    source: &mut Side,
    target: &Side,
    map: &BundleMap,
    is_asked: bool,
) -> Vec<Violation> {
    let laws: [Proof; 4] = [into_the_base, admissible, bracket, onto];
    let laws = if is_asked { laws.as_slice() } else { &laws[..3] };
    laws.iter().map(|law| law(source, target, map)).find(|broken| !broken.is_empty()).unwrap_or_default()
}

/// The two sides of an equation that should hold, and the words before each.
pub(super) struct Sides {
    pub(super) left: ExprId,
    pub(super) right: ExprId,
    pub(super) words: [String; 2],
}

/// A broken law, with its defect.
pub(super) fn broken(
    source: &mut Side,
    origin: Origin,
    what: String,
    sides: &Sides,
    verdict: &Verdict,
    way_out: String,
) -> Violation {
    let base_is_whole = source.proved.positions.manifold.is_whole();
    let graph = source.graph();
    let defect = graph.formula(sides.left - sides.right);
    let [left, right, defect] = [sides.left, sides.right, defect].map(|value| graph.simplify(value));
    let difference = match verdict {
        Verdict::NonZero(witness) if base_is_whole => not_zero(graph, defect, witness),
        Verdict::Unknown(why) => format!("{} could not be decided to be 0: {why}", shown(graph, defect)),
        _ => format!("{} should be 0", shown(graph, defect)),
    };
    let [before, between] = &sides.words;
    let (left, right) = (shown(graph, left), shown(graph, right));
    let evidence = format!("{before} {left}, {between} {right}; the difference {difference}");
    Violation { law: Law::Morphism, origin, what, evidence, way_out }
}

/// The image of an embedded base lies in that of the target.
fn into_the_base(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut pull_back = map.pull_back(target);
    let mut violations = Vec::new();
    for identity in &target.proved.model.identities {
        let value = pull_back.apply(source.graph(), identity.value);
        let value = assuming(source, value);
        if source.vanishes(value).is_zero() {
            continue;
        }
        let value = source.graph().simplify(value);
        violations.push(Violation {
            law: Law::Morphism,
            origin: map.origin,
            what: format!("the base of `{}` is left", target.name()),
            evidence: format!(
                "its identity {} = 0 becomes {} = 0, which does not hold on the base of `{}`",
                shown(&target.proved.model.graph, identity.value),
                shown(source.graph(), value),
                source.name()
            ),
            way_out: "map the coordinates to points of the embedded base".into(),
        });
    }
    for index in 0..target.proved.model.positions.len() {
        violations.extend(off_positions(source, target, map, index));
    }
    violations
}

/// A position constraint of the target that does not hold where the source is.
fn off_positions(source: &mut Side, target: &Side, map: &BundleMap, index: usize) -> Option<Violation> {
    let position = &target.proved.model.positions[index];
    let value = map.pull_back(target).apply(source.graph(), position.value);
    let value = assuming(source, value);
    let undecided = match source.vanishes(value) {
        Verdict::Zero => return None,
        Verdict::NonZero(_) => String::new(),
        Verdict::Unknown(why) => format!(" ({why})"),
    };
    let value = source.graph().simplify(value);
    let (from, to) = (source.name(), target.name());
    let name = name_of(&target.proved.model, ConstraintId::from_index(index));
    let where_from = if source.proved.model.positions.is_empty() {
        "on"
    } else {
        "where the position constraints hold on"
    };
    Some(Violation {
        law: Law::Morphism,
        origin: map.origin,
        what: format!("the positions of `{to}` are left: {name} does not hold"),
        evidence: format!(
            "it becomes {} = 0, which is not so {where_from} the base of `{from}`{undecided}",
            shown(source.graph(), value)
        ),
        way_out: format!("correct the map, or add the constraint to `{from}`"),
    })
}

/// Mathematics (13): `ρ^j_α ∂_jφ^i = ρ'^i_β Φ^β_α`, so that admissible curves go to admissible ones; along the sections
/// that are tangent to the positions.
fn admissible(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (i, coordinate) in target.proved.model.coordinates.iter().enumerate() {
        for (section, components) in source.tangent.clone() {
            let image = map.image(source, &components);
            let left = along(source, &components).apply(source.graph(), map.coordinates[i].value);
            let right = source.graph().inner_product(&map.anchor[i], &image);
            let graph = source.graph();
            let defect = graph.formula(left - right);
            let defect = assuming(source, defect);
            let verdict = source.vanishes(defect);
            if verdict.is_zero() {
                continue;
            }
            let name = &coordinate.name;
            violations.push(broken(
                source,
                map.coordinates[i].origin,
                format!("the map is not admissible: `{name}` and the velocities do not fit together"),
                &Sides {
                    left,
                    right,
                    words: [
                        format!("along `{section}`, `{name}` changes at the rate"),
                        format!("but the anchor of `{}` gives", target.name()),
                    ],
                },
                &verdict,
                format!("correct `{name}` or the velocities that move it: mathematics (13)"),
            ));
            if violations.len() == REPORTED {
                return violations;
            }
            break;
        }
    }
    violations
}

/// ρ(σ).
fn along(source: &mut Side, section: &[ExprId]) -> Derivation {
    let Proved { model, system, .. } = &mut source.proved;
    let anchor = &system.algebroid.anchor;
    let field = anchor.vector_field(&mut model.graph, section);
    Derivation::new(anchor.coordinates.iter().copied().zip(field))
}

/// Mathematics (14): Φ [e_α, e_δ] against the bracket of the images,
/// `Φ^β_γ C^γ_{αδ} = ρ^i_α ∂_iΦ^β_δ − ρ^i_δ ∂_iΦ^β_α + C'^β_{θσ} Φ^θ_α Φ^σ_δ`, which is linear over functions in both
/// sections: where position constraints hold, at places of these for sections tangent to them.
fn bracket(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut violations = Vec::new();
    let sections = source.tangent.clone();
    for (k, alpha) in sections.iter().enumerate() {
        for delta in &sections[k + 1..] {
            if violations.len() == REPORTED {
                return violations;
            }
            violations.extend(bracket_of_pair(source, target, map, [alpha, delta]));
        }
    }
    violations
}

fn bracket_of_pair(
    source: &mut Side,
    target: &Side,
    map: &BundleMap,
    [alpha, delta]: [&(String, Vec<ExprId>); 2],
) -> Option<Violation> {
    let Proved { model, system, .. } = &mut source.proved;
    let bracket = system.algebroid.structure.contract(&mut model.graph, &alpha.1, &delta.1);
    let image = map.image(source, &bracket);
    let (of_alpha, of_delta) = (map.image(source, &alpha.1), map.image(source, &delta.1));
    let algebraic = map.structure.contract(source.graph(), &of_alpha, &of_delta);
    let (mut along_alpha, mut along_delta) = (along(source, &alpha.1), along(source, &delta.1));
    for (beta, (left, algebraic)) in image.into_iter().zip(algebraic).enumerate() {
        let graph = source.graph();
        // the components of the sections stay as they are
        let row = &map.fibre[beta];
        let changes: Vec<ExprId> = row.iter().map(|entry| along_alpha.apply(graph, *entry)).collect();
        let forth = graph.inner_product(&changes, &delta.1);
        let changes: Vec<ExprId> = row.iter().map(|entry| along_delta.apply(graph, *entry)).collect();
        let back = graph.inner_product(&changes, &alpha.1);
        let right =
            graph.linear_combination(&[(1.into(), forth), ((-1).into(), back), (1.into(), algebraic)]);
        let defect = graph.formula(left - right);
        let defect = assuming(source, defect);
        let verdict = source.vanishes(defect);
        if verdict.is_zero() {
            continue;
        }
        let (a, d) = (&alpha.0, &delta.0);
        let b = &target.proved.model.sections[SectionId::from_index(beta)].name;
        return Some(broken(
            source,
            map.velocity[beta].origin,
            format!("the map is no morphism of brackets on the pair [{a}, {d}]"),
            &Sides {
                left,
                right,
                words: [
                    format!("along `{b}`, the image of [{a}, {d}] is"),
                    "but the bracket of the images is".to_owned(),
                ],
            },
            &verdict,
            format!("correct the velocities, or the brackets of `{}`: mathematics (14)", target.name()),
        ));
    }
    None
}

/// Φ is onto on the fibres, of the velocities that are tangent to the positions.
fn onto(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let wanted = target.tangent.len();
    let sections: Matrix = source.tangent.iter().map(|(_, section)| section.clone()).collect();
    let images: Matrix = sections.iter().map(|section| map.image(source, section)).collect();
    let rank = if wanted == 0 || images.is_empty() { Ok(0) } else { source.rank_over_base(&images) };
    let evidence = match rank {
        Ok(rank) if rank == wanted => return Vec::new(),
        Ok(rank) => format!("the rank of the map is {rank}, that of `{}` is {wanted}", target.name()),
        Err(why) => why,
    };
    let way_out = match inclusion::stranger(source, target, map) {
        Some(variable) => {
            let (own, larger) = (source.name(), target.name());
            format!(
                "`{own}` has fewer velocities, as a mode of `{larger}` has: then each variable of its state has to be one \
                 of `{larger}`'s, and `{variable}` is none"
            )
        }
        None => "give velocities that are linearly independent".into(),
    };
    vec![Violation {
        law: Law::Morphism,
        origin: map.origin,
        what: "the map is not onto on the fibres: some velocities are never reached".into(),
        evidence,
        way_out,
    }]
}

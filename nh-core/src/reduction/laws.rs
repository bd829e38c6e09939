//! The laws of a morphism of Lie algebroids, mathematics (13) and (14), CLMM 2.3.

use super::assuming;
use super::bundle_map::BundleMap;
use super::side::Side;
use crate::algebra::Verdict;
use crate::check::evidence::{not_zero, shown};
use crate::id::{ExprId, Id, Origin, SectionId};
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
    let base_is_whole = source.proved.base.is_whole();
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
    violations
}

/// Mathematics (13): `ρ^j_α ∂_jφ^i = ρ'^i_β Φ^β_α`, so that admissible curves go to admissible ones.
fn admissible(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (i, coordinate) in target.proved.model.coordinates.iter().enumerate() {
        for alpha in source.proved.system.algebroid.sections() {
            let anchor = &source.proved.system.algebroid.anchor;
            let graph = &mut source.proved.model.graph;
            let left = anchor.along(alpha).apply(graph, map.coordinates[i].value);
            let right = graph.inner_product(&map.anchor[i], &map.column(alpha));
            let defect = graph.formula(left - right);
            let defect = assuming(source, defect);
            let verdict = source.vanishes(defect);
            if verdict.is_zero() {
                continue;
            }
            let section = source.proved.model.sections[alpha].name.clone();
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

/// Mathematics (14): Φ [e_α, e_δ] against the bracket of the images,
/// `Φ^β_γ C^γ_{αδ} = ρ^i_α ∂_iΦ^β_δ − ρ^i_δ ∂_iΦ^β_α + C'^β_{θσ} Φ^θ_α Φ^σ_δ`.
fn bracket(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut violations = Vec::new();
    let sections: Vec<SectionId> = source.proved.system.algebroid.sections().collect();
    for (k, alpha) in sections.iter().enumerate() {
        for delta in &sections[k + 1..] {
            if violations.len() == REPORTED {
                return violations;
            }
            violations.extend(bracket_of_pair(source, target, map, *alpha, *delta));
        }
    }
    violations
}

fn bracket_of_pair(
    source: &mut Side,
    target: &Side,
    map: &BundleMap,
    alpha: SectionId,
    delta: SectionId,
) -> Option<Violation> {
    let algebroid = source.proved.system.algebroid.clone();
    let graph = source.graph();
    let bracket: Vec<ExprId> =
        algebroid.sections().map(|gamma| algebroid.structure.get(graph, gamma, alpha, delta)).collect();
    let image = map.image(source, &bracket);
    let (of_alpha, of_delta) = (map.column(alpha), map.column(delta));
    let graph = source.graph();
    let algebraic = map.structure.contract(graph, &of_alpha, &of_delta);
    let (mut along_alpha, mut along_delta) = (algebroid.anchor.along(alpha), algebroid.anchor.along(delta));
    for (beta, (left, algebraic)) in image.into_iter().zip(algebraic).enumerate() {
        let graph = source.graph();
        let forth = along_alpha.apply(graph, of_delta[beta]);
        let back = along_delta.apply(graph, of_alpha[beta]);
        let right =
            graph.linear_combination(&[(1.into(), forth), ((-1).into(), back), (1.into(), algebraic)]);
        let defect = graph.formula(left - right);
        let defect = assuming(source, defect);
        let verdict = source.vanishes(defect);
        if verdict.is_zero() {
            continue;
        }
        let [a, d] = [alpha, delta].map(|section| source.proved.model.sections[section].name.clone());
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

/// Φ is onto on the fibres.
fn onto(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let wanted = map.fibre.len();
    let rank = if wanted == 0 { Ok(0) } else { source.rank_over_base(&map.fibre) };
    let evidence = match rank {
        Ok(rank) if rank == wanted => return Vec::new(),
        Ok(rank) => format!("the rank of the map is {rank}, that of `{}` is {wanted}", target.name()),
        Err(why) => why,
    };
    vec![Violation {
        law: Law::Morphism,
        origin: map.origin,
        what: "the map is not onto on the fibres: some velocities are never reached".into(),
        evidence,
        way_out: "give velocities that are linearly independent".into(),
    }]
}

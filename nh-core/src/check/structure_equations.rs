//! The structure equations of a Lie algebroid, mathematics (2) and (3).

use super::evidence::{listed, not_zero_on, shown};
use super::homomorphism::{broken_pairs, homomorphism};
use crate::algebra::{Graph, Rational, Verdict};
use crate::geometry::{Algebroid, Manifold};
use crate::id::{ExprId, Id, Origin, SectionId};
use crate::limits;
use crate::model::{Kinematics, Model};
use crate::violation::{Law, Violation};
use std::collections::{BTreeMap, BTreeSet};

/// At most so many broken instances of one law are reported as errors.
pub(super) const REPORTED: usize = 3;

/// So many times as many are compared with each other.
pub(super) const COMPARED: usize = 8;

/// How an almost Lie algebroid breaks the structure equations, if it does.
#[derive(Clone, Debug, Default)]
pub struct BrokenLaws {
    /// What breaks (2): with evidence.
    pub homomorphism: Option<String>,
    /// What breaks (3) on the sections of the basis.
    pub jacobi: Option<String>,
}

impl BrokenLaws {
    /// Whether it is a Lie algebroid all the same.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.homomorphism.is_none() && self.jacobi.is_none()
    }
}

/// Proves that the anchor is a homomorphism of brackets, and the Jacobi identity. Where the first fails the
/// second is not reported as well. Where `almost` is declared with brackets, what is broken is told and nothing
/// is demanded; brackets that are not declared exist only where (2) holds.
///
/// # Errors
/// The instances of a law that are broken.
pub fn structure_equations(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
) -> Result<BrokenLaws, Vec<Violation>> {
    // coordinate fields commute, and their anchor is the identity
    if matches!(model.kinematics, Kinematics::Tangent) {
        return Ok(BrokenLaws::default());
    }
    if model.almost && model.brackets_declared {
        let told = |violations: Vec<Violation>| {
            violations
                .into_iter()
                .next()
                .map(|Violation { what, evidence, .. }| format!("{what}, {evidence}"))
        };
        return Ok(BrokenLaws {
            homomorphism: told(broken_pairs(model, algebroid, base, 1)),
            jacobi: told(
                broken_triples(model, algebroid, base, 1)
                    .1
                    .into_iter()
                    .map(|(_, violation)| violation)
                    .collect(),
            ),
        });
    }
    let mut violations = homomorphism(model, algebroid, base);
    if violations.is_empty() {
        violations = jacobi(model, algebroid, base);
    }
    if violations.is_empty() { Ok(BrokenLaws::default()) } else { Err(violations) }
}

/// Where the bracket of a pair stands, or else the later of its sections.
pub(super) fn origin_of_pair(model: &Model, alpha: SectionId, beta: SectionId) -> Origin {
    let matches = |left, right| (left, right) == (alpha, beta) || (left, right) == (beta, alpha);
    model
        .brackets
        .iter()
        .find(|declaration| matches(declaration.left, declaration.right))
        .map_or(model.sections[beta].origin, |declaration| declaration.origin)
}

pub(super) fn defect_text(graph: &Graph, defect: ExprId, verdict: &Verdict, base: &Manifold) -> String {
    match verdict {
        Verdict::Zero => "is 0".into(),
        Verdict::NonZero(witness) => not_zero_on(graph, defect, witness, base),
        Verdict::Unknown(why) => format!("{} could not be decided to be 0: {why}", shown(graph, defect)),
    }
}

/// Mathematics (3): `Σ_cyclic [ ρ^i_α ∂_iC^ν_{βγ} + C^μ_{βγ} C^ν_{αμ} ] = 0`.
fn jacobi(model: &mut Model, algebroid: &Algebroid, base: &Manifold) -> Vec<Violation> {
    let (brackets, broken) = broken_triples(model, algebroid, base, REPORTED * COMPARED);
    if let Some(violation) = by_one_bracket(model, &brackets, &broken) {
        return vec![violation];
    }
    broken.into_iter().take(REPORTED).map(|(_, violation)| violation).collect()
}

/// The brackets, and at most so many triples that break (3).
fn broken_triples(
    model: &mut Model,
    algebroid: &Algebroid,
    base: &Manifold,
    most: usize,
) -> (Brackets, Vec<Broken>) {
    let sections: Vec<SectionId> = algebroid.sections().collect();
    let brackets = written_brackets(&mut model.graph, algebroid, &sections);
    let mut broken = Vec::new();
    for triple in triples_with_summands(&model.graph, &brackets) {
        if broken.len() == most {
            break;
        }
        let triple = triple.map(|index| sections[index]);
        let violation = jacobi_of_triple(model, algebroid, &brackets, base, triple);
        broken.extend(violation.map(|violation| (triple, violation)));
    }
    (brackets, broken)
}

/// A triple of sections, and how it breaks (3).
type Broken = ([SectionId; 3], Violation);

/// What breaks the identity, where one bracket enters into all sums that are not 0: what is wrong in a bracket is seen in
/// every sum that it enters into, as a rule, and in no other.
fn by_one_bracket(model: &Model, brackets: &Brackets, broken: &[Broken]) -> Option<Violation> {
    let [(first, violation), others @ ..] = broken else { return None };
    let mut suspects = entering(brackets, *first);
    for (triple, _) in others {
        let here = entering(brackets, *triple);
        suspects.retain(|pair| here.contains(pair));
    }
    if others.is_empty() || suspects.is_empty() {
        return None;
    }
    let name = |pair: &[SectionId; 2]| {
        let [a, b] = pair.map(|section| model.sections[section].name.as_str());
        format!("[{a}, {b}]")
    };
    let sums = if others.len() == 1 { "another sum" } else { "other sums" };
    // of several a bracket that is not 0 is the likelier one
    let is_written = |pair: &&[SectionId; 2]| !brackets[pair[0].index()][pair[1].index()].is_empty();
    let mut likely = suspects.iter().filter(|pair| suspects.len() == 1 || is_written(pair));
    if let (Some(pair), None) = (likely.next(), likely.next()) {
        let bracket = name(pair);
        return Some(Violation {
            origin: origin_of_pair(model, pair[0], pair[1]),
            evidence: format!(
                "{}; {bracket} enters into it, and into {sums} that should be 0",
                violation.evidence
            ),
            way_out: format!(
                "correct the bracket {bracket}; or write `almost;` if an almost Lie algebroid is meant"
            ),
            ..violation.clone()
        });
    }
    let all: Vec<String> = suspects.iter().map(name).collect();
    Some(Violation {
        evidence: format!(
            "{}; {} enter into it, and into {sums} that should be 0",
            violation.evidence,
            listed(&all)
        ),
        way_out: "correct one of these brackets; or write `almost;` if an almost Lie algebroid is meant"
            .into(),
        ..violation.clone()
    })
}

/// The pairs of whose brackets the sum of a triple is made.
fn entering(brackets: &Brackets, triple: [SectionId; 3]) -> BTreeSet<[SectionId; 2]> {
    let mut found = BTreeSet::new();
    for shift in 0..3 {
        let [alpha, beta, gamma] = [0, 1, 2].map(|position| triple[(position + shift) % 3]);
        let within = brackets[beta.index()][gamma.index()].iter().map(|(mu, _)| [alpha, *mu]);
        for [left, right] in within.chain([[beta, gamma]]).filter(|[left, right]| left != right) {
            found.insert([left.min(right), left.max(right)]);
        }
    }
    found
}

/// The triples α < β < γ of whose double brackets one may not be 0, in their order: where there are many sections, most
/// commute, and these obey the identity.
fn triples_with_summands(graph: &Graph, brackets: &Brackets) -> Vec<[usize; 3]> {
    let n = brackets.len();
    let mut triples = Vec::new();
    for beta in 0..n {
        for gamma in beta + 1..n {
            let inner = &brackets[beta][gamma];
            if inner.is_empty() {
                continue;
            }
            // [e_α, C e_μ] = ρ(e_α)(C) e_μ + C [e_α, e_μ]
            let is_constant = inner.iter().all(|(_, component)| graph.as_number(*component).is_some());
            limits::spend(n / 8 + inner.len());
            for alpha in (0..n).filter(|alpha| *alpha != beta && *alpha != gamma) {
                if !is_constant || inner.iter().any(|(mu, _)| !brackets[alpha][mu.index()].is_empty()) {
                    limits::spend(1);
                    let mut triple = [alpha, beta, gamma];
                    triple.sort_unstable();
                    triples.push(triple);
                }
            }
        }
    }
    triples.sort_unstable();
    triples.dedup();
    triples
}

/// The components of the brackets of all pairs, without those written as 0.
type Brackets = Vec<Vec<Vec<(SectionId, ExprId)>>>;

fn written_brackets(graph: &mut Graph, algebroid: &Algebroid, sections: &[SectionId]) -> Brackets {
    let mut brackets: Brackets = vec![vec![Vec::new(); sections.len()]; sections.len()];
    let nonzero = algebroid.structure.nonzero(graph);
    let nonzero: Vec<_> =
        nonzero.map(|(alpha, beta, components)| (alpha, beta, components.to_vec())).collect();
    for (alpha, beta, components) in nonzero {
        for (gamma, component) in algebroid.sections().zip(components) {
            if !graph.is_literal_zero(component) {
                brackets[alpha.index()][beta.index()].push((gamma, component));
                brackets[beta.index()][alpha.index()].push((gamma, graph.formula(-component)));
            }
        }
    }
    brackets
}

fn jacobi_of_triple(
    model: &mut Model,
    algebroid: &Algebroid,
    brackets: &Brackets,
    base: &Manifold,
    triple: [SectionId; 3],
) -> Option<Violation> {
    let defect = jacobiator(&mut model.graph, algebroid, brackets, triple);
    let graph = &mut model.graph;
    for (index, component) in defect {
        let verdict = base.zero_test(graph, component);
        if verdict.is_zero() {
            continue;
        }
        let component = graph.simplify(component);
        let names = triple.map(|section| model.sections[section].name.as_str());
        let [a, b, c] = names;
        let along = &model.sections[index].name;
        let graph = &model.graph;
        let evidence = format!(
            "[{a}, [{b}, {c}]] + [{b}, [{c}, {a}]] + [{c}, [{a}, {b}]] along `{along}`: {}",
            defect_text(graph, component, &verdict, base)
        );
        let origin = declared_among(model, triple);
        return Some(Violation {
            law: Law::Jacobi,
            origin,
            what: format!("the brackets of {} break the Jacobi identity", listed(&names)),
            evidence,
            way_out: "correct a bracket; or write `almost;` if an almost Lie algebroid is meant".into(),
        });
    }
    None
}

/// The last declared bracket among three sections, or else the last of them.
fn declared_among(model: &Model, triple: [SectionId; 3]) -> Origin {
    model
        .brackets
        .iter()
        .rev()
        .find(|declaration| triple.contains(&declaration.left) && triple.contains(&declaration.right))
        .map_or(model.sections[triple[2]].origin, |declaration| declaration.origin)
}

/// The components of the sum, without those written as 0.
fn jacobiator(
    graph: &mut Graph,
    algebroid: &Algebroid,
    brackets: &Brackets,
    triple: [SectionId; 3],
) -> BTreeMap<SectionId, ExprId> {
    let mut summands: BTreeMap<SectionId, Vec<(Rational, ExprId)>> = BTreeMap::new();
    for shift in 0..3 {
        let [alpha, beta, gamma] = [0, 1, 2].map(|position| triple[(position + shift) % 3]);
        let inner = &brackets[beta.index()][gamma.index()];
        if inner.is_empty() {
            continue;
        }
        limits::spend(inner.len());
        let mut along = algebroid.anchor.along(alpha);
        for (mu, component) in inner {
            if graph.as_number(*component).is_none() {
                summands.entry(*mu).or_default().push((Rational::ONE, along.apply(graph, *component)));
            }
            for (nu, outer) in &brackets[alpha.index()][mu.index()] {
                let term = graph.formula(component * outer);
                summands.entry(*nu).or_default().push((Rational::ONE, term));
            }
        }
    }
    summands.into_iter().map(|(nu, terms)| (nu, graph.linear_combination(&terms))).collect()
}

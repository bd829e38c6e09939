//! Solutions of the Hamilton–Jacobi equation on D* (M 2.4), mathematics (20).

use super::evidence::{not_zero, shown};
use crate::algebra::{Derivation, Graph, Matrix, Substitution, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{HamiltonianSide, Procedure};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// Judges the declared section α of D*: d^Dα = 0 and d^D(h∘α) = 0 on the base, and what moves the system
/// beside the bracket, R_L, keeps it. Its integral curves are then motions. The outputs are the velocities of the state at which the momenta are α.
///
/// `fields` are ρ(B_a), and `velocities` the names of the a.
///
/// # Errors
/// The components that do not vanish.
pub fn hamilton_jacobi(
    model: &mut Model,
    side: &HamiltonianSide,
    fields: &Matrix,
    velocities: &[SymbolId],
    base: &Manifold,
) -> Result<Option<Procedure>, Vec<Violation>> {
    let Some(declared) = model.hamilton_jacobi.clone() else { return Ok(None) };
    let (graph, rank) = (&mut model.graph, velocities.len());
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    // 1. α_a, 0 where nothing is said
    let mut section = vec![graph.zero(); rank];
    for (velocity, value) in &declared.components {
        if let Some(a) = velocities.iter().position(|known| known == velocity) {
            section[a] = value.value;
            continue;
        }
        let name = &graph.symbols()[*velocity];
        return Err(vec![Violation {
            law: Law::HamiltonJacobi,
            origin: value.origin,
            what: format!("there is no momentum along `{name}` on D*"),
            evidence: "the constraints give this velocity from those in the state".into(),
            way_out: "name velocities that the state keeps".into(),
        }]);
    }
    // 2. what depends on the momenta, at α
    let mut at_section = Substitution::new(side.momenta.iter().copied().zip(section.iter().copied()));
    let bracket = side.bracket.written_out(graph);
    let energy = side.hamiltonian.written_out(graph)[0];
    let energy = at_section.apply(graph, energy);
    let size = coordinates.len() + rank;
    let mut along: Vec<Derivation> = fields
        .iter()
        .map(|field| Derivation::new(coordinates.iter().copied().zip(field.iter().copied())))
        .collect();
    let name = |graph: &Graph, a: usize| graph.symbols()[velocities[a]].clone();
    let mut violations = Vec::new();
    // 3. (d^Dα)_{ab} = ρ_aα_b − ρ_bα_a − D^c_{ab}α_c
    for a in 0..rank {
        for b in a + 1..rank {
            let product = bracket[(coordinates.len() + a) * size + coordinates.len() + b];
            let product = at_section.apply(graph, product);
            let (forth, back) = (along[a].apply(graph, section[b]), along[b].apply(graph, section[a]));
            let defect =
                graph.linear_combination(&[(1.into(), forth), ((-1).into(), back), (1.into(), product)]);
            let what = format!("d^D alpha along ({}, {})", name(graph, a), name(graph, b));
            violations.extend(judged(
                graph,
                base,
                defect,
                &what,
                declared.origin,
                "the section is not closed",
            ));
        }
    }
    // 4. ρ_a(h∘α)
    for (a, along) in along.iter_mut().enumerate() {
        let defect = along.apply(graph, energy);
        let what = format!("d^D(h(alpha)) along {}", name(graph, a));
        let lead = "the section does not solve the Hamilton-Jacobi equation";
        violations.extend(judged(graph, base, defect, &what, declared.origin, lead));
    }
    // 5. R_L(π_a − α_a), of forces and of what is not homogeneous or moves
    let drift = side.drift.written_out(graph);
    let mut along_drift =
        Derivation::new(coordinates.iter().copied().zip(drift.iter().copied()).collect::<Vec<_>>());
    for (a, momentum) in section.iter().enumerate() {
        let change = along_drift.apply(graph, *momentum);
        let defect = graph.sub(drift[coordinates.len() + a], change);
        let defect = at_section.apply(graph, defect);
        let what = format!("R_L(p - alpha) along {}", name(graph, a));
        let lead = "the motion leaves the section, by forces or by constraints that are not homogeneous";
        violations.extend(judged(graph, base, defect, &what, declared.origin, lead));
    }
    if !violations.is_empty() {
        violations.truncate(1);
        return Err(violations);
    }
    // 6. v = C⁻¹(α − π|₀)
    let lifted = side.inverse.written_out(graph);
    let lifted = lifted
        .into_iter()
        .map(|velocity| {
            let velocity = at_section.apply(graph, velocity);
            graph.simplify(velocity)
        })
        .collect();
    Ok(Some(Procedure::of(lifted)))
}

fn judged(
    graph: &mut Graph,
    base: &Manifold,
    defect: ExprId,
    what: &str,
    origin: crate::id::Origin,
    lead: &str,
) -> Option<Violation> {
    let verdict = base.zero_test(graph, defect);
    let defect = graph.simplify(defect);
    let (lead, evidence) = match &verdict {
        Verdict::Zero => return None,
        Verdict::NonZero(witness) if base.is_whole() => (lead.to_owned(), not_zero(graph, defect, witness)),
        Verdict::NonZero(_) => (lead.to_owned(), format!("{} should be 0", shown(graph, defect))),
        Verdict::Unknown(why) => (
            "whether the section solves the Hamilton-Jacobi equation could not be decided".into(),
            why.clone(),
        ),
    };
    Some(Violation {
        law: Law::HamiltonJacobi,
        origin,
        what: lead,
        evidence: format!("{what}: {evidence}"),
        way_out: "correct the section, or leave it out".into(),
    })
}

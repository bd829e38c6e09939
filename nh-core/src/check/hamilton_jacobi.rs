//! Solutions of the Hamilton–Jacobi equation on D* (M 2.4), mathematics (20).

use super::evidence::{not_zero, shown};
use crate::algebra::{Derivation, Graph, Matrix, Substitution, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{HamiltonianSide, Procedure};
use crate::model::{Model, SectionClaim};
use crate::violation::{Law, Violation};

/// Judges the declared section α of D*: d^Dα = 0 and d^D(h∘α) = 0 on the base, and what moves the system
/// beside the bracket, R_L, keeps it. Its integral curves are then motions. The outputs are the
/// velocities of the state at which the momenta are α.
///
/// `fields` are ρ(B_a), and `velocities` the names of the a.
///
/// # Errors
/// The first component that does not vanish.
pub fn hamilton_jacobi(
    model: &mut Model,
    side: &HamiltonianSide,
    fields: &Matrix,
    velocities: &[SymbolId],
    base: &Manifold,
) -> Result<Option<Procedure>, Vec<Violation>> {
    let Some(declared) = model.hamilton_jacobi.clone() else { return Ok(None) };
    let graph = &mut model.graph;
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    // 1. α, and what depends on the momenta, there
    let section = components(graph, &declared, velocities).map_err(|violation| vec![violation])?;
    let put = Substitution::new(side.momenta.iter().copied().zip(section.iter().copied()));
    let mut on = Section { coordinates, velocities, components: section, put };
    // 2. what has to vanish
    let mut equations = on.curl(graph, side, fields);
    equations.extend(on.change_of_energy(graph, side, fields));
    equations.extend(on.change_by_drift(graph, side));
    for equation in equations {
        if let Some(violation) = judged(graph, base, &equation, declared.origin) {
            return Err(vec![violation]);
        }
    }
    // 3. v = C⁻¹(α − π|₀)
    let lifted = side.inverse.written_out(graph);
    let lifted = on.put.apply_all(graph, &lifted);
    Ok(Some(Procedure::of(lifted.into_iter().map(|velocity| graph.simplify(velocity)).collect())))
}

/// α_a, 0 where nothing is said.
fn components(
    graph: &mut Graph,
    declared: &SectionClaim,
    velocities: &[SymbolId],
) -> Result<Vec<ExprId>, Violation> {
    let mut section = vec![graph.zero(); velocities.len()];
    for (velocity, value) in &declared.components {
        if let Some(a) = velocities.iter().position(|known| known == velocity) {
            section[a] = value.value;
            continue;
        }
        let name = &graph.symbols()[*velocity];
        return Err(Violation {
            law: Law::HamiltonJacobi,
            origin: value.origin,
            what: format!("there is no momentum along `{name}` on D*"),
            evidence: "the constraints give this velocity from those in the state".into(),
            way_out: "name velocities that the state keeps".into(),
        });
    }
    Ok(section)
}

/// What has to vanish.
struct Equation {
    /// Its name.
    what: String,
    /// What it means if it does not.
    lead: &'static str,
    defect: ExprId,
}

/// A section α of D*.
struct Section<'a> {
    /// The x^i.
    coordinates: Vec<SymbolId>,
    /// The names of the a.
    velocities: &'a [SymbolId],
    /// α_a.
    components: Vec<ExprId>,
    /// Puts α_a for π_a.
    put: Substitution,
}

impl Section<'_> {
    fn name<'g>(&self, graph: &'g Graph, a: usize) -> &'g str {
        &graph.symbols()[self.velocities[a]]
    }

    /// The derivative along a vector field on the base.
    fn along(&self, field: &[ExprId]) -> Derivation {
        Derivation::new(self.coordinates.iter().copied().zip(field.iter().copied()))
    }

    /// (d^Dα)_{ab} = ρ_aα_b − ρ_bα_a − D^c_{ab}α_c.
    fn curl(&mut self, graph: &mut Graph, side: &HamiltonianSide, fields: &Matrix) -> Vec<Equation> {
        let bracket = side.bracket.written_out(graph);
        let (n, rank) = (self.coordinates.len(), self.components.len());
        let mut along: Vec<Derivation> = fields.iter().map(|field| self.along(field)).collect();
        let mut equations = Vec::new();
        for (a, b) in (0..rank).flat_map(|a| (a + 1..rank).map(move |b| (a, b))) {
            let product = self.put.apply(graph, bracket[(n + a) * (n + rank) + n + b]);
            let forth = along[a].apply(graph, self.components[b]);
            let back = along[b].apply(graph, self.components[a]);
            let defect =
                graph.linear_combination(&[(1.into(), forth), ((-1).into(), back), (1.into(), product)]);
            let what = format!("d^D alpha along ({}, {})", self.name(graph, a), self.name(graph, b));
            equations.push(Equation { what, lead: "the section is not closed", defect });
        }
        equations
    }

    /// ρ_a(h∘α).
    fn change_of_energy(
        &mut self,
        graph: &mut Graph,
        side: &HamiltonianSide,
        fields: &Matrix,
    ) -> Vec<Equation> {
        let energy = side.hamiltonian.written_out(graph)[0];
        let energy = self.put.apply(graph, energy);
        let mut equations = Vec::new();
        for (a, field) in fields.iter().enumerate() {
            let defect = self.along(field).apply(graph, energy);
            let what = format!("d^D(h(alpha)) along {}", self.name(graph, a));
            let lead = "the section does not solve the Hamilton-Jacobi equation";
            equations.push(Equation { what, lead, defect });
        }
        equations
    }

    /// R_L(π_a − α_a), of forces and of what is not homogeneous or moves.
    fn change_by_drift(&mut self, graph: &mut Graph, side: &HamiltonianSide) -> Vec<Equation> {
        let drift = side.drift.written_out(graph);
        let (rates, forces) = drift.split_at(self.coordinates.len());
        let mut along = self.along(rates);
        let mut equations = Vec::new();
        for (a, force) in forces.iter().enumerate() {
            let change = along.apply(graph, self.components[a]);
            let defect = graph.formula(force - change);
            let defect = self.put.apply(graph, defect);
            let what = format!("R_L(p - alpha) along {}", self.name(graph, a));
            let lead = "the motion leaves the section, by forces or by constraints that are not homogeneous";
            equations.push(Equation { what, lead, defect });
        }
        equations
    }
}

fn judged(graph: &mut Graph, base: &Manifold, equation: &Equation, origin: Origin) -> Option<Violation> {
    let Equation { what, lead, defect } = equation;
    let verdict = base.zero_test(graph, *defect);
    let defect = graph.simplify(*defect);
    let (lead, evidence) = match &verdict {
        Verdict::Zero => return None,
        Verdict::NonZero(witness) if base.is_whole() => (*lead, not_zero(graph, defect, witness)),
        Verdict::NonZero(_) => (*lead, format!("{} should be 0", shown(graph, defect))),
        Verdict::Unknown(why) => {
            ("whether the section solves the Hamilton-Jacobi equation could not be decided", why.clone())
        }
    };
    Some(Violation {
        law: Law::HamiltonJacobi,
        origin,
        what: lead.into(),
        evidence: format!("{what}: {evidence}"),
        way_out: "correct the section, or leave it out".into(),
    })
}

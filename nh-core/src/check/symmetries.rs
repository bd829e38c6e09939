//! Declared sections: in D, or symmetries of L and D.

use super::constraints::Constraints;
use super::evidence::{not_zero, shown};
use super::kinematics::Motion;
use super::sections::{check_gauge, combination, components};
use crate::algebra::{Graph, Verdict, Witness};
use crate::geometry::{ConstraintDistribution, Manifold};
use crate::id::{CoordId, ExprId, Origin};
use crate::mechanics::{LagrangianSystem, Momentum, complete_lift, translations};
use crate::model::{Model, SymmetryDecl};
use crate::violation::{Law, Violation};

/// A section σ with its momentum, and what is proved of it.
#[derive(Clone, Debug)]
pub struct Symmetry {
    /// The label, or the cyclic coordinate.
    pub name: String,
    /// σ^α.
    pub section: Vec<ExprId>,
    /// σ^α p_α − f and what changes it.
    pub momentum: Momentum,
    /// What a constraint is along σ, if σ does not lie in D (in the kernel of ∂φ/∂y).
    pub outside: Option<ExprId>,
    /// Whether σ^C(L) = ḟ.
    pub keeps_lagrangian: Invariance,
    /// Whether σ^C is tangent to the constraint manifold.
    pub keeps_constraints: bool,
    /// Whether σ lies in D and its momentum is constant: CLMM Theorem 3.5.
    pub is_conserved: bool,
}

/// Where an identity holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invariance {
    /// On all of E, over the embedded base.
    Everywhere,
    /// On the constraint manifold.
    OnConstraints,
    /// Not even there.
    Broken,
}

impl Symmetry {
    /// Whether σ lies in D, so that the momentum equation (12) holds.
    #[must_use]
    pub fn in_distribution(&self) -> bool {
        self.outside.is_none()
    }

    /// Whether σ is in D and leaves L and D invariant: a horizontal symmetry, CM section 5.
    #[must_use]
    pub fn is_horizontal(&self) -> bool {
        self.in_distribution() && self.keeps_constraints && self.keeps_lagrangian != Invariance::Broken
    }
}

/// What a section is judged by.
#[derive(Debug)]
pub struct Setting<'a> {
    /// The Lagrangian system.
    pub system: &'a LagrangianSystem,
    /// The constraints.
    pub constraints: &'a Constraints,
    /// D, where sections span it.
    pub spanned: Option<&'a ConstraintDistribution>,
    /// The constraint manifold.
    manifold: Manifold,
}

impl<'a> Setting<'a> {
    /// The setting of a system.
    pub fn new(
        graph: &mut Graph,
        system: &'a LagrangianSystem,
        constraints: &'a Constraints,
        spanned: Option<&'a ConstraintDistribution>,
    ) -> Self {
        let manifold = constraints.manifold(graph, &system.algebroid.velocities);
        Self { system, constraints, spanned, manifold }
    }

    /// φ^A as functions on E.
    fn functions(&self, graph: &mut Graph) -> Vec<ExprId> {
        let Some(linear) = &self.constraints.linear else { return self.constraints.residuals.clone() };
        let velocity = self.system.algebroid.velocity(graph);
        let rows = graph.image(&linear.annihilator, &velocity);
        rows.into_iter().zip(&linear.drift).map(|(row, drift)| graph.formula(row + drift)).collect()
    }

    /// σ^α ∂φ^A/∂y^α.
    fn along_constraints(&self, graph: &mut Graph, section: &[ExprId]) -> Vec<ExprId> {
        if let Some(linear) = &self.constraints.linear {
            return graph.image(&linear.annihilator, section);
        }
        let velocities = &self.system.algebroid.velocities;
        let residuals = self.constraints.residuals.clone();
        let mut components = Vec::with_capacity(residuals.len());
        for residual in residuals {
            let row: Vec<ExprId> = velocities.iter().map(|symbol| graph.partial(residual, *symbol)).collect();
            components.push(graph.inner_product(&row, section));
        }
        components
    }
}

/// Something that should vanish and does not: the function, and where.
type Defect = (ExprId, Option<Witness>);

/// Judges a section.
fn judged(
    graph: &mut Graph,
    setting: &Setting<'_>,
    name: String,
    section: Vec<ExprId>,
    gauge: Option<ExprId>,
) -> Result<(Symmetry, Defects), String> {
    let Setting { system, manifold, constraints, .. } = setting;
    let momentum = Momentum::of(graph, system, &section, gauge, setting.spanned);
    let along = setting.along_constraints(graph, &section);
    let outside = first_defect(graph, manifold, &along)?;
    let mut lift = complete_lift(graph, &system.algebroid, &section, &system.clock);
    let functions = setting.functions(graph);
    let changes = lift.apply_all(graph, &functions);
    let moved = first_defect(graph, manifold, &changes)?;
    let variation = first_defect(graph, manifold, &[momentum.variation])?;
    let everywhere = variation.is_none() && constraints.base().zero_test(graph, momentum.variation).is_zero();
    let rate = momentum.rate(graph);
    let is_conserved = outside.is_none() && manifold.zero_test(graph, rate).is_zero();
    let keeps_lagrangian = match (&variation, everywhere) {
        (Some(_), _) => Invariance::Broken,
        (None, true) => Invariance::Everywhere,
        (None, false) => Invariance::OnConstraints,
    };
    let symmetry = Symmetry {
        name,
        section,
        momentum,
        outside: outside.as_ref().map(|(component, _)| *component),
        keeps_lagrangian,
        keeps_constraints: moved.is_none(),
        is_conserved,
    };
    Ok((symmetry, Defects { outside, moved, variation }))
}

/// What keeps a section from D, and from being a symmetry.
struct Defects {
    outside: Option<Defect>,
    moved: Option<Defect>,
    variation: Option<Defect>,
}

fn first_defect(
    graph: &mut Graph,
    manifold: &Manifold,
    functions: &[ExprId],
) -> Result<Option<Defect>, String> {
    for function in functions {
        match manifold.judged(graph, *function) {
            (_, Verdict::Zero) => {}
            (part, Verdict::NonZero(witness)) => {
                let witness = part.is_whole().then_some(witness);
                return Ok(Some((graph.simplify(*function), witness)));
            }
            (_, Verdict::Unknown(why)) => return Err(why),
        }
    }
    Ok(None)
}

/// The declared sections, each in D or a symmetry.
///
/// # Errors
/// What is no section; sections that are neither in D nor symmetries; a function f that is not the
/// one that L changes by.
pub fn symmetries(
    model: &mut Model,
    motion: &Motion,
    setting: &Setting<'_>,
) -> Result<Vec<Symmetry>, Vec<Violation>> {
    let mut found = Vec::new();
    let mut violations = Vec::new();
    for declared in model.symmetries.clone() {
        match declared_symmetry(model, motion, setting, &declared) {
            Ok(symmetry) => found.push(symmetry),
            Err(violation) => violations.push(violation),
        }
    }
    if violations.is_empty() { Ok(found) } else { Err(violations) }
}

fn declared_symmetry(
    model: &mut Model,
    motion: &Motion,
    setting: &Setting<'_>,
    declared: &SymmetryDecl,
) -> Result<Symmetry, Violation> {
    let section = components(model, motion, setting, declared)?;
    check_gauge(model, declared)?;
    let graph = &mut model.graph;
    let (symmetry, defects) = judged(graph, setting, declared.name.clone(), section, declared.gauge)
        .map_err(|why| Violation {
            law: Law::Decidable,
            origin: declared.origin,
            what: format!("whether `{}` is a symmetry could not be decided", declared.name),
            evidence: why,
            way_out: "write it without roots of negative numbers and divisions by zero".into(),
        })?;
    if let (Some(_), Some(defect)) = (declared.gauge, &defects.variation) {
        return Err(false_gauge(&model.graph, declared, defect));
    }
    let is_symmetry = symmetry.keeps_lagrangian == Invariance::Everywhere && symmetry.keeps_constraints;
    if symmetry.in_distribution() || is_symmetry {
        return Ok(symmetry);
    }
    Err(neither(model, setting, declared, &symmetry, &defects))
}

/// The translations along cyclic coordinates, as far as the anchor determines them; those in D, unless
/// levels of momenta are declared.
pub fn of_cyclic_coordinates(
    model: &mut Model,
    setting: &Setting<'_>,
    cyclic: &[CoordId],
) -> Vec<(CoordId, Symmetry)> {
    let mut found = Vec::new();
    let sections = translations(&mut model.graph, &setting.system.algebroid.anchor, cyclic);
    for (coordinate, section) in cyclic.iter().zip(sections) {
        let Some(section) = section else { continue };
        let name = model.coordinates[*coordinate].name.clone();
        let graph = &mut model.graph;
        // outside D there is no momentum equation: only a level of that momentum would be told so
        let along = setting.along_constraints(graph, &section);
        let in_distribution = along.iter().all(|a| setting.manifold.zero_test(graph, *a).is_zero());
        if !in_distribution && model.routh.is_empty() {
            continue;
        }
        if let Ok((symmetry, _)) = judged(graph, setting, name, section, None) {
            found.push((*coordinate, symmetry));
        }
    }
    found
}

fn false_gauge(graph: &Graph, declared: &SymmetryDecl, defect: &Defect) -> Violation {
    let gauge = declared.gauge.map(|gauge| shown(graph, gauge)).unwrap_or_default();
    Violation {
        law: Law::Symmetry,
        origin: declared.origin,
        what: format!("`{}` does not change the Lagrangian by the derivative of {gauge}", declared.name),
        evidence: format!("what is left over {}", described(graph, defect)),
        way_out: "correct the function behind `up to`, or leave it out".into(),
    }
}

fn described(graph: &Graph, (function, witness): &Defect) -> String {
    match witness {
        Some(witness) => not_zero(graph, *function, witness),
        None => format!("does not vanish where the constraints hold: {}", shown(graph, *function)),
    }
}

/// A section that has no momentum equation and is no symmetry either.
fn neither(
    model: &mut Model,
    setting: &Setting<'_>,
    declared: &SymmetryDecl,
    symmetry: &Symmetry,
    defects: &Defects,
) -> Violation {
    let graph = &mut model.graph;
    let mut evidence = Vec::new();
    if let Some((component, _)) = &defects.outside {
        evidence.push(format!("the constraints are {} along it, not 0", shown(graph, *component)));
    }
    if let Some((change, _)) = &defects.variation {
        evidence.push(format!("it changes the Lagrangian at the rate {}", shown(graph, *change)));
    } else if symmetry.keeps_lagrangian == Invariance::OnConstraints {
        evidence.push("it leaves the Lagrangian invariant only where the constraints hold".into());
    }
    if let Some((change, _)) = &defects.moved {
        evidence.push(format!("it changes the constraints at the rate {}", shown(graph, *change)));
    }
    Violation {
        law: Law::Symmetry,
        origin: declared.origin,
        what: format!("`{}` is neither in D nor a symmetry", declared.name),
        evidence: evidence.join("; "),
        way_out: match nearest(model, setting, &symmetry.section) {
            Some(section) => format!("a section of D has a momentum equation, such as {section}"),
            None => "declare a section of D, which has a momentum equation, or leave it out".into(),
        },
    }
}

/// The section of D with the same independent components.
fn nearest(model: &mut Model, setting: &Setting<'_>, section: &[ExprId]) -> Option<String> {
    if setting.spanned.is_some() {
        return None;
    }
    let velocities = &setting.system.algebroid.velocities;
    let graph = &mut model.graph;
    let distribution = setting.constraints.generic_distribution(graph, velocities)?;
    let kept: Vec<ExprId> = distribution
        .independent
        .iter()
        .filter_map(|symbol| velocities.iter().position(|velocity| velocity == symbol))
        .map(|index| section[index])
        .collect();
    let image = graph.image(&distribution.basis, &kept);
    let image: Vec<ExprId> = image.into_iter().map(|component| graph.simplify(component)).collect();
    if image.iter().all(|component| graph.zero_test(*component).is_zero()) {
        return None;
    }
    let names: Vec<String> = model.sections.iter().map(|section| section.name.clone()).collect();
    Some(combination(&model.graph, &image, &names))
}

/// A request for momenta of which there are none.
#[must_use]
pub fn no_momenta(origin: Origin) -> Violation {
    Violation {
        law: Law::Symmetry,
        origin,
        what: "there are no momenta to emit".into(),
        evidence: "nothing is declared in `symmetries`, and no cyclic coordinate has its section in D".into(),
        way_out: "declare sections: `symmetries { spin: omega; }`".into(),
    }
}

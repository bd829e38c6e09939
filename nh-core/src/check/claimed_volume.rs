//! Claims about the volume that the motion keeps: M 2.5, mathematics (19).

use super::evidence::{not_zero_on, shown};
use crate::algebra::{Graph, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, Origin};
use crate::mechanics::{Density, Flow, ModularSection, Volume};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// The density that was found.
///
/// # Errors
/// Where there is none, with the modular section, or where that could not be decided.
pub fn volume(
    model: &mut Model,
    verdict: &Volume,
    divergence: ExprId,
    origin: Origin,
) -> Result<Density, Violation> {
    let blame = |what: &str, evidence: String, way_out: &str| Violation {
        law: Law::Volume,
        origin,
        what: what.into(),
        evidence,
        way_out: way_out.into(),
    };
    let none = "no volume with a density on the base is invariant";
    match verdict {
        Volume::Kept(density) => Ok(density.clone()),
        Volume::None(section) => {
            let symbols = model.graph.symbols_in(&section.components);
            let depends = model.parameters.iter().any(|parameter| symbols.contains(&parameter.symbol));
            let correct = if depends { "correct the parameters for which this should hold, or " } else { "" };
            Err(blame(
                none,
                format!(
                    "the modular section, up to a change of density, is {}: it is d^D of no function on the base",
                    modular_section(&model.graph, section)
                ),
                &format!("{correct}leave `volume` out"),
            ))
        }
        Volume::Nonlinear => Err(blame(
            none,
            format!(
                "the divergence of the motion is {}, which no function on the base (times det C) can make up for: \
                 its rate is linear in the velocities",
                shown(&model.graph, divergence)
            ),
            "give the density itself, `volume { … }`, or leave `volume` out",
        )),
        Volume::Undecided(why) => Err(blame(
            "whether a volume is invariant could not be decided",
            format!("the divergence of the motion is {}: {why}", shown(&model.graph, divergence)),
            "give the density itself: `volume { … }`",
        )),
        Volume::Unknown(section) => Err(blame(
            "whether a volume is invariant could not be decided",
            format!(
                "the modular section is {}, and d^D f was found to be minus that for no f = sum q log P with constant q \
                 and functions P that occur",
                modular_section(&model.graph, section)
            ),
            "give the density itself: `volume { … }`",
        )),
    }
}

/// `(…)*omega + …`, as a function of the velocities.
fn modular_section(graph: &Graph, section: &ModularSection) -> String {
    let mut text = String::new();
    for (component, velocity) in section.components.iter().zip(&section.velocities) {
        if !graph.is_literal_zero(*component) {
            let plus = if text.is_empty() { "" } else { " + " };
            text.extend([plus, "(", &shown(graph, *component), ")*", &graph.symbols()[*velocity]]);
        }
    }
    if let Some(rest) = section.components.last().filter(|rest| !graph.is_literal_zero(**rest)) {
        let plus = if text.is_empty() { "" } else { " + " };
        text.extend([plus, &shown(graph, *rest)]);
    }
    if text.is_empty() { "0".into() } else { text }
}

/// Whether a claimed density μ(t, x, v) is one and is kept: Γ(μ) + μ div Γ = 0 on the constraint manifold, or on a
/// larger one if there are functions of which no zeros were found.
pub fn claimed_density(
    model: &mut Model,
    (manifold, unsolved): (&Manifold, &[ExprId]),
    density: ExprId,
    divergence: ExprId,
    flow: &mut Flow,
    origin: Origin,
) -> Option<Violation> {
    let graph = &mut model.graph;
    if manifold.zero_test(graph, density).is_zero() {
        return Some(Violation {
            law: Law::Volume,
            origin,
            what: "this density is zero".into(),
            evidence: "every motion keeps it, and it measures nothing".into(),
            way_out: "state a density; `volume;` looks for one on the base".into(),
        });
    }
    let change = flow.derivative(graph, density);
    let defect = graph.formula(change + density * divergence);
    let mut verdict = manifold.zero_test(graph, defect);
    let defect = graph.simplify(defect);
    if let (Verdict::NonZero(_), Some(function)) = (&verdict, unsolved.first()) {
        let why = format!(
            "no points were found where {} = 0, so that it was asked elsewhere",
            shown(graph, *function)
        );
        verdict = Verdict::Unknown(why);
    }
    let (what, evidence) = match &verdict {
        Verdict::Zero => return None,
        Verdict::NonZero(witness) => {
            ("this density is not kept by the motion", not_zero_on(graph, defect, witness, manifold))
        }
        Verdict::Unknown(why) => (
            "whether this density is kept by the motion could not be decided",
            format!("{}: {why}", shown(graph, defect)),
        ),
    };
    Some(Violation {
        law: Law::Volume,
        origin,
        what: what.into(),
        evidence: format!("its rate along the motion plus itself times the divergence: {evidence}"),
        way_out: "correct the density; `volume;` looks for one on the base".into(),
    })
}

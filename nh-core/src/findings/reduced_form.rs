//! What reduction theory calls the equations, and the quantities that it names.

use super::parameters;
use crate::algebra::{Graph, Matrix};
use crate::check::{on_the_base, singular_where};
use crate::compile::{Derived, Proved, Reduced};
use crate::geometry::{ConstraintDistribution, Drops, Manifold, RankSetting};
use crate::id::ExprId;
use crate::limits::attempt;
use crate::mechanics::{Chaplygin, NonholonomicConnection, Splitting};

/// Lagrangians with more operations than this are classified, but their splitting is not shown.
const SHOWN_UP_TO: u64 = 150;
/// What the quantities of a splitting may take, in steps of work: what takes more fills pages, and nothing else
/// depends on it.
const SHOWN: u64 = 40_000;

/// The name of the reduced equations.
#[derive(Clone, Debug)]
pub(crate) enum ReducedForm {
    /// On a Lie algebra: Euler–Poincaré, or Suslov.
    OverAPoint {
        /// Whether there are no constraints.
        is_free: bool,
    },
    /// By the splitting of D.
    Split(Box<Split>),
    /// Affine constraints, or such that depend on the time, have none.
    Unnamed,
}

/// How D is split by the vertical sections.
#[derive(Clone, Debug)]
pub(crate) struct Split {
    /// Whether there are no constraints.
    pub(crate) is_free: bool,
    /// The splitting.
    pub(crate) reduced: Reduced,
    /// Where the projection of a Chaplygin system is singular.
    pub(crate) singular: Vec<ExprId>,
    /// Where S = D ∩ V is larger than at generic points.
    pub(crate) larger: Drops,
    /// Its quantities.
    pub(crate) quantities: Quantities,
}

/// The quantities of a splitting, CM Propositions 8 and 9.
#[derive(Clone, Debug)]
pub(crate) enum Quantities {
    /// They are not asked for: the Lagrangian is long, or nothing is horizontal.
    NotAsked,
    /// They take too long.
    TooLong,
    /// Lifts, curvature, force.
    Chaplygin(Chaplygin),
    /// Sections and brackets; none where they could not be solved for.
    Connection(Option<Connection>),
}

/// The nonholonomic connection with its brackets that do not vanish.
#[derive(Clone, Debug)]
pub(crate) struct Connection {
    /// The sections.
    pub(crate) sections: NonholonomicConnection,
    /// [h_κ, h_λ], for κ < λ.
    pub(crate) curvature: Vec<(usize, usize, Vec<ExprId>)>,
    /// [h_κ, S_ρ].
    pub(crate) coefficients: Vec<(usize, usize, Vec<ExprId>)>,
    /// [S_ρ, S_σ], for ρ < σ.
    pub(crate) brackets: Vec<(usize, usize, Vec<ExprId>)>,
}

impl ReducedForm {
    /// Finds it.
    pub(super) fn of(proved: &mut Proved, derived: &Derived<'_>) -> Self {
        let is_free = match derived {
            Derived::Adapted { distribution, .. } => distribution.constraints.annihilator.is_empty(),
            Derived::Projected { residuals, .. } => residuals.is_empty(),
        };
        if proved.model.coordinates.is_empty() {
            return Self::OverAPoint { is_free };
        }
        let distribution = match derived {
            Derived::Adapted { distribution, .. } => Some(*distribution),
            Derived::Projected { .. } => None,
        };
        let Ok(reduced) = Reduced::of(proved, distribution) else { return Self::Unnamed };
        let singular = if reduced.splitting.is_chaplygin() { not_onto(proved, &reduced) } else { Vec::new() };
        let larger = larger(proved, &reduced);
        let small = proved.model.graph.operation_count(&[proved.system.lagrangian]) <= SHOWN_UP_TO;
        let has_basis = distribution.is_some() || reduced.frame.is_some();
        let is_horizontal = reduced.splitting.horizontal > 0 || reduced.frame.is_some();
        let quantities = if small && has_basis && is_horizontal {
            attempt(SHOWN, || quantities(proved, &reduced)).unwrap_or(Quantities::TooLong)
        } else {
            Quantities::NotAsked
        };
        Self::Split(Box::new(Split { is_free, reduced, singular, larger, quantities }))
    }
}

/// Where the projection of a Chaplygin system is singular all the same: where constraints on V are
/// dependent, or rates along a basis of D. The basis alone does not tell: where D meets V, its own
/// coefficients may be infinite.
fn not_onto(proved: &mut Proved, reduced: &Reduced) -> Vec<ExprId> {
    let parameters = parameters(proved);
    let Proved { model, facts, .. } = proved;
    let Reduced { system, distribution, splitting, .. } = reduced;
    if let Some(on_vertical) = splitting.constraints_on_vertical(&model.graph, system, distribution) {
        let found = singular_where(&mut model.graph, &on_vertical, &parameters, facts).varying;
        if !found.is_empty() {
            return found;
        }
    }
    if splitting.coordinates.len() != splitting.rank {
        return not_onto_embedded(proved, reduced);
    }
    let projection = splitting.projection(&mut model.graph, system, distribution);
    singular_where(&mut model.graph, &projection, &parameters, facts).varying
}

/// Where S = D ∩ V is larger than at generic points: where the constraints and the rates of the coordinates
/// together have less rank.
fn larger(proved: &mut Proved, reduced: &Reduced) -> Drops {
    let parameters = parameters(proved);
    let Proved { model, facts, base, .. } = proved;
    let together = reduced.splitting.constraints_and_rates(&reduced.system, &reduced.distribution);
    let holding = &on_the_base(model);
    let setting = RankSetting { manifold: base, residuals: &[], holding, facts, parameters: &parameters };
    setting.rank(&mut model.graph, &together).map_or(Drops::Undecided, |rank| rank.drops)
}

/// The same over an embedded base, where V has sections of its own, as γ for the anchor γ × ω.
fn not_onto_embedded(proved: &mut Proved, reduced: &Reduced) -> Vec<ExprId> {
    let parameters = parameters(proved);
    let Proved { model, facts, base, .. } = proved;
    let Reduced { system, distribution, .. } = reduced;
    let graph = &mut model.graph;
    let whole = ConstraintDistribution::unconstrained(graph, &system.algebroid.velocities);
    let Ok(splitting) = Splitting::of(graph, system, &whole, &[], base) else { return Vec::new() };
    let Some(vertical) = NonholonomicConnection::of(graph, system, &whole, &splitting, facts) else {
        return Vec::new();
    };
    let rows = &distribution.constraints.annihilator;
    let on_vertical: Matrix = vertical.vertical.iter().map(|section| graph.image(rows, section)).collect();
    let mut found = singular_where(graph, &on_vertical, &parameters, facts).varying;
    found.retain(|factor| !is_constant_on(graph, base, *factor));
    found
}

/// Whether a function has one value on the base, as |γ|² on the sphere.
fn is_constant_on(graph: &mut Graph, base: &Manifold, function: ExprId) -> bool {
    let restricted = base.restrict(graph, function);
    graph.symbols_in(&[restricted]).into_iter().all(|symbol| {
        let slope = graph.partial(restricted, symbol);
        graph.zero_test(slope).is_zero()
    })
}

fn quantities(proved: &mut Proved, reduced: &Reduced) -> Quantities {
    match reduced.chaplygin(proved) {
        Some(found) => Quantities::Chaplygin(found),
        None => Quantities::Connection(Connection::of(proved, reduced)),
    }
}

impl Connection {
    /// S = D ∩ V, the lifts orthogonal to it, and their brackets.
    fn of(proved: &mut Proved, reduced: &Reduced) -> Option<Self> {
        let Reduced { system, distribution, splitting, .. } = reduced;
        let (graph, facts) = (&mut proved.model.graph, &proved.facts);
        let sections = NonholonomicConnection::of(graph, system, distribution, splitting, facts)?;
        let algebroid = &system.algebroid;
        let (mut curvature, mut coefficients, mut brackets) = (Vec::new(), Vec::new(), Vec::new());
        let (lifts, vertical) = (sections.lifts.len(), sections.vertical.len());
        let vanishes =
            |graph: &Graph, value: &[ExprId]| value.iter().all(|entry| graph.is_literal_zero(*entry));
        for kappa in 0..lifts {
            for lambda in kappa + 1..lifts {
                let value = sections.curvature(graph, algebroid, kappa, lambda);
                curvature.push((kappa, lambda, value));
            }
            for rho in 0..vertical {
                let value = sections.coefficients(graph, algebroid, kappa, rho);
                coefficients.push((kappa, rho, value));
            }
        }
        for rho in 0..vertical {
            for sigma in rho + 1..vertical {
                let value = sections.bracket(graph, algebroid, rho, sigma);
                brackets.push((rho, sigma, value));
            }
        }
        for entries in [&mut curvature, &mut coefficients, &mut brackets] {
            entries.retain(|(_, _, value)| !vanishes(graph, value));
        }
        Some(Self { sections, curvature, coefficients, brackets })
    }
}

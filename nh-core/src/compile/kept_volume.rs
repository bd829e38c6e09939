//! The divergence of the motion, and the volume that it keeps.

use super::on_request::{asked, not_differentiable, shortened, state, state_velocities, whole_state};
use super::proved::{Derived, Proved, fence};
use crate::algebra::{
    Echelon, FieldPoint, Function, Graph, Matrix, Node, Rational, Residue, Substitution, Verdict,
};
use crate::check;
use crate::check::evidence::shown;
use crate::functions::{DIVERGENCE, Functions, VOLUME_DENSITY};
use crate::geometry::{ConstraintDistribution, Manifold};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{
    Density, Flow, Procedure, SaddleEquations, Volume, VolumeSetting, divergence, invariant_volume, uncoupled,
};
use crate::model::{Formulation, Model, Request};
use crate::violation::Violation;

/// Derives the divergence and decides about volumes, as far as it is asked for; what the report says.
pub(super) fn derive(
    proved: &mut Proved,
    derived: &Derived<'_>,
    derivative: &Procedure,
    found: &mut Functions,
) -> Result<Vec<String>, Vec<Violation>> {
    let [of_divergence, of_volume] =
        [Request::Divergence, Request::Volume].map(|request| asked(&proved.model, request));
    let claim = proved.model.volume;
    let Some(origin) = of_divergence.or(of_volume).or(claim.map(|claim| claim.origin)) else {
        return Ok(Vec::new());
    };
    // 1. div Γ in the coordinates of the state
    let arguments = whole_state(proved, derived);
    let mut field = divergence(&mut proved.model.graph, derivative, &arguments)
        .map_err(|error| vec![not_differentiable(error, origin)])?;
    let vanishing = vanishing(&proved.model, derived.formulation());
    if let Some(correction) = correction(proved, derivative, &vanishing) {
        field.outputs[0] = proved.model.graph.formula(field.outputs[0] - correction);
    }
    let field = shortened(&mut proved.model.graph, field);
    let mut lines = Vec::new();
    if of_volume.is_some() || claim.is_some() {
        let written_out = field.written_out(&mut proved.model.graph)[0];
        // 2. a claimed density
        if let Some((claim, density)) = claim.and_then(|claim| Some((claim, claim.density?))) {
            let velocities = state_velocities(proved, derived);
            let mut flow = Flow::of(&mut proved.model.graph, derivative, &proved.system, &velocities);
            let manifold = manifold(proved, derived);
            let asked = (&manifold, proved.positions.unsolved.as_slice());
            let (model, origin) = (&mut proved.model, claim.origin);
            let broken = check::claimed_density(model, asked, density, written_out, &mut flow, origin);
            fence(broken.into_iter().collect())?;
            let text = model.graph.text_within(density, 400);
            let signs = changes_of_sign(proved, density);
            lines.push(format!("the density {text} is kept (claimed, and proved){signs}"));
            found.add_if(&VOLUME_DENSITY, of_volume.map(|_| Procedure::of(vec![density])));
        } else {
            // 3. a density on the base
            let verdict = decide(proved, derived, derivative, written_out);
            let origin = claim.map(|claim| claim.origin).or(of_volume).unwrap_or(origin);
            let density = check::volume(&mut proved.model, &verdict, written_out, origin)
                .map_err(|violation| vec![violation])?;
            let not_periodic = not_periodic(proved, &density);
            let density = density_expression(proved, &density);
            lines.push(line(proved, derived, density) + &not_periodic);
            found.add_if(&VOLUME_DENSITY, of_volume.map(|_| Procedure::of(vec![density])));
        }
    }
    found.add_if(&DIVERGENCE, of_divergence.map(|_| field));
    Ok(lines)
}

/// Where a density that is claimed has zeros between places of either sign: it is that of a volume on each side alone.
fn changes_of_sign(proved: &mut Proved, density: ExprId) -> String {
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let mut factors = check::with_zeros(&mut proved.model, &[density]);
    let graph = &proved.model.graph;
    factors.retain(|factor| graph.has_both_signs(*factor, &parameters));
    let zeros: Vec<String> = factors.iter().map(|factor| format!("{} = 0", shown(graph, *factor))).collect();
    match zeros.as_slice() {
        [] => String::new(),
        zeros => format!(
            "; it changes its sign where {}, and is that of a volume on each side",
            zeros.join(" or ")
        ),
    }
}

/// The constraint manifold as far as the state can leave it.
fn manifold(proved: &mut Proved, derived: &Derived<'_>) -> Manifold {
    match derived {
        Derived::Adapted { .. } => proved.positions.manifold.clone(),
        Derived::Projected { .. } => {
            proved.constraints.manifold(&mut proved.model.graph, &proved.system.algebroid.velocities)
        }
    }
}

/// What the report says about an invariant volume.
fn line(proved: &Proved, derived: &Derived<'_>, density: ExprId) -> String {
    let graph = &proved.model.graph;
    let names: Vec<String> =
        state(proved, derived).iter().map(|symbol| format!("d({})", graph.symbols()[*symbol])).collect();
    let on = match derived {
        Derived::Adapted { .. } if proved.model.positions.is_empty() => "",
        Derived::Adapted { .. } => ", divided by the differentials of the position constraints",
        Derived::Projected { .. } => ", divided by the differentials of the constraints",
    };
    let text = graph.text_within(density, 400);
    format!("invariant: ({text}) {}{on} (mathematics (19), M 2.5)", names.join(" "))
}

/// A warning where the density is an exponential of coordinates, which may be angles.
fn not_periodic(proved: &Proved, density: &Density) -> String {
    let graph = &proved.model.graph;
    let coordinates: Vec<&str> = density
        .iter()
        .filter_map(|(factor, _)| match graph.node(*factor) {
            Node::Apply(Function::Exp, x) => {
                graph.as_symbol(*x).map(|symbol| graph.symbols()[symbol].as_str())
            }
            _ => None,
        })
        .collect();
    if coordinates.is_empty() {
        return String::new();
    }
    format!("; the density is not periodic in {}: no function of an angle", coordinates.join(", "))
}

/// Functions f on the base, (∂_t + Γ) f = g f, that vanish at the states of the system: identities of embedded
/// coordinates, and position constraints where a state has no velocities across them. Where it has them, (∂_t + Γ) f
/// is the constraint φ on velocities, whose rate is 0: their share in the trace of g is none.
pub(super) fn vanishing(model: &Model, formulation: Formulation) -> Vec<ExprId> {
    let identities = model.identities.iter().map(|identity| identity.value);
    let positions = model.positions.iter().map(|position| position.value);
    match formulation {
        Formulation::Adapted => identities.chain(positions).collect(),
        Formulation::Projected => identities.collect(),
    }
}

/// Where functions f with (∂_t + Γ) f = g f vanish the volume is that of dx/df: the divergence there is less by the
/// trace of g. `None` where that is 0.
fn correction(proved: &mut Proved, derivative: &Procedure, functions: &[ExprId]) -> Option<ExprId> {
    if functions.is_empty() {
        return None;
    }
    let Proved { model, system, positions, .. } = proved;
    let (graph, manifold) = (&mut model.graph, &positions.manifold);
    let coordinates = system.algebroid.anchor.coordinates.clone();
    let rates = derivative.written_out(graph)[..coordinates.len()].to_vec();
    let gradient = |graph: &mut Graph, function: ExprId| -> Vec<ExprId> {
        coordinates.iter().map(|symbol| graph.partial(function, *symbol)).collect()
    };
    let mut slopes: Matrix = functions.iter().map(|f| gradient(graph, *f)).collect();
    let mut changes: Matrix = slopes
        .clone()
        .iter()
        .zip(functions)
        .map(|(slope, function)| {
            let (along, by_time) =
                (graph.inner_product(slope, &rates), graph.partial(*function, system.clock.time));
            let change = graph.formula(along + by_time);
            gradient(graph, change)
        })
        .collect();
    // functions that follow from others say nothing more
    let independent = manifold.independent_rows(graph, &slopes).ok()?;
    slopes = independent.iter().map(|row| slopes[*row].clone()).collect();
    changes = independent.iter().map(|row| changes[*row].clone()).collect();
    let (at_slopes, at_changes) =
        (manifold.restrict_matrix(graph, &slopes), manifold.restrict_matrix(graph, &changes));
    if trace_vanishes(graph, &at_slopes, &at_changes) {
        return None;
    }
    // g = ∂(Γf) Fᵀ (F Fᵀ)⁻¹
    let gram: Matrix = slopes.iter().map(|a| graph.image(&slopes, a)).collect();
    let right: Matrix = slopes.iter().map(|a| graph.image(&changes, a)).collect();
    let solved = graph.solve_linear(&gram, &right)?.values;
    let trace: Vec<ExprId> = (0..solved.len()).map(|k| solved[k][k]).collect();
    Some(graph.sum(&trace))
}

/// Whether tr(∂(Γf) Fᵀ (F Fᵀ)⁻¹) is 0 at random points of the base.
fn trace_vanishes(graph: &Graph, slopes: &Matrix, changes: &Matrix) -> bool {
    let together = [slopes.as_slice(), changes].concat();
    [26_000, 27_000].into_iter().all(|start| {
        let Ok(rows) = graph.matrix_in_field(&together, |seed| FieldPoint::random(start + seed)) else {
            return false;
        };
        let (slopes, changes) = rows.split_at(slopes.len());
        let dot =
            |a: &[Residue], b: &[Residue]| a.iter().zip(b).fold(Residue::ZERO, |sum, (a, b)| sum + *a * *b);
        let system: Vec<Vec<Residue>> =
            slopes.iter().map(|a| slopes.iter().chain(changes).map(|b| dot(a, b)).collect()).collect();
        let echelon = Echelon::of(system);
        let k = slopes.len();
        let trace =
            (0..k).filter_map(|i| echelon.rows.get(i)?.get(k + i)).fold(Residue::ZERO, |sum, x| sum + *x);
        echelon.rank() == k && trace == Residue::ZERO
    })
}

/// Looks for a density on the base, in a basis of D that holds at most points; times det C where this
/// depends on the velocities, so that it is one in (x, π).
fn decide(proved: &mut Proved, derived: &Derived<'_>, derivative: &Procedure, divergence: ExprId) -> Volume {
    let velocities = proved.system.algebroid.velocities.clone();
    let local;
    let distribution = match derived {
        Derived::Adapted { distribution, .. } => *distribution,
        Derived::Projected { .. } => {
            let graph = &mut proved.model.graph;
            match proved.constraints.generic_distribution(graph, &velocities) {
                None => return on_nonlinear_constraints(proved, derived, divergence),
                Some(found) => {
                    local = found;
                    &local
                }
            }
        }
    };
    let in_state = state_velocities(proved, derived);
    let graph = &mut proved.model.graph;
    let of_saddle = match derived {
        Derived::Adapted { .. } => None,
        Derived::Projected { equations, .. } => of_saddle(graph, equations),
    };
    let lagrangian = proved.system.lagrangian;
    let determinants =
        of_saddle.unwrap_or_else(|| determinants(graph, lagrangian, distribution, &velocities));
    let (moving, on_base): (Vec<ExprId>, Vec<ExprId>) =
        determinants.into_iter().partition(|factor| graph.depends_on(*factor, &in_state));
    let mut flow = Flow::of(graph, derivative, &proved.system, &in_state);
    let mut terms = vec![divergence];
    for determinant in &moving {
        let change = flow.derivative(graph, *determinant);
        terms.push(graph.formula(change / determinant));
    }
    let divergence = graph.sum(&terms);
    let divergence = distribution.restriction(graph, &velocities).apply(graph, divergence);
    let divergence = graph.simplify(divergence);
    let time = proved.system.clock.time;
    // det C may depend on it where the divergence does not: it is exp(c*t), say
    let depends_on_time = graph.depends_on(divergence, &[time])
        || graph.symbols_in(&distribution.velocity).contains(&time)
        || graph.symbols_in(&on_base).contains(&time);
    let anchor = &proved.system.algebroid.anchor;
    let mut fields: Matrix =
        (0..distribution.rank()).map(|a| anchor.vector_field(graph, &distribution.section(a))).collect();
    fields.push(anchor.vector_field(graph, &distribution.offset));
    let mut base = anchor.coordinates.clone();
    if depends_on_time {
        base.push(time);
        let along_time = graph.unit_vector(fields.len(), fields.len() - 1);
        for (field, rate) in fields.iter_mut().zip(along_time) {
            field.push(rate);
        }
    }
    let hints = [on_base.as_slice(), &distribution.pivots].concat();
    let setting = VolumeSetting {
        divergence,
        fields,
        base,
        velocities: distribution.independent.clone(),
        parameters: proved.model.parameters.iter().map(|parameter| parameter.symbol).collect(),
        manifold: &proved.positions.manifold,
        is_larger: !proved.positions.unsolved.is_empty(),
        hints,
    };
    match invariant_volume(graph, &setting) {
        Volume::Kept(mut density) => {
            let one = graph.one();
            density.extend(moving.into_iter().map(|determinant| (determinant, one)));
            Volume::Kept(density)
        }
        verdict => verdict,
    }
}

/// The constraints leave no basis in which the divergence could be compared with a linear form: all that
/// is seen is whether it vanishes.
fn on_nonlinear_constraints(proved: &mut Proved, derived: &Derived<'_>, divergence: ExprId) -> Volume {
    let manifold = manifold(proved, derived);
    match manifold.zero_test(&mut proved.model.graph, divergence) {
        Verdict::Zero => Volume::Kept(Vec::new()),
        _ => Volume::Undecided("a density is looked for under linear constraints alone".into()),
    }
}

/// The determinant of the saddle matrix of (9), block by block: det C times the square of a minor of the constraints,
/// whichever velocities C keeps, so that it does not divide by pivots. `None` for large blocks.
fn of_saddle(graph: &mut Graph, equations: &SaddleEquations) -> Option<Vec<ExprId>> {
    const BLOCK: usize = 6;
    let saddle = equations.matrix(graph);
    let blocks = uncoupled(graph, &saddle);
    let is_small = blocks.iter().all(|block| block.len() <= BLOCK);
    is_small.then(|| {
        let determinant = |block: &Vec<usize>| graph.small_determinant(&Graph::submatrix(&saddle, block));
        blocks.iter().map(determinant).collect()
    })
}

/// det C, block by block.
fn determinants(
    graph: &mut Graph,
    lagrangian: ExprId,
    distribution: &ConstraintDistribution,
    velocities: &[SymbolId],
) -> Vec<ExprId> {
    const BLOCK: usize = 4;
    let images = velocities.iter().copied().zip(distribution.velocity.iter().copied());
    let restricted = Substitution::new(images).apply(graph, lagrangian);
    let mass: Matrix = distribution
        .independent
        .iter()
        .map(|a| {
            let momentum = graph.partial(restricted, *a);
            distribution.independent.iter().map(|b| graph.partial(momentum, *b)).collect()
        })
        .collect();
    let mut determinants = Vec::new();
    for block in uncoupled(graph, &mass).into_iter().filter(|block| block.len() <= BLOCK) {
        let inner = Graph::submatrix(&mass, &block);
        let determinant = graph.small_determinant(&inner);
        determinants.push(determinant);
    }
    determinants
}

/// The density as an expression: powers that are no integers of what may be negative are powers of the
/// absolute value.
fn density_expression(proved: &mut Proved, density: &Density) -> ExprId {
    let facts = proved.facts.clone();
    let graph = &mut proved.model.graph;
    let mut exponents = Vec::new();
    let mut factors: Vec<(ExprId, Rational)> = Vec::new();
    for (factor, exponent) in density {
        if let Node::Apply(Function::Exp, logarithm) = *graph.node(*factor) {
            exponents.push(graph.formula(exponent * logarithm));
            continue;
        }
        let positive = graph.range(*factor, &facts).is_positive();
        if let Some(exponent) = graph.value_of(*exponent).cloned() {
            let even = (exponent.clone() * Rational::new(1, 2)).is_integer();
            let base = if positive || even { *factor } else { graph.apply(Function::Abs, *factor) };
            factors.push((base, exponent));
        } else {
            let base = if positive { *factor } else { graph.apply(Function::Abs, *factor) };
            let logarithm = graph.apply(Function::Ln, base);
            exponents.push(graph.formula(exponent * logarithm));
        }
    }
    let exponent = graph.sum(&exponents);
    let power = graph.apply(Function::Exp, exponent);
    factors.push((power, Rational::ONE));
    graph.product(&factors)
}

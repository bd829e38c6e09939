//! The reduced equations by the velocities that the Lagrangian is written in.
//!
//! A Lagrangian is mostly a function F(t, x, u) of velocities u^k = θ^k(y) of points and bodies,
//! with one-forms θ^k on E. Then the Euler–Lagrange side (6), contracted with a section σ, is
//!
//! `δL(σ) = Σ_k [ θ^k(σ) d/dt F_k + F_k dθ^k(y, σ) ] − ρ(σ)F|_u`,  F_k = ∂F/∂u^k,
//!
//! by the exterior derivative of mathematics section 5, with ∂_tθ^k(σ) added to dθ^k(y, σ) where a
//! form depends on the time. Where the θ^k are closed (velocities of
//! points in an inertial frame) this is Kane's form with the partial velocities θ^k(B_a): nothing
//! is expanded, and chains of bodies stay chains.

use super::adapted::ReducedEquations;
use super::euler_lagrange::LagrangianSystem;
use super::exterior_derivative::ExteriorDerivative;
use super::restricted::{Restricted, by_multiples, differentiate_all};
use super::wheel_frames::{TurnedPoint, WheelFrames};
use crate::algebra::{Derivation, Graph, Matrix, Node, Substitution};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SectionId, SymbolId};

/// L = F(t, x, u) with u^k = θ^k(y).
pub(super) struct VelocityForms {
    /// F, with a symbol for each u^k.
    pub(super) function: ExprId,
    /// The symbols and the forms; the quasi-velocities that F still has among them.
    pub(super) forms: Vec<(SymbolId, ExprId)>,
}

impl VelocityForms {
    /// Takes out every sum that is linear in the velocities and enters L nonlinearly.
    pub(super) fn of(graph: &mut Graph, system: &LagrangianSystem) -> Self {
        let velocities = &system.algebroid.velocities;
        let nodes = graph.reachable(&[system.lagrangian]);
        let mut linear = vec![false; graph.len()];
        let mut depends = vec![false; graph.len()];
        for id in &nodes {
            let (is_linear, moves) = linearity(graph, *id, velocities, &linear, &depends);
            linear[id.index()] = is_linear;
            depends[id.index()] = moves;
        }
        let is_form =
            |graph: &Graph, id: ExprId| linear[id.index()] && matches!(graph.node(id), Node::Sum { .. });
        let mut taken: Vec<ExprId> = Vec::new();
        for id in nodes.iter().filter(|id| depends[id.index()] && !linear[id.index()]) {
            for operand in graph.node(*id).operands() {
                if is_form(graph, operand) && !taken.contains(&operand) {
                    taken.push(operand);
                }
            }
        }
        let mut substitution = Substitution::new([]);
        let mut forms = Vec::new();
        for form in taken {
            let symbol = graph.new_symbol(format!("u{}", forms.len()));
            let image = graph.symbol(symbol);
            substitution.insert_node(form, image);
            forms.push((symbol, form));
        }
        let function = substitution.apply(graph, system.lagrangian);
        for velocity in velocities {
            if graph.depends_on(function, &[*velocity]) {
                forms.push((*velocity, graph.symbol(*velocity)));
            }
        }
        Self { function, forms }
    }
}

/// Whether a node is linear and homogeneous in the velocities by its form, and whether it depends
/// on them at all.
fn linearity(
    graph: &Graph,
    id: ExprId,
    velocities: &[SymbolId],
    linear: &[bool],
    depends: &[bool],
) -> (bool, bool) {
    match graph.node(id) {
        Node::Symbol(symbol) => {
            let is_velocity = velocities.contains(symbol);
            (is_velocity, is_velocity)
        }
        Node::Sum { constant, terms } => {
            let moves = terms.iter().any(|(term, _)| depends[term.index()]);
            (moves && constant.is_zero() && terms.iter().all(|(term, _)| linear[term.index()]), moves)
        }
        Node::Product { factors, .. } => {
            let moving: Vec<_> = factors.iter().filter(|(base, _)| depends[base.index()]).collect();
            let is_linear =
                matches!(moving.as_slice(), [(base, power)] if power.is_one() && linear[base.index()]);
            (is_linear, !moving.is_empty())
        }
        node => (false, node.operands().any(|operand| depends[operand.index()])),
    }
}

/// The reduced equations in this form.
pub fn equations_by_velocity_forms(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
) -> ReducedEquations {
    let forms = VelocityForms::of(graph, system);
    let on = Restricted::of(graph, distribution);
    equations(graph, system, on, &distribution.independent, &forms, &[])
}

/// The reduced equations in this form, with the partial velocities as intermediate results; `None` if
/// there are none worth a name.
pub fn equations_by_partial_velocities(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
) -> Option<ReducedEquations> {
    let forms = VelocityForms::of(graph, system);
    let on = Restricted::by_partial_velocities(graph, distribution, &system.algebroid.velocities, &forms)?;
    let mut equations = equations(graph, system, on, &distribution.independent, &forms, &[]);
    for entry in equations.mass.iter_mut().flatten().chain(&mut equations.force) {
        *entry = graph.simplify(*entry);
    }
    Some(equations)
}

/// The reduced equations with the velocities of points on wheels in the frames of these; `None` if
/// there are no such points.
///
/// With `s + i r = e^{−ia} (u₁ + i u₂)`, dθ¹ = ω∧θ² and dθ² = −ω∧θ¹ (ω = 0 for points in an inertial
/// frame), the curls of the turned forms contribute, for every section σ,
///
/// `F_s dθ^s(y, σ) + F_r dθ^r(y, σ) = μ (ȧ + ω(y)) (s θ^r(σ) − r θ^s(σ))`.
pub fn equations_in_wheel_frames(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    residuals: &[ExprId],
) -> Option<ReducedEquations> {
    let velocities = &system.algebroid.velocities;
    let mut forms = VelocityForms::of(graph, system);
    let mut frames = WheelFrames::of(graph, velocities, distribution, residuals, &mut forms)?;
    let (definitions, mut images) = by_multiples(graph, frames.definitions, &distribution.independent);
    let velocity = images.apply_all(graph, &frames.velocity);
    for point in &mut frames.points {
        point.components = point.components.map(|component| images.apply(graph, component));
    }
    let mut curl = None;
    let turned: Vec<(TurnedPoint, Vec<ExprId>)> = frames
        .points
        .into_iter()
        .filter_map(|point| {
            let curl = curl.get_or_insert_with(|| ExteriorDerivative::anywhere(graph, system));
            spin(graph, system, &forms, (point.forms, point.axes), curl).map(|spin| (point, spin))
        })
        .collect();
    let independent = &distribution.independent;
    let on = Restricted::by(graph, definitions, velocity, independent);
    Some(equations(graph, system, on, independent, &forms, &turned))
}

/// The reduced equations; some pairs of forms are turned, each with the one-form ω of its axes.
fn equations(
    graph: &mut Graph,
    system: &LagrangianSystem,
    on: Restricted,
    independent: &[SymbolId],
    forms: &VelocityForms,
    turned: &[(TurnedPoint, Vec<ExprId>)],
) -> ReducedEquations {
    let algebroid = &system.algebroid;
    let Restricted { mut definitions, velocity, eliminated, sections, partials: mut derivations, .. } = on;
    let changed = algebroid.velocities.iter().copied().zip(velocity.iter().copied()).chain(eliminated);
    let mut restriction =
        Substitution::new(changed.filter(|(symbol, value)| graph.as_symbol(*value) != Some(*symbol)));
    let VelocityForms { function, forms } = forms;
    // 1. û^k on D, and the partial velocities θ^k(B_a) = ∂û^k/∂v^a
    let restricted =
        on.forms.unwrap_or_else(|| forms_on_distribution(graph, forms, turned, &mut restriction));
    let partials: Matrix =
        derivations.iter_mut().map(|partial| partial.apply_all(graph, &restricted)).collect();
    // 2. F̂_k and ρ-gradient of F, on D
    let images = forms.iter().map(|(symbol, _)| *symbol).zip(restricted.iter().copied());
    let mut on_distribution = Substitution::new(images);
    let mut slope = |graph: &mut Graph, symbol: &SymbolId| {
        let partial = graph.partial(*function, *symbol);
        on_distribution.apply(graph, partial)
    };
    let slopes: Vec<ExprId> = forms.iter().map(|(symbol, _)| slope(graph, symbol)).collect();
    let gradient: Vec<ExprId> =
        algebroid.anchor.coordinates.iter().map(|symbol| slope(graph, symbol)).collect();
    // 3. d/dt F̂_k at v̇ = 0
    let mut along = algebroid.along(graph, &velocity, &system.clock);
    differentiate_all(graph, &mut definitions, &mut along, "rate", on.simplified);
    let changes = along.apply_all(graph, &slopes);
    // 4. contraction with B_a
    let forces = restriction.apply_all(graph, &system.forces);
    // the quasi-velocities themselves: dy^γ(y, e_α) = C^γ_{αβ} y^β, all in one bracket term
    let zero = graph.zero();
    let momenta: Vec<ExprId> = algebroid
        .velocities
        .iter()
        .map(|velocity| forms.iter().position(|(symbol, _)| symbol == velocity).map_or(zero, |k| slopes[k]))
        .collect();
    let bracket = algebroid.structure.bracket_term(graph, &velocity, &momenta);
    let curved = curved(graph, system, forms, turned);
    // the turning of pairs: ȧ + ω(y)
    let turning = rates_of_turning(graph, turned, &velocity, &mut along);
    let (mut mass, mut force): (Matrix, Vec<ExprId>) = (Vec::new(), Vec::new());
    let inertia: Matrix = derivations.iter_mut().map(|partial| partial.apply_all(graph, &slopes)).collect();
    for (a, symbol) in independent.iter().enumerate() {
        let section = &sections[a];
        let row: Vec<ExprId> = (0..independent.len())
            .map(|b| {
                if b < a {
                    return mass[b][a];
                }
                graph.inner_product(&partials[a], &inertia[b])
            })
            .collect();
        mass.push(row);
        let inertial = graph.inner_product(&partials[a], &changes);
        let field = algebroid.anchor.vector_field(graph, section);
        let potential = graph.inner_product(&field, &gradient);
        let mut applied = graph.inner_product(section, &forces);
        for value in system.forces_along(*symbol) {
            let value = restriction.apply(graph, value);
            applied = graph.formula(applied + value);
        }
        let gyroscopic = graph.inner_product(section, &bracket);
        let mut total = vec![
            (1.into(), applied),
            (1.into(), potential),
            ((-1).into(), inertial),
            ((-1).into(), gyroscopic),
        ];
        let mut curl = None;
        for k in &curved {
            let curl = curl.get_or_insert_with(|| ExteriorDerivative::of(graph, system, &velocity, section));
            let curl = curl.apply(graph, forms[*k].1);
            total.push(((-1).into(), graph.formula(slopes[*k] * curl)));
        }
        for ((point, _), rate) in turned.iter().zip(&turning) {
            let [s, r] = point.forms;
            let (forth, back) =
                (graph.formula(slopes[s] * partials[a][r]), graph.formula(slopes[r] * partials[a][s]));
            total.push(((-1).into(), graph.formula(rate * (forth - back))));
        }
        force.push(graph.linear_combination(&total));
    }
    let rates = algebroid.rates(graph, &velocity);
    let independent = independent.to_vec();
    ReducedEquations { definitions, mass, force, rates, velocity, independent }
}

/// û^k: the components of turned points, the other forms at y = B v + y₀.
fn forms_on_distribution(
    graph: &mut Graph,
    forms: &[(SymbolId, ExprId)],
    turned: &[(TurnedPoint, Vec<ExprId>)],
    restriction: &mut Substitution,
) -> Vec<ExprId> {
    let mut restricted: Vec<ExprId> = Vec::with_capacity(forms.len());
    for (k, (_, form)) in forms.iter().enumerate() {
        let component = turned.iter().find_map(|(point, _)| {
            let position = point.forms.iter().position(|form| *form == k)?;
            Some(point.components[position])
        });
        restricted.push(component.unwrap_or_else(|| restriction.apply(graph, *form)));
    }
    restricted
}

/// The forms with dθ ≠ 0, but for quasi-velocities and turned points, whose dθ is known.
fn curved(
    graph: &mut Graph,
    system: &LagrangianSystem,
    forms: &[(SymbolId, ExprId)],
    turned: &[(TurnedPoint, Vec<ExprId>)],
) -> Vec<usize> {
    let mut anywhere = None;
    let mut found = Vec::new();
    for (k, (symbol, form)) in forms.iter().enumerate() {
        let is_turned = turned.iter().any(|(point, _)| point.forms.contains(&k));
        if is_turned || system.algebroid.velocities.contains(symbol) {
            continue;
        }
        let curl = anywhere.get_or_insert_with(|| ExteriorDerivative::anywhere(graph, system));
        if !curl.vanishes(graph, *form) {
            found.push(k);
        }
    }
    found
}

/// ȧ + ω(y) for each turned point.
fn rates_of_turning(
    graph: &mut Graph,
    turned: &[(TurnedPoint, Vec<ExprId>)],
    velocity: &[ExprId],
    along: &mut Derivation,
) -> Vec<ExprId> {
    let mut rates = Vec::with_capacity(turned.len());
    for (point, spin) in turned {
        let change = along.apply(graph, point.angle);
        let spinning = graph.inner_product(spin, velocity);
        rates.push(graph.formula(change + spinning));
    }
    rates
}

/// ω with dθ¹ = ω∧θ² and dθ² = −ω∧θ¹ for a pair of forms with axes, by its components on the sections, if there
/// is such.
pub(super) fn spin(
    graph: &mut Graph,
    system: &LagrangianSystem,
    forms: &VelocityForms,
    (pair, axes): ([usize; 2], [usize; 2]),
    curl: &mut ExteriorDerivative,
) -> Option<Vec<ExprId>> {
    let algebroid = &system.algebroid;
    let [x, y] = axes.map(SectionId::from_index);
    let zero = graph.zero();
    // dy^x(e_β, e_y) = −C^x_{βy} = ω_β
    let omega: Vec<ExprId> = algebroid
        .sections()
        .map(|section| {
            if section == x || section == y {
                return zero;
            }
            let symbol = algebroid.structure.get(graph, x, section, y);
            graph.formula(-symbol)
        })
        .collect();
    // of each form its values on both arguments
    let velocity = algebroid.velocity(graph);
    let turning = graph.inner_product(&omega, &velocity);
    let turning = [turning, curl.on_second(graph, turning)];
    let [one, two] = pair.map(|k| forms.forms[k].1);
    for (form, other, sign) in [(one, two, -1), (two, one, 1)] {
        let rotation = curl.apply(graph, form);
        let other = [other, curl.on_second(graph, other)];
        let (forth, back) = (graph.formula(turning[0] * other[1]), graph.formula(turning[1] * other[0]));
        let wedge = graph.formula(forth - back);
        let difference = graph.linear_combination(&[(1.into(), rotation), (sign.into(), wedge)]);
        if !graph.zero_test(difference).is_zero() {
            return None;
        }
    }
    Some(omega)
}

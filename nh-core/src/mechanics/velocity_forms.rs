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
use crate::algebra::{Derivation, Graph, Matrix, Node, Substitution};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};

/// L = F(t, x, u) with u^k = θ^k(y).
struct VelocityForms {
    /// F, with a symbol for each u^k.
    function: ExprId,
    /// The symbols and the forms; the quasi-velocities that F still has among them.
    forms: Vec<(SymbolId, ExprId)>,
}

impl VelocityForms {
    /// Takes out every sum that is linear in the velocities and enters L nonlinearly.
    fn of(graph: &mut Graph, system: &LagrangianSystem) -> Self {
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
    let algebroid = &system.algebroid;
    let velocity = distribution.velocity.clone();
    let mut restriction = distribution.restriction(graph, &algebroid.velocities);
    let VelocityForms { function, forms } = VelocityForms::of(graph, system);
    // 1. û^k on D, and the partial velocities θ^k(B_a) = ∂û^k/∂v^a
    let restricted: Vec<ExprId> = forms.iter().map(|(_, form)| restriction.apply(graph, *form)).collect();
    let independent = distribution.independent.clone();
    let partials: Matrix = independent
        .iter()
        .map(|symbol| restricted.iter().map(|u| graph.partial(*u, *symbol)).collect())
        .collect();
    // 2. F̂_k and ρ-gradient of F, on D
    let images = forms.iter().map(|(symbol, _)| *symbol).zip(restricted.iter().copied());
    let mut on_distribution = Substitution::new(images);
    let slopes: Vec<ExprId> = forms
        .iter()
        .map(|(symbol, _)| {
            let slope = graph.partial(function, *symbol);
            on_distribution.apply(graph, slope)
        })
        .collect();
    let coordinates = algebroid.anchor.coordinates.clone();
    let gradient: Vec<ExprId> = coordinates
        .iter()
        .map(|symbol| {
            let partial = graph.partial(function, *symbol);
            on_distribution.apply(graph, partial)
        })
        .collect();
    // 3. d/dt F̂_k at v̇ = 0
    let mut along = algebroid.along(graph, &velocity, system.time);
    let changes: Vec<ExprId> = slopes.iter().map(|slope| along.apply(graph, *slope)).collect();
    // 4. contraction with B_a
    let forces: Vec<ExprId> = system.forces.iter().map(|force| restriction.apply(graph, *force)).collect();
    // the quasi-velocities themselves: dy^γ(y, e_α) = C^γ_{αβ} y^β, all in one bracket term
    let zero = graph.zero();
    let is_velocity = |symbol: &SymbolId| algebroid.velocities.contains(symbol);
    let momenta: Vec<ExprId> = algebroid
        .velocities
        .iter()
        .map(|velocity| forms.iter().position(|(symbol, _)| symbol == velocity).map_or(zero, |k| slopes[k]))
        .collect();
    let bracket = algebroid.structure.bracket_term(graph, &velocity, &momenta);
    let curved: Vec<usize> = (0..forms.len())
        .filter(|k| !is_velocity(&forms[*k].0) && !is_closed(graph, system, forms[*k].1))
        .collect();
    let (mut mass, mut force): (Matrix, Vec<ExprId>) = (Vec::new(), Vec::new());
    for (a, symbol) in independent.iter().enumerate() {
        let section = distribution.section(a);
        let row: Vec<ExprId> = independent
            .iter()
            .enumerate()
            .map(|(b, other)| {
                if b < a {
                    return mass[b][a];
                }
                let inertia: Vec<ExprId> = slopes.iter().map(|slope| graph.partial(*slope, *other)).collect();
                graph.inner_product(&partials[a], &inertia)
            })
            .collect();
        mass.push(row);
        let inertial = graph.inner_product(&partials[a], &changes);
        let field = algebroid.anchor.vector_field(graph, &section);
        let potential = graph.inner_product(&field, &gradient);
        let mut applied = graph.inner_product(&section, &forces);
        for (_, value) in system.forces_on_distribution.iter().filter(|(direction, _)| direction == symbol) {
            let value = restriction.apply(graph, *value);
            applied = graph.add(applied, value);
        }
        let gyroscopic = graph.inner_product(&section, &bracket);
        let mut total = vec![
            (1.into(), applied),
            (1.into(), potential),
            ((-1).into(), inertial),
            ((-1).into(), gyroscopic),
        ];
        for k in &curved {
            let curl = exterior_derivative(graph, system, forms[*k].1, &velocity, &section);
            total.push(((-1).into(), graph.mul(slopes[*k], curl)));
        }
        force.push(graph.linear_combination(&total));
    }
    let rates = algebroid.rates(graph, &velocity);
    ReducedEquations { mass, force, rates, velocity, independent }
}

/// Whether dθ = 0 for θ(y) = `form`, and θ does not depend on the time.
fn is_closed(graph: &mut Graph, system: &LagrangianSystem, form: ExprId) -> bool {
    let first = system.algebroid.velocity(graph);
    let second: Vec<ExprId> = (0..first.len())
        .map(|index| {
            let symbol = graph.new_symbol(format!("z{index}"));
            graph.symbol(symbol)
        })
        .collect();
    let curl = exterior_derivative(graph, system, form, &first, &second);
    graph.zero_test(curl).is_zero()
}

/// `dθ(σ, τ) = ρ(σ)θ(τ) − ρ(τ)θ(σ) − θ([σ, τ])` for sections whose components are held constant,
/// with `∂_tθ(τ)` where θ depends on the time: along a motion, t goes with σ.
fn exterior_derivative(
    graph: &mut Graph,
    system: &LagrangianSystem,
    form: ExprId,
    sigma: &[ExprId],
    tau: &[ExprId],
) -> ExprId {
    let algebroid = &system.algebroid;
    // the derivative along one section of the form, then the other section put in
    let mut term = |direction: &[ExprId], section: &[ExprId]| {
        let field = algebroid.anchor.vector_field(graph, direction);
        let coordinates = algebroid.anchor.coordinates.iter().copied();
        // the directions as symbols, so that they are not differentiated themselves
        let symbols: Vec<SymbolId> =
            (0..field.len()).map(|index| graph.new_symbol(format!("direction{index}"))).collect();
        let seeds: Vec<ExprId> = symbols.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let change = Derivation::new(coordinates.zip(seeds)).apply(graph, form);
        let images = symbols.into_iter().zip(field);
        let sections = algebroid.velocities.iter().copied().zip(section.iter().copied());
        Substitution::new(images.chain(sections)).apply(graph, change)
    };
    let (forth, back) = (term(sigma, tau), term(tau, sigma));
    let bracket = algebroid.structure.contract(graph, sigma, tau);
    let images = algebroid.velocities.iter().copied().zip(bracket);
    let of_bracket = Substitution::new(images).apply(graph, form);
    // the motion goes along σ + ∂_t
    let change = graph.partial(form, system.time);
    let images = algebroid.velocities.iter().copied().zip(tau.iter().copied());
    let in_time = Substitution::new(images).apply(graph, change);
    graph.linear_combination(&[
        (1.into(), forth),
        ((-1).into(), back),
        ((-1).into(), of_bracket),
        (1.into(), in_time),
    ])
}

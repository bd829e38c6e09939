//! The claims: each function beside its definition.

use super::super::differentiated::{SLOPES_OF_POSITIONS, SLOPES_OF_VELOCITIES};
use super::super::proved::Split;
use super::{Claims, Declared, Derivatives, Parts};
use crate::choose::{
    AlmostPoissonForm, BracketForm, DerivedFunction, GyroscopicForm, PowerForm, SplittingForm, ValuesForm,
    VelocityNames,
};
use crate::functions::{
    BRACKET, BRACKET_WITH_ENERGY, CHRISTOFFEL, CONNECTION, CONNECTION_COEFFICIENTS, CURVATURE, DIVERGENCE,
    DRIFT_OF_OUTPUTS, ENERGY, GYROSCOPIC, HAMILTON_JACOBI, HORIZONTAL_FORCE, HORIZONTAL_LIFTS,
    LOCKED_INERTIA, MOMENTA, MOMENTUM_RATES, OUTPUT_JACOBIAN, OUTPUTS, PARAMETER_JACOBIAN, POWER, RESIDUAL,
    VELOCITY, VERTICAL_MOMENTA, VERTICAL_MOMENTUM_RATES, VERTICAL_SECTIONS, VERTICAL_VELOCITIES,
    VOLUME_DENSITY,
};

/// What is read off the state, and the ways back to where it belongs.
pub(super) fn of_state<'d>(
    found: &'d Derivatives,
    declared: &'d Declared,
    names: VelocityNames<'d>,
) -> Claims<'d> {
    let Derivatives { given, parts } = found;
    let functions = &parts.functions;
    let mut claims = Claims::new();
    if let Some(energy) = functions.get(&ENERGY) {
        claims.push(("energy", DerivedFunction::Energy(energy)));
    }
    if let Some(velocity) = functions.get(&VELOCITY) {
        claims.push(("velocity", DerivedFunction::Velocity(velocity)));
    }
    if let Some(outputs) = functions.get(&OUTPUTS) {
        let form = ValuesForm { values: outputs, declared: &declared.outputs, names };
        claims.push(("outputs", DerivedFunction::Values(form)));
        if let Some(jacobian) = functions.get(&OUTPUT_JACOBIAN) {
            let claim = DerivedFunction::Jacobian(outputs, jacobian, &declared.arguments);
            claims.push(("output_jacobian", claim));
        }
    }
    if let Some(momenta) = functions.get(&MOMENTA) {
        claims.push(("momenta", DerivedFunction::Momenta(momenta, &declared.sections)));
    }
    if let Some(residual) = functions.get(&RESIDUAL) {
        claims.push(("constraint_residual", DerivedFunction::Residual(residual, &declared.residuals)));
    }
    if let Some(projection) = &parts.projection {
        claims.push(("projection", DerivedFunction::Projection(projection, given.residuals)));
    }
    if let Some(positions) = &parts.positions {
        let claim = DerivedFunction::Return(positions, declared.constraints, given.residuals);
        claims.push(("position_return", claim));
        if let Some(slopes) = &positions.slopes {
            let claim = DerivedFunction::Jacobian(&positions.step, &slopes.positions, &declared.state);
            claims.push((SLOPES_OF_POSITIONS, claim));
            let step = parts.projection.as_ref().map(|projection| &projection.step);
            if let (Some(step), Some(by)) = (step.or(positions.velocities.as_ref()), &slopes.velocities) {
                let claim = DerivedFunction::Jacobian(step, by, &declared.moved);
                claims.push((SLOPES_OF_VELOCITIES, claim));
            }
        }
    }
    for (impact, rows) in parts.impacts.iter().zip(&declared.impacts) {
        claims.push(("impact", DerivedFunction::Jump(impact, rows)));
    }
    if let Some(embedding) = &parts.embedding {
        claims.push(("normalize", DerivedFunction::Normalisation(embedding, &declared.identities)));
    }
    claims
}

/// What is derived from the motion.
pub(super) fn of_motion<'d>(
    found: &'d Derivatives,
    declared: &'d Declared,
    names: VelocityNames<'d>,
) -> Claims<'d> {
    let Derivatives { given, parts: Parts { functions, linearized, .. } } = found;
    let derivative = given.derivative;
    let mut claims = Claims::new();
    if let Some(linearized) = linearized {
        claims.push(("jacobian", DerivedFunction::Linearized(derivative, linearized, &declared.arguments)));
    }
    if let Some(jacobian) = functions.get(&PARAMETER_JACOBIAN) {
        let claim = DerivedFunction::Jacobian(derivative, jacobian, &declared.parameters);
        claims.push(("parameter_jacobian", claim));
    }
    if let (Some(momenta), Some(rates)) = (functions.get(&MOMENTA), functions.get(&MOMENTUM_RATES)) {
        claims.push(("momentum_rates", DerivedFunction::Rates(momenta, rates)));
    }
    if let (Some(power), Some(energy)) = (functions.get(&POWER), functions.get(&ENERGY)) {
        let (multipliers, rows) = given.multipliers;
        let multipliers = (!multipliers.outputs.is_empty()).then_some(multipliers);
        let form = PowerForm { power, energy, forces: &declared.forces, names, multipliers, rows };
        claims.push(("power", DerivedFunction::Power(form)));
    }
    if let Some(divergence) = functions.get(&DIVERGENCE) {
        claims.push(("divergence", DerivedFunction::Divergence(divergence, &declared.vanishing)));
    }
    if let Some(density) = functions.get(&VOLUME_DENSITY) {
        claims.push(("volume_density", DerivedFunction::Density(density, &declared.vanishing)));
    }
    claims
}

/// What is derived on phase space.
pub(super) fn of_phase_space<'d>(found: &'d Derivatives, declared: &'d Declared) -> Claims<'d> {
    let Parts { functions, phase_space, .. } = found.parts;
    let mut claims = Claims::new();
    if let Some(form) = &phase_space.invariants {
        let claim = DerivedFunction::Jacobian(&form.values, &form.gradients, &declared.state);
        claims.push(("invariant_gradients", claim));
    }
    if let Some(form) = &phase_space.held {
        let positions = found.parts.positions.as_ref();
        let positions = positions.map_or(0, |positions| positions.count - positions.redundant.len());
        claims.push(("held_equations", DerivedFunction::Held(form, positions)));
    }
    if let Some(form) = &phase_space.leapfrog {
        claims.push(("leapfrog", DerivedFunction::Leapfrog(form)));
    }
    if let Some(form) = &phase_space.variational {
        claims.push(("rattle", DerivedFunction::Variational(form)));
    }
    if let Some(form) = &phase_space.euler_poincare_suslov {
        claims.push(("euler_poincare_suslov", DerivedFunction::DiscreteMomentum(form)));
    }
    if let Some(lifted) = functions.get(&HAMILTON_JACOBI) {
        claims.push(("hamilton_jacobi", DerivedFunction::Section(lifted, &declared.claimed)));
    }
    let Some(energy) = functions.get(&ENERGY) else { return claims };
    if let Some(form) = &phase_space.almost_poisson {
        let (gradient, covector, sharp) = (&form.gradient, form.covector.as_slice(), &form.sharp);
        let form = AlmostPoissonForm { gradient, covector, sharp, energy };
        claims.push(("discrete_gradient", DerivedFunction::Sharp(form)));
    }
    if let Some(side) = &phase_space.hamiltonian {
        claims.push(("hamiltonian", DerivedFunction::Hamiltonian(side, energy)));
    }
    let brackets = [&OUTPUTS, &BRACKET, &BRACKET_WITH_ENERGY, &DRIFT_OF_OUTPUTS];
    if let [Some(outputs), Some(bracket), Some(with_energy), Some(drift)] =
        brackets.map(|signature| functions.get(signature))
    {
        let form = BracketForm { outputs, bracket, with_energy, drift, energy };
        claims.push(("bracket", DerivedFunction::Bracket(form)));
    }
    claims
}

/// What is derived from the kinetic metric and the brackets.
pub(super) fn of_geometry<'d>(
    found: &'d Derivatives,
    declared: &'d Declared,
    split: Option<&'d Split>,
) -> Claims<'d> {
    let functions = &found.parts.functions;
    let mut claims = Claims::new();
    if let (Some(christoffel), Some(connection)) = (functions.get(&CHRISTOFFEL), functions.get(&CONNECTION)) {
        claims.push(("christoffel", DerivedFunction::Christoffel(christoffel)));
        claims.push(("connection", DerivedFunction::Connection(connection, christoffel)));
    }
    if let Some(force) = functions.get(&GYROSCOPIC) {
        let form = GyroscopicForm { force, over: &declared.gyroscopic };
        claims.push(("gyroscopic", DerivedFunction::Gyroscopic(form)));
    }
    if let Some(split) = split {
        let form = SplittingForm {
            vertical: functions.get(&VERTICAL_SECTIONS),
            lifts: functions.get(&HORIZONTAL_LIFTS),
            inertia: functions.get(&LOCKED_INERTIA),
            coefficients: functions.get(&CONNECTION_COEFFICIENTS),
            curvature: functions.get(&CURVATURE),
            momenta: functions.get(&VERTICAL_MOMENTA),
            velocities: functions.get(&VERTICAL_VELOCITIES),
            force: functions.get(&HORIZONTAL_FORCE),
            over: &split.over,
            coordinates: &split.coordinates,
            group: &split.group,
            is_embedded: split.is_embedded,
        };
        claims.push(("splitting", DerivedFunction::Splitting(form)));
    }
    if let (Some(momenta), Some(rates)) =
        (functions.get(&VERTICAL_MOMENTA), functions.get(&VERTICAL_MOMENTUM_RATES))
    {
        claims.push(("vertical_momentum_rates", DerivedFunction::Rates(momenta, rates)));
    }
    claims
}

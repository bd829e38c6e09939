//! The equations in velocity forms, with named partial velocities, with named momenta and with chained constraints are those of the reduced form (8),
//! entry by entry.

use crate::adapted_frame::stages;
use crate::systems;
use nonholonomic_core::mechanics::{
    Definition, equations_by_momenta, equations_by_partial_velocities, equations_by_velocity_forms,
    equations_in_wheel_frames, reduced_equations,
};
use nonholonomic_core::model::Model;

/// Whether there was a form in the frames of wheels.
fn forms_agree(mut model: Model) -> bool {
    let (system, distribution) = stages(&mut model);
    let graph = &mut model.graph;
    let expected = reduced_equations(graph, &system, &distribution);
    let residuals: Vec<_> = model.constraints.iter().map(|constraint| constraint.residual).collect();
    let chained = distribution.chained(graph, &residuals, &system.algebroid.velocities);
    let on_wheels = equations_in_wheel_frames(graph, &system, &distribution, &residuals);
    let is_on_wheels = on_wheels.is_some();
    let candidates = [
        equations_by_velocity_forms(graph, &system, &distribution),
        equations_by_velocity_forms(graph, &system, &chained),
    ];
    let by_partials = equations_by_partial_velocities(graph, &system, &distribution);
    let by_momenta = equations_by_momenta(graph, &system, &distribution);
    for candidate in candidates.into_iter().chain(on_wheels).chain(by_partials).chain(by_momenta) {
        let entries = expected.mass.iter().flatten().chain(&expected.force).chain(&expected.rates);
        let others = candidate.mass.iter().flatten().chain(&candidate.force).chain(&candidate.rates);
        let others = candidate.definitions.with_outputs(others.copied().collect()).written_out(graph);
        assert_eq!(entries.clone().count(), others.len());
        for (entry, other) in entries.zip(others) {
            let defect = graph.formula(entry - other);
            let (found, meant) = (graph.text(other), graph.text(*entry));
            assert!(graph.zero_test(defect).is_zero(), "{found} is not {meant}");
        }
    }
    is_on_wheels
}

#[test]
fn of_constrained_and_free_systems() {
    forms_agree(systems::sleigh());
    forms_agree(systems::robot());
    forms_agree(systems::snakeboard(false));
    forms_agree(systems::charged_particle(false));
    forms_agree(systems::car());
}

#[test]
fn with_drift_and_time() {
    forms_agree(systems::ball_on_rotating_table());
    forms_agree(systems::steered_blade());
    forms_agree(systems::time_dependent_form());
}

/// Trailers in the frame of the tractor and in absolute and relative angles: hitches behind the axle,
/// a load that is not over the wheels, a hitch without wheels, and a drift across one of the wheels.
#[test]
fn on_wheels() {
    for relative in [false, true] {
        assert!(forms_agree(systems::trailers(relative, false)));
        assert!(forms_agree(systems::trailers(relative, true)));
    }
}

/// What is no product is named: where nothing was, nothing of the above has been compared.
#[test]
fn quotients_of_parameters_and_angles_are_named() {
    for (mut model, names) in [(systems::car(), Some(["omega_per_v"])), (systems::sleigh(), None)] {
        let (system, distribution) = stages(&mut model);
        let graph = &mut model.graph;
        let found = equations_by_partial_velocities(graph, &system, &distribution);
        let found = found.map(|equations| {
            let names = equations.definitions.definitions.iter().filter_map(|definition| match definition {
                Definition::Value { symbol, .. } => Some(graph.symbols()[*symbol].as_str()),
                _ => None,
            });
            names.collect::<Vec<_>>()
        });
        // besides its rate
        assert_eq!(found.as_ref().and_then(|found| found.first()), names.as_ref().map(|names| &names[0]));
    }
}

//! The equations in velocity forms and with chained constraints are those of the reduced form (8),
//! entry by entry.

use crate::adapted_frame::stages;
use crate::systems;
use nh_core::mechanics::{equations_by_velocity_forms, reduced_equations};
use nh_core::model::Model;

fn forms_agree(mut model: Model) {
    let (system, distribution) = stages(&mut model);
    let graph = &mut model.graph;
    let expected = reduced_equations(graph, &system, &distribution);
    let residuals: Vec<_> = model.constraints.iter().map(|constraint| constraint.residual).collect();
    let chained = distribution.chained(graph, &residuals, &system.algebroid.velocities);
    for candidate in [
        equations_by_velocity_forms(graph, &system, &distribution),
        equations_by_velocity_forms(graph, &system, &chained),
    ] {
        let entries = expected.mass.iter().flatten().chain(&expected.force).chain(&expected.rates);
        let others = candidate.mass.iter().flatten().chain(&candidate.force).chain(&candidate.rates);
        for (entry, other) in entries.zip(others) {
            let defect = graph.sub(*entry, *other);
            assert!(
                graph.zero_test(defect).is_zero(),
                "{} is not {}",
                graph.text(*other),
                graph.text(*entry)
            );
        }
    }
}

#[test]
fn of_constrained_and_free_systems() {
    forms_agree(systems::sleigh());
    forms_agree(systems::robot());
    forms_agree(systems::snakeboard(false));
    forms_agree(systems::charged_particle(false));
}

#[test]
fn with_drift_and_time() {
    forms_agree(systems::ball_on_rotating_table());
    forms_agree(systems::steered_blade());
    forms_agree(systems::time_dependent_form());
}

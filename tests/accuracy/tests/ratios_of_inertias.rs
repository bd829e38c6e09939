//! Inertias over eighteen decades cost the default level no digits where one constraint stands alone.

use nh_accuracy::places::Regime;
use nh_accuracy::systems;

/// The factor that the default level gives away for speed.
const GIVEN_AWAY: f64 = 4.0;

#[test]
fn forces_do_not_cancel_against_a_single_constraint() {
    let all = systems::all();
    let system = all.iter().find(|system| system.name() == "veselova").expect("it is in the table");
    let errors = system.errors(Regime::Masses);
    let [_, balanced, _] = errors.levels;
    let told = format!("{errors:?}");
    assert!(balanced.median < GIVEN_AWAY * errors.conditioning.median, "{told}");
    // the worst is within what the inputs explain, at the same place
    assert!(errors.unexplained[1] < GIVEN_AWAY, "{told}");
}

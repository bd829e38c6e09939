//! Every regular state has a finite derivative, as accurate as its inputs allow.

use nh_accuracy::regular::PLACES;
use nh_accuracy::systems;

/// How many units of round-off, as carried on from the inputs, a derivative may be off. Some hundred
/// operations, each rounded, stay below; a form that divides by what vanishes does not.
const ALLOWED: f64 = 16.0;

#[test]
fn every_regular_state_is_finite_and_accurate() {
    for system in systems::all() {
        let found = system.regular_states();
        let told = format!("{}: {found:?}", system.name());
        assert!(found.regular > PLACES / 2, "{told}");
        assert_eq!((found.infinite, found.infinite_in_f32), (0, 0), "{told}");
        assert!(found.growth < ALLOWED && found.growth_of_f32 < ALLOWED, "{told}");
        // a difference over a step of 1e-10, in 31 digits
        assert!(found.twins_differ < 1e-12, "{told}");
    }
}

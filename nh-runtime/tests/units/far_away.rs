//! Implicit steps of fixed length beside a component that is large, and in small units: equations are solved to the digits
//! of each component, or refused wherever they are refused alone.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::problems::Four;

/// How far something has come, and something that turns in any unit.
struct Turning {
    unit: f64,
}

impl Dynamics for Turning {
    type State = Four<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, Four([_, y, ..]): &Four<f64>, (): &()) -> Four<f64> {
        let y = y / self.unit;
        Four([0.37, (-3.0 * y * y * y + y.cos() - 2.0 * y.sin()) * self.unit, 0.0, 0.0])
    }
}

fn the_same<M: Method<Turning>>(method: impl Fn() -> M) {
    let end = |road: f64, unit: f64, start: f64| {
        let mut sim = Integrator::new(Turning { unit }, method(), 0.0, Four([road, start * unit, 0.0, 0.0]));
        let end = sim.advance_to(3.0);
        end.is_ok().then(|| sim.state().0[1] / unit)
    };
    for start in [2.0, 0.5, -0.1, 0.0] {
        let plain = end(0.0, 1.0, start);
        for (road, unit) in [
            (1e3, 1.0),
            (1e9, 1.0),
            (1e12, 1.0),
            (1e15, 1.0),
            (0.0, 1e-8),
            (1.0, 1e-12),
            (1e12, 1e-12),
            (0.0, 1e8),
        ] {
            let found = end(road, unit, start);
            let is_same = match (found, plain) {
                (Some(found), Some(plain)) => (found - plain).abs() <= 1e-14,
                (found, plain) => found.is_none() && plain.is_none(),
            };
            assert!(is_same, "{road:e} {unit:e} {start}: {found:?} {plain:?}");
        }
    }
}

#[test]
fn a_large_component_excuses_no_other() {
    for step in [0.01, 0.1, 0.3] {
        the_same(|| ImplicitMidpoint::new(step));
        the_same(|| GaussLegendre4::new(step));
        the_same(|| GaussLegendre6::new(step));
    }
}

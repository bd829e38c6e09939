//! That difference quotients serve as well as the Jacobian itself, whatever the units.

use nonholonomic::prelude::*;
use nonholonomic::{Method, Statistics};

use crate::problems::{Four, Kind, Problem};
use crate::scaled::{Scaled, multiplied};
use crate::{Change, Part};

/// Units far apart: kilometres and micrometres, radians, tons in a microsecond.
const FAR_APART: [Change; 6] = [
    Change { part: Part::EachComponent, time: 0, state: [0; 4], other: 0 },
    // a hundred quintillions, and as small a share of one
    Change { part: Part::EachComponent, time: 0, state: [66; 4], other: 0 },
    Change { part: Part::EachComponent, time: 0, state: [-66; 4], other: 0 },
    Change { part: Part::EachComponent, time: 0, state: [20, 0, 0, 20], other: 0 },
    Change { part: Part::EachComponent, time: -20, state: [-30, 10, 0, 5], other: 0 },
    Change { part: Part::EachComponent, time: 31, state: [0, 0, 40, -10], other: 0 },
];

/// The end of a motion, in its own units, and what it cost.
fn end<M: Method<Scaled<Problem<f64>>>>(
    kind: Kind,
    change: &Change,
    horizon: f64,
    method: impl Fn(Four<f64>, Four<f64>) -> M,
) -> ([f64; 4], Statistics) {
    let problem = Problem::new(kind);
    let scaled = Scaled::new(problem, change);
    let (course, _) = problem.course();
    let negligible = multiplied(&problem.negligible(), &scaled.units);
    let start = multiplied(&course.start, &scaled.units);
    let method = method(Four([1e-6; 4]), Four(negligible.0.map(|atol| 1e-2 * atol)));
    let mut sim = Integrator::new(scaled, method, course.from * scaled.time, start).max_steps(20_000);
    sim.advance_to(course.to.min(horizon) * scaled.time)
        .unwrap_or_else(|error| panic!("{kind:?} {change:?}: {error}"));
    let mut end = sim.state().0;
    end.iter_mut().zip(scaled.units.0).for_each(|(x, unit)| *x /= unit);
    (end, sim.statistics())
}

#[test]
fn quotients_serve_as_well_as_the_jacobian() {
    let mut report = String::new();
    // with the tenths of all steps that may be added
    macro_rules! compare {
        ($($method:ident to $horizon:literal: $more:literal)*) => {$(
            for kind in Kind::ALL {
                let exact = |rtol, atol| $method::new().tolerances(rtol, atol).with_jacobian();
                let (expected, cost) = end(kind, &FAR_APART[0], $horizon, exact);
                for change in &FAR_APART {
                    let (found, ours) = end(kind, change, $horizon, |rtol, atol| $method::new().tolerances(rtol, atol));
                    let permitted = Problem::<f64>::new(kind).negligible().0;
                    let off = (0..4).fold(0.0_f64, |most, i| {
                        most.max((found[i] - expected[i]).abs() / (1e-2 * permitted[i] + 1e-6 * expected[i].abs()))
                    });
                    let tries = |s: &Statistics| s.steps + s.rejected;
                    if off > 30.0 || tries(&ours) > tries(&cost) + tries(&cost) * $more / 10 + 5 {
                        report += concat!("\n", stringify!($method));
                        report += &std::format!(
                            " {kind:?} {:?}: {off:.1e} tolerances, {} steps for {}",
                            change.state, tries(&ours), tries(&cost)
                        );
                    }
                }
            }
        )*};
    }
    // the order of the latter rests on the Jacobian, of which quotients have half the digits: E5 takes more steps, and
    // beyond the horizon loses accuracy
    compare! { Radau5 to 1e9: 1 Rodas5P to 1e5: 15 }
    assert!(report.is_empty(), "{report}");
}

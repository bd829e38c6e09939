//! That difference quotients serve as well as the Jacobian itself, whatever the units.

use nonholonomic::Method;
use nonholonomic::prelude::*;

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

/// The starts that are compared. They differ by some rounding errors, since what one run of E5 ends with is a matter of
/// luck, with the Jacobian as without.
const STARTS: i32 = 5;

/// The ends of a motion from all starts, in its own units, and the steps that were tried.
fn ends<M: Method<Scaled<Problem<f64>>>>(
    kind: Kind,
    change: &Change,
    rtol: f64,
    method: impl Fn(Four<f64>, Four<f64>) -> M,
) -> (Vec<[f64; 4]>, u64) {
    let problem = Problem::new(kind);
    let scaled = Scaled::new(problem, change);
    let (course, _) = problem.course();
    let negligible = multiplied(&problem.negligible(), &scaled.units);
    let mut steps = 0;
    let mut end = |k: i32| {
        let mut start = multiplied(&course.start, &scaled.units);
        start.0.iter_mut().for_each(|x| *x *= 1.0 + 1e-14 * f64::from(k - STARTS / 2));
        let method = method(Four([rtol; 4]), Four(negligible.0.map(|atol| 1e4 * rtol * atol)));
        let mut sim = Integrator::new(scaled, method, course.from * scaled.time, start).max_steps(20_000);
        sim.advance_to(course.to.min(HORIZON) * scaled.time)
            .unwrap_or_else(|error| panic!("{kind:?} {change:?}: {error}"));
        steps += sim.statistics().steps + sim.statistics().rejected;
        let mut end = sim.state().0;
        end.iter_mut().zip(scaled.units.0).for_each(|(x, unit)| *x /= unit);
        end
    };
    ((0..STARTS).map(&mut end).collect(), steps)
}

/// The end of the motions.
const HORIZON: f64 = 1e9;
/// The relative tolerance that is compared, and that of the solution.
const RTOL: f64 = 1e-6;
const FINE: f64 = 1e-9;

/// The middle one of the errors, in tolerances.
fn middle(kind: Kind, ends: &[[f64; 4]], solution: &[f64; 4]) -> f64 {
    let negligible = Problem::<f64>::new(kind).negligible().0;
    let permitted = |i: usize| 1e-2 * negligible[i] + RTOL * solution[i].abs();
    let off =
        |end: &[f64; 4]| (0..4).map(|i| (end[i] - solution[i]).abs() / permitted(i)).fold(0.0, f64::max);
    let mut errors: Vec<f64> = ends.iter().map(off).collect();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() / 2]
}

#[test]
fn quotients_serve_as_well_as_the_jacobian() {
    let mut report = String::new();
    for kind in Kind::ALL {
        let exact = |rtol, atol| Radau5::new().tolerances(rtol, atol).with_jacobian();
        let (solutions, _) = ends(kind, &FAR_APART[0], FINE, exact);
        macro_rules! compare {
            ($($method:ident)*) => {$(
                let exact = |rtol, atol| $method::new().tolerances(rtol, atol).with_jacobian();
                let (expected, cost) = ends(kind, &FAR_APART[0], RTOL, exact);
                let usual = middle(kind, &expected, &solutions[0]);
                for change in &FAR_APART {
                    let (found, ours) = ends(kind, change, RTOL, |rtol, atol| $method::new().tolerances(rtol, atol));
                    let off = middle(kind, &found, &solutions[0]);
                    if off > (3.0 * usual).max(30.0) || ours > cost + cost / 10 + 5 {
                        report += concat!("\n", stringify!($method));
                        report += &std::format!(
                            " {kind:?} {:?}: {off:.1e} tolerances for {usual:.1e}, {ours} steps for {cost}",
                            change.state
                        );
                    }
                }
            )*};
        }
        compare! { Radau5 Rodas5P }
    }
    assert!(report.is_empty(), "{report}");
}

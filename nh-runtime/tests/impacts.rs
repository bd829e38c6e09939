//! Impacts against what is known of them, mathematics (50), and the law of units, mathematics (29).

// bits and exact zeros are meant
#![allow(clippy::float_cmp)]

use core::ops::ControlFlow;

use nonholonomic::impacts::{End, Impact, ImpactError, Rows, advance_with_impacts, strike};
use nonholonomic::prelude::*;
use nonholonomic::{D, Dynamics, Method};

/// A particle in the plane, in a field.
#[derive(Clone, Copy, Debug)]
struct Particle {
    mass: f64,
    field: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Place([f64; 4]);

impl State for Place {
    type Scalar = f64;
    type Dim = D<4>;
    fn to_array(&self) -> [f64; 4] {
        self.0
    }
    fn from_array(x: [f64; 4]) -> Self {
        Self(x)
    }
    fn names() -> [&'static str; 4] {
        ["x", "y", "u", "v"]
    }
}

impl Dynamics for Particle {
    type State = Place;
    type Input = ();
    fn derivative(&self, _t: f64, Place([_, _, u, v]): &Place, (): &()) -> Place {
        Place([*u, *v, 0.0, -self.field])
    }
}

/// Walls with these normals, inside of which the particle is; `None` for a wall that it is to stop at.
struct Walls<const R: usize> {
    normals: [[f64; 2]; R],
    bilateral: bool,
    restitution: f64,
}

impl<const R: usize> Impact<Particle, R> for Walls<R> {
    fn names(&self) -> [&'static str; R] {
        core::array::from_fn(|i| ["first", "second", "third", "fourth", "fifth", "sixth", "seventh"][i])
    }
    fn restitution(&self, _system: &Particle) -> f64 {
        self.restitution
    }
    fn is_homogeneous(&self) -> bool {
        true
    }
    fn gaps(&self, _system: &Particle, _t: f64, Place([x, y, ..]): &Place) -> [Option<f64>; R] {
        self.normals.map(|[a, b]| (!self.bilateral).then_some(a * x + b * y))
    }
    fn rows(&self, system: &Particle, _t: f64, Place([_, _, u, v]): &Place) -> Rows<f64, [f64; 4], R> {
        let n = &self.normals;
        Rows {
            approach: n.map(|[a, b]| a * u + b * v),
            response: n.map(|[a, b]| [0.0, 0.0, a / system.mass, b / system.mass]),
            mobility: core::array::from_fn(|i| {
                core::array::from_fn(|j| (n[i][0] * n[j][0] + n[i][1] * n[j][1]) / system.mass)
            }),
        }
    }
}

const HEAVY: Particle = Particle { mass: 3.0, field: 9.81 };

fn energy(system: &Particle, Place([_, y, u, v]): &Place) -> f64 {
    system.mass * (0.5 * (u * u + v * v) + system.field * y)
}

#[test]
fn bilateral_rows_project_and_lose_what_is_said() {
    let edge = |restitution| Walls { normals: [[0.6, 0.8]], bilateral: true, restitution };
    let before = Place([1.0, 2.0, 0.3, -0.7]);
    for restitution in [0.0, 0.4, 1.0] {
        let struck = strike(&HEAVY, &edge(restitution), 0.0, &before, 0.0).unwrap();
        let along = |Place([_, _, u, v]): &Place| (0.6 * u + 0.8 * v, 0.8 * u - 0.6 * v);
        let ((s, slip), (s_after, slip_after)) = (along(&before), along(&struck.after));
        assert!((s_after + restitution * s).abs() < 1e-15 && (slip - slip_after).abs() < 1e-15);
        assert_eq!(struck.after.0[..2], before.0[..2]);
        let lost = energy(&HEAVY, &before) - energy(&HEAVY, &struck.after);
        assert!((lost - struck.lost.unwrap()).abs() < 1e-14, "{lost} {:?}", struck.lost);
        assert!((lost - 0.5 * (1.0 - restitution * restitution) * s * s * HEAVY.mass).abs() < 1e-14);
    }
}

#[test]
fn in_a_corner_walls_push_together_or_one_alone() {
    // an acute corner: whatever is thrown into it ends there, without restitution
    let corner = |normals| Walls { normals, bilateral: false, restitution: 0.0 };
    let acute = corner([[0.0, 1.0], [1.0, -0.2]]);
    let struck = strike(&HEAVY, &acute, 0.0, &Place([0.0, 0.0, -1.0, -1.0]), 0.0).unwrap();
    assert!(struck.after.0.iter().all(|x| x.abs() < 1e-15), "{struck:?}");
    assert!(struck.impulses.iter().all(|mu| *mu > 0.0));
    // an obtuse one: it slides along the second wall, which turns it away from the first
    let obtuse = corner([[0.0, 1.0], [0.8, 0.6]]);
    let struck = strike(&HEAVY, &obtuse, 0.0, &Place([0.0, 0.0, -1.0, -0.1]), 0.0).unwrap();
    assert_eq!(struck.impulses[0], 0.0);
    let along = -0.6 + 0.8 * 0.1;
    assert!(
        (struck.after.0[2] - 0.6 * along).abs() < 1e-15 && (struck.after.0[3] + 0.8 * along).abs() < 1e-15
    );
    // the first wall is open at first, and closes by the push of the second
    let struck = strike(&HEAVY, &acute, 0.0, &Place([0.0, 0.0, -1.0, 0.05]), 0.0).unwrap();
    assert!(struck.after.0.iter().all(|x| x.abs() < 1e-15), "{struck:?}");
    // a wall that is left pushes nothing
    let struck = strike(&HEAVY, &acute, 0.0, &Place([0.0, 0.0, 1.0, 0.1]), 0.0).unwrap();
    assert_eq!((struck.impulses, struck.after), ([0.0; 2], struck.before));
}

/// The bounces of a ball that is dropped, and how its way has ended.
fn dropped(
    method: impl Method<Particle>,
    particle: Particle,
    start: Place,
    unit: f64,
) -> (u32, End<f64>, Place, u64) {
    let ground = Walls { normals: [[0.0, 1.0]], bilateral: false, restitution: 0.5 };
    let mut sim = Integrator::new(particle, method, 0.0, start);
    let mut bounces = 0;
    let end = advance_with_impacts(&mut sim, 100.0 * unit, &ground, 0.0, |_| {
        bounces += 1;
        ControlFlow::Continue(())
    });
    let end = end.unwrap_or_else(|error| panic!("{error}"));
    (bounces, end, *sim.state(), sim.statistics().steps)
}

#[test]
fn bounces_without_end_are_an_event_and_no_fall_through_the_ground() {
    fn check(name: &str, method: impl Method<Particle>) {
        let (bounces, end, Place([x, y, u, v]), steps) =
            dropped(method, HEAVY, Place([0.0, 1.0, 0.1, 0.0]), 1.0);
        let over = 3.0 * (2.0_f64 / 9.81).sqrt();
        let End::Accumulated { row: 0, time } = end else { panic!("{name}: {end:?}") };
        assert!((time - over).abs() < 1e-4, "{name}: {time} {over}");
        assert!(bounces > 15 && steps > u64::from(bounces), "{name}: {bounces}, {steps}");
        assert!(
            y.abs() < 1e-9 && v == 0.0 && (x - u * time).abs() < 1e-6 && u == 0.1,
            "{name}: {x} {y} {u} {v}"
        );
    }
    check("Dopri5", Dopri5::new().rtol(1e-9).atol(1e-12));
    check("Dop853", Dop853::new().rtol(1e-9).atol(1e-12));
    check("Rk4", Rk4::new(0.01));
    check("Radau5", Radau5::new().rtol(1e-9).atol(1e-12));
}

#[test]
fn units_change_nothing() {
    let method = |sigma: f64, tau: f64| {
        let units = [sigma, sigma, sigma / tau, sigma / tau];
        Dopri5::new().tolerances(Place([1e-9; 4]), Place(units.map(|unit| 1e-12 * unit)))
    };
    let (bounces, end, Place(state), steps) =
        dropped(method(1.0, 1.0), HEAVY, Place([0.0, 1.0, 0.1, 0.0]), 1.0);
    let End::Accumulated { time, .. } = end else { panic!("{end:?}") };
    for (s, t) in [(40, 0), (0, 30), (-100, 60), (200, -200)] {
        let (sigma, tau) = (2.0_f64.powi(s), 2.0_f64.powi(t));
        let particle = Particle { mass: HEAVY.mass, field: HEAVY.field * sigma / tau / tau };
        let start = Place([0.0, sigma, 0.1 * sigma / tau, 0.0]);
        let (again, end, Place([x, y, u, v]), more) = dropped(method(sigma, tau), particle, start, tau);
        let state_again = [x / sigma, y / sigma, u * tau / sigma, v * tau / sigma];
        assert_eq!((again, state_again, more), (bounces, state, steps), "2^{s}, 2^{t}");
        assert_eq!(end, End::Accumulated { row: 0, time: time * tau }, "2^{s}, 2^{t}");
    }
}

#[test]
fn what_has_no_solution_is_told() {
    let walls = |normals, restitution| Walls { normals, bilateral: false, restitution };
    let into = Place([0.0, 0.0, -1.0, -1.0]);
    let told = |refused: Result<_, ImpactError>| match refused {
        Err(error) => error.to_string(),
        Ok(()) => String::new(),
    };
    let strike = |walls: &Walls<2>, at: &Place| told(strike(&HEAVY, walls, 0.5, at, 0.0).map(|_| ()));
    assert_eq!(
        strike(&walls([[0.0, 1.0], [0.0, 2.0]], 0.0), &into),
        "the row `second` is a combination of the others on the constraints at t = 0.5, so that its impulse is not \
         determined: leave it out"
    );
    assert_eq!(
        strike(&walls([[0.0, 1.0], [1.0, 0.0]], 1.5), &into),
        "the coefficient of restitution is 1.5, but has to be from 0 to 1"
    );
    assert_eq!(
        strike(&walls([[0.0, f64::NAN], [1.0, 0.0]], 0.0), &into),
        "the row `first` has a number that is not finite at t = 0.5: look at the last good state, and at the \
         parameters"
    );
    // in a narrow corner a ball goes to and fro more often than eight times
    let narrow = walls([[0.0, 1.0], [0.02, -1.0]], 1.0);
    assert_eq!(
        strike(&narrow, &Place([0.0, 0.0, -1.0, 0.1])),
        "the row `second` still closes at t = 0.5 after 8 jumps in one instant: give less restitution, or let the \
         rows land together"
    );
    let seven = Walls { normals: [[0.0, 1.0]; 7], bilateral: false, restitution: 0.0 };
    assert_eq!(
        told(nonholonomic::impacts::strike(&HEAVY, &seven, 0.0, &into, 0.0).map(|_| ())),
        "the impact has 7 rows, more than the six that are tried in all combinations: tell those apart that cannot \
         be closed together"
    );
}

/// A ground at some height, which rises along x. It tells nothing of the sizes of what its gap is a difference of.
struct Ground {
    height: f64,
    slope: f64,
    restitution: f64,
}

impl Impact<Particle, 1> for Ground {
    fn names(&self) -> [&'static str; 1] {
        ["ground"]
    }
    fn restitution(&self, _system: &Particle) -> f64 {
        self.restitution
    }
    fn gaps(&self, _system: &Particle, _t: f64, Place([x, y, ..]): &Place) -> [Option<f64>; 1] {
        [Some(y - self.slope * x - self.height)]
    }
    fn rows(&self, system: &Particle, _t: f64, Place([_, _, u, v]): &Place) -> Rows<f64, [f64; 4], 1> {
        Rows {
            approach: [v - self.slope * u],
            response: [[0.0, 0.0, -self.slope / system.mass, 1.0 / system.mass]],
            mobility: [[self.slope.mul_add(self.slope, 1.0) / system.mass]],
        }
    }
}

#[test]
fn a_ball_rests_on_any_ground_at_any_time_and_never_falls_through() {
    fn check(name: &str, method: &(impl Method<Particle> + Clone)) {
        for (height, slope) in [(0.0, 0.0), (10.0, 0.0), (1000.0, 0.0), (-3.3, -0.5), (0.4, 0.2)] {
            for restitution in [0.0, 0.02, 0.4, 0.9] {
                for clock in [0.0, 100.0, -0.5] {
                    let case = format!("{name}, at {height}, slope {slope}, e = {restitution}, from {clock}");
                    let ground = Ground { height, slope, restitution };
                    let start = Place([0.3, slope * 0.3 + height + 0.2, 0.0, 0.0]);
                    let mut sim = Integrator::new(HEAVY, method.clone(), clock, start).max_steps(20_000);
                    let mut bounces = 0;
                    let gap = |x: &Place| x.0[1] - slope * x.0[0] - height;
                    let mut run = |sim: &mut Integrator<_, _>| {
                        advance_with_impacts(sim, clock + 30.0, &ground, 0.0, |struck| {
                            bounces += 1;
                            let deep = -gap(&struck.after);
                            assert!(deep < 1e-11 * (1.0 + height.abs()), "{case}: {deep:e}");
                            ControlFlow::Continue(())
                        })
                    };
                    let end = run(&mut sim);
                    let Ok(End::Accumulated { row: 0, time }) = end else { panic!("{case}: {end:?}") };
                    assert!(
                        gap(sim.state()).abs() < 1e-9 * (1.0 + height.abs()),
                        "{case}: {:?}",
                        sim.state()
                    );
                    let Place([_, _, u, v]) = *sim.state();
                    assert!((v - slope * u).abs() < 1e-12, "{case}: {:?}", sim.state());
                    // it does not go on from there
                    let again = run(&mut sim);
                    assert!(matches!(again, Ok(End::Accumulated { row: 0, .. })), "{case}: {again:?}");
                    assert!(sim.time() - time < 1e-6, "{case}: {time} {}", sim.time());
                    assert!(bounces > 0, "{case}");
                }
            }
        }
    }
    check("Dopri5", &Dopri5::new().rtol(1e-9).atol(1e-12));
    check("Rk4", &Rk4::new(0.01));
    check("GaussLegendre6", &GaussLegendre6::new(0.05));
    check("Radau5", &Radau5::new().rtol(1e-9).atol(1e-12));
}

#[test]
fn a_start_on_the_ground_that_moves_into_it_jumps_at_once() {
    for height in [0.0, 10.0] {
        let start = Place([0.0, height, 0.5, -2.0]);
        for restitution in [0.5, 0.0] {
            let ground = Ground { height, slope: 0.0, restitution };
            let mut sim = Integrator::new(HEAVY, Dopri5::new(), 1.0, start);
            let mut speeds = Vec::new();
            let end = advance_with_impacts(&mut sim, 1.1, &ground, 0.0, |struck| {
                speeds.push((struck.time, struck.after.0[3]));
                ControlFlow::Continue(())
            });
            assert_eq!(speeds, [(1.0, 2.0 * restitution)], "{height}");
            if restitution > 0.0 {
                assert_eq!(end.unwrap(), End::Target);
                assert!((sim.state().0[1] - height - 0.1 * 1.0 + 0.5 * 9.81 * 0.01).abs() < 1e-12);
            } else {
                assert!(matches!(end, Ok(End::Accumulated { row: 0, .. })), "{end:?}");
            }
            // told to stop there, it stops there
            let mut sim = Integrator::new(HEAVY, Dopri5::new(), 1.0, start);
            let end = advance_with_impacts(&mut sim, 1.1, &ground, 0.0, |_| ControlFlow::Break(()));
            assert_eq!((end.unwrap(), sim.time()), (End::Stopped, 1.0));
        }
    }
}

#[test]
fn limits_hold_for_all_flights_together() {
    let ground = Ground { height: 0.0, slope: 0.0, restitution: 1.0 };
    let start = Place([0.0, 1.0, 0.0, 0.0]);
    let mut sim = Integrator::new(HEAVY, Rk4::new(0.1), 0.0, start).max_steps(50);
    let end = advance_with_impacts(&mut sim, 1e6, &ground, 0.0, |_| ControlFlow::Continue(()));
    let expected = IntegrationError::TooManySteps { time: sim.time(), target: 1e6, limit: 50 };
    assert!(matches!(end, Err(ImpactError::Integration(error)) if error == expected), "{end:?}");
}

#[test]
fn a_start_inside_that_moves_out_meets_the_ground_where_it_is() {
    let ground = Ground { height: 0.0, slope: 0.0, restitution: 0.5 };
    let start = Place([0.0, -0.1, 0.0, 2.0]);
    let mut sim = Integrator::new(HEAVY, Rk4::new(0.01), 0.0, start);
    let mut first = None;
    let end = advance_with_impacts(&mut sim, 1.0, &ground, 0.1, |struck| {
        first = Some(*struck);
        ControlFlow::Break(())
    });
    let struck = first.unwrap();
    let expected = (2.0 + (4.0_f64 - 2.0 * 9.81 * 0.1).sqrt()) / 9.81;
    assert!(end.unwrap() == End::Stopped && (struck.time - expected).abs() < 1e-12, "{struck:?} {expected}");
}

/// A run that ends within a few roundings of an impact has it or has it before it, and goes on from there as one that does
/// not end.
#[test]
fn a_target_at_an_impact_stops_no_ball() {
    fn check(name: &str, method: &(impl Method<Particle> + Clone)) {
        for (height, drop) in [(0.0, 1.0), (0.0, 2.0), (10.0, 1.0), (-3.3, 0.3)] {
            for clock in [0.0, 100.0] {
                let ground = Ground { height, slope: 0.0, restitution: 0.5 };
                let fall = (2.0 * drop / 9.81_f64).sqrt();
                for units in -20..=20 {
                    let first = clock + fall + f64::from(units) * f64::EPSILON * (clock + fall);
                    let start = Place([0.0, height + drop, 0.0, 0.0]);
                    let mut sim = Integrator::new(HEAVY, method.clone(), clock, start);
                    let mut bounces = 0;
                    for target in [first, clock + 1.5 * fall] {
                        let end = advance_with_impacts(&mut sim, target, &ground, 0.0, |_| {
                            bounces += 1;
                            ControlFlow::Continue(())
                        });
                        let case = format!("{name} to {height} by {drop} from {clock}, {units} units off");
                        assert!(matches!(end, Ok(End::Target)), "{case}: {end:?}");
                    }
                    // halfway through the second flight it is at its top
                    let Place([_, y, _, v]) = *sim.state();
                    assert!(bounces == 1 && v.abs() < 1e-6, "{name} to {height}, {units}: {bounces}, {v}");
                    assert!((y - height - 0.25 * drop).abs() < 1e-6, "{name} to {height}, {units}: {y}");
                }
            }
        }
    }
    check("Dopri5", &Dopri5::new().rtol(1e-9).atol(1e-12));
    check("Rk4", &Rk4::new(0.01));
    check("GaussLegendre6", &GaussLegendre6::new(0.05));
    check("Radau5", &Radau5::new().rtol(1e-9).atol(1e-12));
}

/// A ball at rest on the ground that is pulled away from it leaves it.
#[test]
fn what_is_pulled_off_the_ground_leaves_it() {
    fn check(name: &str, method: &(impl Method<Particle> + Clone)) {
        for (height, slope) in [(0.0, 0.0), (10.0, 0.0), (-3.3, 0.0), (0.3, 0.7), (1000.0, -0.2)] {
            for (clock, field) in [(0.0, -1.0), (0.3, -4.3), (100.0, -1e-3), (-7.0, -100.0)] {
                for x in [0.0, 0.3] {
                    let ground = Ground { height, slope, restitution: 0.5 };
                    let start = Place([x, slope * x + height, 0.0, 0.0]);
                    let particle = Particle { field, ..HEAVY };
                    let mut sim = Integrator::new(particle, method.clone(), clock, start);
                    let case = format!("{name}, at {height}, slope {slope}, from {clock} by {field}");
                    let end = advance_with_impacts(&mut sim, clock + 0.5, &ground, 0.0, |struck| {
                        panic!("{case}: {struck:?}")
                    });
                    assert!(matches!(end, Ok(End::Target)), "{case}: {end:?}");
                    let risen = sim.state().0[1] - start.0[1];
                    assert!((risen + field * 0.125).abs() < 1e-9 * (1.0 + height.abs()), "{case}: {risen}");
                }
            }
        }
    }
    check("Dopri5", &Dopri5::new().rtol(1e-9).atol(1e-12));
    check("Rk4", &Rk4::new(0.01));
    check("GaussLegendre6", &GaussLegendre6::new(0.05));
    check("Radau5", &Radau5::new().rtol(1e-9).atol(1e-12));
}

#[test]
fn impacts_are_not_undone() {
    let ground = Ground { height: 0.0, slope: 0.0, restitution: 1.0 };
    let mut sim = Integrator::new(HEAVY, Dopri5::new(), 0.0, Place([0.0, 1.0, 0.0, 0.0]));
    let run = |sim: &mut Integrator<_, _>, target| {
        advance_with_impacts(sim, target, &ground, 0.0, |_| ControlFlow::Continue(()))
    };
    assert_eq!(run(&mut sim, 1.0), Ok(End::Target));
    let there = *sim.state();
    let refused = run(&mut sim, 0.25).unwrap_err();
    assert_eq!((sim.time(), *sim.state()), (1.0, there));
    assert_eq!(
        refused.to_string(),
        "the way from t = 1.0 to 0.25 leads back in time, where impacts cannot be undone: start before them, or go back \
         to the last one with `advance_to`"
    );
    assert_eq!(run(&mut sim, 1.0), Ok(End::Target));
}

#[test]
fn a_gap_that_is_no_number_is_no_open_one() {
    let ground = Ground { height: 0.0, slope: 0.0, restitution: 1.0 };
    for y in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = strike(&HEAVY, &ground, 0.5, &Place([0.0, y, 0.0, -1.0]), 0.0);
        let expected = ImpactError::NotFinite { row: "ground", time: 0.5 };
        assert!(matches!(refused, Err(error) if error == expected), "{refused:?}");
    }
}

#[test]
fn a_row_that_no_impulse_moves_ahead_is_told_as_such() {
    let walls = Walls { normals: [[0.0, 1.0]], bilateral: false, restitution: 0.5 };
    let falling = Place([0.0, 0.0, 0.0, -1.0]);
    let negative = Particle { mass: -0.25, ..HEAVY };
    let refused = strike(&negative, &walls, 0.5, &falling, 0.0).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "an impulse of 1 along the row `first` changes its rate by -4.0 at t = 0.5, which has to be positive: look for a \
         mass that is not, and for constraints that hold the row"
    );
    // what takes no part is not asked
    let rising = Place([0.0, 1.0, 0.0, 1.0]);
    assert_eq!(strike(&negative, &walls, 0.5, &rising, 0.0).unwrap().after, rising);
    let nowhere = Walls { normals: [[0.0, 0.0]], ..walls };
    let refused = strike(&HEAVY, &nowhere, 0.5, &falling, 0.0);
    assert!(matches!(refused, Err(ImpactError::NoResponse { response: 0.0, .. })), "{refused:?}");
}

#[test]
fn the_gap_up_to_which_a_row_is_closed_is_a_length() {
    let ground = Ground { height: 0.0, slope: 0.0, restitution: 1.0 };
    let start = Place([0.0, 1.0, 0.0, -1.0]);
    for closed in [f64::NAN, f64::INFINITY, -1e-3] {
        let refused = strike(&HEAVY, &ground, 0.5, &start, closed).unwrap_err();
        assert_eq!(
            refused.to_string(),
            format!(
                "the gap up to which a row is closed is {closed:?}, but has to be a finite number that is not negative"
            )
        );
        let mut sim = Integrator::new(HEAVY, Dopri5::new(), 0.0, start);
        let run = advance_with_impacts(&mut sim, 1.0, &ground, closed, |_| ControlFlow::Continue(()));
        assert!(matches!(run, Err(ImpactError::Closed { .. })), "{run:?}");
        assert_eq!((sim.time(), *sim.state()), (0.0, start));
    }
}

#[test]
fn a_run_does_not_start_beyond_a_gap() {
    let ground = Ground { height: 0.0, slope: 0.0, restitution: 0.5 };
    let run = |y: f64, closed: f64| {
        let mut sim = Integrator::new(HEAVY, Dopri5::new(), 0.0, Place([3.0, y, 0.0, 1.0]));
        advance_with_impacts(&mut sim, 5.0, &ground, closed, |_| ControlFlow::Continue(()))
    };
    assert_eq!(
        run(-0.5, 0.0).unwrap_err().to_string(),
        "the gap of the row `ground` is -0.5 at t = 0.0, where the run starts: start where no gap is negative, or say how \
         far it may be by `closed`"
    );
    // within rounding, or what was said
    for (y, closed) in [(-1e-9, 0.0), (-1e-3, 2e-3)] {
        assert!(matches!(run(y, closed), Ok(End::Accumulated { row: 0, .. })), "{y}");
    }
}

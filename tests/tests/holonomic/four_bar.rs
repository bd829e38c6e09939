//! A four-bar linkage: a loop of links that closes in the plane.

use nonholonomic::prelude::*;

/// Crank, coupler, rocker, and the distance of the joints.
pub(super) const LENGTHS: [f64; 4] = [1.0, 3.0, 2.5, 3.0];

macro_rules! linkage {
    ($(#[$doc:meta])* $name:ident: $($more:tt)*) => {
        $(#[$doc])*
        #[nonholonomic(
            base { a, b, c }
            holonomic {
                closure: [
                    l1 * cos(a) + l2 * cos(b) - l3 * cos(c) - d,
                    l1 * sin(a) + l2 * sin(b) - l3 * sin(c)
                ] = 0;
            }
            lagrangian {
                J1 / 2 * der(a)^2 + J2 / 2 * der(b)^2 + J3 / 2 * der(c)^2
                + m / 2 * (l1^2 * der(a)^2 + l2^2 / 4 * der(b)^2 + l1 * l2 * cos(a - b) * der(a) * der(b))
            }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        pub(super) struct $name { l1: f64, l2: f64, l3: f64, d: f64, J1: f64, J2: f64, J3: f64, m: f64 }

        impl $name {
            pub(super) const MODEL: Self = Self { l1: LENGTHS[0], l2: LENGTHS[1], l3: LENGTHS[2], d: LENGTHS[3], J1: 0.1, J2: 0.3, J3: 0.4, m: 1.0 };
        }
    };
}

linkage!(
    /// All velocities, with multipliers.
    FourBar:
);
linkage!(
    /// The crank's velocity alone.
    OnTheCrank: independent { der(a) }
);

linkage!(
    /// With steps that keep the loop closed by themselves.
    Kept: emit { discrete_gradient, symmetric_projection }
);

/// A crank that turns at 20 rad/s.
fn start() -> FourBarState {
    let mut state = FourBarState { a: 0.2, b: 0.9, c: 1.6, a_dot: 20.0, b_dot: -10.0, c_dot: -8.0 };
    FourBar::MODEL.project(0.0, &mut state).unwrap();
    let crank = 20.0 / state.a_dot;
    state.a_dot *= crank;
    state.b_dot *= crank;
    state.c_dot *= crank;
    state
}

fn on_the_crank(state: FourBarState) -> OnTheCrankState {
    OnTheCrankState { a: state.a, b: state.b, c: state.c, a_dot: state.a_dot }
}

/// How far the loop is open.
fn opening(state: &FourBarState) -> f64 {
    let left = FourBar::MODEL.constraint_residual(0.0, state);
    left.closure[0].hypot(left.closure[1])
}

#[test]
fn accelerations_are_those_of_the_crank_alone() {
    let state = start();
    let all = FourBar::MODEL.derivative(0.0, &state, &());
    let one = OnTheCrank::MODEL.derivative(0.0, &on_the_crank(state), &());
    assert!((all.a_dot - one.a_dot).abs() < 1e-12 * one.a_dot.abs(), "{} {}", all.a_dot, one.a_dot);
    assert!((all.b - one.b).abs() < 1e-13 && (all.c - one.c).abs() < 1e-13);
    // E(a, a') = ½ I(a) a'², so that I a'' = −½ I' a'², where I' is a difference quotient of this energy
    let inertia = |a: f64| {
        let mut moved = FourBarState { a, ..state };
        // the rest follows the crank: two equations in b and c
        for _ in 0..50 {
            let left = FourBar::MODEL.constraint_residual(0.0, &moved);
            let model = FourBar::MODEL;
            let (sb, cb) = moved.b.sin_cos();
            let (sc, cc) = moved.c.sin_cos();
            let det = model.l2 * model.l3 * (sb * cc - cb * sc);
            moved.b += (model.l3 * cc * left.closure[0] + model.l3 * sc * left.closure[1]) / det;
            moved.c += (model.l2 * cb * left.closure[0] + model.l2 * sb * left.closure[1]) / det;
        }
        assert!(opening(&moved) < 1e-14);
        2.0 * OnTheCrank::MODEL.energy(0.0, &OnTheCrankState { a_dot: 1.0, ..on_the_crank(moved) })
    };
    let h = 1e-5;
    let slope = (inertia(state.a + h) - inertia(state.a - h)) / (2.0 * h);
    let expected = -0.5 * slope * state.a_dot.powi(2) / inertia(state.a);
    assert!((all.a_dot - expected).abs() < 1e-7 * expected.abs(), "{} {expected}", all.a_dot);
}

#[test]
fn the_loop_stays_closed_at_speed() {
    let energy = FourBar::MODEL.energy(0.0, &start());
    let method = Dopri5::new().rtol(1e-6).atol(1e-6);
    let mut sim = Integrator::new(FourBar::MODEL, method, 0.0, start());
    let mut crank = Integrator::new(OnTheCrank::MODEL, method, 0.0, on_the_crank(start()));
    for time in 1..=20 {
        sim.advance_to(f64::from(time)).unwrap();
        crank.advance_to(f64::from(time)).unwrap();
        assert!(opening(sim.state()) < 1e-12, "{:e}", opening(sim.state()));
        let left = OnTheCrank::MODEL.constraint_residual(0.0, crank.state());
        assert!(left.closure[0].hypot(left.closure[1]) < 1e-12);
    }
    let drift = (FourBar::MODEL.energy(0.0, sim.state()) / energy - 1.0).abs();
    assert!(drift < 1e-3, "{drift:e}");
    // without returns the loop opens
    let mut alone = Integrator::new(FourBar::MODEL, method, 0.0, start()).without_return();
    alone.advance_to(20.0).unwrap();
    assert!(opening(alone.state()) > 1e-4, "{:e}", opening(alone.state()));
}

#[test]
fn the_report_tells_of_the_loop() {
    let report = FourBar::REPORT;
    assert!(report.contains("position constraints: 2"), "{report}");
    assert!(report.contains("the state keeps every velocity"), "{report}");
    let report = OnTheCrank::REPORT;
    // cos b sin c − sin b cos c, where the rockers are in line
    assert!(report.contains("they break down where"), "{report}");
}

/// Energy and loop together, to round-off, for 200 turns of the crank.
#[test]
fn discrete_gradients_keep_the_loop_and_the_energy() {
    let FourBarState { a, b, c, a_dot, b_dot, c_dot } = start();
    let state = KeptState { a, b, c, a_dot, b_dot, c_dot };
    let energy = Kept::MODEL.energy(0.0, &state);
    let mut sim = Integrator::new(Kept::MODEL, DiscreteGradient::new(0.005), 0.0, state);
    let (mut worst, mut open) = (0.0_f64, 0.0_f64);
    while sim.time() < 63.0 {
        sim.step().unwrap();
        worst = worst.max((Kept::MODEL.energy(0.0, sim.state()) / energy - 1.0).abs());
        let left = Kept::MODEL.equations(0.0, sim.state());
        open = left[..2].iter().fold(open, |open, left| open.max(left.abs()));
    }
    // angles are a thousand radians at the end
    assert!(worst < 1e-12 && open < 1e-12, "{worst:e} {open:e}");
    let method = ImplicitMidpoint::new(0.005).symmetrically_projected();
    let mut sim = Integrator::new(Kept::MODEL, method, 0.0, state);
    sim.advance_to(63.0).unwrap();
    let left = Kept::MODEL.equations(0.0, sim.state());
    assert!(left[..2].iter().all(|left| left.abs() < 1e-12), "{left:?}");
}

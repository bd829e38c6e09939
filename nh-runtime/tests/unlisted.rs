//! Systems that are in no list, at settings that are in no list: every method that the declaration allows
//! against a reference at the limit of double precision.

#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nonholonomic::Method;
use nonholonomic::prelude::*;

/// A sleigh on a stiff spring, which leads from the origin to the point `b` ahead on its axis.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian {
        let px = x + b * cos(theta);
        let py = y + b * sin(theta);
        J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) - k / 2 * (px^2 + py^2)
    }
    constraints { v2 = 0; }
    assume { m > 0; J > 0; }
    emit { jacobian, taylor, discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
struct SprungSleigh {
    m: f64,
    J: f64,
    a: f64,
    b: f64,
    k: f64,
}

/// A ball of radius r that rolls inside an upright cylinder, its centre at distance R from the axis:
/// it does not fall, it bobs up and down.
#[nonholonomic(
    base   { phi, z }
    basis  { turn, rise, w[3] }
    anchor { der(phi) = turn; der(z) = rise; }
    brackets so(3) { w }
    lagrangian { m / 2 * (R^2 * turn^2 + rise^2) + I / 2 * dot(w, w) - m * g * z }
    constraints {
        R * turn = -r * w[2];
        rise = r * (w[1] * cos(phi) - w[0] * sin(phi));
    }
    assume { m > 0; I > 0; R > 0; r > 0; }
    emit { jacobian, taylor, discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
struct BallInCylinder {
    m: f64,
    I: f64,
    R: f64,
    r: f64,
    g: f64,
}

/// A thin disk that rolls and may fall over; `tilt` is zero where it lies flat.
#[nonholonomic(
    base { heading, tilt, roll, x, y }
    lagrangian {
        let s = sin(tilt);
        let c = cos(tilt);
        // the centre is r s above the ground, and beside the contact
        let vx = der(x) - r * (-s * der(tilt) * sin(heading) + c * der(heading) * cos(heading));
        let vy = der(y) + r * (-s * der(tilt) * cos(heading) - c * der(heading) * sin(heading));
        m / 2 * (vx^2 + vy^2 + r^2 * c^2 * der(tilt)^2)
            + A / 2 * (der(tilt)^2 + s^2 * der(heading)^2) + C / 2 * (der(roll) + c * der(heading))^2
            - m * g * r * s
    }
    constraints {
        der(x) = -r * cos(heading) * der(roll);
        der(y) = -r * sin(heading) * der(roll);
    }
    assume { m > 0; A > 0; C > 0; r > 0; }
    emit { jacobian, taylor, discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    A: f64,
    C: f64,
    r: f64,
    g: f64,
}

/// A vehicle on a rear blade and a steered front blade, at the distance l, whose fork turns by itself
/// against a spring.
#[nonholonomic(
    base   { heading, steer, x, y }
    lagrangian {
        let c = cos(heading);
        let s = sin(heading);
        // the centre of mass is ahead of the rear blade by a
        m / 2 * ((der(x) - a * s * der(heading))^2 + (der(y) + a * c * der(heading))^2)
            + J / 2 * der(heading)^2 + F / 2 * (der(heading) + der(steer))^2 - k / 2 * steer^2
    }
    constraints {
        der(y) * cos(heading) = der(x) * sin(heading);
        (der(y) + l * cos(heading) * der(heading)) * cos(heading + steer)
            = (der(x) - l * sin(heading) * der(heading)) * sin(heading + steer);
    }
    assume { m > 0; J > 0; F > 0; l > 0; }
    emit { jacobian, taylor, discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
struct Bicycle {
    m: f64,
    J: f64,
    F: f64,
    a: f64,
    l: f64,
    k: f64,
}

/// The largest error of a component, relative where it is above 1; infinite if one is not a number.
fn distance<X: State<Scalar = f64>>(a: &X, b: &X) -> f64 {
    let (a, b) = (a.to_array(), b.to_array());
    let each = a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| (a - b).abs() / b.abs().max(1.0));
    let worst = each.fold(0.0, Scalar::max);
    if worst.is_nan() { f64::INFINITY } else { worst }
}

/// A motion with its end to the last digits.
struct Motion<S: Dynamics> {
    name: String,
    system: S,
    start: S::State,
    end: f64,
    reference: S::State,
    /// The error below which round-off decides.
    round_off: f64,
    failures: Vec<String>,
}

impl<S> Motion<S>
where
    S: TaylorSeries + Jacobian + AlmostPoisson + Dynamics<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
{
    /// The end by the series of order 30, which another method confirms.
    fn new(name: String, system: S, start: S::State, end: f64) -> Self {
        let failures = Vec::new();
        let mut motion = Self { name, system, start, end, reference: start, round_off: 1e-10, failures };
        let series = Taylor::<f64, 31>::of_order(30).rtol(1e-15);
        motion.reference = motion.reach(series).expect("a smooth motion");
        let confirmed = motion.reach(Vern9::new().rtol(1e-14)).expect("a smooth motion");
        let apart = distance(&confirmed, &motion.reference);
        assert!(apart < 1e-11, "{}: {apart:e}", motion.name);
        motion
    }

    fn reach<M: Method<S>>(&self, method: M) -> Result<S::State, IntegrationError> {
        let mut sim = Integrator::new(self.system, method, 0.0, self.start);
        sim.advance_to(self.end)?;
        Ok(*sim.state())
    }

    /// The error at the end; infinite if it is not reached.
    fn error<M: Method<S>>(&mut self, method: &str, with: M) -> f64 {
        match self.reach(with) {
            Ok(end) => distance(&end, &self.reference),
            Err(error) => {
                self.failures.push(format!("{} by {method}: {error}", self.name));
                f64::INFINITY
            }
        }
    }

    /// An error of at most a thousand tolerances: what some hundred steps may add up to.
    fn adaptive<M: Method<S>>(&mut self, method: &str, of: impl Fn(f64) -> M, tolerances: &[f64]) {
        for &tolerance in tolerances {
            let error = self.error(method, of(tolerance));
            if error > 1e3 * tolerance {
                self.failures.push(format!("{} by {method}, {tolerance:e}: {error:e}", self.name));
            }
        }
    }

    /// An error that falls with the order, three quarters of it at least, as long as it is above round-off.
    fn fixed<M: Method<S>>(&mut self, method: &str, of: impl Fn(f64) -> M, h: f64, order: f64) {
        let (coarse, fine) = (self.error(method, of(h)), self.error(method, of(h / 2.0)));
        if !(fine < self.round_off || fine < coarse * 2.0_f64.powf(-0.75 * order)) {
            self.failures.push(format!("{} by {method}, {h:e}: {coarse:e} {fine:e}", self.name));
        }
    }

    /// As [`fixed`](Self::fixed), and the energy stays.
    fn energy_kept<M: Method<S>>(&mut self, method: &str, of: impl Fn(f64) -> M, h: f64, order: f64) {
        self.fixed(method, &of, h, order);
        let energy = |state: &S::State| self.system.energy(0.0, state);
        let before = energy(&self.start);
        if let Ok(end) = self.reach(of(h)) {
            let off = energy(&end) / before - 1.0;
            if off.is_nan() || off.abs() > 1e-12 {
                self.failures.push(format!("{} by {method}, {h:e}: energy {off:e}", self.name));
            }
        }
    }

    /// Every method; `h` is a step that resolves the motion.
    fn every_method(mut self, h: f64) {
        self.adaptive("Bs23", |tolerance| Bs23::new().rtol(tolerance), &[1e-4, 1e-6]);
        self.adaptive("Dopri5", |tolerance| Dopri5::new().rtol(tolerance), &[1e-4, 1e-9]);
        self.adaptive("Tsit5", |tolerance| Tsit5::new().rtol(tolerance), &[1e-4, 1e-9]);
        self.adaptive("Dop853", |tolerance| Dop853::new().rtol(tolerance), &[1e-4, 1e-8, 1e-12]);
        self.adaptive("Vern9", |tolerance| Vern9::new().rtol(tolerance), &[1e-4, 1e-8, 1e-12]);
        self.adaptive("Taylor", |tolerance| Taylor::new().rtol(tolerance), &[1e-4, 1e-8, 1e-12]);
        self.adaptive("Radau5", |tolerance| Radau5::new().rtol(tolerance), &[1e-4, 1e-8]);
        self.adaptive("Radau5 (∂f)", |tolerance| Radau5::new().rtol(tolerance).with_jacobian(), &[1e-8]);
        self.adaptive("Rodas5P", |tolerance| Rodas5P::new().rtol(tolerance), &[1e-4, 1e-8]);
        self.adaptive("Rodas5P (∂f)", |tolerance| Rodas5P::new().rtol(tolerance).with_jacobian(), &[1e-8]);
        self.fixed("Heun", Heun::new, h / 8.0, 2.0);
        self.fixed("Ralston", Ralston::new, h / 4.0, 3.0);
        self.fixed("Rk4", Rk4::new, h, 4.0);
        self.fixed("Rk4, compensated", |h| Rk4::new(h).compensated(), h, 4.0);
        self.fixed("Dop853::fixed", Dop853::fixed, h, 8.0);
        self.fixed("Vern9::fixed", Vern9::fixed, h, 9.0);
        self.fixed("ImplicitMidpoint", ImplicitMidpoint::new, h, 2.0);
        self.fixed("… of order 4", |h| ImplicitMidpoint::new(h).fourth_order(), h, 4.0);
        self.fixed("… of order 6", |h| ImplicitMidpoint::new(h).sixth_order(), h, 6.0);
        self.fixed("GaussLegendre4", GaussLegendre4::new, h, 4.0);
        self.fixed("GaussLegendre6", |h| GaussLegendre6::new(h).with_jacobian(), h, 6.0);
        self.energy_kept("DiscreteGradient", DiscreteGradient::new, h, 2.0);
        self.energy_kept("… (∂f)", |h| DiscreteGradient::new(h).with_jacobian(), h, 2.0);
        self.energy_kept("… of order 4", |h| DiscreteGradient::new(h).fourth_order(), h, 4.0);
        self.energy_kept("… of order 6", |h| DiscreteGradient::new(h).sixth_order(), h, 6.0);
        assert!(self.failures.is_empty(), "\n{}", self.failures.join("\n"));
    }
}

#[test]
fn a_sleigh_on_springs_soft_and_stiff() {
    for k in [3.0, 1e4, 1e8] {
        let system = SprungSleigh { m: 1.3, J: 0.4, a: 0.2, b: 0.7, k };
        let start = SprungSleighState { theta: 0.4, x: -0.64, y: -0.3, omega: 0.3, v1: 0.2 };
        let period = std::f64::consts::TAU / (k / 1.3).sqrt();
        Motion::new(format!("sleigh on a spring of {k:e}"), system, start, 2.0 * period)
            .every_method(period / 128.0);
    }
}

#[test]
fn a_ball_in_a_cylinder() {
    let system = BallInCylinder { m: 0.7, I: 0.02, R: 1.1, r: 0.25, g: 9.81 };
    let start = BallInCylinderState { phi: 0.2, z: 1.0, turn: 3.0, w_0: 0.5, w_1: -2.0 };
    Motion::new("ball in a cylinder".to_owned(), system, start, 3.0).every_method(0.02);
}

#[test]
fn a_disk_upright_and_nearly_flat() {
    let (m, r) = (2.0, 0.5);
    let system = Disk { m, A: m * r * r / 4.0, C: m * r * r / 2.0, r, g: 9.81 };
    for (tilt, end) in [(1.5, 1.5), (0.05, 0.2)] {
        let start = DiskState {
            heading: 0.3,
            tilt,
            heading_dot: 2.0,
            tilt_dot: 0.1,
            roll_dot: 6.0,
            ..DiskState::default()
        };
        let mut motion = Motion::new(format!("disk at {tilt}"), system, start, end);
        // the mass matrix is singular where it lies flat, as the square of the tilt
        motion.round_off = motion.round_off.max(1e-12 / (tilt * tilt));
        motion.every_method(end / 400.0);
    }
}

#[test]
fn a_bicycle_with_its_fork_ahead_and_across() {
    let system = Bicycle { m: 80.0, J: 9.0, F: 0.3, a: 0.5, l: 1.1, k: 20.0 };
    for (steer, steer_dot) in [(0.4_f64, 0.5), (1.57, 0.01)] {
        let (heading, heading_dot) = (0.2_f64, 0.7);
        let speed = heading_dot * system.l / steer.tan();
        let start = BicycleState {
            heading,
            steer,
            heading_dot,
            steer_dot,
            x_dot: speed * heading.cos(),
            y_dot: speed * heading.sin(),
            ..BicycleState::default()
        };
        Motion::new(format!("bicycle steered by {steer}"), system, start, 2.0).every_method(0.01);
    }
}

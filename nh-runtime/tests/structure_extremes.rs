//! Extremes for the methods that keep structure: scales, hostile numbers, repetition, single precision.

#![allow(clippy::float_cmp)] // exact repetition is meant

use nonholonomic::Method;
use nonholonomic::prelude::*;

/// The contact oscillator with all velocities in the state, with a mass and a stiffness.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k / 2 * (x^2 + y^2 + z^2) - epsilon / 2 * x^2 * z^2
    }
    constraints { der(x) = -b * y * der(z); }
    formulation { projected }
    conserved { total = m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + k / 2 * (x^2 + y^2 + z^2) + epsilon / 2 * x^2 * z^2; }
    assume { m > 0; k > 0; }
    emit { discrete_gradient, leapfrog, invariants, taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Contact<T> {
    m: T,
    k: T,
    epsilon: T,
    b: T,
}

/// Suslov's problem in general position.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 }
    constraints { w[2] = s * w[0]; }
    emit { discrete_gradient, euler_poincare_suslov, jacobian, taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Suslov<T> {
    I: [T; 3],
    s: T,
}

/// A motion of the contact oscillator of amplitude `size` and frequency √(k/m); with b = 1/size and
/// ε = 0.3 k/size² it is the same at every scale.
struct Swing {
    system: Contact<f64>,
    start: ContactState<f64>,
    frequency: f64,
}

impl Swing {
    fn new(m: f64, k: f64, size: f64) -> Self {
        let frequency = (k / m).sqrt();
        let speed = size * frequency;
        let start = ContactState {
            x: 0.3 * size,
            y: 0.5 * size,
            z: 0.4 * size,
            x_dot: -0.5 * 0.8 * speed,
            y_dot: speed,
            z_dot: 0.8 * speed,
        };
        Self { system: Contact { m, k, epsilon: 0.3 * k / (size * size), b: 1.0 / size }, start, frequency }
    }

    /// The error at the end of two periods against the motion at scale one, in units of the motion, and
    /// the relative error of the energy.
    fn errors<M: Method<Contact<f64>>>(&self, method: M, exact: &[f64; 6]) -> (f64, f64) {
        let mut sim = Integrator::new(self.system, method, 0.0, self.start);
        sim.advance_to(12.0 / self.frequency).unwrap();
        let (end, first) = (sim.state(), &self.start);
        let size = first.x / 0.3;
        let units = [size, size, size, size * self.frequency, size * self.frequency, size * self.frequency];
        let reached = end.to_array();
        let error = (0..6).fold(0.0_f64, |worst, i| worst.max((reached[i] / units[i] - exact[i]).abs()));
        let energy = self.system.energy(0.0, end) / self.system.energy(0.0, first) - 1.0;
        (error, energy.abs())
    }
}

#[test]
fn scales_of_mass_time_and_length() {
    let one = Swing::new(1.0, 1.0, 1.0);
    let mut sim = Integrator::new(one.system, Vern9::new().rtol(1e-14), 0.0, one.start);
    sim.advance_to(12.0).unwrap();
    let exact = sim.state().to_array();
    let mut failures = Vec::new();
    for m in [1e-9, 1e9] {
        for k in [1e-9, 1e9] {
            for size in [1e-6, 1e6] {
                let swing = Swing::new(m, k, size);
                let h = 0.05 / swing.frequency;
                let mut check = |name: &str, (error, energy): (f64, f64), [most, kept]: [f64; 2]| {
                    if !(error <= most && energy <= kept) {
                        failures.push(format!("{name}, m {m:e} k {k:e} size {size:e}: {error:e} {energy:e}"));
                    }
                };
                let (second, fourth, sixth) = ([2e-2, 1e-13], [3e-5, 1e-13], [1e-7, 1e-13]);
                check("DiscreteGradient", swing.errors(DiscreteGradient::new(h), &exact), second);
                check("compensated", swing.errors(DiscreteGradient::new(h).compensated(), &exact), second);
                check("Jacobian", swing.errors(DiscreteGradient::new(h).with_jacobian(), &exact), second);
                check("of order 4", swing.errors(DiscreteGradient::new(h).fourth_order(), &exact), fourth);
                check("of order 6", swing.errors(DiscreteGradient::new(h).sixth_order(), &exact), sixth);
                check("Conserving", swing.errors(Conserving::new(Rk4::new(h)), &exact), [3e-5, 1e-13]);
                check("ImplicitMidpoint", swing.errors(ImplicitMidpoint::new(h), &exact), [2e-2, 1e-3]);
                check("GaussLegendre6", swing.errors(GaussLegendre6::new(h), &exact), [1e-7, 1e-8]);
                check("ReflectedLeapfrog", swing.errors(ReflectedLeapfrog::new(h), &exact), [2e-2, 1e-2]);
                check("Projected", swing.errors(Projected::new(Rk4::new(h), 1), &exact), [1e-4, 1e-5]);
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} failures\n{}",
        failures.len(),
        failures[..failures.len().min(40)].join("\n")
    );
}

/// A weight on a rod.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * l * y }
    holonomic { rod: x^2 + y^2 = l^2; }
    emit { rattle }
)]
#[derive(Clone, Copy, Debug)]
struct Rod<T> {
    m: T,
    k: T,
    l: T,
}

/// As a motion of the contact oscillator, that of the weight is the same at every scale.
#[test]
fn scales_of_a_constrained_motion() {
    let run = |[m, k, l]: [f64; 3], of_order: u32| -> [f64; 5] {
        let frequency = (k / m).sqrt();
        let system = Rod { m, k, l };
        let [x_dot, y_dot] = [0.4, 0.3].map(|rate| rate * l * frequency);
        let start = RodState { x: 0.6 * l, y: -0.8 * l, x_dot, y_dot };
        let rattle = Rattle::new(0.05 / frequency);
        let end = 12.0 / frequency;
        let reached = match of_order {
            2 => at(system, start, rattle, end),
            4 => at(system, start, rattle.fourth_order(), end),
            _ => at(system, start, rattle.sixth_order(), end),
        };
        let off = (reached.x.hypot(reached.y) / l - 1.0).abs();
        assert!(off < 1e-14, "{m:e} {k:e} {l:e}, order {of_order}: {off:e}");
        let speed = l * frequency;
        let kept = system.energy(0.0, &reached) - system.energy(0.0, &start);
        [reached.x / l, reached.y / l, reached.x_dot / speed, reached.y_dot / speed, kept / (k * l * l)]
    };
    for (of_order, error) in [(2, 1e-2), (4, 1e-4), (6, 1e-5)] {
        let one = run([1.0; 3], of_order);
        assert!(one[4].abs() < error, "order {of_order}: {one:?}");
        for m in [1e-9, 1e9] {
            for k in [1e-9, 1e9] {
                for l in [1e-6, 1e6] {
                    let other = run([m, k, l], of_order);
                    let off = one.iter().zip(other).map(|(one, other)| (one - other).abs());
                    let off = off.fold(0.0, f64::max);
                    assert!(off < 1e-11, "{m:e} {k:e} {l:e}, order {of_order}: {off:e}");
                }
            }
        }
    }
}

fn at<M: Method<Rod<f64>>>(system: Rod<f64>, start: RodState<f64>, method: M, t: f64) -> RodState<f64> {
    let mut sim = Integrator::new(system, method, 0.0, start);
    sim.advance_to(t).unwrap();
    *sim.state()
}

#[test]
fn inertias_of_any_ratio() {
    for ratio in [1e-9, 1e-3, 1e3, 1e9] {
        for slope in [1e-6, 0.7, 1e3] {
            let system = Suslov { I: [1.0, ratio, 2.0], s: slope };
            let start = SuslovState { w_0: 0.6, w_1: 0.8 };
            // it turns at a rate of 1 + slope, and settles at one that the derivative shows
            let rate = system.derivative(0.0, &start, &());
            let h = 0.01 / rate.w_0.abs().max(rate.w_1.abs()).max(1.0 + slope);
            let exact = after(system, start, Vern9::new().rtol(1e-13), 100.0 * h);
            let size = exact.w_0.abs().max(exact.w_1.abs()).max(1.0);
            let off =
                |by: SuslovState<f64>| (by.w_0 - exact.w_0).abs().max((by.w_1 - exact.w_1).abs()) / size;
            let by_gradient = after(system, start, DiscreteGradient::new(h), 100.0 * h);
            let kept = system.energy(0.0, &by_gradient) / system.energy(0.0, &start) - 1.0;
            assert!(kept.abs() < 1e-12 && off(by_gradient) < 1e-2, "{ratio:e} {slope:e}: {kept:e} {exact:?}");
            // its error is h² times the ratio of the inertias
            if (1e-6..1e6).contains(&ratio) {
                let by_suslov = after(system, start, DiscreteSuslov::new(h), 100.0 * h);
                assert!(off(by_suslov) < 1e-2, "{ratio:e} {slope:e}: {exact:?} {by_suslov:?}");
            }
        }
    }
}

/// The momentum at the start; and in every iteration there, and on both sides of it for each of the two velocities.
#[test]
fn what_an_iteration_costs_is_counted() {
    let system = Suslov { I: [1.0, 2.0, 3.0], s: 0.7 };
    let mut sim = Integrator::new(system, DiscreteSuslov::new(0.05), 0.0, SuslovState { w_0: 0.6, w_1: 0.8 });
    sim.advance_to(1.0).unwrap();
    let cost = sim.statistics();
    assert!(cost.iterations >= 2 * cost.steps && cost.steps == 20, "{cost:?}");
    assert_eq!(cost.evaluations, cost.steps + 5 * cost.iterations);
    assert_eq!((cost.jacobians, cost.factorizations), (cost.iterations, cost.iterations));
}

fn after<M: Method<Suslov<f64>>>(
    system: Suslov<f64>,
    start: SuslovState<f64>,
    method: M,
    t: f64,
) -> SuslovState<f64> {
    let mut sim = Integrator::new(system, method, 0.0, start);
    sim.advance_to(t).unwrap();
    *sim.state()
}

/// Refuses what is hostile at once, and leaves the state unharmed.
fn refuses<M: Method<Contact<f64>> + Clone>(method: M) {
    let Swing { system, start, .. } = Swing::new(1.0, 1.0, 1.0);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut sim = Integrator::new(Contact { k: bad, ..system }, method.clone(), 0.0, start);
        assert!(matches!(sim.step(), Err(IntegrationError::Parameter(error)) if error.parameter == "k"));
        let mut sim = Integrator::new(system, method.clone(), 0.0, ContactState { y_dot: bad, ..start });
        let error = sim.advance_to(1.0).unwrap_err();
        assert!(matches!(error, IntegrationError::NonFiniteState { component: "y_dot", .. }));
        let mut sim = Integrator::new(system, method.clone(), bad, start);
        assert!(matches!(sim.step(), Err(IntegrationError::NonFiniteTime { .. })));
        let mut sim = Integrator::new(system, method.clone(), 0.0, start);
        assert!(matches!(sim.advance_to(bad), Err(IntegrationError::NonFiniteTime { .. })));
        assert_eq!((*sim.state(), sim.time()), (start, 0.0));
        sim.advance_to(0.1).unwrap();
    }
    // denormals are numbers
    let tiny = ContactState { x: 5e-324, y: -1e-310, z: 0.0, x_dot: 0.0, y_dot: 3e-320, z_dot: 0.0 };
    let mut sim = Integrator::new(system, method.clone(), 0.0, tiny);
    sim.advance_to(0.5).unwrap();
    assert!(sim.state().to_array().iter().all(|x| x.abs() < 1e-300));
    // at rest
    let mut sim = Integrator::new(system, method.clone(), 0.0, ContactState::default());
    sim.advance_to(0.5).unwrap();
    assert_eq!(*sim.state(), ContactState::default());
    // nothing to do, and back
    let mut sim = Integrator::new(system, method, 0.0, start);
    sim.advance_to(0.0).unwrap();
    assert_eq!(sim.statistics().steps, 0);
    sim.advance_to(0.5).unwrap();
    sim.advance_to(0.0).unwrap();
    let back = sim.state().to_array().into_iter().zip(start.to_array());
    assert!(back.into_iter().all(|(a, b)| (a - b).abs() < 1e-4) && sim.time() == 0.0, "{:?}", sim.state());
}

/// The same numbers from a run as a whole, step by step, after a reset, and from a clone.
fn repeats<M: Method<Contact<f64>> + Clone>(method: M) {
    let Swing { system, start, .. } = Swing::new(1.0, 1.0, 1.0);
    let mut whole = Integrator::new(system, method.clone(), 0.0, start);
    whole.advance_to(7.3).unwrap();
    let mut single = Integrator::new(system, method, 0.0, start);
    while single.time() != 7.3 {
        single.step_towards(7.3).unwrap();
        // looking at a step changes nothing
        let from = single.time();
        assert!(single.at(from).is_ok());
    }
    assert_eq!((whole.state(), whole.statistics()), (single.state(), single.statistics()));
    single.reset(0.0, start);
    single.advance_to(3.0).unwrap();
    let mut copy = single.clone();
    single.advance_to(7.3).unwrap();
    copy.advance_to(7.3).unwrap();
    assert_eq!((single.state(), single.statistics()), (copy.state(), copy.statistics()));
}

/// All methods of this room.
macro_rules! each {
    ($check:ident, $number:ty) => {
        let h = <$number as Scalar>::from_f64;
        $check(DiscreteGradient::new(h(0.01)));
        $check(DiscreteGradient::new(h(0.01)).with_jacobian().compensated());
        $check(DiscreteGradient::new(h(0.05)).fourth_order());
        $check(DiscreteGradient::new(h(0.05)).sixth_order());
        $check(ImplicitMidpoint::new(h(0.05)).fourth_order());
        $check(ImplicitMidpoint::new(h(0.05)).sixth_order().compensated());
        $check(ReflectedLeapfrog::new(h(0.01)));
        $check(Conserving::new(Rk4::new(h(0.05))));
        $check(Conserving::new(Dopri5::new()));
        $check(Projected::new(Rk4::new(h(0.05)), 3));
        $check(Projected::new(Dop853::new(), 1));
        $check(Projected::new(Radau5::new(), 1));
        $check(Taylor::new());
        $check(Rodas5P::new().with_jacobian());
    };
}

#[test]
fn hostile_numbers_are_refused_at_once() {
    each!(refuses, f64);
}

#[test]
fn runs_repeat_to_the_last_bit() {
    each!(repeats, f64);
}

#[test]
fn single_precision() {
    fn check<M: Method<Contact<f32>>>(method: M) {
        let system = Contact { m: 1.0_f32, k: 1.0, epsilon: 0.3, b: 1.0 };
        let start = ContactState { x: 0.3, y: 0.5, z: 0.4, x_dot: -0.4, y_dot: 1.0, z_dot: 0.8 };
        let before = system.energy(0.0, &start);
        let mut sim = Integrator::new(system, method, 0.0, start);
        sim.advance_to(20.0).unwrap();
        let energy = system.energy(0.0, sim.state()) / before - 1.0;
        assert!(energy.abs() < 2e-3, "{energy}");
        sim.advance_to(0.0).unwrap();
        assert!((sim.state().y - 0.5).abs() < 2e-2, "{:?}", sim.state());
    }
    each!(check, f32);
}

//! The bicycle of Meijaard, Papadopoulos, Ruina, Schwab (Proc. R. Soc. A 463, 2007, 1955–1982), declared by its geometry:
//! a position constraint that is not solved, four constraints of rolling, and mathematics (36) on the manifold that they
//! leave.

use nalgebra::{Matrix2, Matrix4};
use nonholonomic::prelude::*;
use nonholonomic::{ChartError, Jet, linearize_on_constraints};

nh_models::bicycle! {
    #[derive(Clone, Copy, Debug)]
    struct Bicycle<T>;
}

/// The published parameters, with gravity.
fn bicycle<T: Scalar>(g: f64) -> Bicycle<T> {
    nh_models::published_bicycle!(Bicycle, g, T::from_f64)
}

const GRAVITY: f64 = 9.81;

/// Upright and straight ahead.
fn straight(speed: f64) -> BicycleState<f64> {
    BicycleState { rear_dot: -speed / 0.3, ..BicycleState::default() }
}

/// What is kept: all coordinates but the pitch, and the rates of lean, steer and rear wheel.
const CHART: [usize; 10] = [0, 1, 2, 3, 5, 6, 7, 8, 9, 10];
/// Lean, steer and their rates among these.
const BALANCE: [usize; 4] = [3, 4, 7, 8];

/// Ż of lean, steer and their rates by these, and by the rest the largest entry of the rates'.
fn balance(g: f64, speed: f64) -> (Matrix4<f64>, f64) {
    let system = bicycle::<Jet<f64, 11>>(g);
    let state = straight(speed).to_array();
    let found = linearize_on_constraints(&system, 0.0, &state, &[], |[]| (), &CHART).unwrap();
    let others = (0..10).filter(|column| !BALANCE.contains(column));
    let strange =
        others.flat_map(|column| [7, 8].map(|row| found.a[(row, column)].abs())).fold(0.0, f64::max);
    (Matrix4::from_fn(|row, column| found.a[(BALANCE[row], BALANCE[column])]), strange)
}

/// M of the equations in lean and steer: twice the kinetic energy at unit rates, the bicycle standing.
fn mass() -> Matrix2<f64> {
    use BicycleCoordinate::{lean, rear, steer};
    let system = bicycle::<f64>(0.0);
    let energy = |lean_dot: f64, steer_dot: f64| {
        let guess = BicycleState { lean_dot, steer_dot, ..BicycleState::default() };
        let state = system.assemble_holding(0.0, &guess, &[lean, steer, rear]).unwrap();
        assert_eq!((state.lean_dot, state.steer_dot), (lean_dot, steer_dot));
        system.energy(0.0, &state)
    };
    let (first, second) = (energy(1.0, 0.0), energy(0.0, 1.0));
    let mixed = energy(1.0, 1.0) - first - second;
    Matrix2::new(2.0 * first, mixed, mixed, 2.0 * second)
}

fn is_near(found: &Matrix2<f64>, published: [f64; 4], what: &str) {
    let published = Matrix2::from_row_slice(&published);
    let size = published.abs().max();
    for (found, published) in found.iter().zip(published.iter()) {
        assert!((found - published).abs() <= 1e-12 * size.max(1.0), "{what}: {found} {published}");
    }
}

#[test]
fn the_matrices_are_the_published_ones() {
    let mass = mass();
    is_near(&mass, [80.81722, 2.319_413_322_087_09, 2.319_413_322_087_09, 0.297_841_881_996_86], "M");
    let block = |matrix: &Matrix4<f64>, column: usize| -(mass * matrix.fixed_view::<2, 2>(2, column));
    let (standing, strange) = balance(1.0, 0.0);
    assert!(strange < 1e-12, "{strange}");
    let k0 = [-80.95, -2.599_516_852_498_72, -2.599_516_852_498_72, -0.803_294_884_586_18];
    is_near(&block(&standing, 0), k0, "K0");
    let (moving, strange) = balance(0.0, 1.0);
    assert!(strange < 1e-12, "{strange}");
    is_near(&block(&moving, 0), [0.0, 76.597_345_895_732_22, 0.0, 2.654_315_237_946_04], "K2");
    let c1 = [0.0, 33.866_413_914_924_94, -0.850_356_414_569_78, 1.685_403_973_975_60];
    is_near(&block(&moving, 2), c1, "C1");
    // lean and steer change by their rates
    let rates = moving.fixed_view::<2, 4>(0, 0);
    assert!((rates - nalgebra::Matrix2x4::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)).abs().max() < 1e-14);
}

#[test]
fn eigenvalues_are_the_published_ones() {
    // the weave mode's real and imaginary part, capsize, castering; v = 0 has four real ones. At 5 m/s all published
    // digits, at the others ten decimals
    let published = [
        (3.0, (1.706_756_056_6, 2.315_824_473_8), -2.633_661_372_5, -10.351_014_672_5, 1e-9),
        (
            5.0,
            (-0.775_341_882_195_85, 4.464_867_713_788_23),
            -0.322_866_429_004_09,
            -14.078_389_692_798_22,
            1e-12,
        ),
        (10.0, (-3.720_168_404_4, 10.906_811_394_8), 0.161_053_386_5, -24.624_596_350_2, 1e-9),
    ];
    for (speed, (re, im), capsize, castering, tolerance) in published {
        // (λ² − 2 re λ + re² + im²) (λ − capsize) (λ − castering)
        let (p, q) = (-2.0 * re, re * re + im * im);
        let (r, s) = (-capsize - castering, capsize * castering);
        let expected = [q * s, p * s + q * r, q + p * r + s, p + r];
        for (found, expected) in characteristic(&balance(GRAVITY, speed).0).iter().zip(expected) {
            assert!((found - expected).abs() < tolerance * expected.abs(), "{speed} m/s: {found} {expected}");
        }
    }
    let (first, second): (f64, f64) = (3.131_643_247_9, 5.530_943_717_7);
    let [a0, a1, a2, a3] = characteristic(&balance(GRAVITY, 0.0).0);
    assert!((a0 / (first * second).powi(2) - 1.0).abs() < 1e-10, "{a0}");
    assert!((a2 / (first * first + second * second) + 1.0).abs() < 1e-10, "{a2}");
    assert!(a1.abs() < 1e-11 && a3.abs() < 1e-12, "{a1} {a3}");
}

/// a₀, a₁, a₂, a₃ of λ⁴ + a₃ λ³ + a₂ λ² + a₁ λ + a₀, by Faddeev and LeVerrier.
fn characteristic(a: &Matrix4<f64>) -> [f64; 4] {
    let mut coefficients = [0.0; 4];
    let mut m = Matrix4::identity();
    for k in 1..=4_u8 {
        let product = a * m;
        let coefficient = -product.trace() / f64::from(k);
        coefficients[4 - usize::from(k)] = coefficient;
        m = product + Matrix4::identity() * coefficient;
    }
    coefficients
}

/// Where a function of the speed changes its sign.
fn root(mut low: f64, mut high: f64, f: impl Fn([f64; 4]) -> f64) -> f64 {
    let at = |speed: f64| f(characteristic(&balance(GRAVITY, speed).0));
    let is_positive = at(low) > 0.0;
    for _ in 0..46 {
        let middle = 0.5 * (low + high);
        if (at(middle) > 0.0) == is_positive { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn weave_and_capsize_speeds_are_the_published_ones() {
    // Hurwitz: a pair of imaginary eigenvalues, and an eigenvalue 0
    let weave = root(4.0, 4.6, |[a0, a1, a2, a3]| a1 * a2 * a3 - a1 * a1 - a3 * a3 * a0);
    let capsize = root(5.5, 6.5, |[a0, ..]| a0);
    assert!((weave - 4.292_382_536_341).abs() < 1.5e-12, "{weave}");
    assert!((capsize - 6.024_262_015_388).abs() < 1.5e-12, "{capsize}");
}

#[test]
fn a_pushed_bicycle_steers_itself_upright() {
    let system = bicycle::<f64>(GRAVITY);
    let mut start = straight(4.6);
    start.lean_dot = 0.3;
    system.project(0.0, &mut start).unwrap();
    let energy = system.energy(0.0, &start);
    let mut sim = Integrator::new(system, Dopri5::new().rtol(1e-9).atol(1e-9), 0.0, start);
    let mut most: f64 = 0.0;
    for tenth in 1..=100 {
        sim.advance_to(f64::from(tenth) / 10.0).unwrap();
        most = most.max(sim.state().lean.abs());
        let left = system.constraint_residual(sim.time(), sim.state());
        assert!(left.ground.abs() < 1e-12, "{left:?}");
    }
    assert!(most > 0.05 && sim.state().lean.abs() < 0.02, "{most} {}", sim.state().lean);
    assert!((sim.state().y).abs() > 0.1, "a bicycle has no preferred direction");
    assert!((system.energy(10.0, sim.state()) / energy - 1.0).abs() < 1e-7);
    // and falls when it is slow
    let mut start = straight(2.0);
    start.lean_dot = 0.3;
    system.project(0.0, &mut start).unwrap();
    let mut sim = Integrator::new(system, Dopri5::new().rtol(1e-9).atol(1e-9), 0.0, start);
    let fallen = Events::new(|_, state: &BicycleState<f64>, &()| [state.lean.abs() - 1.0]);
    assert!(sim.advance_until(10.0, &fallen).unwrap().is_some());
}

#[test]
fn what_is_no_chart_is_refused() {
    let system = bicycle::<Jet<f64, 11>>(GRAVITY);
    let state = straight(5.0).to_array();
    let refused = |chart: &[usize; 10]| {
        linearize_on_constraints(&system, 0.0, &state, &[], |[]| (), chart).unwrap_err()
    };
    assert_eq!(refused(&[0, 1, 2, 3, 5, 6, 7, 8, 9, 11]), ChartError::NoSuchComponent { index: 11 });
    let few = linearize_on_constraints(&system, 0.0, &state, &[], |[]| (), &[3, 5, 8, 9]);
    assert_eq!(few.unwrap_err(), ChartError::WrongNumber { chosen: 4, free: 10 });
    assert!(
        few.unwrap_err().to_string().contains("4 components are chosen where the constraints leave 10 free")
    );
}

//! Explicit methods notice that equations are stiff, and only then.

use nonholonomic::prelude::*;
use nonholonomic::{D, Method};

use crate::problems::{Numbers, Problem, VanDerPol};

#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair<T>(T, T);

impl<T: Real> State for Pair<T> {
    type Scalar = T;
    type Dim = D<2>;
    fn to_array(&self) -> [T; 2] {
        [self.0, self.1]
    }
    fn from_array([x, y]: [T; 2]) -> Self {
        Self(x, y)
    }
    fn names() -> [&'static str; 2] {
        ["x", "y"]
    }
}

/// Prothero and Robinson's: x' = −rate (x − cos t) − sin t, beside it a slow swing.
struct Relaxing<T>(T);

impl<T: Real> Dynamics for Relaxing<T> {
    type State = Pair<T>;
    type Input = ();
    fn derivative(&self, t: T, x: &Pair<T>, (): &()) -> Pair<T> {
        let (sine, cosine) = t.sin_cos();
        Pair(-self.0 * (x.0 - cosine) - sine, -x.1)
    }
}

/// When stiffness was noticed in a run over twenty units of time.
fn noticed<T: Real, M: Method<Relaxing<T>>>(rate: f64, method: M) -> Option<f64> {
    let mut sim = Integrator::new(Relaxing(T::from_f64(rate)), method, T::ZERO, Pair(T::ONE, T::ONE));
    sim.advance_to(T::from_f64(20.0)).unwrap();
    sim.statistics().stiff_at
}

#[test]
fn fast_decay_is_noticed_by_every_explicit_method_that_looks() {
    for rate in [500.0, 1e4] {
        for (name, at) in [
            ("Dopri5", noticed::<f64, _>(rate, Dopri5::new().rtol(1e-4))),
            ("Tsit5", noticed::<f64, _>(rate, Tsit5::new().rtol(1e-4))),
            ("Dop853", noticed::<f64, _>(rate, Dop853::new().rtol(1e-6))),
            ("Vern9", noticed::<f64, _>(rate, Vern9::new().rtol(1e-6))),
            ("Dopri5 in f32", noticed::<f32, _>(rate, Dopri5::new().rtol(1e-3))),
        ] {
            assert!(at.is_some_and(|at| at > 0.0 && at < 18.0), "{name} at {rate}: {at:?}");
        }
        assert_eq!(noticed::<f64, _>(rate, Radau5::new().rtol(1e-6)), None);
        assert_eq!(noticed::<f64, _>(rate, Rodas5P::new().rtol(1e-6)), None);
    }
}

#[test]
fn it_is_noticed_where_hardly_more_than_rounding_is_permitted() {
    fn check<M: Method<VanDerPol> + Copy + core::fmt::Debug>(method: M) {
        let mut sim = Integrator::new(VanDerPol, method, 0.0, Numbers(VanDerPol::START));
        sim.advance_to(1e-3).unwrap();
        assert!(sim.statistics().stiff_at.is_some(), "{method:?}");
    }
    for rtol in [1e-4, 1e-6, 1e-8, 1e-10, 1e-11, 1e-12] {
        check(Dopri5::new().rtol(rtol));
        check(Tsit5::new().rtol(rtol));
        check(Dop853::new().rtol(rtol));
        check(Vern9::new().rtol(rtol));
    }
}

#[test]
fn slow_decay_is_not_stiff() {
    for rate in [0.1, 1.0, 3.0] {
        assert_eq!(noticed::<f64, _>(rate, Dopri5::new().rtol(1e-10)), None, "{rate}");
        assert_eq!(noticed::<f64, _>(rate, Dop853::new().rtol(1e-12)), None, "{rate}");
        assert_eq!(noticed::<f64, _>(rate, Vern9::new().rtol(1e-13)), None, "{rate}");
        assert_eq!(noticed::<f64, _>(rate, Tsit5::new().rtol(1e-8)), None, "{rate}");
    }
}

#[test]
fn fast_swings_are_not_stiff() {
    struct Swing(f64);
    impl Dynamics for Swing {
        type State = Pair<f64>;
        type Input = ();
        fn derivative(&self, t: f64, x: &Pair<f64>, (): &()) -> Pair<f64> {
            Pair(x.1 + (self.0 * t).sin(), -self.0 * self.0 * x.0)
        }
    }
    for rate in [1.0, 1e3] {
        let mut sim = Integrator::new(Swing(rate), Dopri5::new().rtol(1e-6), 0.0, Pair(1.0, 0.0));
        sim.advance_to(200.0 / rate).unwrap();
        assert!(sim.statistics().steps > 500);
        assert_eq!(sim.statistics().stiff_at, None, "{rate}");
        let mut sim = Integrator::new(Swing(rate), Vern9::new().rtol(1e-5), 0.0, Pair(1.0, 0.0));
        sim.advance_to(1000.0 / rate).unwrap();
        assert!(sim.statistics().steps > 100);
        assert_eq!(sim.statistics().stiff_at, None, "{rate}");
        let mut sim = Integrator::new(Swing(rate), Dop853::new().rtol(1e-4), 0.0, Pair(1.0, 0.0));
        sim.advance_to(1000.0 / rate).unwrap();
        assert_eq!(sim.statistics().stiff_at, None, "{rate}");
    }
}

/// Two swings, the second of which goes round once while the first does so `ratio` times.
struct Swings {
    ratio: f64,
}

impl Dynamics for Swings {
    type State = Numbers<4>;
    type Input = ();
    fn derivative(&self, _: f64, &Numbers([a, b, c, d]): &Numbers<4>, (): &()) -> Numbers<4> {
        Numbers([b * self.ratio, -a * self.ratio, d, -c])
    }
}

#[test]
fn swings_are_not_stiff_however_little_is_permitted_where_they_cross_zero() {
    fn check<M: Method<Swings> + Copy + core::fmt::Debug>(method: M) {
        for (sizes, ratio) in [([1.0, 1.0], 1.0), ([1.0, 1e-3], 7.3), ([1e4, 1.0], 0.13), ([1.0, 1e3], 2.6)] {
            let start = Numbers([0.6 * sizes[0], 0.8 * sizes[0], sizes[1], 0.0]);
            let told = format!("{method:?}: {sizes:?}, {ratio}");
            let mut sim = Integrator::new(Swings { ratio }, method, 0.0, start);
            sim.advance_to(1000.0 / ratio.max(1.0)).unwrap();
            let Statistics { stiff_at, switches, .. } = sim.statistics();
            assert_eq!((stiff_at, switches), (None, 0), "{told}");
        }
    }
    for digits in 3..10 {
        let rtol = 10.0_f64.powi(-digits);
        for share in [1.0, 1e-3, 1e-6, 0.0] {
            let atol = rtol * share;
            check(Dopri5::new().rtol(rtol).atol(atol));
            check(Tsit5::new().rtol(rtol).atol(atol));
            check(Dop853::new().rtol(rtol).atol(atol));
            check(Vern9::new().rtol(rtol).atol(atol));
            check(Auto::new().rtol(rtol).atol(atol));
        }
    }
}

#[test]
fn the_time_scales_with_its_unit() {
    struct Slower(f64);
    impl Dynamics for Slower {
        type State = Pair<f64>;
        type Input = ();
        fn derivative(&self, t: f64, x: &Pair<f64>, (): &()) -> Pair<f64> {
            let Pair(x, y) = Relaxing(1e3).derivative(t / self.0, x, &());
            Pair(x / self.0, y / self.0)
        }
    }
    let at = |unit: f64| {
        let method = Dopri5::new().rtol(1e-4).atol(1e-6).first_step(0.001 * unit);
        let mut sim = Integrator::new(Slower(unit), method, 0.0, Pair(1.0, 1.0));
        sim.advance_to(20.0 * unit).unwrap();
        sim.statistics().stiff_at.unwrap() / unit
    };
    assert_eq!(at(1.0).to_bits(), at(2.0_f64.powi(300)).to_bits());
    assert_eq!(at(1.0).to_bits(), at(2.0_f64.powi(-200)).to_bits());
}

/// A swing whose second component is so small that its tolerance is the absolute one: by differences of states that are
/// apart by chance its derivative changes by turns much and little, in units of the tolerance.
#[test]
fn swings_are_not_stiff_in_whatever_units() {
    struct Swing(f64);
    impl Dynamics for Swing {
        type State = Pair<f64>;
        type Input = ();
        fn derivative(&self, t: f64, &Pair(x, y): &Pair<f64>, (): &()) -> Pair<f64> {
            Pair(y / self.0 + 0.3 * (2.0 * t).sin(), -x * self.0)
        }
    }
    fn check<M: Method<Swing> + Copy + core::fmt::Debug>(unit: f64, method: M) {
        let mut sim = Integrator::new(Swing(unit), method, 0.0, Pair(1.0, 0.5 * unit));
        sim.advance_to(500.0).unwrap();
        let Statistics { stiff_at, switches, .. } = sim.statistics();
        assert_eq!((stiff_at, switches), (None, 0), "{unit} {method:?}");
    }
    for unit in [1.0, 0.1, 0.03, 0.01] {
        for rtol in [1e-3, 1e-4, 1e-5] {
            check(unit, Dopri5::new().rtol(rtol));
            check(unit, Tsit5::new().rtol(rtol));
            check(unit, Dop853::new().rtol(rtol));
            check(unit, Vern9::new().rtol(rtol * 0.1));
            check(unit, Auto::new().rtol(rtol));
        }
    }
}

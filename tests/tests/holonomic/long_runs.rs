//! Long runs of a linkage at speed, beside the same linkage in one coordinate.

use nonholonomic::D;
use nonholonomic::prelude::*;

use super::four_bar::{FourBar, FourBarCoordinate, FourBarState, LENGTHS, OnTheCrank, OnTheCrankState};

/// The linkage in the crank's angle: the others by the law of cosines.
#[derive(Clone, Copy, Debug)]
struct Minimal;

/// The crank's angle and rate.
#[derive(Clone, Copy, Debug)]
struct Crank([f64; 2]);

impl State for Crank {
    type Scalar = f64;
    type Dim = D<2>;

    fn to_array(&self) -> [f64; 2] {
        self.0
    }
    fn from_array(components: [f64; 2]) -> Self {
        Self(components)
    }
    fn names() -> [&'static str; 2] {
        ["a", "a_dot"]
    }
}

impl Minimal {
    fn linkage(Crank([a, a_dot]): &Crank) -> OnTheCrankState {
        let [l1, l2, l3, d] = LENGTHS;
        let (x, y) = (d - l1 * a.cos(), -l1 * a.sin());
        let far = x.hypot(y);
        let b = y.atan2(x) + ((l2 * l2 + far * far - l3 * l3) / (2.0 * l2 * far)).acos();
        let c = (l2 * b.sin() - y).atan2(l2 * b.cos() - x);
        OnTheCrankState { a: *a, b, c, a_dot: *a_dot }
    }
    fn energy(state: &Crank) -> f64 {
        OnTheCrank::MODEL.energy(0.0, &Self::linkage(state))
    }
}

impl Dynamics for Minimal {
    type State = Crank;
    type Input = ();

    fn derivative(&self, t: f64, state: &Crank, (): &()) -> Crank {
        let rate = OnTheCrank::MODEL.derivative(t, &Self::linkage(state), &());
        Crank([rate.a, rate.a_dot])
    }
}

#[test]
fn five_hundred_seconds_at_speed() {
    let guess = FourBarState { a: 0.2, b: 0.9, c: 1.6, a_dot: 20.0, ..FourBarState::default() };
    let start = FourBar::MODEL.assemble_holding(0.0, &guess, &[FourBarCoordinate::a]).unwrap();
    let method = Dopri5::new().rtol(1e-6).atol(1e-6);
    let mut sim = Integrator::new(FourBar::MODEL, method, 0.0, start);
    let own = Crank([start.a, start.a_dot]);
    let mut minimal = Integrator::new(Minimal, method, 0.0, own);
    let (given, of_one) = (FourBar::MODEL.energy(0.0, &start), Minimal::energy(&own));
    assert!((given / of_one - 1.0).abs() < 1e-14, "{given} {of_one}");
    let (mut open, mut lost, mut lost_by_one): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for second in 1..=500 {
        let time = f64::from(second);
        sim.advance_to(time).unwrap();
        minimal.advance_to(time).unwrap();
        let left = FourBar::MODEL.constraint_residual(time, sim.state());
        open = open.max(left.closure[0].hypot(left.closure[1]));
        lost = lost.max((FourBar::MODEL.energy(time, sim.state()) / given - 1.0).abs());
        lost_by_one = lost_by_one.max((Minimal::energy(minimal.state()) / of_one - 1.0).abs());
    }
    println!("open {open:e}, energy {lost:e}, in one coordinate {lost_by_one:e}");
    println!("{:?} {:?}", sim.statistics(), minimal.statistics());
    assert!(open <= 1e-12, "{open:e}");
    assert!(lost <= 1.2 * lost_by_one, "{lost:e} {lost_by_one:e}");
}

//! Hostile numbers in a control loop: every block gives finite results or a typed error, and after an
//! error it goes on as if the bad call had not been.

use nalgebra::{Matrix1, Matrix2, SMatrix, SVector, Vector1, Vector2, matrix, vector};
use nonholonomic::control::{
    ControlError, Correction, Cost, Estimate, Ilqr, Improvement, Model, Quadratic, Regulator, Unscented,
    angle_difference, held_noise, shooting_cost, shooting_gradient, zero_order_hold,
};

/// What a broken sensor, an overflow or a typing error puts in the place of a number.
const HOSTILE: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    -f64::MAX,
    1e160,
    -1e160,
    5e-324,
    1e-310,
    0.0,
    -0.0,
    -1.0,
];

fn all<const R: usize, const C: usize>(m: &SMatrix<f64, R, C>) -> bool {
    m.iter().all(|x| x.is_finite())
}

trait Finite {
    fn is_finite(&self) -> bool;
}
impl Finite for Regulator<f64, 2, 1> {
    fn is_finite(&self) -> bool {
        all(&self.gain) && all(&self.cost)
    }
}
impl Finite for (Matrix2<f64>, Vector2<f64>) {
    fn is_finite(&self) -> bool {
        all(&self.0) && all(&self.1)
    }
}
impl Finite for Matrix2<f64> {
    fn is_finite(&self) -> bool {
        all(self)
    }
}
impl Finite for Estimate<f64, 2> {
    fn is_finite(&self) -> bool {
        all(&self.mean) && all(&self.covariance)
    }
}
impl Finite for Correction<f64, 2> {
    fn is_finite(&self) -> bool {
        self.estimate.is_finite() && !self.surprise.is_nan()
    }
}
impl Finite for Improvement<f64> {
    fn is_finite(&self) -> bool {
        [self.cost, self.decrease, self.promised].iter().all(|x| x.is_finite())
    }
}

/// The result is finite, or an error; a number that is not finite is always an error.
fn judged<T: Finite>(block: &str, hostile: f64, result: &Result<T, ControlError>) {
    match result {
        Ok(value) => {
            assert!(value.is_finite(), "{block} of {hostile:e}: a result that is not finite");
            assert!(hostile.is_finite(), "{block} of {hostile:e}: no error");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A double integrator.
const A: Matrix2<f64> = matrix![1.0, 0.1; 0.0, 1.0];
const B: Vector2<f64> = vector![0.0, 0.1];
const R: Matrix1<f64> = matrix![1.0];
const CROSS: Vector2<f64> = vector![0.2, -0.1];

/// The linear system x' = a x + b u.
#[derive(Clone, Copy)]
struct Linear(Matrix2<f64>, Vector2<f64>);

impl Model<f64, 2, 1> for Linear {
    fn step(&self, _tick: usize, x: &Vector2<f64>, u: &Vector1<f64>) -> Vector2<f64> {
        self.0 * x + self.1 * u[0]
    }
    fn linearized(&self, _: usize, _: &Vector2<f64>, _: &Vector1<f64>) -> (Matrix2<f64>, Vector2<f64>) {
        (self.0, self.1)
    }
}

const COST: Quadratic<f64, 2, 1> = Quadratic {
    goal: vector![1.0, 0.0],
    state: vector![1.0, 1.0],
    input: vector![0.1],
    end: vector![1.0, 1.0],
};

/// A matrix with a bad number in one place.
fn with<const R: usize, const C: usize>(m: &SMatrix<f64, R, C>, place: usize, x: f64) -> SMatrix<f64, R, C> {
    let mut bad = *m;
    bad[place] = x;
    bad
}

#[test]
fn discretisation_and_regulation() {
    let q = Matrix2::identity();
    for x in HOSTILE {
        judged("hold of dt", x, &zero_order_hold(&A, &B, x));
        judged("regulator of r", x, &Regulator::stationary(&A, &B, &q, &matrix![x]));
        judged("before of r", x, &Regulator::before(&q, &A, &B, &q, &matrix![x]));
        judged("noise of dt", x, &held_noise(&A, &q, x));
        let cross = Regulator::stationary_with_cross;
        judged("cross of r", x, &cross(&A, &B, &q, &matrix![x], &CROSS));
        for place in 0..4 {
            let bad = with(&A, place, x);
            judged("hold of a", x, &zero_order_hold(&bad, &B, 0.1));
            judged("regulator of a", x, &Regulator::stationary(&bad, &B, &q, &R));
            judged("before of a", x, &Regulator::before(&q, &bad, &B, &q, &R));
            judged("noise of a", x, &held_noise(&bad, &q, 0.1));
            judged("noise of a and dt", x, &held_noise(&bad, &q, 1e-300));
            judged("cross of a", x, &cross(&bad, &B, &q, &R, &CROSS));
            let bad = with(&q, place, x);
            judged("regulator of q", x, &Regulator::stationary(&A, &B, &bad, &R));
            judged("before of q", x, &Regulator::before(&q, &A, &B, &bad, &R));
            judged("before of next", x, &Regulator::before(&bad, &A, &B, &q, &R));
            judged("noise of a density", x, &held_noise(&A, &bad, 0.1));
            judged("cross of q", x, &cross(&A, &B, &bad, &R, &CROSS));
        }
        for place in 0..2 {
            let bad = with(&B, place, x);
            judged("hold of b", x, &zero_order_hold(&A, &bad, 0.1));
            judged("regulator of b", x, &Regulator::stationary(&A, &bad, &q, &R));
            judged("before of b", x, &Regulator::before(&q, &A, &bad, &q, &R));
            judged("cross of b", x, &cross(&A, &bad, &q, &R, &CROSS));
            judged("cross of cross", x, &cross(&A, &B, &q, &R, &with(&CROSS, place, x)));
        }
    }
}

/// A finite difference is an angle; another is not a number, which every filter refuses.
#[test]
fn differences_of_angles() {
    let belief = Estimate { mean: vector![0.1, 0.0], covariance: Matrix2::identity() };
    for x in HOSTILE {
        for y in HOSTILE {
            let difference = angle_difference(x, y);
            assert_eq!(difference.is_finite(), (x - y).is_finite(), "{x:e} {y:e}");
            assert!(!difference.is_finite() || difference.abs() <= std::f64::consts::PI, "{x:e} {y:e}");
        }
        let innovation = vector![angle_difference(x, belief.mean[0])];
        judged("angle", x, &belief.corrected(&innovation, &matrix![1.0, 0.0], &R));
    }
}

#[test]
fn filters() {
    let one = Matrix2::identity();
    let good = Estimate { mean: vector![0.0, 0.0], covariance: one };
    let row = matrix![1.0, 0.0];
    let filter = Unscented::default();
    let seen = |x: Vector2<f64>| vector![x[0]];
    let less = |a: Vector1<f64>, b: Vector1<f64>| a - b;
    for x in HOSTILE {
        judged("innovation", x, &good.corrected(&vector![x], &row, &R));
        judged("noise of a sensor", x, &good.corrected(&vector![1.0], &row, &matrix![x]));
        judged("measured", x, &filter.corrected(&good, &vector![x], seen, less, &R));
        judged("noise", x, &filter.corrected(&good, &vector![1.0], seen, less, &matrix![x]));
        judged("observed", x, &filter.corrected(&good, &vector![1.0], |_| vector![x], less, &R));
        judged("spread", x, &Unscented { spread: x, ..filter }.predicted(&good, |x| A * x, &one));
        judged("shift", x, &Unscented { shift: x, ..filter }.predicted(&good, |x| A * x, &one));
        judged("kurtosis", x, &Unscented { kurtosis: x, ..filter }.predicted(&good, |x| A * x, &one));
        for place in 0..2 {
            let bad = Estimate { mean: with(&good.mean, place, x), ..good };
            judged("mean", x, &bad.corrected(&vector![1.0], &row, &R));
            judged("next mean", x, &good.predicted(bad.mean, &A, &one));
            judged("mean of points", x, &filter.predicted(&bad, |x| A * x, &one));
            judged("mean of seen points", x, &filter.corrected(&bad, &vector![1.0], seen, less, &R));
            judged("observation", x, &good.corrected(&vector![1.0], &with(&row, place, x), &R));
        }
        for place in 0..4 {
            let covariance = with(&one, place, x);
            let bad = Estimate { covariance, ..good };
            judged("covariance", x, &bad.predicted(good.mean, &A, &one));
            judged("covariance, corrected", x, &bad.corrected(&vector![1.0], &row, &R));
            judged("covariance of points", x, &filter.predicted(&bad, |x| A * x, &one));
            judged("covariance of seen points", x, &filter.corrected(&bad, &vector![1.0], seen, less, &R));
            judged("transition", x, &good.predicted(good.mean, &with(&A, place, x), &one));
            judged("noise of a step", x, &good.predicted(good.mean, &A, &covariance));
            judged("noise of points", x, &filter.predicted(&good, |x| A * x, &covariance));
            judged("map", x, &filter.predicted(&good, |p| with(&A, place, x) * p, &one));
        }
    }
}

#[test]
fn covariances_that_are_none_are_refused() {
    let one = Matrix2::identity();
    let row = matrix![1.0, 0.0];
    for covariance in
        [matrix![1.0, 2.0; 2.0, 1.0], -one, matrix![1.0, 0.0; 0.0, -0.1], matrix![0.0, 1.0; 1.0, 0.0]]
    {
        let bad = Estimate { mean: Vector2::zeros(), covariance };
        let good = Estimate { mean: Vector2::zeros(), covariance: one };
        let refused = |error: Option<ControlError>| {
            assert!(matches!(error, Some(ControlError::NotDefinite { .. })), "{covariance} {error:?}");
        };
        refused(bad.predicted(bad.mean, &A, &one).err());
        refused(bad.corrected(&vector![0.1], &row, &R).err());
        refused(good.predicted(bad.mean, &A, &covariance).err());
        refused(good.corrected(&vector![0.1, 0.2], &one, &covariance).err());
        refused(Unscented::default().predicted(&bad, |x| A * x, &one).err());
        refused(Unscented::default().predicted(&good, |x| A * x, &covariance).err());
        refused(Regulator::stationary(&A, &B, &covariance, &R).err());
    }
    let singular = matrix![1.0, 1.0; 1.0, 1.0];
    let weights = Regulator::stationary(&A, &one, &one, &singular);
    assert!(matches!(weights, Err(ControlError::NotDefinite { matrix: "r", .. })), "{weights:?}");
}

/// After every error the plan goes on as one that has not seen the bad number, bit for bit.
#[test]
fn plans() {
    let linear = Linear(A, B);
    let start = vector![0.3, 0.0];
    let fresh = || Ilqr::<f64, 2, 1, 20>::new(vector![0.1]).bounds(vector![-1.0], vector![1.0]);
    let mut expected = fresh();
    expected.improve(&linear, &COST, &start).unwrap();
    let after = |plan: &mut Ilqr<f64, 2, 1, 20>, block: &str, x: f64| {
        plan.improve(&linear, &COST, &start).unwrap();
        assert_eq!(plan.inputs(), expected.inputs(), "{block} of {x:e}");
        assert_eq!(plan.states(), expected.states(), "{block} of {x:e}");
        assert_eq!(plan.gains(), expected.gains(), "{block} of {x:e}");
    };
    for x in HOSTILE {
        let tried = |block: &str, model: Linear, cost: Quadratic<f64, 2, 1>, start: Vector2<f64>| {
            let mut plan = fresh();
            let result = plan.improve(&model, &cost, &start);
            judged(block, x, &result);
            if result.is_err() {
                after(&mut plan, block, x);
            }
        };
        for place in 0..2 {
            tried("start", linear, COST, with(&start, place, x));
            tried("model b", Linear(A, with(&B, place, x)), COST, start);
            tried("weight", linear, Quadratic { state: with(&COST.state, place, x), ..COST }, start);
            tried("weight at the end", linear, Quadratic { end: with(&COST.end, place, x), ..COST }, start);
            tried("goal", linear, Quadratic { goal: with(&COST.goal, place, x), ..COST }, start);
        }
        for place in 0..4 {
            tried("model a", Linear(with(&A, place, x), B), COST, start);
        }
        tried("weight of the input", linear, Quadratic { input: vector![x], ..COST }, start);
        let mut plan = fresh();
        judged("tolerance", x, &plan.solve(&linear, &COST, &start, x, 3));
        let mut plan = fresh();
        plan.inputs_mut()[7] = vector![x];
        judged("inputs", x, &plan.improve(&linear, &COST, &start));
        judged("first input", x, &Ilqr::<_, _, _, 20>::new(vector![x]).improve(&linear, &COST, &start));
    }
    let mut once = fresh();
    once.solve(&linear, &COST, &start, 1e-9, 0).unwrap();
    assert_eq!(once.inputs(), expected.inputs());
}

#[test]
fn bounds_leave_something_between_them() {
    let linear = Linear(A, B);
    let start = vector![0.3, 0.0];
    let bounded =
        |low: f64, high: f64| Ilqr::<f64, 2, 1, 20>::new(vector![0.1]).bounds(vector![low], vector![high]);
    for (low, high) in [(f64::NAN, 1.0), (-1.0, f64::NAN), (1.0, -1.0)] {
        let mut plan = bounded(low, high);
        assert!(plan.inputs().iter().all(all));
        let refused = plan.improve(&linear, &COST, &start);
        assert!(matches!(refused, Err(ControlError::Bounds { input: 0, .. })), "{refused:?}");
    }
    for (low, high) in [(f64::NEG_INFINITY, f64::INFINITY), (0.2, 0.2), (-5e-324, 5e-324)] {
        let mut plan = bounded(low, high);
        let last = plan.improve(&linear, &COST, &start).unwrap();
        assert!(last.is_finite());
        assert!(plan.inputs().iter().all(|u| low <= u[0] && u[0] <= high));
    }
}

/// A cost whose expansions, and nothing else, are bad.
struct Misled(f64, usize);

impl Cost<f64, 2, 1> for Misled {
    fn stage(&self, tick: usize, x: &Vector2<f64>, u: &Vector1<f64>) -> f64 {
        COST.stage(tick, x, u)
    }
    fn stage_expansion(
        &self,
        tick: usize,
        x: &Vector2<f64>,
        u: &Vector1<f64>,
    ) -> nonholonomic::control::Expansion<f64, 2, 1> {
        let mut expansion = COST.stage_expansion(tick, x, u);
        match self.1 {
            0 => expansion.x[0] = self.0,
            1 => expansion.u[0] = self.0,
            2 => expansion.xx[(0, 0)] = self.0,
            3 => expansion.ux[(0, 0)] = self.0,
            _ => expansion.uu[(0, 0)] = self.0,
        }
        expansion
    }
    fn end(&self, x: &Vector2<f64>) -> f64 {
        COST.end(x)
    }
    fn end_expansion(&self, x: &Vector2<f64>) -> nonholonomic::control::Expansion<f64, 2, 1> {
        COST.end_expansion(x)
    }
}

#[test]
fn derivatives_that_are_none() {
    let linear = Linear(A, B);
    let start = vector![0.3, 0.0];
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..5 {
            let mut plan = Ilqr::<f64, 2, 1, 20>::new(vector![0.1]);
            let before = *plan.inputs();
            let refused = plan.improve(&linear, &Misled(x, place), &start);
            assert!(matches!(refused, Err(ControlError::NotFinite { .. })), "{place} {x} {refused:?}");
            assert_eq!(plan.inputs(), &before);
            assert!(plan.gains().iter().all(all));
        }
    }
    // a concave cost is regularized away, or refused
    for place in 2..5 {
        let mut plan = Ilqr::<f64, 2, 1, 20>::new(vector![0.1]);
        judged("curvature", -1e3, &plan.improve(&linear, &Misled(-1e3, place), &start));
        judged("curvature", -1e30, &plan.improve(&linear, &Misled(-1e30, place), &start));
    }
}

#[test]
fn gradients() {
    let start = vector![0.3, 0.0];
    let inputs = [vector![0.1]; 5];
    let (mut states, mut gradient) = ([Vector2::zeros(); 5], [Vector1::zeros(); 5]);
    for x in HOSTILE {
        for place in 0..2 {
            let bad = with(&start, place, x);
            let result = shooting_gradient(&Linear(A, B), &COST, &bad, &inputs, &mut states, &mut gradient);
            match result {
                Ok(cost) => assert!(cost.is_finite() && gradient.iter().all(all), "{x:e}"),
                Err(error) => assert!(matches!(error, ControlError::NotFinite { .. }), "{error}"),
            }
            assert!(x.is_finite() || result.is_err());
            // for a line search, a number that is worse than any other
            let cost = shooting_cost(&Linear(A, B), &COST, &bad, &inputs);
            assert!(cost.is_finite() || result.is_err());
        }
    }
    let none: [Vector1<f64>; 0] = [];
    let empty = shooting_gradient(&Linear(A, B), &COST, &start, &none, &mut [], &mut []);
    assert_eq!(empty, Ok(COST.end(&start)));
}

/// A loop that meets a bad measurement every third tick refuses it, and balances all the same.
#[test]
fn a_loop_survives() {
    let unstable = matrix![1.02, 0.1; 0.05, 1.0];
    let regulator = Regulator::stationary(&unstable, &B, &Matrix2::identity(), &R).unwrap();
    let mut belief = Estimate { mean: vector![0.0, 0.0], covariance: Matrix2::identity() };
    let mut real = vector![0.5, -0.2];
    let (mut refused, mut bad) = (0, HOSTILE.iter().filter(|x| !x.is_finite()).cycle());
    for tick in 0..300 {
        let seen = if tick % 3 == 2 { *bad.next().unwrap() } else { real[0] };
        let innovation = vector![seen - belief.mean[0]];
        match belief.corrected(&innovation, &matrix![1.0, 0.0], &matrix![1e-4]) {
            Ok(correction) => belief = correction.estimate,
            Err(_) => refused += 1,
        }
        let input: SVector<f64, 1> = regulator.input(&belief.mean);
        real = unstable * real + B * input;
        let mean = unstable * belief.mean + B * input;
        belief = belief.predicted(mean, &unstable, &(Matrix2::identity() * 1e-8)).unwrap();
    }
    assert_eq!(refused, 100);
    assert!(real.norm() < 1e-6, "{real}");
}

/// The cost |c x + d u|² + |e u|² where d and e are small: a gain that is given is that of many steps backwards from the
/// end of a horizon, by the squares of what costs.
#[test]
fn cheap_inputs_that_outputs_show_at_once() {
    let mut seed = 5_u32;
    let mut number = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX) * 2.0 - 1.0
    };
    let mut compared = 0;
    for case in 0..150 {
        let (scale, permitted) = [(1.0, 1e-12), (1e-3, 1e-12), (1e-6, 3e-10)][case % 3];
        let a = SMatrix::<f64, 3, 3>::from_fn(|_, _| number());
        let b = SMatrix::<f64, 3, 2>::from_fn(|_, _| number());
        let c = SMatrix::<f64, 2, 3>::from_fn(|_, _| number());
        let [d, e] = [(); 2].map(|()| SMatrix::<f64, 2, 2>::from_fn(|_, _| scale * number()));
        let r = d.transpose() * d + e.transpose() * e;
        let cross = c.transpose() * d;
        let found = Regulator::stationary_with_cross(&a, &b, &(c.transpose() * c), &r, &cross);
        let Ok(found) = found else { continue };
        let (mut cost, mut gain) = (c.transpose() * c, SMatrix::<f64, 2, 3>::zeros());
        for _ in 0..1000 {
            let heavy = (r + b.transpose() * cost * b).try_inverse().unwrap();
            let next = heavy * (b.transpose() * cost * a + cross.transpose());
            let (closed, shown, spent) = (a - b * next, c - d * next, e * next);
            cost = closed.transpose() * cost * closed + shown.transpose() * shown + spent.transpose() * spent;
            let moved = (next - gain).norm();
            gain = next;
            if moved <= 1e-15 * gain.norm() {
                compared += 1;
                let off = (found.gain - gain).norm();
                assert!(off < permitted * gain.norm(), "{case}: {off:e} of {gain}");
                break;
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

//! The law over what keeps energies, invariants, constraints and reversibility.

use nonholonomic::prelude::*;
use nonholonomic::{
    D, DiscreteLagrangian, EulerPoincareSuslov, Invariants, Leapfrog, Method, ProjectionError, ScalarOf,
    State,
};

use crate::problems::{Four, Kind, Problem};
use crate::record::{Course, recorded};
use crate::scaled::{Scaled, two};
use crate::{Change, Part, Verdict, changes};

// A planet with its energy: the only one of the problems that has one.

impl<T: Real> Energy for Problem<T> {
    fn energy(&self, _t: T, Four([x, y, u, v]): &Four<T>) -> T {
        (*u * *u + *v * *v) * T::from_f64(0.5) - (*x * *x + *y * *y).sqrt().recip()
    }
}

impl<T: Real> AlmostPoisson for Problem<T> {
    fn energy_gradient(&self, _t: T, Four([x, y, u, v]): &Four<T>) -> [T; 4] {
        let square = *x * *x + *y * *y;
        let cube = square * square.sqrt();
        [*x / cube, *y / cube, *u, *v]
    }
    fn almost_poisson(&self, _t: T, _x: &Four<T>, [a, b, c, d]: &[T; 4]) -> [T; 4] {
        [*c, *d, -*a, -*b]
    }
}

impl<T: Real> Invariants for Problem<T> {
    type Count = D<2>;
    fn invariants(&self, t: T, state: &Four<T>) -> [T; 2] {
        let Four([x, y, u, v]) = *state;
        [self.energy(t, state), x * v - y * u]
    }
    fn invariant_gradients(&self, t: T, state: &Four<T>) -> [[T; 4]; 2] {
        let Four([x, y, u, v]) = *state;
        [self.energy_gradient(t, state), [v, -u, -y, x]]
    }
}

impl<T: Real> Leapfrog for Problem<T> {
    fn kick(&self, state: &Four<T>, h: T) -> Four<T> {
        let [a, b, _, _] = self.energy_gradient(T::ZERO, state);
        let Four([x, y, u, v]) = *state;
        Four([x, y, u - h * a, v - h * b])
    }
}

/// The planet on a wire through its start, a circle about the sun.
impl<T: Real> DiscreteLagrangian for Problem<T> {
    fn lagrangian_slopes(&self, state: &Four<T>) -> [T; 4] {
        let [a, b, u, v] = self.energy_gradient(T::ZERO, state);
        [-a, -b, u, v]
    }
    fn position_constraints(&self, Four([x, y, ..]): &Four<T>) -> [T; 4] {
        [
            (*x * *x + *y * *y - T::from_f64(0.4) * T::from_f64(0.4)) * T::from_f64(0.5),
            T::ZERO,
            T::ZERO,
            T::ZERO,
        ]
    }
    fn constrained(&self, Four([x, y, ..]): &Four<T>, [a, b, c, _]: &[T; 4]) -> [T; 4] {
        let along = (*c - *x * *a - *y * *b) / (*x * *x + *y * *y);
        [*a + along * *x, *b + along * *y, T::ZERO, T::ZERO]
    }
}

/// Three numbers.
#[derive(Clone, Copy, Debug)]
struct Spin<T>([T; 3]);

impl<T: Scalar> State for Spin<T> {
    type Scalar = T;
    type Dim = D<3>;
    fn to_array(&self) -> [T; 3] {
        self.0
    }
    fn from_array(components: [T; 3]) -> Self {
        Self(components)
    }
    fn names() -> [&'static str; 3] {
        ["a", "b", "c"]
    }
}

fn cross<T: Real>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// A free rigid body, whose angular velocity keeps its length too where all its moments are equal.
#[derive(Clone, Copy)]
struct Body<T>([T; 3]);

impl<T: Real> Body<T> {
    fn momentum(&self, Spin([a, b, c]): &Spin<T>) -> [T; 3] {
        let [i, j, k] = self.0;
        [i * *a, j * *b, k * *c]
    }
}

impl<T: Real> Dynamics for Body<T> {
    type State = Spin<T>;
    type Input = ();
    fn derivative(&self, _t: T, w: &Spin<T>, (): &()) -> Spin<T> {
        let ([x, y, z], [i, j, k]) = (cross(self.momentum(w), w.0), self.0);
        Spin([x / i, y / j, z / k])
    }
}

impl<T: Real> EulerPoincareSuslov for Body<T> {
    fn discrete_momentum(&self, w: &Spin<T>, h: T) -> [T; 3] {
        let p = self.momentum(w);
        // ⟨p, [w, B_a]⟩ = (p × w)_a
        let first = cross(p, w.0);
        let second = cross(first, w.0);
        core::array::from_fn(|a| {
            p[a] - h * T::from_f64(0.5) * first[a] + h * h / T::from_f64(12.0) * second[a]
        })
    }
}

impl<T: Real> Constrained for Body<T> {
    type Constraints = D<1>;
    fn constraint_residual(&self, _t: T, Spin([a, b, c]): &Spin<T>) -> [T; 1] {
        [*a * *a + *b * *b + *c * *c - T::ONE]
    }
    fn project(&self, _t: T, Spin([a, b, c]): &mut Spin<T>) -> Result<(), ProjectionError> {
        let length = (*a * *a + *b * *b + *c * *c).sqrt();
        (*a, *b, *c) = (*a / length, *b / length, *c / length);
        Ok(())
    }
}

struct Trial {
    verdict: Verdict,
    numbers: &'static str,
    changes: Vec<Change>,
}

impl Trial {
    fn of<S, M>(
        &mut self,
        name: &str,
        apart: bool,
        system: S,
        course: &Course<S::State>,
        method: impl Fn(ScalarOf<S>, ScalarOf<S>) -> M,
    ) where
        S: Dynamics<Input = ()> + Copy,
        ScalarOf<S>: Real,
        M: Method<Scaled<S>> + Clone,
    {
        let run = |change: &Change| {
            let scaled = Scaled::new(system, change);
            recorded(&scaled, &method(scaled.time, two(change.state[0])), course)
        };
        let expected = run(&Change { part: Part::Time, time: 0, state: [0; 4], other: 0 });
        for change in &self.changes {
            if apart || change.part != Part::EachComponent {
                let difference = expected.difference(&run(change));
                let told = |difference| format!("2^{} 2^{:?}: {difference}", change.time, change.state);
                let name = format!("{name}{}", self.numbers);
                self.verdict.note(&name, change.part, difference.map(told));
            }
        }
    }

    fn all<T: Real>(&mut self) {
        let w = T::from_f64;
        let planet = Problem::<T>::new(Kind::Kepler);
        let course = Course { steps: 30, ..planet.course().0 };
        let h = w(0.03125);
        self.of("DiscreteGradient", false, planet, &course, |tau, _| DiscreteGradient::new(h * tau));
        self.of("DiscreteGradient, with Jacobian", false, planet, &course, |tau, _| {
            DiscreteGradient::new(h * tau).with_jacobian().compensated()
        });
        self.of("DiscreteGradient, order 4", false, planet, &course, |tau, _| {
            DiscreteGradient::new(h * tau).fourth_order()
        });
        self.of("DiscreteGradient, order 6", false, planet, &course, |tau, _| {
            DiscreteGradient::new(h * tau).sixth_order()
        });
        self.of("SymmetricProjection", false, planet, &course, |tau, _| {
            ImplicitMidpoint::new(h * tau).symmetrically_projected()
        });
        self.of("SymmetricProjection, order 4", false, planet, &course, |tau, _| {
            ImplicitMidpoint::new(h * tau).symmetrically_projected().fourth_order()
        });
        self.of("Conserving<Rk4>", false, planet, &course, |tau, _| Conserving::new(Rk4::new(h * tau)));
        self.of("Conserving<Dopri5>", false, planet, &course, |_, unit| {
            Conserving::new(Dopri5::new().rtol(w(1e-5)).atol(w(1e-6) * unit))
        });
        let body = Body([w(1.0), w(1.5), w(2.2)]);
        let start = Spin([w(0.48), w(0.6), w(0.64)]);
        let spin = Course { start, from: w(0.25), to: w(10.0), steps: 30 };
        self.of("DiscreteSuslov", false, body, &spin, |tau, _| DiscreteSuslov::new(h * tau));
        self.of("DiscreteSuslov, order 4", false, body, &spin, |tau, _| {
            DiscreteSuslov::new(h * tau).fourth_order()
        });
        let ball = Body([w(1.0); 3]);
        self.of("Projected<Rk4>", true, ball, &spin, |tau, _| Projected::new(Rk4::new(h * tau), 3));
        self.of("Projected<Tsit5>", false, ball, &spin, |_, unit| {
            Projected::new(Tsit5::new().rtol(w(1e-5)).atol(w(1e-6) * unit), 1)
        });
        // velocities are places over times
        let [time, state] = [|c: &Change| c.time, |c: &Change| c.state[0]];
        // and accelerations places over squares of times, which have to be in range
        self.changes.retain(|c| c.time.abs() <= 300);
        for change in &mut self.changes {
            let (time, [x, y, ..]) = (time(change), change.state);
            debug_assert_eq!(state(change), x);
            change.state = [x, y, x - time, y - time];
        }
        self.of("ReflectedLeapfrog", true, planet, &course, |tau, _| ReflectedLeapfrog::new(h * tau));
        self.of("Rattle", true, planet, &course, |tau, _| Rattle::new(h * tau));
        self.of("Rattle, order 4", true, planet, &course, |tau, _| Rattle::new(h * tau).fourth_order());
    }
}

#[test]
fn structure_in_double_precision() {
    let mut trial = Trial { verdict: Verdict::default(), numbers: "", changes: changes(true) };
    trial.all::<f64>();
    trial.verdict.judge();
}

#[test]
fn structure_in_single_precision() {
    let mut trial = Trial { verdict: Verdict::default(), numbers: " in f32", changes: changes(false) };
    trial.all::<f32>();
    trial.verdict.judge();
}

/// The iteration by which generated code returns to a manifold, on a circle and on a parabola.
#[test]
fn projection_to_a_manifold() {
    let mut verdict = Verdict::default();
    let run = |unit: f64| {
        let circle = |[x, y]: &[f64; 2]| [(x / unit).powi(2) + (y / unit).powi(2) - 1.0];
        let to_circle = |_: &[f64; 2], p: &[f64; 2]| {
            let factor = circle(p)[0] / (2.0 * (circle(p)[0] + 1.0));
            [p[0] - factor * p[0], p[1] - factor * p[1]]
        };
        let first = nonholonomic::__private::project([3.0 * unit, -4.0 * unit], to_circle, circle);
        let given = |off: f64| {
            let point = [0.6 * unit, 0.8 * (1.0 + off) * unit];
            nonholonomic::__private::check_identities(
                point,
                to_circle(&point, &point),
                [("r", circle(&point)[0])],
            )
        };
        let far = [0.0, 1e-8, 1e-6, 1e-4].map(|off| given(off).is_ok());
        (first.map(|p| p.map(|x| (x / unit).to_bits())), far)
    };
    for change in changes(true) {
        if change.part == Part::OneUnit {
            let differs = run(two(change.state[0])) != run(1.0);
            let detail = differs.then(|| format!("2^{:?}", change.state));
            verdict.note("project", change.part, detail);
        }
    }
    verdict.judge();
}

//! The law over the Taylor method, whose systems are declared.

use nonholonomic::prelude::*;
use nonholonomic::{Method, State};

use crate::record::{Course, recorded};
use crate::scaled::{Scaled, multiplied};
use crate::{Change, Part, Verdict, changes};

/// A spring whose force goes with the cube: at x = 0 every second term of its series vanishes.
#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 - k / 4 * x^4 }
    emit { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Cubic<T> {
    k: T,
}

/// A planet.
#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 + mu / sqrt(x^2 + y^2) }
    emit { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Planet<T> {
    mu: T,
}

/// A sleigh on se(2) with its place.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + 1 / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    forces      { omega: -c * omega; }
    emit        { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    J: T,
    a: T,
    c: T,
}

struct Trial {
    verdict: Verdict,
    changes: Vec<Change>,
}

impl Trial {
    fn of<S, M>(
        &mut self,
        (name, apart): (&str, bool),
        system: S,
        course: &Course<S::State>,
        method: impl Fn(S::State, <S::State as State>::Scalar) -> M,
    ) where
        S: TaylorSeries + Jacobian + Dynamics<Input = ()> + Copy,
        <S::State as State>::Scalar: Real,
        M: Method<Scaled<S>> + Clone,
    {
        let run = |change: &Change| {
            let scaled = Scaled::new(system, change);
            let units = scaled.units.to_array();
            let [unit, ..] = units.as_ref() else { panic!("a state has a component") };
            recorded(&scaled, &method(scaled.units, *unit), course)
        };
        let expected = run(&Change { part: Part::Time, time: 0, state: [0; 4], other: 0 });
        for change in &self.changes {
            if apart || change.part != Part::EachComponent {
                let difference = expected.difference(&run(change));
                let told = |difference| format!("2^{} 2^{:?}: {difference}", change.time, change.state);
                self.verdict.note(name, change.part, difference.map(told));
            }
        }
    }

    fn each<T, S>(&mut self, what: &str, system: S, start: S::State, from: T, to: T)
    where
        T: Real,
        S: TaylorSeries + Jacobian + Dynamics<Input = ()> + Copy,
        S::State: State<Scalar = T>,
    {
        let course = Course { start, from, to, steps: 40 };
        let w = T::from_f64;
        let uniform = |_: S::State, unit: T| Taylor::<T>::new().rtol(w(1e-6)).atol(w(1e-8) * unit);
        self.of((&format!("Taylor, {what}"), false), system, &course, uniform);
        let relative = |_: S::State, _: T| Taylor::<T>::new().rtol(w(1e-5)).atol(T::ZERO);
        // where all that moves is zero, and what is not rests, relative tolerances tell of no scale but one for all
        let rates = system.derivative(from, &start, &()).to_array();
        let numbers = start.to_array();
        let mut pairs = numbers.as_ref().iter().zip(rates.as_ref());
        let is_guided = pairs.any(|(x, f)| *x != T::ZERO && *f != T::ZERO);
        self.of((&format!("Taylor, relative, {what}"), is_guided), system, &course, relative);
        let by_component = |units: S::State, _: T| {
            let all = |number: f64| {
                let mut numbers = units.to_array();
                numbers.as_mut().fill(w(number));
                S::State::from_array(numbers)
            };
            Taylor::<T>::new().tolerances(all(1e-5), multiplied(&all(1e-7), &units))
        };
        self.of((&format!("Taylor, by component, {what}"), true), system, &course, by_component);
        // declared systems with their Jacobians go with the other methods as well
        let implicit =
            |_: S::State, unit: T| Radau5::new().rtol(w(1e-5)).atol(w(1e-6) * unit).with_jacobian();
        self.of((&format!("Radau5 with Jacobian, {what}"), false), system, &course, implicit);
        let rosenbrock = |_: S::State, unit: T| Rodas5P::new().rtol(w(1e-5)).atol(w(1e-6) * unit);
        self.of((&format!("Rodas5P, {what}"), false), system, &course, rosenbrock);
    }

    fn systems<T: Real>(&mut self, numbers: &str) {
        let w = T::from_f64;
        let cubic = Cubic { k: w(1.0) };
        let start = CubicState { x: w(0.0), x_dot: w(1.0) };
        self.each(&format!("a cubic spring{numbers}"), cubic, start, w(0.0), w(20.0));
        let start = PlanetState { x: w(0.4), y: w(0.0), x_dot: w(0.0), y_dot: w(2.0) };
        self.each(&format!("a planet{numbers}"), Planet { mu: w(1.0) }, start, w(0.0), w(10.0));
        let sleigh = Sleigh { J: w(0.3), a: w(0.2), c: w(0.01) };
        let start = SleighState { theta: w(0.3), x: w(0.0), y: w(0.0), omega: w(1.0), v1: w(0.5) };
        self.each(&format!("a sleigh{numbers}"), sleigh, start, w(0.0), w(9.0));
        // at rest, where nothing tells of a scale but the tolerance and the target
        let start = CubicState { x: w(0.0), x_dot: w(0.0) };
        self.each(&format!("rest{numbers}"), cubic, start, w(1.0), w(9.0));
    }
}

#[test]
fn series_in_double_precision() {
    let mut trial = Trial { verdict: Verdict::default(), changes: changes(true) };
    trial.systems::<f64>("");
    trial.verdict.judge();
}

#[test]
fn series_in_single_precision() {
    let mut trial = Trial { verdict: Verdict::default(), changes: changes(false) };
    trial.systems::<f32>(" in f32");
    trial.verdict.judge();
}

//! The law over every method that goes with any system.
//! The choice of the first step, mathematics (30), is among the decisions.

use nonholonomic::methods::Controller;
use nonholonomic::prelude::*;
use nonholonomic::{Jacobian, Method, ScalarOf};

use crate::problems::{Four, Kind, Problem};
use crate::record::{Record, recorded};
use crate::scaled::{Scaled, multiplied};
use crate::{Change, Part, Verdict, changes};

/// The settings of a method, in the units of a run.
pub(crate) struct Settings<T> {
    pub(crate) step: T,
    pub(crate) rtol: T,
    pub(crate) atol: T,
    pub(crate) tolerances: (Four<T>, Four<T>),
}

/// The system that the methods are tried on.
type Tried<T> = Scaled<Problem<T>>;

/// Whether a method is to obey under a unit for each component too.
#[derive(Clone, Copy, PartialEq)]
enum Components {
    Apart,
    Together,
}
use Components::{Apart, Together};

/// One method on all problems in all units.
struct Trial<'a> {
    verdict: Verdict,
    numbers: &'static str,
    kinds: &'a [Kind],
    changes: Vec<Change>,
}

impl Trial<'_> {
    fn of<T: Real, M: Method<Tried<T>> + Clone>(
        &mut self,
        name: &str,
        components: Components,
        method: impl Fn(&Settings<T>) -> M,
    ) {
        for &kind in self.kinds {
            let plain = Change { part: Part::Time, time: 0, state: [0; 4], other: 0 };
            let expected = run(kind, &plain, &method);
            for change in &self.changes {
                if change.part == Part::EachComponent && components == Together {
                    continue;
                }
                let difference = expected.difference(&run(kind, change, &method));
                let detail = difference.map(|difference| {
                    format!("{kind:?}, 2^{} 2^{:?}: {difference}", change.time, change.state)
                });
                self.verdict.note(&format!("{name}{}", self.numbers), change.part, detail);
            }
        }
    }
}

fn run<T: Real, M: Method<Tried<T>> + Clone>(
    kind: Kind,
    change: &Change,
    method: impl Fn(&Settings<T>) -> M,
) -> Record {
    let problem = Problem::<T>::new(kind);
    let scaled = Scaled::new(problem, change);
    let (course, step) = problem.course();
    let [unit, ..] = scaled.units.0;
    let negligible = problem.negligible();
    let relative = [1e-4, 1e-5, 1e-4, 1e-6].map(|r| T::from_f64(r).max(T::EPSILON * T::from_f64(16.0)));
    let settings = Settings {
        step: step * scaled.time,
        rtol: T::from_f64(1e-5),
        atol: negligible.0[1] * unit,
        tolerances: (Four(relative), multiplied(&negligible, &scaled.units)),
    };
    recorded(&scaled, &method(&settings), &course)
}

/// Every method under the law.
fn every_method<T: Real>(trial: &mut Trial<'_>)
where
    Tried<T>: Jacobian<State = Four<T>, Input = ()>,
    ScalarOf<Tried<T>>: Real,
{
    let each = trial;
    each.of::<T, _>("Euler", Apart, |s| Euler::new(s.step));
    each.of::<T, _>("Heun", Apart, |s| Heun::new(s.step));
    each.of::<T, _>("Ralston", Apart, |s| Ralston::new(s.step));
    each.of::<T, _>("Rk4", Apart, |s| Rk4::new(s.step));
    each.of::<T, _>("Rk4, compensated", Apart, |s| Rk4::new(s.step).compensated());
    macro_rules! explicit {
        ($($name:ident)*) => {$(
            let name = stringify!($name);
            each.of::<T, _>(name, Together, |s| $name::new().rtol(s.rtol).atol(s.atol));
            each.of::<T, _>(&format!("{name}, by component"), Apart, |s| {
                $name::new().tolerances(s.tolerances.0, s.tolerances.1)
            });
            each.of::<T, _>(&format!("{name}::fixed"), Apart, |s| $name::fixed(s.step));
        )*};
    }
    explicit! { Bs23 Dopri5 Tsit5 Dop853 Vern9 }
    each.of::<T, _>("Dopri5, absolute", Together, |s| Dopri5::new().rtol(T::ZERO).atol(s.atol));
    each.of::<T, _>("Dopri5, relative", Apart, |s| Dopri5::new().rtol(s.rtol).atol(T::ZERO));
    each.of::<T, _>("Tsit5, limited", Apart, |s| {
        let law = Controller::filter([1.0 / 18.0, 1.0 / 9.0, 1.0 / 18.0].map(T::from_f64));
        let method = Tsit5::new().tolerances(s.tolerances.0, s.tolerances.1).controller(law);
        method.first_step(s.step).max_step(s.step * T::from_f64(8.0))
    });
    macro_rules! stiff {
        ($($name:ident)*) => {$(
            let name = stringify!($name);
            let by_component = |s: &Settings<T>| $name::new().tolerances(s.tolerances.0, s.tolerances.1);
            each.of::<T, _>(name, Together, |s| $name::new().rtol(s.rtol).atol(s.atol));
            each.of::<T, _>(&format!("{name}, with Jacobian"), Together, |s| {
                $name::new().rtol(s.rtol).atol(s.atol).with_jacobian()
            });
            each.of::<T, _>(&format!("{name}, by component"), Together, by_component);
            each.of::<T, _>(&format!("{name}, relative"), Together, |s| {
                $name::new().rtol(s.rtol).atol(T::ZERO)
            });
        )*};
    }
    stiff! { Radau5 Rodas5P }
    each.of::<T, _>("Auto", Together, |s| Auto::new().rtol(s.rtol).atol(s.atol));
    each.of::<T, _>("ImplicitMidpoint", Together, |s| ImplicitMidpoint::new(s.step));
    each.of::<T, _>("ImplicitMidpoint, with Jacobian", Together, |s| {
        ImplicitMidpoint::new(s.step).with_jacobian()
    });
    each.of::<T, _>("ImplicitMidpoint, order 4", Together, |s| ImplicitMidpoint::new(s.step).fourth_order());
    each.of::<T, _>("ImplicitMidpoint, order 6", Together, |s| {
        ImplicitMidpoint::new(s.step).with_jacobian().sixth_order().compensated()
    });
    each.of::<T, _>("GaussLegendre4", Together, |s| GaussLegendre4::new(s.step));
    each.of::<T, _>("GaussLegendre4, with Jacobian", Together, |s| {
        GaussLegendre4::new(s.step).with_jacobian()
    });
    each.of::<T, _>("GaussLegendre6", Together, |s| GaussLegendre6::new(s.step));
    each.of::<T, _>("GaussLegendre6, with Jacobian", Together, |s| {
        GaussLegendre6::new(s.step).with_jacobian().compensated()
    });
}

#[test]
fn methods_in_double_precision() {
    let mut trial =
        Trial { verdict: Verdict::default(), numbers: "", kinds: &Kind::ALL, changes: changes(true) };
    every_method::<f64>(&mut trial);
    trial.verdict.judge();
}

#[test]
fn methods_in_single_precision() {
    let mut trial = Trial {
        verdict: Verdict::default(),
        numbers: " in f32",
        kinds: &Kind::SINGLE,
        changes: changes(false),
    };
    every_method::<f32>(&mut trial);
    trial.verdict.judge();
}

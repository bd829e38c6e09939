//! Runs by the methods that keep structure, and by Taylor series, in double and single precision: the bits of
//! what comes out.

use nonholonomic::methods::Method;
use nonholonomic::prelude::*;

use crate::bits::{Bits, line};
use crate::systems::{
    Contact, ContactOnTq, ContactOnTqState, ContactState, Rod, RodState, Suslov, SuslovState,
};

/// The bits of the state after five units of time.
fn run<S, M, T>(lines: &mut Vec<String>, name: &str, system: S, start: S::State, method: M)
where
    S: Dynamics<State: State<Scalar = T>>,
    M: Method<S>,
    T: Real + Bits,
{
    let mut sim = Integrator::new(system, method, T::ZERO, start);
    match sim.advance_to(T::from_f64(5.0)) {
        Ok(()) => lines.push(line(name, sim.state().to_array().as_ref())),
        Err(error) => panic!("{name}: {error}"),
    }
}

/// All of them, a line each.
pub(crate) fn all<T: Real + Bits>() -> Vec<String> {
    let lines = &mut Vec::new();
    let number = |x: f64| T::from_f64(x);
    let h = number(0.05);
    let contact = Contact { epsilon: number(0.3) };
    let start = ContactState::from([0.3, 0.5, 0.4, 1.0, 0.8].map(number));
    let gradients = DiscreteGradient::new(h);
    run(lines, "DiscreteGradient", contact, start, gradients);
    run(lines, " compensated", contact, start, gradients.compensated());
    run(lines, " of fourth order", contact, start, gradients.fourth_order());
    run(lines, " of sixth order", contact, start, gradients.sixth_order());
    run(lines, "Taylor", contact, start, Taylor::<T>::new());
    run(lines, "Taylor, order 15", contact, start, Taylor::<T, 25>::of_order(15));
    let on_tq = ContactOnTq { epsilon: number(0.3) };
    let start = ContactOnTqState::from([0.3, 0.5, 0.4, -0.4, 1.0, 0.8].map(number));
    run(lines, "ReflectedLeapfrog", on_tq, start, ReflectedLeapfrog::new(h));
    run(lines, "Conserving(Rk4)", on_tq, start, Conserving::new(Rk4::new(h)));
    run(lines, "Conserving(Dopri5)", on_tq, start, Conserving::new(Dopri5::new()));
    run(lines, "Projected(Rk4)", on_tq, start, Projected::new(Rk4::new(h), 2));
    run(lines, "Projected(Dopri5)", on_tq, start, Projected::new(Dopri5::new(), 1));
    let (rod, start) = (Rod { g: number(1.0) }, RodState::from([0.6, -0.8, 0.4, 0.3].map(number)));
    run(lines, "Rattle", rod, start, Rattle::new(h));
    run(lines, "Rattle of fourth order", rod, start, Rattle::new(h).fourth_order());
    let suslov = Suslov { I: [1.0, 2.0, 3.0].map(number), k: number(0.7) };
    let start = SuslovState::from([0.6, 0.8].map(number));
    run(lines, "DiscreteSuslov", suslov, start, DiscreteSuslov::new(h));
    core::mem::take(lines)
}

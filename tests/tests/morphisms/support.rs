//! What a reduction promises, checked on a trajectory.

use core::fmt::Debug;

use nonholonomic::prelude::*;
use nonholonomic::{Dim, ScalarOf};

/// The end of a trajectory, to about 1e-11.
pub(super) fn end<S>(system: &S, start: S::State, input: S::Input, time: f64) -> S::State
where
    S: Dynamics + Clone,
    S::State: State<Scalar = f64>,
{
    let method = Dopri5::new().rtol(1e-12).atol(1e-12);
    let mut sim = Integrator::new(system.clone(), method, 0.0, start);
    sim.set_input(input);
    sim.advance_to(time).unwrap();
    *sim.state()
}

/// Both states agree to `tolerance`, relative to their size.
pub(super) fn assert_close<S: State<Scalar = f64>>(found: &S, expected: &S, tolerance: f64) {
    let (found, expected) = (found.to_array(), expected.to_array());
    let size = expected.as_ref().iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    for ((a, b), name) in found.as_ref().iter().zip(expected.as_ref()).zip(S::names().as_ref()) {
        assert!((a - b).abs() <= tolerance * size, "{name}: {a} is not {b}");
    }
}

/// The motion goes to the motion: the reduction of the end is the end of the reduction.
pub(super) fn reduces<F, R>(full: &F, start: F::State, input: F::Input)
where
    F: Reduction<R> + Clone,
    R: Dynamics + Clone,
    F::State: State<Scalar = f64>,
    R::State: State<Scalar = f64>,
{
    let reduced = full.reduced();
    reduced.validate().unwrap();
    let control = full.reduce_input(0.0, &start, &input);
    let carried = full.reduce(2.0, &end(full, start, input, 2.0));
    let direct = end(&reduced, full.reduce(0.0, &start), control, 2.0);
    assert_close(&carried, &direct, 1e-9);
    // it moves at all
    let moved = direct.to_array();
    let begin = full.reduce(0.0, &start).to_array();
    assert!(moved.as_ref().iter().zip(begin.as_ref()).any(|(a, b)| (a - b).abs() > 1e-3));
}

/// The full motion follows from the reduced one and the dropped coordinates.
pub(super) fn reconstructs<F, R>(full: &F, start: F::State, input: F::Input)
where
    F: Reconstruction<R> + Clone,
    R: Dynamics + Clone,
    F::State: State<Scalar = f64>,
    R::State: State<Scalar = ScalarOf<F>>,
    F::Joint: State<Scalar = f64> + Debug,
{
    reduces::<F, R>(full, start, input);
    let joint = Reconstructed::<F, R>::new(full.clone());
    let control = full.reduce_input(0.0, &start, &input);
    let begin = joint.start(0.0, &start);
    assert_close(&joint.full_state(0.0, &begin), &start, 1e-14);
    let found = joint.full_state(2.0, &end(&joint, begin, control, 2.0));
    assert_close(&found, &end(full, start, input, 2.0), 1e-9);
    assert_eq!(F::Joint::names().as_ref().len(), <<F::Joint as State>::Dim as Dim>::N);
}

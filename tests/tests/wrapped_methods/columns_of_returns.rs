//! Columns of a `Variational` beside a state that returns to position constraints.

use nonholonomic::prelude::*;

use crate::{Pushed, PushedState};

/// A tie that always holds to the last digit, and a rope on which it depends on rounding.
#[nonholonomic(
    base { x, y }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2) - k / 2 * (x^2 + y^2) }
    holonomic { tie: x = y; }
    emit { jacobian, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Tied {
    k: f64,
}

/// Columns beside a state follow its return wherever it is, and are no part of what a start is judged by.
#[test]
fn columns_follow_the_return_of_their_state() {
    use nonholonomic::methods::Uniform;
    use nonholonomic::sensitivity::{By, ColumnTolerance, Variational, WithColumns};
    let tied = Tied { k: 1.0 };
    let begun = TiedState { x: 1.0, y: 1.0, ..Default::default() };
    let motion = Variational::new(tied, [By::Start(0), By::Start(1)]);
    let mut sim = Integrator::new(motion, Rk4::new(0.1), 0.0, motion.start(&begun).unwrap());
    sim.advance_to(1.0).unwrap();
    let mut columns = motion.start(&begun).unwrap().columns;
    let mut alone = Integrator::new(tied, Rk4::new(0.1), 0.0, begun);
    motion.advance(&mut alone, 1.0, &mut columns).unwrap();
    for (beside, along) in sim.state().columns.iter().zip(columns) {
        for (beside, along) in beside.to_array().iter().zip(along.to_array()) {
            assert!((beside - along).abs() < 1e-15, "{beside} {along}");
        }
    }
    assert!(sim.statistics().largest_correction < 1e-15, "{:?}", sim.statistics());

    let rope = Pushed { l: 0.7, v: 0.0, g: 9.81, lag: 0.3 };
    let motion = Variational::new(rope, [By::Start(0), By::Start(1)]);
    let placed = |angle: f64| PushedState {
        x: 0.7 * angle.sin(),
        y: -0.7 * angle.cos(),
        x_dot: 0.21 * angle.cos(),
        y_dot: 0.21 * angle.sin(),
        pull: 0.0,
    };
    for k in 0..50 {
        let start = motion.start(&placed(0.1 + 0.05 * f64::from(k))).unwrap();
        Integrator::new(motion, Rk4::new(0.01), 0.0, start).step().unwrap();
        let tolerance = ColumnTolerance::new(1e-9, 1e-9);
        Integrator::new(motion, Dopri5::new().tolerance(tolerance), 0.0, start).step().unwrap();
        let of_state = Dopri5::new().tolerance(ColumnTolerance::of_state(Uniform::of(1e-9, 1e-9)));
        Integrator::new(motion, of_state, 0.0, start).step().unwrap();
        let off = WithColumns { state: PushedState { y: start.state.y + 1e-3, ..start.state }, ..start };
        let refused = Integrator::new(motion, Rk4::new(0.01), 0.0, off).step();
        assert!(matches!(refused, Err(IntegrationError::OffConstraints { .. })), "{refused:?}");
    }
}

/// Through an integrator, whose returns take a second step of Newton's where the first does not reach the rope.
#[test]
fn columns_are_the_derivative_of_the_steps_that_are_taken() {
    use nonholonomic::sensitivity::{By, Variational};
    let rope = Pushed { l: 0.7, v: 0.0, g: 9.81, lag: 0.3 };
    let end = |angle: f64, h: f64| {
        let (sin, cos) = angle.sin_cos();
        let start =
            PushedState { x: 0.7 * sin, y: -0.7 * cos, x_dot: 0.77 * cos, y_dot: 0.77 * sin, pull: 0.0 };
        let mut sim = Integrator::new(rope, Rk4::new(h), 0.0, start);
        sim.advance_to(1.0).unwrap();
        (start, sim.state().to_array(), sim.statistics().largest_correction)
    };
    for h in [0.2, 0.1, 0.05] {
        let (start, _, moved) = end(0.8, h);
        let motion = Variational::new(rope, [By::Start(0)]);
        let mut columns = [PushedState {
            x: 0.7 * 0.8_f64.cos(),
            y: 0.7 * 0.8_f64.sin(),
            x_dot: -0.77 * 0.8_f64.sin(),
            y_dot: 0.77 * 0.8_f64.cos(),
            pull: 0.0,
        }];
        let mut begun = motion.start(&start).unwrap();
        begun.columns = columns;
        motion.advance(&mut Integrator::new(rope, Rk4::new(h), 0.0, start), 1.0, &mut columns).unwrap();
        let mut beside = Integrator::new(motion, Rk4::new(h), 0.0, begun);
        beside.advance_to(1.0).unwrap();
        let d = 1e-3;
        let [a, b, c, e] = [-2.0, -1.0, 1.0, 2.0].map(|k| end(0.8 + k * d, h).1);
        for (i, (along, beside)) in
            columns[0].to_array().iter().zip(beside.state().columns[0].to_array()).enumerate()
        {
            let slope = (a[i] - 8.0 * b[i] + 8.0 * c[i] - e[i]) / (12.0 * d);
            assert!((along - slope).abs() < 2e-9, "{h} {i} {moved:e}: {along} {slope}");
            assert!((beside - slope).abs() < 2e-9, "{h} {i} {moved:e}: {beside} {slope}");
        }
    }
}

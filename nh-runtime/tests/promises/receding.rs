//! Predictive control of plants that are unstable and not quite the model: improve, apply, shift.

use nalgebra::{SVector, vector};
use nonholonomic::control::{Entry, Ilqr, Model, Quadratic, Sampled};
use nonholonomic::prelude::*;

/// A pole on a cart.
#[nonholonomic(
    base       { place, tilt }
    lagrangian {
        cart / 2 * der(place)^2 + pole / 2 * (der(place) + l * der(tilt) * cos(tilt))^2
            + pole / 2 * (l * der(tilt) * sin(tilt))^2 - pole * g * l * cos(tilt)
    }
    forces     { place: push + gust; }
    inputs     { push }
    assume     { cart > 0; pole > 0; l > 0; }
    emit       { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Balance<T> {
    cart: T,
    pole: T,
    l: T,
    g: T,
    gust: T,
}

const TICK: f64 = 0.04;

/// The largest tilt and place of a run in a plant that differs from the model by a share `error`, with `iterations`
/// of improvement in each tick.
fn run<T: Entry>(error: f64, iterations: u32, ticks: usize) -> (f64, f64) {
    let c = T::from_f64;
    let planned = Balance { cart: T::ONE, pole: c(0.3), l: c(0.5), g: c(9.81), gust: T::ZERO };
    let model = Sampled { system: planned, start: T::ZERO, dt: c(TICK) };
    let cost = Quadratic {
        goal: SVector::zeros(),
        state: vector![c(2.0), c(10.0), c(0.1), c(0.1)],
        input: vector![c(0.02)],
        end: vector![c(20.0), c(100.0), c(5.0), c(5.0)],
    };
    let mut plan = Ilqr::<T, 4, 1, 25>::new(vector![T::ZERO]).bounds(vector![c(-15.0)], vector![c(15.0)]);
    // a plan where the goal is: its feedback leads there from elsewhere
    plan.improve(&model, &cost, &SVector::zeros()).unwrap();
    let mut x = vector![c(0.3), c(0.25), T::ZERO, T::ZERO];
    let (mut tilt, mut place) = (0.0_f64, 0.0_f64);
    for tick in 0..ticks {
        for _ in 0..iterations {
            plan.improve(&model, &cost, &x).unwrap();
        }
        // gusts come and go
        let gust = c(if (tick / 40) % 3 == 1 { 1.0 } else { 0.0 });
        let share = c(1.0 + error);
        let system = Balance { pole: planned.pole * share, l: planned.l * share, gust, ..planned };
        let plant = Sampled { system, ..model };
        let input = plan.inputs()[0];
        assert!(input[0].abs() <= c(15.0));
        x = plant.step(tick, &x, &input);
        plan.shift();
        if tick > 50 {
            (tilt, place) = (tilt.max(x[1].to_f64().abs()), place.max(x[0].to_f64().abs()));
        }
    }
    (tilt, place)
}

#[test]
fn an_unstable_plant_that_is_not_the_model_stays_up() {
    for (error, iterations) in [(0.0, 1), (0.02, 1), (-0.02, 2), (0.1, 1)] {
        let (tilt, place) = run::<f64>(error, iterations, 160);
        assert!(tilt < 0.15 && place < 0.6, "{error}, {iterations}: {tilt} {place}");
    }
    let (tilt, place) = run::<f32>(0.02, 1, 160);
    assert!(tilt < 0.15 && place < 0.6, "{tilt} {place}");
}

/// From where the model has led, the plan is the same, shifted; and from elsewhere no worse than its inputs alone.
#[test]
fn a_shifted_plan_goes_on() {
    let system = Balance { cart: 1.0, pole: 0.3, l: 0.5, g: 9.81, gust: 0.0 };
    let model = Sampled { system, start: 0.0, dt: TICK };
    let cost = Quadratic {
        goal: SVector::zeros(),
        state: vector![2.0, 10.0, 0.1, 0.1],
        input: vector![0.02],
        end: vector![20.0, 100.0, 5.0, 5.0],
    };
    let mut plan = Ilqr::<f64, 4, 1, 40>::new(vector![0.0]);
    let start = vector![0.3, 0.2, 0.0, 0.0];
    plan.improve(&model, &cost, &SVector::zeros()).unwrap();
    plan.solve(&model, &cost, &start, 1e-10, 100).unwrap();
    let before = plan;
    plan.shift();
    for tick in 0..39 {
        assert_eq!(plan.inputs()[tick], before.inputs()[tick + 1]);
        assert_eq!(plan.states()[tick], before.states()[tick + 1]);
        assert_eq!(plan.gains()[tick], before.gains()[tick + 1]);
    }
    let end = model.step(39, &before.states()[39], &before.inputs()[39]);
    assert_eq!((plan.states()[39], plan.inputs()[39]), (end, before.inputs()[39]));
    assert_eq!(plan.gains()[39], before.gains()[39]);
    // a disturbed start: the inputs alone lead away, with feedback they hardly cost more than the best ones
    let aside = plan.states()[0] + vector![0.0, 0.02, 0.0, 0.1];
    let alone = nonholonomic::control::shooting_cost(&model, &cost, &aside, plan.inputs());
    let mut best = plan;
    let best = best.solve(&model, &cost, &aside, 1e-12, 200).unwrap().cost;
    let first = plan.improve(&model, &cost, &aside).unwrap();
    assert!(first.cost + first.decrease < 1.3 * best && alone > 10.0 * best, "{first:?} {best} {alone}");
    // inputs of one's own are taken as they are
    let mut own = before;
    own.inputs_mut()[0] = vector![1.0];
    let alone = nonholonomic::control::shooting_cost(&model, &cost, &aside, own.inputs());
    let improved = own.improve(&model, &cost, &aside).unwrap();
    assert_eq!(improved.cost + improved.decrease, alone);
}

/// A plan that cannot be made better stays what it is, feedback included, however often it is asked: on the way from
/// elsewhere, and at rest in the goal.
fn stays<T: Entry>(tolerance: f64) {
    let c = T::from_f64;
    let system = Balance { cart: T::ONE, pole: c(0.3), l: c(0.5), g: c(9.81), gust: T::ZERO };
    let model = Sampled { system, start: T::ZERO, dt: c(TICK) };
    for weight in [1.0, 1e-12, 1e12] {
        let cost = Quadratic {
            goal: SVector::zeros(),
            state: vector![2.0, 10.0, 0.1, 0.1].map(|w| c(w * weight)),
            input: vector![c(0.02 * weight)],
            end: vector![20.0, 100.0, 5.0, 5.0].map(|w| c(w * weight)),
        };
        for (bound, start) in [
            (1e3, vector![T::ZERO, T::ZERO, T::ZERO, T::ZERO]),
            (1e3, vector![c(0.3), c(0.2), T::ZERO, c(-0.1)]),
            (4.0, vector![c(0.3), c(0.1), T::ZERO, c(-0.1)]),
        ] {
            let mut plan =
                Ilqr::<T, 4, 1, 30>::new(vector![T::ZERO]).bounds(vector![c(-bound)], vector![c(bound)]);
            plan.improve(&model, &cost, &SVector::zeros()).unwrap();
            for _ in 0..30 {
                plan.improve(&model, &cost, &start).unwrap();
            }
            let gains = *plan.gains();
            for _ in 0..40 {
                let last = plan.improve(&model, &cost, &start).unwrap();
                assert!(last.promised <= T::EPSILON.sqrt() * last.cost, "{last:?}");
            }
            let largest = gains.iter().flatten().fold(0.0_f64, |most, gain| most.max(gain.to_f64().abs()));
            assert!(largest > 10.0, "{gains:?}");
            for (now, then) in plan.gains().iter().zip(&gains) {
                let off = (now - then).iter().fold(0.0_f64, |most, off| most.max(off.to_f64().abs()));
                assert!(off <= tolerance * largest, "{weight} {start:?}: {now:?} {then:?}");
            }
        }
    }
}

#[test]
fn a_plan_that_cannot_be_improved_keeps_its_feedback() {
    stays::<f64>(1e-6);
    stays::<f32>(1e-3);
}

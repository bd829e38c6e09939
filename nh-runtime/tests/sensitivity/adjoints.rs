//! Discrete adjoints: exact for the steps that are taken.

use nonholonomic::control::{Cost, Quadratic, Sampled, shooting_gradient};
use nonholonomic::methods::{
    BogackiShampine3, DormandPrince5, DormandPrince8, Euler1, Fixed, Heun2, Kutta4, Ralston3, Tableau,
    Tsitouras5, Verner9,
};
use nonholonomic::nalgebra::{SMatrix, SVector, vector};
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{
    Adjoint, By, Checkpoint, Gradient, Objective, SensitivityError, Slope, Variational,
};
use nonholonomic::{D, Jet};

use crate::models::{Free, Numbers, Pendulum, Push, close};

const PENDULUM: Pendulum<f64> = Pendulum { k: 1.3, c: 0.2 };
const START: [f64; 3] = [0.7, -0.4, 0.1];
const TICKS: usize = 24;

fn pushes() -> [Push<f64>; TICKS] {
    core::array::from_fn(|k| Push([(0.7 * k as f64).sin()]))
}

/// g = x₁² x₂ + x₃, ℓ = t x₁² + u² x₂ in any numbers.
fn end<T: Scalar>([a, b, c]: [T; 3]) -> T {
    a * a * b + c
}
fn running<T: Scalar>(t: T, [a, b, _]: [T; 3], u: T) -> T {
    t * a * a + u * u * b
}

struct Both;

impl<S> Objective<S, 3, 1> for Both
where
    S: Dynamics<State = Numbers<f64, 3>, Input = Push<f64>>,
{
    fn running(&self, _tick: usize, t: f64, x: &Numbers<f64, 3>, Push([u]): &Push<f64>) -> Slope<f64, 3, 1> {
        let jets = Jet::<f64, 3, 1>::variables(x.0);
        let u = Jet { by_others: [1.0], ..Jet::constant(*u) };
        let found = running(Jet::constant(t), jets, u);
        Slope { value: found.value, by_state: found.by, by_input: found.by_others }
    }
    fn end(&self, _t: f64, x: &Numbers<f64, 3>) -> Slope<f64, 3, 1> {
        let found = end(Jet::<f64, 3>::variables(x.0));
        Slope { value: found.value, by_state: found.by, by_input: [0.0] }
    }
}

/// Times that are not evenly spaced.
fn time(tick: usize) -> f64 {
    let k = tick as f64;
    0.3 + 0.05 * k + 0.001 * k * k
}

fn gradient<P: Tableau>(places: usize) -> (Gradient<Numbers<f64, 3>, f64, 3, 2>, [[f64; 1]; TICKS]) {
    let mut by_inputs = [[0.0]; TICKS];
    let mut room = [Checkpoint::room(Numbers([0.0; 3])); TICKS];
    let steps = Adjoint::new(&PENDULUM, Fixed::<P, f64>::new(0.05))
        .by_parameters(|s: &Pendulum<f64>, t, x: &Numbers<f64, 3>, u: &Push<f64>| s.by_parameters(t, x, u));
    let found =
        steps.gradient_at(time, &Numbers(START), &pushes(), &Both, &mut room[..places], &mut by_inputs);
    (found.unwrap(), by_inputs)
}

/// Mathematics (52): the gradient by everything is that of the same steps in jets, for every table; and how many states
/// are kept changes no bit.
#[test]
fn gradients_are_those_of_the_steps() {
    const ALL: usize = TICKS + 5;
    type J = Jet<f64, ALL>;
    fn check<P: Tableau>() {
        let (found, by_inputs) = gradient::<P>(TICKS);
        let given = pushes();
        let values: [f64; ALL] = core::array::from_fn(|i| match i {
            0..3 => START[i],
            3 => PENDULUM.k,
            4 => PENDULUM.c,
            _ => given[i - 5].0[0],
        });
        let all = J::variables(values);
        let system = Pendulum { k: all[3], c: all[4] };
        let mut x = Numbers([all[0], all[1], all[2]]);
        let mut cost = J::ZERO;
        for k in 0..TICKS {
            let (t, h) = (J::constant(time(k)), J::constant(time(k + 1) - time(k)));
            cost += h * running(t, x.0, all[5 + k]);
            x = Fixed::<P, J>::step(&system, t, h, &x, &Push([all[5 + k]]));
        }
        cost += end(x.0);
        close(found.value, cost.value, 64.0);
        assert_eq!(found.end.0, x.0.map(|x| x.value));
        let parts = found.by_start.iter().chain(&found.by_parameters).chain(by_inputs.iter().flatten());
        for (found, expected) in parts.zip(cost.by) {
            close(*found, expected, 256.0);
        }
        for places in 0..TICKS {
            assert_eq!(gradient::<P>(places), (found, by_inputs), "{places} places");
        }
    }
    check::<Euler1>();
    check::<Heun2>();
    check::<Ralston3>();
    check::<Kutta4>();
    check::<BogackiShampine3>();
    check::<DormandPrince5>();
    check::<Tsitouras5>();
    check::<DormandPrince8>();
    check::<Verner9>();
}

/// λᵀX is the same at every tick: what is pulled back and what is carried forwards are transposes of each other.
#[test]
fn covectors_times_columns_are_constant() {
    let motion = Variational::new(Free, [By::Start(0), By::Start(1)]);
    let start = motion.start(&Numbers([1.2, 0.5])).unwrap();
    let mut places = vec![start];
    for k in 0..200 {
        places.push(Dopri5::step(&motion, 0.1 * k as f64, 0.1, &places[k], &()));
    }
    let mut covector = [0.3, -1.1];
    let product = |covector: [f64; 2], columns: &[Numbers<f64, 2>; 2]| {
        columns.map(|Numbers([a, b])| covector[0] * a + covector[1] * b)
    };
    let expected = product(covector, &places[200].columns);
    for k in (0..200).rev() {
        let place = &places[k];
        let back = Fixed::<DormandPrince5, f64>::pulled_back_step(
            &Free,
            0.1 * k as f64,
            0.1,
            &place.state,
            &(),
            |_| covector,
            |_, _, ()| SMatrix::<f64, 2, 0>::zeros(),
        );
        covector = back.by_state;
        for (found, expected) in product(covector, &place.columns).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-13 * expected.abs().max(1.0), "{found} {expected}");
        }
    }
}

/// The same cost without that on the way.
struct OnlyEnd;

impl<S: Dynamics<State = Numbers<f64, 3>, Input = Push<f64>>> Objective<S, 3, 1> for OnlyEnd {
    fn end(&self, t: f64, x: &Numbers<f64, 3>) -> Slope<f64, 3, 1> {
        Objective::<S, 3, 1>::end(&Both, t, x)
    }
}

/// A long run with few places, against forward columns.
#[test]
fn long_runs_with_few_places() {
    const TICKS: usize = 3000;
    let pushes = vec![Push([0.1]); TICKS];
    let mut by_inputs = vec![[0.0]; TICKS];
    let mut room = [Checkpoint::room(Numbers([0.0; 3])); 12];
    let steps = Adjoint::new(&PENDULUM, Rk4::new(0.01));
    let found = steps.gradient(0.0, &Numbers(START), &pushes, &Both, &mut room, &mut by_inputs).unwrap();
    let last = steps.gradient(0.0, &Numbers(START), &pushes, &OnlyEnd, &mut room, &mut by_inputs).unwrap();
    assert_eq!(last.end, found.end);
    // the sum over all inputs is the derivative by a constant one
    let motion = Variational::new(PENDULUM, [By::Input(0), By::Start(1)]);
    let mut sim = Integrator::new(motion, Rk4::new(0.01), 0.0, motion.start(&Numbers(START)).unwrap());
    sim.set_input(Push([0.1]));
    sim.advance_to(30.0).unwrap();
    let slope = end(Jet::<f64, 3>::variables(sim.state().state.0)).by;
    let along = |column: &Numbers<f64, 3>| column.0.iter().zip(slope).map(|(x, g)| x * g).sum::<f64>();
    let [by_input, by_rate] = sim.state().columns;
    let sum: f64 = by_inputs.iter().flatten().sum();
    assert!((sum - along(&by_input)).abs() < 1e-11 * sum.abs().max(1.0), "{sum}");
    assert!((last.by_start[1] - along(&by_rate)).abs() < 1e-11);
}

/// The cost of the ticks as one per time.
struct Weighed(Quadratic<f64, 3, 1>);

impl Objective<Pendulum<f64>, 3, 1> for Weighed {
    fn running(&self, k: usize, _t: f64, x: &Numbers<f64, 3>, u: &Push<f64>) -> Slope<f64, 3, 1> {
        let (x, u) = (x.0.into(), u.0.into());
        let slope = self.0.stage_expansion(k, &x, &u);
        // per time, of which each tick has a tenth
        Slope {
            value: 10.0 * self.0.stage(k, &x, &u),
            by_state: (10.0 * slope.x).into(),
            by_input: (10.0 * slope.u).into(),
        }
    }
    fn end(&self, _t: f64, x: &Numbers<f64, 3>) -> Slope<f64, 3, 1> {
        let x = x.0.into();
        Slope { value: self.0.end(&x), by_state: self.0.end_expansion(&x).x.into(), by_input: [0.0] }
    }
}

/// The pendulum with the input of a model.
#[derive(Clone, Copy)]
struct Named;

impl Dynamics for Named {
    type State = Numbers<f64, 3>;
    type Input = [f64; 1];
    fn derivative(&self, t: f64, x: &Numbers<f64, 3>, u: &[f64; 1]) -> Numbers<f64, 3> {
        PENDULUM.derivative(t, x, &Push(*u))
    }
}

impl Jacobian for Named {
    type InputDim = D<1>;
    fn state_jacobian(&self, t: f64, x: &Numbers<f64, 3>, u: &[f64; 1]) -> [[f64; 3]; 3] {
        PENDULUM.state_jacobian(t, x, &Push(*u))
    }
    fn input_jacobian(&self, t: f64, x: &Numbers<f64, 3>, u: &[f64; 1]) -> [[f64; 1]; 3] {
        PENDULUM.input_jacobian(t, x, &Push(*u))
    }
}

/// The seam to optimisers takes the same adjoint.
#[test]
fn shooting_is_the_same() {
    let (mut states, mut gradient) = ([SVector::zeros(); TICKS], [SVector::zeros(); TICKS]);
    let cost = Quadratic {
        goal: vector![1.0, 0.0, 0.2],
        state: vector![1.0, 0.1, 0.0],
        input: vector![0.05],
        end: vector![3.0, 1.0, 0.5],
    };
    let inputs = pushes().map(|push| SVector::from(push.0));
    let model = Sampled { system: Named, start: 0.0, dt: 0.1 };
    let total = shooting_gradient(&model, &cost, &START.into(), &inputs, &mut states, &mut gradient).unwrap();
    let mut by_inputs = [[0.0]; TICKS];
    let mut room = [Checkpoint::room(Numbers([0.0; 3])); 3];
    let found = Adjoint::new(&PENDULUM, Rk4::new(0.1))
        .gradient(0.0, &Numbers(START), &pushes(), &Weighed(cost), &mut room, &mut by_inputs)
        .unwrap();
    close(found.value, total, 64.0);
    for (found, expected) in by_inputs.iter().flatten().zip(gradient.iter().flat_map(|g| g.iter())) {
        close(*found, *expected, 64.0);
    }
}

#[test]
fn without_steps_and_with_wrong_slices() {
    let mut room = [Checkpoint::room(Numbers([0.0; 3])); 3];
    let steps = Adjoint::new(&PENDULUM, Rk4::new(0.1));
    let none = steps.gradient(0.0, &Numbers(START), &[], &Both, &mut room, &mut []).unwrap();
    assert_eq!((none.value, none.end), (end(START), Numbers(START)));
    assert_eq!(none.by_start, end(Jet::<f64, 3>::variables(START)).by);
    let wrong = steps.gradient(0.0, &Numbers(START), &[Push([0.0]); 2], &Both, &mut room, &mut [[0.0]]);
    assert_eq!(wrong, Err(SensitivityError::Length { slice: "by_inputs", length: 1, expected: 2 }));
    let off = steps.gradient(0.0, &Numbers(START), &[Push([f64::NAN]); 2], &Both, &mut room, &mut [[0.0]; 2]);
    assert!(matches!(off, Err(SensitivityError::NotFinite { .. })));
    let nowhere = Numbers([f64::NAN, 0.0, 0.0]);
    for inputs in [&[][..], &[Push([0.0]); 3]] {
        let refused =
            steps.gradient(0.0, &nowhere, inputs, &Both, &mut room, &mut [[0.0]; 3][..inputs.len()]);
        assert_eq!(refused, Err(SensitivityError::NotFinite { what: "start", time: 0.0 }));
    }
    for length in [0.0, -0.1, f64::NAN] {
        let steps = Adjoint::new(&PENDULUM, Rk4::new(length));
        let refused = steps.gradient(0.0, &Numbers(START), &[Push([0.0])], &Both, &mut room, &mut [[0.0]]);
        assert!(matches!(refused, Err(SensitivityError::Integration(_))), "{length}: {refused:?}");
    }
}

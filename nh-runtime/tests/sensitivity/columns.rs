//! Forward sensitivities of explicit methods.

use nonholonomic::methods::{
    BogackiShampine3, DormandPrince5, DormandPrince8, Euler1, Fixed, Heun2, Kutta4, PerComponent, Ralston3,
    Tableau, Tsitouras5, Uniform, Verner9,
};
use nonholonomic::nalgebra::SMatrix;
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{By, ColumnTolerance, SensitivityError, Variational};
use nonholonomic::{D, Jacobian, Jet, Vern9};

use crate::models::{Numbers, Pendulum, Push, close};

const PENDULUM: Pendulum<f64> = Pendulum { k: 1.3, c: 0.2 };
const START: [f64; 3] = [0.7, -0.4, 0.1];
const PUSH: f64 = 0.3;

/// By all of the start, the input and both parameters.
const ALL: [By; 6] =
    [By::Start(0), By::Start(1), By::Start(2), By::Input(0), By::Parameter(0), By::Parameter(1)];

type J = Jet<f64, 6>;

/// The pendulum, its start and its push in numbers with the derivatives by all of these.
fn in_jets() -> (Pendulum<J>, Numbers<J, 3>, Push<J>) {
    let [a, b, c, push, k, friction] =
        J::variables([START[0], START[1], START[2], PUSH, PENDULUM.k, PENDULUM.c]);
    (Pendulum { k, c: friction }, Numbers([a, b, c]), Push([push]))
}

fn motion() -> Variational<
    Pendulum<f64>,
    impl Fn(&Pendulum<f64>, f64, &Numbers<f64, 3>, &Push<f64>) -> SMatrix<f64, 3, 2> + Copy,
    6,
> {
    Variational::new(PENDULUM, ALL).by_parameters(
        |system: &Pendulum<f64>, t, x: &Numbers<f64, 3>, u: &Push<f64>| system.by_parameters(t, x, u),
    )
}

/// Compares the columns with the derivatives that the same steps in jets have.
fn agree(columns: &[Numbers<f64, 3>; 6], jets: &Numbers<J, 3>, ulps: f64) {
    for (k, column) in columns.iter().enumerate() {
        for (found, expected) in column.0.iter().zip(&jets.0) {
            close(*found, expected.by[k], ulps);
        }
    }
}

/// Mathematics (51): steps of the variational equation are the derivatives of the steps, of every table.
#[test]
fn columns_are_the_derivatives_of_the_steps() {
    fn check<P: Tableau>() {
        let motion = motion();
        let start = motion.start(&Numbers(START)).unwrap();
        let mut sim = Integrator::new(motion, Fixed::<P, f64>::new(0.05), 0.2, start);
        sim.set_input(Push([PUSH]));
        let (system, mut jets, push) = in_jets();
        let mut t = 0.2;
        for _ in 0..60 {
            sim.step().unwrap();
            let h = sim.time() - t;
            jets = Fixed::<P, J>::step(&system, J::constant(t), J::constant(h), &jets, &push);
            t = sim.time();
        }
        for (found, expected) in sim.state().state.0.iter().zip(&jets.0) {
            close(*found, expected.value, 64.0);
        }
        agree(&sim.state().columns, &jets, 512.0);
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

/// With tolerances of the state alone, the steps are those of an integration without columns, and the columns their
/// derivatives.
#[test]
fn columns_that_are_not_looked_at_change_no_step() {
    let uniform = Uniform::of(1e-7, 1e-9);
    let tolerance = ColumnTolerance::of_state(uniform);
    let motion = motion();
    let start = motion.start(&Numbers(START)).unwrap();
    let mut sim = Integrator::new(motion, Dopri5::new().tolerance(tolerance).first_step(0.01), 0.0, start);
    let plain = Dopri5::new().tolerance(uniform).first_step(0.01);
    let mut alone = Integrator::new(PENDULUM, plain, 0.0, Numbers(START));
    sim.set_input(Push([PUSH]));
    alone.set_input(Push([PUSH]));
    let (system, mut jets, push) = in_jets();
    while alone.time() < 10.0 {
        let t = alone.time();
        alone.step().unwrap();
        sim.step().unwrap();
        assert_eq!((sim.time(), sim.state().state), (alone.time(), *alone.state()));
        let h = J::constant(alone.time() - t);
        jets = Fixed::<DormandPrince5, J>::step(&system, J::constant(t), h, &jets, &push);
    }
    agree(&sim.state().columns, &jets, 4096.0);
    assert_eq!(sim.statistics().rejected, alone.statistics().rejected);
}

/// x' = −p x + u: x = e^(−p t) x₀ + u (1 − e^(−p t))/p.
#[derive(Clone, Copy)]
struct Decay(f64);

impl Dynamics for Decay {
    type State = Numbers<f64, 1>;
    type Input = Push<f64>;
    fn derivative(&self, _t: f64, Numbers([x]): &Numbers<f64, 1>, Push([u]): &Push<f64>) -> Numbers<f64, 1> {
        Numbers([u - self.0 * x])
    }
}

impl Jacobian for Decay {
    type InputDim = D<1>;
    fn state_jacobian(&self, _t: f64, _x: &Numbers<f64, 1>, _u: &Push<f64>) -> [[f64; 1]; 1] {
        [[-self.0]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Numbers<f64, 1>, _u: &Push<f64>) -> [[f64; 1]; 1] {
        [[1.0]]
    }
}

/// Where nothing is left of the state but its columns move on, tolerances of the columns are what keeps their digits.
#[test]
fn columns_have_tolerances_of_their_own() {
    let (p, u) = (2.0, 0.5);
    let motion = Variational::new(Decay(p), [By::Start(0), By::Input(0), By::Parameter(0)]).by_parameters(
        |_: &Decay, _, Numbers([x]): &Numbers<f64, 1>, _: &Push<f64>| SMatrix::<f64, 1, 1>::new(-x),
    );
    // on its equilibrium: the state stands still, and every step keeps it
    let start = motion.start(&Numbers([u / p])).unwrap();
    let error = |tolerance: ColumnTolerance<f64, Uniform<f64>, Uniform<f64>, 3>| {
        let mut sim = Integrator::new(motion, Dopri5::new().tolerance(tolerance), 0.0, start);
        sim.set_input(Push([u]));
        sim.advance_to(1.5).unwrap();
        let decayed = (-p * 1.5_f64).exp();
        let expected = [decayed, (1.0 - decayed) / p, -u / p / p * (1.0 - decayed)];
        let columns = sim.state().columns.iter().zip(expected);
        (columns.map(|(found, expected)| (found.0[0] - expected).abs()).fold(0.0, f64::max), sim.statistics())
    };
    let (fine, fine_cost) = error(ColumnTolerance::new(1e-4, 1e-11));
    let (coarse, cost) = error(ColumnTolerance::new(1e-4, 1e-7));
    let (unseen, unseen_cost) = error(ColumnTolerance::of_state(Uniform::of(1e-4, 1e-4)));
    assert!(fine < 1e-9 && coarse < 1e-3, "{fine:e} {coarse:e}");
    assert!(unseen > coarse && unseen_cost.steps < cost.steps && cost.steps < fine_cost.steps, "{unseen:e}");
    // a column by what is a thousandth in size may err by a thousand times as much
    let (plain, plain_cost) = error(ColumnTolerance::new(1e-4, 1e-9));
    let (sized, sized_cost) = error(ColumnTolerance::new(1e-4, 1e-9).sizes([1e-3; 3]));
    assert!(sized_cost.steps < plain_cost.steps && sized > plain);
}

#[test]
fn what_is_wrong_is_refused() {
    let motion = Variational::new(PENDULUM, [By::Start(3)]);
    let found = motion.start(&Numbers(START)).unwrap_err();
    assert_eq!(found, SensitivityError::NoSuchColumn { what: "components of the state", index: 3, count: 3 });
    assert_eq!(
        found.to_string(),
        "a column is to be taken by number 3 of the components of the state, of which there are 3: count from 0"
    );
    for by in [By::Parameter(0), By::Input(1)] {
        assert!(Variational::new(PENDULUM, [by]).start(&Numbers(START)).is_err());
    }
    let motion = Variational::new(PENDULUM, [By::Start(0)]);
    let start = motion.start(&Numbers(START)).unwrap();
    let each = PerComponent::of(Numbers([1e-6; 3]), Numbers([1e-9, -1.0, 1e-9]));
    for tolerance in [
        ColumnTolerance::of_both(PerComponent::of(Numbers([1e-6; 3]), Numbers([1e-9; 3])), each),
        ColumnTolerance::of_both(each, PerComponent::of(Numbers([1e-6; 3]), Numbers([1e-9; 3]))),
        ColumnTolerance::of_both(
            PerComponent::of(Numbers([1e-6; 3]), Numbers([1e-9; 3])),
            PerComponent::of(Numbers([1e-6; 3]), Numbers([1e-9; 3])),
        )
        .sizes([0.0]),
    ] {
        let mut sim = Integrator::new(motion, Vern9::new().tolerance(tolerance), 0.0, start);
        assert!(matches!(sim.step(), Err(IntegrationError::Setting { .. })));
    }
}

/// In single precision, too: the columns of the same steps differ by rounding alone, and the control by columns keeps
/// what it promises. It is asked before the pendulum turns back: friction of the square of the rate bends the columns
/// there, and what a step across that costs depends on where it falls, in double precision as well.
#[test]
fn in_single_precision() {
    let system = Pendulum { k: 1.3_f32, c: 0.2 };
    let single = Variational::new(system, ALL)
        .by_parameters(|s: &Pendulum<f32>, t, x: &Numbers<f32, 3>, u: &Push<f32>| s.by_parameters(t, x, u));
    let narrow = single.start(&Numbers(START.map(<f32 as Scalar>::from_f64))).unwrap();
    let wide = motion().start(&Numbers(START)).unwrap();

    let mut steps = Integrator::new(single, Rk4::new(0.0625), 0.0, narrow);
    let mut same = Integrator::new(motion(), Rk4::new(0.0625), 0.0, wide);
    steps.set_input(Push([0.3]));
    same.set_input(Push([PUSH]));
    steps.advance_to(3.0).unwrap();
    same.advance_to(3.0).unwrap();
    alike(&steps.state().columns, &same.state().columns, 1e-6);

    let mut controlled =
        Integrator::new(single, Dopri5::new().tolerance(ColumnTolerance::new(1e-6, 1e-6)), 0.0, narrow);
    let fine = Dop853::new().tolerance(ColumnTolerance::new(1e-12, 1e-12));
    let mut fine = Integrator::new(motion(), fine, 0.0, wide);
    controlled.set_input(Push([0.3]));
    fine.set_input(Push([PUSH]));
    controlled.advance_to(1.0).unwrap();
    fine.advance_to(1.0).unwrap();
    alike(&controlled.state().columns, &fine.state().columns, 1e-6);
}

/// Compares columns in single precision with those in double.
fn alike(single: &[Numbers<f32, 3>; 6], double: &[Numbers<f64, 3>; 6], tolerance: f64) {
    for (single, double) in single.iter().zip(double).flat_map(|(a, b)| a.0.iter().zip(b.0)) {
        assert!((f64::from(*single) - double).abs() < tolerance * double.abs().max(1.0), "{single} {double}");
    }
}

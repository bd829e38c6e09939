//! Lanes equal numbers, bit for bit.

use nh_lanes::{Random, Sleigh, SleighInput, SleighState, sleigh};
use nonholonomic::prelude::*;
use nonholonomic::wide::{f32x8, f64x4};

/// A number whose bits can be compared.
trait Bits: Scalar {
    fn bits(self) -> u64;
    fn any(random: &mut Random) -> Self;
}
impl Bits for f64 {
    fn bits(self) -> u64 {
        // NaN differ in bits that mean nothing
        if self.is_nan() { 0x7ff8 << 48 } else { self.to_bits() }
    }
    fn any(random: &mut Random) -> Self {
        match random.bits() % 8 {
            0 => f64::from_bits(random.bits()),
            1 => [0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0][(random.bits() % 6) as usize],
            2 => 1e7 * random.number(),
            _ => 10.0 * random.number(),
        }
    }
}
impl Bits for f32 {
    fn bits(self) -> u64 {
        if self.is_nan() { 0x7fc0 << 16 } else { self.to_bits().into() }
    }
    #[allow(clippy::cast_possible_truncation)]
    fn any(random: &mut Random) -> Self {
        if random.bits().is_multiple_of(8) {
            f32::from_bits(random.bits() as u32)
        } else {
            f64::any(random) as f32
        }
    }
}

/// Compares a function of lanes with that of each number.
fn same<L: Lanes<Lane: Bits>>(what: &str, lanes: L, single: impl Fn(usize) -> L::Lane) {
    for i in 0..L::COUNT {
        assert_eq!(
            lanes.lane(i).bits(),
            single(i).bits(),
            "{what}, lane {i}: {:?} {:?}",
            lanes.lane(i),
            single(i)
        );
    }
}

fn functions<L, F>()
where
    L: Lanes<Lane: Bits>,
    F: Lanes<Lane = L::Lane>,
{
    let mut random = Random(99);
    for _ in 0..10_000 {
        let [a, b, c] = [(); 3].map(|()| L::from_lanes(|_| L::Lane::any(&mut random)));
        let one = |pack: L, i: usize| F::splat(pack.lane(i));
        macro_rules! compare {
            ($($text:literal $function:expr;)*) => {$(
                same($text, { let f: fn(L, L, L) -> L = $function; f(a, b, c) }, |i| {
                    let f: fn(F, F, F) -> F = $function;
                    f(one(a, i), one(b, i), one(c, i)).lane(0)
                });
            )*};
        }
        compare! {
            "+" |a, b, _| a + b;
            "-" |a, b, _| a - b;
            "*" |a, b, _| a * b;
            "/" |a, b, _| a / b;
            "neg" |a, _, _| -a;
            "mul_add" |a, b, c| a.mul_add(b, c);
            "mul_add_exact" |a, b, _| a.mul_add_exact(b, -(a * b));
            "recip" |a, _, _| a.recip();
            "sin" |a, _, _| a.sin();
            "cos" |a, _, _| a.cos();
            "sin_cos().0" |a, _, _| a.sin_cos().0;
            "sin_cos().1" |a, _, _| a.sin_cos().1;
            "sqrt" |a, _, _| a.sqrt();
            "cbrt" |a, _, _| a.cbrt();
            "tan" |a, _, _| a.tan();
            "asin" |a, _, _| a.asin();
            "acos" |a, _, _| a.acos();
            "atan" |a, _, _| a.atan();
            "atan2" |a, b, _| a.atan2(b);
            "sinh" |a, _, _| a.sinh();
            "cosh" |a, _, _| a.cosh();
            "tanh" |a, _, _| a.tanh();
            "exp" |a, _, _| a.exp();
            "ln" |a, _, _| a.ln();
            "powf" |a, b, _| a.powf(b);
            "powi" |a, _, _| a.powi(-3);
            "abs" |a, _, _| a.abs();
            "sign" |a, _, _| a.sign();
            "min" |a, b, _| a.min(b);
            "max" |a, b, _| a.max(b);
            "select_gt" |a, b, c| a.select_gt(b, c, a + c);
        }
        let all = |condition: fn(F, F) -> bool| (0..L::COUNT).all(|i| condition(one(a, i), one(b, i)));
        assert_eq!(a.all_gt(b), all(Scalar::all_gt));
        assert_eq!(a.all_ge(b), all(Scalar::all_ge));
        assert_eq!(a.all_ne(b), all(Scalar::all_ne));
        assert_eq!(a.is_finite(), all(|a, _| a.is_finite()));
    }
}

#[test]
fn functions_of_lanes_are_those_of_numbers() {
    functions::<f64x4, Fast<f64>>();
    functions::<f32x8, Fast<f32>>();
}

/// Steps, energies, outputs and Jacobians of the sleigh, at states and parameters that differ from lane to lane.
fn systems<L, F>(shared_input: f64)
where
    L: Lanes<Lane: Bits>,
    F: Lanes<Lane = L::Lane>,
{
    let value = |i: usize| L::Lane::from_f64(0.37 * f64::from(u8::try_from(i).unwrap()) - 1.1);
    let start = |number: &dyn Fn(f64) -> L::Lane| [0.3, -2.0, 0.7, 1.9, -0.8].map(number);
    let lane = |i: usize| move |share: f64| L::Lane::from_f64(share) * value(i) + L::Lane::from_f64(0.1);
    let lanes: Sleigh<L> = sleigh(value);
    let mut state: SleighState<L> =
        SleighState::from([0, 1, 2, 3, 4].map(|k| L::from_lanes(|i| start(&lane(i))[k])));
    let singles: Vec<Sleigh<F>> = (0..L::COUNT).map(|i| sleigh(|_| value(i))).collect();
    let mut alone: Vec<SleighState<F>> =
        (0..L::COUNT).map(|i| SleighState::from(start(&lane(i)).map(F::splat))).collect();
    let dt = 0.01;
    for step in 0..200 {
        let t = f64::from(step) * dt;
        let input = SleighInput { torque: L::from_f64(shared_input) };
        let single_input = SleighInput { torque: F::from_f64(shared_input) };
        state = Rk4::step(&lanes, L::from_f64(t), L::from_f64(dt), &state, &input);
        let energy = lanes.energy(L::from_f64(t), &state);
        let speed = lanes.outputs(L::from_f64(t), &state, &input).speed;
        let (a, b) = lanes.jacobian(L::from_f64(t), &state, &input);
        for (i, (single, alone)) in singles.iter().zip(&mut alone).enumerate() {
            *alone = Rk4::step(single, F::from_f64(t), F::from_f64(dt), alone, &single_input);
            let equal = |what: &str, lanes: L, number: F| {
                assert_eq!(lanes.lane(i).bits(), number.lane(0).bits(), "{what}, step {step}, lane {i}");
            };
            for (ours, theirs) in state.to_array().into_iter().zip(alone.to_array()) {
                equal("state", ours, theirs);
            }
            equal("energy", energy, single.energy(F::from_f64(t), alone));
            equal("speed", speed, single.outputs(F::from_f64(t), alone, &single_input).speed);
            let (single_a, single_b) = single.jacobian(F::from_f64(t), alone, &single_input);
            for (ours, theirs) in a.iter().zip(single_a.iter()).chain(b.iter().zip(single_b.iter())) {
                equal("Jacobian", *ours, *theirs);
            }
        }
    }
    assert!(lanes.validate().is_ok());
}

#[test]
fn systems_of_lanes_are_those_of_numbers() {
    systems::<f64x4, Fast<f64>>(0.2);
    systems::<f32x8, Fast<f32>>(0.2);
}

#[test]
fn one_broken_lane_is_found() {
    let mut broken: Sleigh<f64x4> = sleigh(|_| 0.0);
    broken.m = f64x4::from_lanes(|i| if i == 2 { -1.0 } else { 1.0 });
    assert!(broken.validate().is_err());
    broken.m = f64x4::from_lanes(|i| if i == 3 { f64::NAN } else { 1.0 });
    assert!(broken.validate().unwrap_err().to_string().contains("NaN"));
}

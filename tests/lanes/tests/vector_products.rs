//! Products of Jacobians with vectors in lanes equal those in numbers, bit for bit.

use nonholonomic::prelude::*;
use nonholonomic::wide::f64x4;

/// A cart with a motor on a hill: the current follows the voltage with a delay.
#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 - m * cos(x) }
    inputs     { volts }
    auxiliary  { der(current) = (volts - gain * der(x) - resistance * sin(current)) / inductance; }
    forces     { x: gain * current; }
    assume     { m > 0; inductance > 0; }
    emit       { jacobian_product, adjoint_product }
)]
#[derive(Clone, Copy, Debug)]
struct Cart<T> {
    m: T,
    gain: T,
    resistance: T,
    inductance: T,
}

fn equal<const N: usize>(lanes: [f64x4; N], numbers: [Fast<f64>; N], lane: usize) {
    for (number, all) in numbers.iter().zip(&lanes) {
        assert_eq!(number.0.to_bits(), all.lane(lane).to_bits(), "lane {lane}");
    }
}

#[test]
fn products_in_lanes() {
    let lanes =
        |scale: f64| f64x4::from_lanes(|i| scale * (1.0 + 0.37 * f64::from(u8::try_from(i).unwrap())));
    let cart = Cart { m: lanes(0.5), gain: lanes(0.4), resistance: lanes(1.1), inductance: lanes(0.05) };
    let state = CartState::from([0.1, -0.7, 1.3].map(lanes));
    let vector = CartState::from([-0.9, 0.3, 0.2].map(lanes));
    let [input, along] = [6.0, -0.4].map(|volts| CartInput { volts: lanes(volts) });
    let forth = cart.jacobian_product(lanes(0.0), &state, &input, &vector, &along).to_array();
    let (back, by_input) = cart.adjoint_product(lanes(0.0), &state, &input, &vector);
    for i in 0..4 {
        let [m, gain, resistance, inductance] =
            [cart.m, cart.gain, cart.resistance, cart.inductance].map(|x| Fast(x.lane(i)));
        let single = Cart { m, gain, resistance, inductance };
        let of = |state: &CartState<f64x4>| CartState::from(state.to_array().map(|x| Fast(x.lane(i))));
        let (state, vector) = (of(&state), of(&vector));
        let [input, along] = [&input, &along].map(|input| CartInput { volts: Fast(input.volts.lane(i)) });
        equal(forth, single.jacobian_product(Fast(0.0), &state, &input, &vector, &along).to_array(), i);
        let (one_back, one_by_input) = single.adjoint_product(Fast(0.0), &state, &input, &vector);
        equal(back.to_array(), one_back.to_array(), i);
        equal([by_input.volts], [one_by_input.volts], i);
    }
}

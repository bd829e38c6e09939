//! Auxiliary states in lanes equal those in numbers, bit for bit.

use nonholonomic::prelude::*;
use nonholonomic::wide::f64x4;

/// A cart with a motor: the current follows the voltage with a delay.
#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 }
    inputs     { volts }
    auxiliary  { der(current) = (volts - gain * der(x) - resistance * sin(current)) / inductance; }
    forces     { x: gain * current; }
    assume     { m > 0; inductance > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Cart<T> {
    m: T,
    gain: T,
    resistance: T,
    inductance: T,
}

#[test]
fn currents_in_lanes() {
    let lanes =
        |scale: f64| f64x4::from_lanes(|i| scale * (1.0 + 0.37 * f64::from(u8::try_from(i).unwrap())));
    let cart = Cart { m: lanes(0.5), gain: lanes(0.4), resistance: lanes(1.1), inductance: lanes(0.05) };
    let state = CartState { x: lanes(0.1), x_dot: lanes(-0.7), current: lanes(1.3) };
    let found = cart.derivative(lanes(0.0), &state, &CartInput { volts: lanes(6.0) });
    for i in 0..4 {
        let [m, gain, resistance, inductance] =
            [cart.m, cart.gain, cart.resistance, cart.inductance].map(|x| Fast(x.lane(i)));
        let single = Cart { m, gain, resistance, inductance };
        let [x, x_dot, current] = [state.x, state.x_dot, state.current].map(|x| Fast(x.lane(i)));
        let state = CartState { x, x_dot, current };
        let volts = Fast(lanes(6.0).lane(i));
        let rate = single.derivative(Fast(0.0), &state, &CartInput { volts });
        let all: [Fast<f64>; 3] = rate.into();
        let lane: [f64x4; 3] = found.into();
        for (number, lane) in all.iter().zip(&lane) {
            assert_eq!(number.0.to_bits(), lane.lane(i).to_bits(), "lane {i}");
        }
    }
}

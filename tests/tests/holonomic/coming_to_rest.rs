//! A linkage whose trim is looked for from guesses that move: where it is found all rest, and the linear model is there.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { a, b, c }
    let e(q) = [cos(q), sin(q)];
    holonomic { closure: l1 * e(a) + l2 * e(b) - l3 * e(c) - [d, 0] = 0; }
    lagrangian {
        J / 2 * (der(a)^2 + der(b)^2 + der(c)^2) - m * g * (l1 * sin(a) + l2 / 2 * sin(b)) - k / 2 * (c - b)^2
    }
    linearization { keep: a, der(a); }
)]
#[derive(Clone, Copy, Debug)]
struct Sprung {
    l1: f64,
    l2: f64,
    l3: f64,
    d: f64,
    J: f64,
    m: f64,
    g: f64,
    k: f64,
}

#[test]
fn what_is_trimmed_is_linearized() {
    let linkage = Sprung { l1: 1.0, l2: 3.1, l3: 2.4, d: 3.3, J: 0.4, m: 2.0, g: 9.81, k: 30.0 };
    let random = |number: u32| 2.0 * (f64::from(number) * 0.754_877_666).fract() - 1.0;
    let mut found = 0;
    for number in 0..20 {
        let [a, b, c, a_dot, b_dot, c_dot] = [0, 1, 2, 3, 4, 5].map(|place| random(6 * number + place));
        let guess = SprungState { a: 0.7 + a, b: 0.75 + b, c: 1.9 + c, a_dot, b_dot, c_dot };
        let Ok((rest, ())) = linkage.trim(0.0, &guess, &(), &[]) else { continue };
        found += 1;
        let rates = [rest.a_dot, rest.b_dot, rest.c_dot];
        assert!(rates.iter().all(|rate| rate.abs() < 1e-15), "{number}: {rates:?}");
        let model = linkage.linearize(0.0, &rest, &()).unwrap();
        let slope = |by: f64| {
            let moved = SprungState { a: rest.a + by, ..rest };
            let on = linkage.assemble_holding(0.0, &moved, &[SprungCoordinate::a]).unwrap();
            linkage.derivative(0.0, &on, &()).a_dot
        };
        let difference = (slope(1e-5) - slope(-1e-5)) / 2e-5;
        assert!((model.a[(1, 0)] - difference).abs() < 1e-6 * (1.0 + difference.abs()), "{model:?}");
    }
    assert!(found > 13, "{found}");
}

//! A plate in the plane on two legs that are pushed: held by where it is, against the balance of its forces.

use nonholonomic::prelude::*;

/// Each leg turns about its foot and has a mass at its upper end, where the plate is.
#[nonholonomic(
    base { x, y, a, q1, s1, q2, s2 }
    let e(q) = [cos(q), sin(q)];
    let p = [x, y];
    let upper1 = [-d, 0] + s1 * e(q1);
    let upper2 = [d, 0] + s2 * e(q2);
    lagrangian {
        kinetic(M, I, p, a) + kinetic(m, upper1) + kinetic(m, upper2)
            - g * (M * y + m * (upper1[1] + upper2[1]))
    }
    holonomic {
        one: upper1 - (p - w * e(a)) = 0;
        two: upper2 - (p + w * e(a)) = 0;
    }
    inputs { push1, push2 }
    forces { s1: push1; s2: push2; }
    assume { M > 0; I > 0; m > 0; w > 0; d > 0; }
    emit   { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Plate {
    M: f64,
    I: f64,
    m: f64,
    g: f64,
    w: f64,
    d: f64,
}

const PLATE: Plate = Plate { M: 3.0, I: 0.2, m: 0.1, g: 9.81, w: 0.3, d: 0.5 };
const ROUGH: PlateState = PlateState {
    x: 0.05,
    y: 0.8,
    a: 0.1,
    q1: 1.4,
    s1: 0.8,
    q2: 1.7,
    s2: 0.8,
    x_dot: 0.0,
    y_dot: 0.0,
    a_dot: 0.0,
    q1_dot: 0.0,
    s1_dot: 0.0,
    q2_dot: 0.0,
    s2_dot: 0.0,
};

/// Also those that are zero: an equation that holds before the step has nothing but rounding after it.
#[test]
fn held_coordinates_keep_their_rates() {
    use PlateCoordinate::{a, x, y};
    for x_dot in [0.0, 0.1, 1.0] {
        for y_dot in [0.0, -0.7, 2.0] {
            for a_dot in [0.0, 0.2, 3.0] {
                for legs in [0.0, 0.1] {
                    let guess = PlateState {
                        x_dot,
                        y_dot,
                        a_dot,
                        q1_dot: legs,
                        s1_dot: legs,
                        q2_dot: legs,
                        s2_dot: legs,
                        ..ROUGH
                    };
                    let found = PLATE.assemble_holding(0.0, &guess, &[x, y, a]);
                    let found =
                        found.unwrap_or_else(|error| panic!("{x_dot} {y_dot} {a_dot} {legs}: {error}"));
                    let rates = [found.x_dot - x_dot, found.y_dot - y_dot, found.a_dot - a_dot];
                    assert!(rates.iter().all(|off| off.abs() < 1e-15), "{rates:?}");
                    let open: [f64; 8] = PLATE.constraint_residual(0.0, &found).into();
                    assert!(open.iter().all(|left| left.abs() < 1e-14), "{open:?}");
                }
            }
        }
    }
}

/// Newton and Euler for the plate alone: the multipliers are what it takes from the legs, with the sign turned.
#[test]
fn the_plate_is_balanced_by_its_legs() {
    use PlateCoordinate::{a, x, y};
    let guess = PlateState { x_dot: 0.1, a_dot: 0.2, ..ROUGH };
    let start = PLATE.assemble_holding(0.0, &guess, &[x, y, a]).unwrap();
    let input = PlateInput { push1: 19.0, push2: 14.0 };
    let rates = PLATE.derivative(0.0, &start, &input);
    let forces = PLATE.multipliers(0.0, &start, &input);
    let [one, two] = [forces.one, forces.two].map(|[across, up]| [-across, -up]);
    let Plate { M, I, g, w, .. } = PLATE;
    let (sin, cos) = start.a.sin_cos();
    let moment = w * (cos * (two[1] - one[1]) - sin * (two[0] - one[0]));
    let left = [
        M * rates.x_dot - one[0] - two[0],
        M * (rates.y_dot + g) - one[1] - two[1],
        I * rates.a_dot - moment,
    ];
    assert!(left.iter().all(|left| left.abs() < 1e-13), "{left:?}");
    assert!(one[1] > 5.0 && two[1] > 5.0, "{one:?} {two:?}");
}

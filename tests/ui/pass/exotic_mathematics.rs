use nonholonomic::prelude::*;

#[nonholonomic(base { x } basis { v } anchor { der(x) = 0; } brackets { } lagrangian { m / 2 * v^2 })]
struct AnchorZero { m: f64 }

#[nonholonomic(base { x, y, z } basis { v } anchor { der(x) = v; der(y) = 0; der(z) = y * v; } brackets { } lagrangian { v^2 / 2 })]
struct UnusedNames { m: f64 }

#[nonholonomic(base { x, y, z } lagrangian { exp(der(x)) + der(y)^(3/2) - m * sqrt(1 - der(z)^2) })]
struct NotQuadratic { m: f64 }

#[nonholonomic(base { x } basis { v, w } anchor { der(x) = v; } brackets { [v, w] = x * w; } lagrangian { (v^2 + w^2) / 2 })]
struct BracketOnTheBase;

#[nonholonomic(basis { a, b, c } brackets so(3) { a, b, c } lagrangian { a^2 + b^2 + c^2 } constraints { a = b * sin(t); })]
struct ConstraintWithoutCoordinates {}

fn main() {
    let start = AnchorZeroState { x: 1.0, v: 2.0 };
    assert_eq!(AnchorZero { m: 1.0 }.derivative(0.0, &start, &()), AnchorZeroState::default());
}

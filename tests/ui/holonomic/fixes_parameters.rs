use nonholonomic::prelude::*;

/// A rod of two lengths.
#[nonholonomic(
    base { x, y }
    holonomic {
        one: x^2 + y^2 = a^2;
        two: 2 * x^2 + 2 * y^2 = b;
        redundant;
    }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64, a: f64, b: f64 }

fn main() {}

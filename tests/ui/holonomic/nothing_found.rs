use nonholonomic::prelude::*;

#[nonholonomic(
    base { a, b }
    holonomic {
        one: exp(a) + sin(a * b) = 2;
        two: exp(b) + cos(a) * b^3 = 2;
    }
    lagrangian { J / 2 * (der(a)^2 + der(b)^2) }
)]
struct S { J: f64 }

fn main() {}

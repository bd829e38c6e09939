use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints {
        first: der(y) = der(x);
        second: der(z) = der(y);
        third: der(z) = der(x);
    }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - J * x * y }
    emit { momenta }
)]
struct Sleigh {
    m: f64,
    J: f64,
}

fn main() {}

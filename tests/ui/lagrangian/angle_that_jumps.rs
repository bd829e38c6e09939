use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * y * atan2(0 * y, x) }
)]
#[derive(Clone, Copy)]
struct S {
    m: f64,
    k: f64,
}

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - (r + d) * x }
    assume { r > 0; d > 2 * r; d^2 < 4 * r^2; }
)]
#[derive(Clone, Copy)]
struct S {
    m: f64,
    r: f64,
    d: f64,
}

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - m * g * h * sin(x) }
    units { x, h = m; m = kg; g = m s^-2; }
)]
struct S { m: f64, g: f64, h: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - m * g * x - k * x }
    units { x = m; m = kg; g = m/s^2; k = N/m; }
)]
struct S { m: f64, g: f64, k: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, x_dot }
    lagrangian { m / 2 * (der(x)^2 + der(x_dot)^2) }
)]
struct S { m: f64 }

fn main() {}

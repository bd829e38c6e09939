use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    units { x = 10 m; }
)]
struct S { m: f64 }

fn main() {}

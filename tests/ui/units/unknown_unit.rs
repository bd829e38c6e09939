use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    units { x = meter; m = Kg; }
)]
struct S { m: f64 }

fn main() {}

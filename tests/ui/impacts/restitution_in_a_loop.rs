use nonholonomic::prelude::*;

#[nonholonomic(
    base { y[2] }
    lagrangian { m / 2 * dot(der(y), der(y)) - m * (y[0] + y[1]) }
    impacts { for i in 0..2 { floor: y[i] >= 0 with restitution e[i]; } }
)]
struct S { m: f64, e: [f64; 2] }

fn main() {}

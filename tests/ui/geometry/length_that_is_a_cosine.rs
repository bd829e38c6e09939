use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, a }
    lagrangian { kinetic(m, J, [x, 0], a) - k * norm([sin(a) * cos(a), cos(a)^2]) }
)]
struct S { m: f64, J: f64, k: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[9] }
    lagrangian { m / 2 * dot(der(x), der(x)) }
    constraints { for i in 0..4000 { for j in 0..4000 { der(x[0]) = i * j; } } }
)]
struct S { m: f64 }

fn main() {}

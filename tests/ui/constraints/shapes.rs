use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[3] }
    lagrangian { m / 2 * dot(der(x), der(x)) }
    constraints { der(x) = [0, 1]; }
)]
struct S { m: f64 }

fn main() {}

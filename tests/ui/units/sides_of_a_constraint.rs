use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, q }
    lagrangian { m / 2 * der(x)^2 + J / 2 * der(q)^2 }
    constraints { rolling: der(x) = r^2 * der(q); }
    units { x, r = m; q = 1; m = kg; J = kg m^2; }
)]
struct S { m: f64, J: f64, r: f64 }

fn main() {}

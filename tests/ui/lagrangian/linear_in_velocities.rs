use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { x * der(y) - y * der(x) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { m }
    lagrangian { der(m)^2 / 2 }
)]
struct S { m: f64 }

fn main() {}

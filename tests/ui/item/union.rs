use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 }
)]
union S { m: f64, k: f64 }

fn main() {}

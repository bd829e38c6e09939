use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m * x }
)]
struct S { m: f64 }

fn main() {}

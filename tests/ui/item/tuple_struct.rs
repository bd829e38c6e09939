use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 }
)]
struct S(f64);

fn main() {}

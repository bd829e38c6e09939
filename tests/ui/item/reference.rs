use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
)]
struct S<'a> { m: &'a f64 }

fn main() {}

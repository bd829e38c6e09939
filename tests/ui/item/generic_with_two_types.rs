use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k * x }
)]
struct S<T, U> { m: T, k: U }

fn main() {}

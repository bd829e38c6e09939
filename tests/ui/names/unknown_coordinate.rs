use nonholonomic::prelude::*;

#[nonholonomic(
    base { phi }
    lagrangian { m / 2 * der(psi)^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k * x }
)]
struct S { m: f64, #[nh(skip)] k: u8 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { y }
    lagrangian { m / 2 * der(y)^2 }
    emit { trim }
)]
struct Mass { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 }
    forces     { x: -abs(der(x)) * der(x); }
    emit       { taylor }
)]
struct Kink { m: f64 }

fn main() {}

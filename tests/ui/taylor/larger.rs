use nonholonomic::prelude::*;

#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 }
    forces     { x: max(der(x), x); }
    emit       { taylor }
)]
struct Larger { m: f64 }

fn main() {}

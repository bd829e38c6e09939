use nonholonomic::prelude::*;

#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 }
    forces     { x: -sign(der(x)); }
    emit       { taylor }
)]
struct Jump { m: f64 }

fn main() {}

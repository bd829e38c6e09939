use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 * (1 + t^2) / 2 }
    emit { connection }
)]
struct Growing;

fn main() {}

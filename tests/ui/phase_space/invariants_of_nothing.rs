use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    emit { invariants }
)]
struct Free;

fn main() {}

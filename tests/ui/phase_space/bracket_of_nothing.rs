use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    emit { bracket }
)]
struct Free;

fn main() {}

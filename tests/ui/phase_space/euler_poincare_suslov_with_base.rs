use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    emit { euler_poincare_suslov }
)]
struct Free;

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y } holonomic { rod: x^2 + y^2 = 1; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    inputs { push } forces { x: push; }
    emit { rattle }
)]
struct Rod;

fn main() {}

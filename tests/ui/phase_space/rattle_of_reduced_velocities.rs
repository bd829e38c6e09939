use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y } holonomic { rod: x^2 + y^2 = 1; }
    independent { der(x) }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    emit { rattle }
)]
struct Rod;

fn main() {}

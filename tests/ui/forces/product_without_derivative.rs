use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    forces { x: self.motor(der(x)); }
    emit { adjoint_product }
)]
struct Cart { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    forces { x: self.drag(der(x)); }
    emit { jacobian }
)]
struct Cart { m: f64 }

impl Cart {
    fn drag(&self, v: f64) -> f64 { -v }
}

fn main() {}

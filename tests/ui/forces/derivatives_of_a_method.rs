use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    forces { x: self.motor(der(x), x); }
    derivative { motor: [self.motor_d1]; }
)]
struct Cart { m: f64 }

impl Cart {
    fn motor(&self, v: f64, x: f64) -> f64 { -v * x }
}

fn main() {}

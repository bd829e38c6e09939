use nonholonomic::prelude::*;

#[nonholonomic(
    base { x } lagrangian { m / 2 * der(x)^2 }
    forces { x: self.motor(der(x)); } emit { taylor }
)]
struct Driven { m: f64 }

impl Driven {
    fn motor(&self, v: f64) -> f64 {
        self.m - v
    }
}
fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } forces { x: self.motor(der(x)); })]
struct Full { m: f64 }
impl Full { fn motor(&self, v: f64) -> f64 { -v } }

#[nonholonomic(basis { u } brackets {} lagrangian { m / 2 * u^2 } forces { u: -u; })]
struct Reduced { m: f64 }

morphism! { Full -> Reduced { velocities { u = der(x); } } }

fn main() {}

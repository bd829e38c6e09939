use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

#[nonholonomic(basis { u, v } brackets {} lagrangian { m / 2 * (u^2 + v^2) })]
struct Reduced { m: f64 }

morphism! { Full -> Reduced { parametrs {} velocities { u = der(z); v = der(y); vv = der(x); } } }

fn main() {}

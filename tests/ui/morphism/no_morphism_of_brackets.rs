use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

#[nonholonomic(basis { u, v } brackets { [u, v] = v; } lagrangian { m / 2 * (u^2 + v^2) })]
struct Reduced { m: f64 }

morphism! { Full -> Reduced { velocities { u = der(x); v = der(y); } } }

fn main() {}

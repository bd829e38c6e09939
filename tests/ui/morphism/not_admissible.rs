use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

#[nonholonomic(base { x } basis { u, v } anchor { der(x) = u; } brackets {} lagrangian { m / 2 * (u^2 + v^2) })]
struct Reduced { m: f64 }

morphism! { Full -> Reduced { base { x = 2 * x; } velocities { u = der(x); v = der(y); } } }

fn main() {}

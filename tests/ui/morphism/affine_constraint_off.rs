use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) } constraints { der(y) = a; })]
struct Full { m: f64, a: f64 }

#[nonholonomic(basis { u, v } brackets {} lagrangian { m / 2 * (u^2 + v^2) } constraints { v = 2 * a; })]
struct Reduced { m: f64, a: f64 }

morphism! { Full -> Reduced { velocities { u = der(x); v = der(y); } } }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } holonomic { rod: x^2 + y^2 = l^2; } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64, l: f64 }

#[nonholonomic(base { a } basis { w } anchor { der(a) = w; } lagrangian { m / 2 * l^2 * w^2 })]
struct Angle { m: f64, l: f64 }

morphism! { Full -> Angle { base { a = atan2(y, x); } velocities { w = (y * der(x) - x * der(y)) / l^2; } } }

fn main() {}

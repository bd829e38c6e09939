use nonholonomic::prelude::*;

#[nonholonomic(base { a } lagrangian { m / 2 * der(a)^2 })]
struct Full { m: f64 }

#[nonholonomic(base { c, s } on { c^2 + s^2 = 1; } basis { w } anchor { der(c) = -s * w; der(s) = c * w; } lagrangian { m / 2 * w^2 })]
struct Reduced { m: f64 }

morphism! { Full -> Reduced { base { c = cos(a); s = sin(2 * a); } velocities { w = der(a); } } }

fn main() {}

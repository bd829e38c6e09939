use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } holonomic { rod: x^2 + y^2 = l^2; } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64, l: f64 }

#[nonholonomic(base { a } lagrangian { m / 2 * der(a)^2 })]
struct Angle { m: f64 }

morphism! { Full -> Angle { base { a = atan2(y, x); } } }

fn main() {}

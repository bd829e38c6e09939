use nonholonomic::prelude::*;

#[nonholonomic(base { a } lagrangian { m / 2 * der(a)^2 })]
struct Angle { m: f64 }

#[nonholonomic(base { x, y } holonomic { rod: x^2 + y^2 = 1; } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Plane { m: f64 }

morphism! { Angle -> Plane { base { x = sin(a); y = cos(2 * a); } } }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } holonomic { rod: x^2 + y^2 = t^2; } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Plane { m: f64 }

morphism! { Full -> Plane {} }

fn main() {}

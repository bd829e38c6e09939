use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Thrown { m: f64 }

/// On a circle, by its angle, which the larger system does not have.
#[nonholonomic(base { a } lagrangian { m / 2 * der(a)^2 })]
struct Guided { m: f64 }

morphism! { Guided -> Thrown { base { x = cos(a); y = sin(a); } } }

fn main() {}

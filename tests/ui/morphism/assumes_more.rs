use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]
struct One { m: f64 }

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } assume { m > 0; })]
struct Other { m: f64 }

morphism! { One -> Other { base { x = x; } } }

fn main() {}

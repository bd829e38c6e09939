use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) } constraints { der(y) = 0; } forces { x: -c * der(x); })]
struct Sliding { m: f64, c: f64 }

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Flying { m: f64 }

morphism! { Sliding -> Flying { base { x = x; y = y; } } }

fn main() {}

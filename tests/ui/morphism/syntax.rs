use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

morphism! { Full => Full {} }
morphism! { Full<f64> -> Full {} }
morphism! { Full -> Full { velocities = der(x) } }

fn main() {}

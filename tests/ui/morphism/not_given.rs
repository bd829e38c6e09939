use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

#[nonholonomic(
    base { q } basis { u, v } anchor { der(q) = u; } brackets {} lagrangian { M / 2 * (u^2 + v^2) }
    forces { u: push; } inputs { push }
)]
struct Reduced { M: f64 }

morphism! { Full -> Reduced {} }

fn main() {}

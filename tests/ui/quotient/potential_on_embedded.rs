use nonholonomic::prelude::*;

#[nonholonomic(
    base { g[2] }
    on { dot(g, g) = 1; }
    basis { w }
    anchor { der(g[0]) = g[1] * w; der(g[1]) = -g[0] * w; }
    brackets {}
    lagrangian { w^2 / 2 - c * g[1] }
)]
struct Full { c: f64 }

quotient! { Full -> struct Reduced by { g } }

fn main() {}

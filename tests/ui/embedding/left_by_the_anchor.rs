use nonholonomic::prelude::*;

#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = w; }
    brackets { }
    lagrangian { m / 2 * dot(w, w) }
)]
struct S { m: f64 }

fn main() {}

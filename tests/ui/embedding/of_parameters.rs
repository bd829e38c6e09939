use nonholonomic::prelude::*;

#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = m; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { m / 2 * dot(w, w) }
)]
struct S { m: f64 }

fn main() {}

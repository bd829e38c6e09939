use nonholonomic::prelude::*;

#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    lagrangian { m / 2 * dot(der(g), der(g)) - m * g[2] }
)]
struct SphericalPendulum { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, w) / 2 - g[2] }
    emit { splitting }
)]
struct Top;

fn main() {}

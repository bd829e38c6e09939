use nonholonomic::prelude::*;

#[nonholonomic(
    basis { w[3], v[3] }
    brackets {
        [w[0], w[1]] = w[2]; [w[1], w[2]] = w[0]; [w[2], w[0]] = w[1];
        [w[0], v[1]] = v[2]; [w[0], v[2]] = v[1];
        [w[1], v[2]] = v[0]; [w[1], v[0]] = -v[2];
        [w[2], v[0]] = v[1]; [w[2], v[1]] = -v[0];
    }
    lagrangian { dot(w, w) / 2 + m * dot(v, v) / 2 }
)]
struct S { m: f64 }

fn main() {}

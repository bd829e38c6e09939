use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    basis { u, w[3] }
    anchor { der(x) = u; }
    brackets so(3) { w }
    lagrangian { m / 2 * u^2 + dot(w, w) / 2 }
    routh { x = mu; }
)]
struct Carried {
    m: f64,
    mu: f64,
}

fn main() {}

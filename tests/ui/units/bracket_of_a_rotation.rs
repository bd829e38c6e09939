use nonholonomic::prelude::*;

#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { dot(w, w) / 2 * J }
    units { w = m/s; J = kg; }
)]
struct S { J: f64 }

fn main() {}

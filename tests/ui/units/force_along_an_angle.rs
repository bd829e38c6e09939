use nonholonomic::prelude::*;

#[nonholonomic(
    base { q }
    lagrangian { J / 2 * der(q)^2 }
    inputs { push }
    forces { q: push; }
    units { q = rad; J = kg m^2; push = N; }
)]
struct S { J: f64 }

fn main() {}

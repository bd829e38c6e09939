use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    let scaled(v) = v * v;
    lagrangian { kinetic(m, scaled([x, y])) }
)]
struct S { m: f64 }

fn main() {}

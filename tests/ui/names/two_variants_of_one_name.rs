//! An entry of a family and a coordinate, whose names in code are one.
use nonholonomic::prelude::*;

#[nonholonomic(
    base { q[2], q_0 }
    lagrangian { m / 2 * (dot(der(q), der(q)) + der(q_0)^2) }
    holonomic { sphere: dot(q, q) + q_0^2 = l^2; }
)]
#[derive(Clone, Copy)]
struct Met {
    m: f64,
    l: f64,
}

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    basis { u, v, w }
    brackets heisenberg(1) { u, v, w }
    frame { h = u + a * v; }
    lagrangian { (u^2 + v^2 + w^2) / 2 }
    distribution { h, v }
)]
struct Fixture { a: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 }
    constraints { w[2] = k * w[0]; }
    volume;
)]
struct Suslov { A: f64, B: f64, C: f64, k: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { (w[0]^2 + 2 * w[1]^2 + 3 * w[2]^2) / 2 }
    constraints { w[2] = w[0]; }
    volume;
)]
struct Suslov;

fn main() {}

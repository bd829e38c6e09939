use nonholonomic::prelude::*;

#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { dot(w, I * w) / 2 }
    conserved { dot(I * w, I * w) }
)]
struct S { I: [[f64; 3]; 3] }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    brackets so(3) { w }
    lagrangian { dot(w, w) / 2 - c * R[0][0] }
)]
struct Full { c: f64 }

quotient! { Full -> struct Reduced by { R[0], R[1] } }

fn main() {}

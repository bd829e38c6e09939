use nonholonomic::prelude::*;

#[nonholonomic(
    base { R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    brackets so(3) { w }
    lagrangian {
        dot(w, w) / 2 - R[0][0]^6 - 3 * R[0][0]^4 * R[1][0]^2 - 3 * R[0][0]^2 * R[1][0]^4 - R[1][0]^6
    }
)]
struct Full;

quotient! { Full -> struct Reduced by { R[0], R[1] } }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, theta }
    basis { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    brackets { [omega, v1] = v2; [omega, v2] = v1; }
    lagrangian { m / 2 * (omega^2 + v1^2 + v2^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { c, s, x, y }
    on { c^2 + s^2 = 1; }
    basis { turn, vx, vy }
    anchor { der(c) = -s * turn; der(s) = c * turn; der(x) = vx; der(y) = vy; }
    holonomic { end: x = c; }
    lagrangian { m / 2 * (vx^2 + vy^2) + J / 2 * turn^2 }
    emit { symmetric_projection }
)]
struct S { m: f64, J: f64 }

fn main() {}

use nonholonomic::prelude::*;

/// A parallelogram, and another between the same cranks.
#[nonholonomic(
    base { a, b, c, d }
    let e(q) = [cos(q), sin(q)];
    holonomic {
        one: 2 * e(a) + 3 * e(b) = 2 * e(c) + [3, 0];
        two: e(a) + 3 * e(d) = e(c) + [3, 0];
    }
    lagrangian { J / 2 * (der(a)^2 + der(b)^2 + der(c)^2 + der(d)^2) }
)]
struct S { J: f64 }

fn main() {}

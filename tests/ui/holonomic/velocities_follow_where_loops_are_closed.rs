use nonholonomic::prelude::*;

/// A four-bar linkage, whose rocker has a length.
#[nonholonomic(
    base { a, b, c, s }
    let e(q) = [cos(q), sin(q)];
    let joint = 0.3 * e(a) + 0.7 * e(b);
    let rocker = joint - [0.6, 0];
    holonomic { closure: joint = 0.5 * e(c) + [0.6, 0]; }
    constraints { length: der(dot(rocker, rocker)) = 0; }
    lagrangian { J / 2 * (der(a)^2 + der(b)^2 + der(c)^2 + der(s)^2) }
)]
struct S { J: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { c, s }
    on { c^2 + s^2 = 1; }
    basis { w }
    anchor { der(c) = -s * w; der(s) = c * w; }
    lagrangian { J / 2 * w^2 - k * sqrt(1 - c) }
)]
struct OnOne { J: f64, k: f64 }

#[nonholonomic(
    base { c, s }
    on { c^2 + s^2 = 1; }
    basis { w }
    anchor { der(c) = -s * w; der(s) = c * w; }
    lagrangian { J / 2 * w^2 - k * asin(s) }
)]
struct Arc { J: f64, k: f64 }

#[nonholonomic(
    base { x, y }
    holonomic { circle: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * sqrt(2 * l + 2 * y) }
)]
struct Rod { m: f64, k: f64, l: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, th }
    lagrangian { m / 2 * der(x)^2 + J / 2 * der(th)^2 }
    inputs { left, right }
    forces { x: (left + right) / r - m * g; th: (right - left) * b / r; }
    outputs { pull = (left - right) / r + m * g; }
    units { x, b, r = m; th = rad; m = kg; g = m/s^2; left, right = N; }
)]
struct S { m: f64, J: f64, g: f64, b: f64, r: f64 }

fn main() {}

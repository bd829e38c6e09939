use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (a * der(x)^2 + b * der(y)^2) / 2 - c * x }
    forces { x: -d * x; y: -c * y; }
    outputs { f = (a * b - c) * x; h = (a - d) / b; }
    units { y = m; }
)]
struct S { a: f64, b: f64, c: f64, d: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    frame { s = x_dot + y_dot; } distribution { s } orthonormal { u }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { der(y) = 2 * der(x); }
    outputs { height = 2 * y; }
    track { der(x), der(y), hieght, z }
)]
struct S { m: f64 }

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - sin(y) }
    constraints { der(y) = 2 * der(x); }
    outputs { sideways = x; }
    track { der(x), der(y) }
)]
struct T { m: f64 }

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    outputs { place = [x, z]; far = x; }
    track { der(x), y }
    emit { output_jacobian, bracket }
)]
struct U { m: f64 }

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * x * y }
    forces { y: k * x; }
    outputs { rise = der(y); }
    track { rise }
    emit { bracket }
)]
struct V { m: f64, k: f64 }

fn main() {}

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
    outputs { place = [x, y, z]; }
    track { der(x), y }
)]
struct U { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    holonomic { circle: x^2 + y^2 = l^2; }
    linearization { }
)]
struct S { m: f64, l: f64 }

#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { edge: sin(theta) * der(x) = cos(theta) * der(y); }
    linearization { }
)]
struct T { m: f64, J: f64 }

fn main() {}

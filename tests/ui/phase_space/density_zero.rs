use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    constraints { der(y) = x * der(x); }
    volume { cos(x)^2 + sin(x)^2 - 1; }
)]
#[derive(Clone, Copy, Debug)]
struct Track;

fn main() {}

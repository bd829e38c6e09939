use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
    constraints { der(x)^2 + der(y)^2 = u^2; }
    emit { volume }
)]
struct Thermostat { g: f64, u: f64 }

fn main() {}

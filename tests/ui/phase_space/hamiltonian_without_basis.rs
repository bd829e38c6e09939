use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, x, y }
    lagrangian { (der(theta)^2 + der(x)^2 + der(y)^2) / 2 }
    constraints { sin(theta) * der(x) = cos(theta) * der(y); }
    emit { hamiltonian }
)]
struct Skate;

fn main() {}

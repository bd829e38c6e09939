use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    emit { hamiltonian }
    track { x }
)]
struct Free;

fn main() {}

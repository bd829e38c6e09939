use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 + der(x)^4 / 4 }
    emit { hamiltonian }
)]
struct Quartic;

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { -sqrt(1 - der(x)^2 - der(y)^2) }
    emit { rattle }
)]
struct Photon;

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { r, phi }
    basis { u, w }
    anchor { der(r) = u; der(phi) = w / r; }
    lagrangian { (u^2 + w^2) / 2 }
    volume { r^2; }
)]
struct Polar;

fn main() {}

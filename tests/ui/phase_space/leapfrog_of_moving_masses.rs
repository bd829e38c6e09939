use nonholonomic::prelude::*;

#[nonholonomic(
    base { r, phi }
    lagrangian { (der(r)^2 + r^2 * der(phi)^2) / 2 }
    formulation { projected }
    emit { leapfrog }
)]
struct Polar;

fn main() {}

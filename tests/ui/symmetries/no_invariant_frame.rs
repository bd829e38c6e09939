use nonholonomic::prelude::*;

#[nonholonomic(
    base { q, p, z }
    lagrangian { der(q)^2 / (2 * q^2) + der(p)^2 / (2 * q) + der(z)^2 / 2 }
    symmetries { shift: der(p); stretch: q * der(q) + p / 2 * der(p); }
    emit { splitting }
)]
struct Affine;

fn main() {}

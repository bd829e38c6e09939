use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    forces { x: -der(x)^2 * exp(-x^2); }
    volume;
)]
#[derive(Clone, Copy, Debug)]
struct Flow;

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 - x^2 * cos(t) }
    emit { discrete_gradient }
)]
struct Pumped;

fn main() {}

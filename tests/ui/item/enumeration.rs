use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 }
)]
enum S { A }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    conserved { p = self.momentum(x); }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    forces { x: self.spring(x); }
    linearization { keep: x, der(x); }
)]
struct S { m: f64 }
impl S { fn spring(&self, x: f64) -> f64 { -x } }

fn main() {}

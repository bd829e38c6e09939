use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) } forces { y: self.spring(y); })]
struct Full { m: f64 }

impl Full { fn spring(&self, y: f64) -> f64 { -y } }

quotient! { Full -> struct Reduced by { x } }

fn main() {}

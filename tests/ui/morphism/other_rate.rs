use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } auxiliary { der(lag) = der(x) - c * lag; } forces { x: lag; })]
struct Full { m: f64, c: f64 }

#[nonholonomic(basis { u } brackets {} lagrangian { m / 2 * u^2 } auxiliary { der(lag) = u - 2 * c * lag; } forces { u: lag; })]
struct Reduced { m: f64, c: f64 }

morphism! { Full -> Reduced { velocities { u = der(x); } } }

fn main() {}

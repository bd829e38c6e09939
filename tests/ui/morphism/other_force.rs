use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } forces { x: push - c * der(x); } inputs { push })]
struct Full { m: f64, c: f64 }

#[nonholonomic(basis { u } brackets {} lagrangian { m / 2 * u^2 } forces { u: push - c * u; } inputs { push })]
struct Reduced { m: f64, c: f64 }

morphism! { Full -> Reduced { parameters { c = 2 * c; } velocities { u = der(x); } } }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]
struct Mass { m: f64 }

nonholonomic::morphism! { let -> Mass { } }

nonholonomic::morphism! { self::Mass -> in::Mass { } }

nonholonomic::quotient! { crate -> struct Less by { x } }

fn main() {}

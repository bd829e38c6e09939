use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    names { state = Point; velocity = Point; }
)]
struct Particle { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    forces { x: -c * der(x); }
    hamilton_jacobi { x_dot: p; }
)]
#[derive(Clone, Copy, Debug)]
struct Damped {
    p: f64,
    c: f64,
}

fn main() {}

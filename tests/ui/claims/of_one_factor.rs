//! A slot that is as well a wall: cos x = 0 holds for all heights.
use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, z }
    lagrangian { m / 2 * (der(x)^2 + der(z)^2) - m * g * z }
    holonomic { slot: sin(2 * x) = 2 * z * cos(x); }
    conserved { gap = sin(x) - z; }
)]
#[derive(Clone, Copy)]
struct Slotted {
    m: f64,
    g: f64,
}

fn main() {}

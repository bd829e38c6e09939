#![deny(dead_code)]
use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - m * g * x }
)]
struct S { m: f64, g: f64, k: f64 }

fn main() {
    let s = S { m: 1.0, g: 9.81, k: 3.0 };
    println!("{}", s.energy(0.0, &SState::default()));
}

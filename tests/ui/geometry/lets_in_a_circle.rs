use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    let tip = elbow + l;
    let elbow = tip - l * sin(x);
    lagrangian { m / 2 * der(tip)^2 }
)]
struct S { m: f64, l: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
)]
struct S { m: f64 }

fn main() {}

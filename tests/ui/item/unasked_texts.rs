use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
)]
struct Free;

fn main() {
    println!("{}", Free::C99);
    println!("{} {}", Free::LATEX, Free::DERIVATION);
}

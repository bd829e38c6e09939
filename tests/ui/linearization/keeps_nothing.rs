use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } linearization { keep: ; })]
struct S { m: f64 }

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } linearization { x, der(x) })]
struct R { m: f64 }

fn main() {
    let s = S { m: 1.0 };
    let _ = (s.linearize(0.0, &SState::default(), &()), s.trim(0.0, &SState::default(), &(), &[SVariable::x]));
}

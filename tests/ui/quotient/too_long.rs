use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian {
    let a = y * sin(y) + cos(y);
    let b = a * sin(a) + cos(a);
    let c = b * sin(b) + cos(b);
    let d = c * sin(c) + cos(c);
    let e = d * sin(d) + cos(d);
    let f = e * sin(e) + cos(e);
    let g = f * sin(f) + cos(f);
    let h = g * sin(g) + cos(g);
    m / 2 * (der(x)^2 + der(y)^2) + sin(h) * h
})]
struct Full { m: f64 }
quotient! { Full -> struct Reduced by { x } }
fn main() {}

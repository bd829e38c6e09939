use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    holonomic { circle: x^2 + y^2 = l^2; }
    independent { x, y }
)]
struct S { m: f64, l: f64 }

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    holonomic { circle: x^2 + y^2 = l^2; }
    independent { x }
)]
struct T { m: f64, l: f64 }

#[nonholonomic(
    base { c, s, z }
    on { c^2 + s^2 = 1; }
    basis { w, v }
    anchor { der(c) = -s * w; der(s) = c * w; der(z) = v; }
    lagrangian { m / 2 * (w^2 + v^2) }
    holonomic { screw: z = h * s; }
    independent { s, z, s }
)]
struct U { m: f64, h: f64 }

#[nonholonomic(
    base { c, s, z }
    on { c^2 + s^2 = 1; }
    basis { w, v }
    anchor { der(c) = -s * w; der(s) = c * w; der(z) = v; }
    lagrangian { m / 2 * (w^2 + v^2) }
    holonomic { screw: z = h * s; }
    independent { s, z }
)]
struct V { m: f64, h: f64 }

fn main() {}

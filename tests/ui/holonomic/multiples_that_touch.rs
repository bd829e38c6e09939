use nonholonomic::prelude::*;

/// Two ellipsoids that meet in (0, 0, 1) alone.
#[nonholonomic(
    base { x, y, z }
    holonomic { x^2 + x*y + y^2 + z^2 = 1; x^2 - x*y + y^2 + (z - 2)^2 = 1; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Between { m: f64 }

/// Three bars that are as long together as the pins are apart.
#[nonholonomic(
    base { x, y, u, v }
    holonomic { x^2 + y^2 = 1; (u - x)^2 + (v - y)^2 = 4; (6 - u)^2 + v^2 = 9; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(u)^2 + der(v)^2) }
)]
struct Stretched { m: f64 }

/// The same for bars of any length.
#[nonholonomic(
    base { x, y, u, v }
    holonomic { x^2 + y^2 = a^2; (u - x)^2 + (v - y)^2 = b^2; (a + b + c - u)^2 + v^2 = c^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(u)^2 + der(v)^2) }
    assume { a > 0; b > 0; c > 0; }
)]
struct Bars { m: f64, a: f64, b: f64, c: f64 }

fn main() {}

use nonholonomic::prelude::*;

/// A rod is as far to the right as it is long in one place alone, whatever its length.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    impacts { wall: x <= l; }
)]
struct InThePlane { m: f64, l: f64 }

#[nonholonomic(
    base { x, y, z }
    holonomic { rod: x^2 + y^2 + z^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    impacts { wall: x <= l; }
)]
struct InSpace { m: f64, l: f64 }

#[nonholonomic(
    base { x, y, z }
    holonomic { shell: x^2 + x*y + y^2 + z^2 = 1; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    impacts { other: x^2 - x*y + y^2 + (z - 2)^2 >= 1; }
)]
struct BesideAShell { m: f64 }

#[nonholonomic(
    base { a }
    lagrangian { J / 2 * der(a)^2 }
    impacts { top: cos(a) <= 1; }
)]
struct Always { J: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    holonomic { circle: x^2 + (y - l)^2 = l^2; }
    assume { l > 0; }
    linearization { keep: x, y, der(x); }
)]
struct Pendulum { m: f64, l: f64, g: f64 }

#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { skate: sin(theta) * der(x) = cos(theta) * der(y); }
    formulation { projected }
    linearization { keep: theta, der(x), der(y); }
)]
struct Skate { m: f64, J: f64 }

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    holonomic { shelf: y = l; }
    linearization { keep: y, x; }
)]
struct Shelf { m: f64, l: f64 }

/// Of a sphere two coordinates are independent.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { dot(w, w) - g[2] }
    linearization { keep: g, w; }
)]
struct Sphere;

/// At its lowest point alone the height does not do.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    holonomic { circle: x^2 + (y - l)^2 = l^2; }
    assume { l > 0; }
    linearization { keep: y, der(y); }
)]
#[derive(Clone, Copy)]
struct Upright { m: f64, l: f64, g: f64 }

fn main() {
    let _ = Upright { m: 1.0, l: 1.0, g: 9.8 }.linearize(0.0, &UprightState::default(), &());
}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { p[3], R[3][3] }
    on { transpose(R) * R = identity(3); }
    basis { w[2], v[3] }
    anchor { der(p) = R * v; der(R) = R * hat(w); }
    lagrangian { m / 2 * dot(v, v) + J / 2 * dot(w, w) - m * g * p[2] }
    constraints { v[0] = a * w[1]; v[1] = -a * w[2]; }
    outputs { slip = v + cross(w, [0, 0, -a]); }
)]
struct Ball { m: f64, g: f64, a: f64, J: f64 }

fn main() {}

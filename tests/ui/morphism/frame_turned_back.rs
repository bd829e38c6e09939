use nonholonomic::prelude::*;

#[nonholonomic(base { x, y, phi } lagrangian { (der(x)^2 + der(y)^2 + der(phi)^2) / 2 })]
struct Full {}

#[nonholonomic(basis { w, u, v } brackets se(2) { w, u, v } lagrangian { (u^2 + v^2 + w^2) / 2 })]
struct Reduced {}

morphism! { Full -> Reduced { velocities {
    w = der(phi); u = cos(phi) * der(x) - sin(phi) * der(y); v = sin(phi) * der(x) + cos(phi) * der(y);
} } }

fn main() {}

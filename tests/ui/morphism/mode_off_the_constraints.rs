use nonholonomic::prelude::*;

#[nonholonomic(base { x, y, z } lagrangian { der(x)^2 + der(y)^2 + der(z)^2 } constraints { der(y) = 0; der(z) = der(x); })]
struct Rail;

#[nonholonomic(base { x, y, z } lagrangian { der(x)^2 + der(y)^2 + der(z)^2 } constraints { der(z) = 0; })]
struct Plane;

morphism! { Rail -> Plane { base { x = x; y = y; z = z; } } }

fn main() {}

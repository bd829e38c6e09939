use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, th } basis { v, side, omega }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
    }
    lagrangian { (v^2 + side^2 + omega^2) / 2 }
    emit { rattle }
)]
struct Disk;

fn main() {}

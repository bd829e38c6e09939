use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, x[2] }
    lagrangian { m / 2 * (der(theta)^2 + dot(der(x), der(x))) + typo }
    constraints { belt: der(theta) = der(x[0]) + t; }
    inputs { u }
    forces { theta: u; x[0]: -der(x[0]); }
    emit { power }
)]
#[derive(Clone, Copy)]
struct Belt { m: f64 }

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    frame { along = der(x) + k * der(y); }
    distribution { along }
    forces { x: typo; }
    emit { reactions }
)]
#[derive(Clone, Copy)]
struct Rail { m: f64, k: f64 }

fn main() {
    println!("{:?}", Rail { m: 1.0, k: 2.0 }.reactions(0.0, &RailState::default(), &()));
    let power = Belt { m: 1.0 }.power(0.0, &BeltState::default(), &BeltInput { u: 1.0 });
    println!("{} {} {} {}", power.total(), power.forces.theta, power.forces.x_0, power.constraints.belt);
}

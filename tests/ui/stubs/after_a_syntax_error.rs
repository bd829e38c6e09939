use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta x, y }
    basis { omega, v1, v2 }
    anchor { der(theta) = omega; der(x) = v1 * cos(theta) - ; der(y) = v1 * sin(theta); }
    lagrangian { m / 2 * (omega^2 + v1^2 + 2v2^2) }
    constraints { blade: v2 == 0; }
    outputs { speed = abs(v1); }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy)]
struct Sleigh<T> { m: T }

fn main() {
    let sleigh = Sleigh { m: 1.0 };
    let start = SleighState { theta: 0.0, x: 0.0, y: 0.0, omega: 0.0, v1: 1.0 };
    let mut sim = Integrator::new(sleigh, Dopri5::new(), 0.0, start);
    sim.advance_to(1.0).unwrap();
    let at = (sim.time(), sim.state());
    println!("{} {:?}", sleigh.energy(at.0, at.1), sleigh.outputs(at.0, at.1, &()).speed);
    println!("{:?}", sleigh.reactions(at.0, at.1, &()).v2);
    println!("{:?} {:?}", sleigh.validate(), sleigh.velocity(at.0, at.1).v2);
}

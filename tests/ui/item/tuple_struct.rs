use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m/2*der(x)^2 }
    inputs { u }
    forces { x: u; }
    emit { jacobian }
)]
#[derive(Clone, Copy)]
struct S(f64);

fn main() {
    let start = SState { x: 0.0, x_dot: 1.0 };
    let mut sim = Integrator::new(S(1.0), Rk4::new(0.01), 0.0, start);
    sim.set_input(SInput { u: 1.0 });
    sim.advance_to(1.0).unwrap();
    println!("{} {:?}", S(1.0).energy(0.0, sim.state()), sim.state().x);
}

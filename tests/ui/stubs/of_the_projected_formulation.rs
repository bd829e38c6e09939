use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, x, y }
    lagrangian { m / 2 * (der(theta)^2 + der(x)^2 + der(y)^2) + typo }
    constraints { blade: cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    emit { multipliers }
)]
#[derive(Clone, Copy)]
struct Blade { m: f64 }

fn main() {
    let blade = Blade { m: 1.0 };
    let mut start =
        BladeState { theta: 0.0, x: 0.0, y: 0.0, theta_dot: 0.0, x_dot: 1.0, y_dot: 0.0 };
    blade.project(0.0, &mut start).unwrap();
    let mut sim = Integrator::new(blade, Projected::new(Dopri5::new(), 1), 0.0, start);
    sim.advance_to(1.0).unwrap();
    let residual = blade.constraint_residual(0.0, sim.state()).blade;
    println!("{residual} {}", blade.multipliers(0.0, sim.state(), &()).blade);
}

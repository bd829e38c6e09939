use nonholonomic::prelude::*;

#[nonholonomic(base { x, y, z } lagrangian { m / 2 * der(x)^2 } inputs { u } constraints { der(y) = 0; } emit { multipliers })]
#[derive(Clone, Copy)]
struct Cart { m: f64 }

fn main() {
    let cart = Cart { m: 1.0 };
    let start = CartState { x: 0.0, y: 0.0, z: 0.0, x_dot: 1.0, z_dot: 0.0 };
    let mut sim = Integrator::new(cart, Dopri5::new(), 0.0, start);
    sim.set_input(CartInput { u: 0.1 });
    sim.advance_to(1.0).unwrap();
    let _ = (cart.derivative(0.0, &start, &CartInput::default()).x, cart.velocity(0.0, &start).y_dot);
}

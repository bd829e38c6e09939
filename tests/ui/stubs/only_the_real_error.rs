use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(z)^2) } inputs { u } constraints { der(y) = 0; } outputs { o = x; })]
#[derive(Clone, Copy)]
struct Cart { m: f64 }

fn main() {
    let cart = Cart { m: 1.0 };
    let start = CartState { x: 0.0, y: 0.0, x_dot: 1.0 };
    let mut sim = Integrator::new(cart, Dopri5::new(), 0.0, start);
    sim.set_input(CartInput { u: 0.1 });
    sim.advance_to(1.0).unwrap();
    let _ = (cart.energy(sim.time(), sim.state()), cart.validate(), Cart::REPORT, sim.state().x_dot);
}

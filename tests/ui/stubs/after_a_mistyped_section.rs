use nonholonomic::prelude::*;

#[nonholonomic(bsae { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) } inputs { u } emit { jacobian })]
#[derive(Clone, Copy)]
struct Cart { m: f64 }

fn main() {
    let cart = Cart { m: 1.0 };
    let start = CartState { x: 0.0, y: 0.0, x_dot: 1.0, y_dot: 0.0 };
    let mut sim = Integrator::new(cart, ImplicitMidpoint::new(0.1).with_jacobian(), 0.0, start);
    sim.set_input(CartInput { u: 0.1 });
    let (a, b) = cart.jacobian(sim.time(), sim.state(), &CartInput { u: 0.0 });
    println!("{} {} {}", a[(3, 3)], b[(3, 0)], Cart::REPORT);
}

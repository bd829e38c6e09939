#![allow(non_snake_case, reason = "moments of inertia are written I")]
mod systems;
use nh_runtime::prelude::*;
use systems::*;

fn drift<S: AlmostPoisson<State: State<Scalar = f64>, Input = ()> + Copy, M: nh_runtime::Method<S>>(
    name: &str,
    system: S,
    start: S::State,
    method: M,
    steps: u64,
) {
    let mut sim = Integrator::new(system, method, 0.0, start);
    let e0 = system.energy(0.0, &start);
    let mut worst: f64 = 0.0;
    let clock = std::time::Instant::now();
    for k in 0..steps {
        if let Err(e) = sim.step() {
            println!("{name}: step {k}: {e}");
            return;
        }
        worst = worst.max(((system.energy(0.0, sim.state()) - e0) / e0).abs());
    }
    let end = ((system.energy(0.0, sim.state()) - e0) / e0).abs();
    let st = sim.statistics();
    println!(
        "{name:30} {steps:9} worst {worst:.2e} end {end:.2e} it/step {:.2} jac/step {:.3} {:.2} us/step",
        st.iterations as f64 / st.steps as f64,
        st.jacobians as f64 / st.steps as f64,
        clock.elapsed().as_secs_f64() * 1e6 / steps as f64
    );
}

fn main() {
    let n: u64 = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(10_000);
    let contact = ContactOscillator { epsilon: 0.3 };
    let start = ContactOscillatorState { x: 0.3, y: 0.5, z: 0.4, y_dot: 1.0, z_dot: 0.8 };
    drift("contact", contact, start, DiscreteGradient::new(0.1), n);
    drift("contact held", contact, start, DiscreteGradient::new(0.1), n);
    drift("contact compensated", contact, start, DiscreteGradient::new(0.1).compensated(), n);
    drift("contact compensated held", contact, start, DiscreteGradient::new(0.1).compensated(), n);
    drift("contact midpoint", contact, start, ImplicitMidpoint::new(0.1), n);
    drift("contact 4", contact, start, DiscreteGradient::new(0.1).fourth_order(), n);
    drift("contact 6", contact, start, DiscreteGradient::new(0.1).sixth_order(), n);
    let suslov = HeavySuslov { I: [1.0, 1.7, 2.2], c: [0.4, 0.3, 0.2] };
    let s = HeavySuslovState { g: [0.6, 0.0, 0.8], w_0: 0.7, w_1: 0.9 };
    drift("heavy Suslov", suslov, s, DiscreteGradient::new(0.1), n);
    drift("heavy Suslov held", suslov, s, DiscreteGradient::new(0.1), n);
    let v = Veselova { I: [1.3, 0.8, 2.1], c: [0.2, -0.5, 0.9] };
    let s = VeselovaState { g: [0.6, 0.0, 0.8], w: [0.8, 0.5, -0.6] };
    drift("Veselova", v, s, DiscreteGradient::new(0.1), n);
    drift("Veselova held", v, s, DiscreteGradient::new(0.1), n);
    let b = ChaplyginSphere { I: [1.3, 0.8, 2.1], m: 0.9, r: 0.6 };
    let s = ChaplyginSphereState { g: [0.6, 0.0, 0.8], w: [0.8, 0.5, -0.6] };
    drift("sphere", b, s, DiscreteGradient::new(0.1), n);
    drift("sphere held", b, s, DiscreteGradient::new(0.1), n);
}

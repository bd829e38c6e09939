//! A closed loop: what methods keep of its energy and of the loop.

use nonholonomic::prelude::*;
use nonholonomic::{Holding, Method};

/// A four-bar linkage in three angles, whose loop closes by position constraints.
#[nonholonomic(
    base { crank, coupler, rocker }
    let along(angle) = [cos(angle), sin(angle)];
    holonomic { closure: l[0] * along(crank) + l[1] * along(coupler) = l[2] * along(rocker) + [d, 0]; }
    lagrangian {
        J[0] / 2 * der(crank)^2 + kinetic(m, J[1], l[0] * along(crank) + l[1] / 2 * along(coupler), coupler)
            + J[2] / 2 * der(rocker)^2
    }
    units { crank, coupler, rocker = rad; l, d = m; m = kg; J = kg m^2; }
    emit { discrete_gradient, symmetric_projection, rattle }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Linkage {
    /// Lengths of crank, coupler and rocker (m).
    pub(crate) l: [f64; 3],
    /// Distance of the joints on the ground (m).
    pub(crate) d: f64,
    /// Mass of the coupler (kg).
    pub(crate) m: f64,
    /// Moments of inertia of crank and rocker about their joints, and of the coupler about its middle (kg m²).
    pub(crate) J: [f64; 3],
}

pub(crate) const LINKAGE: Linkage = Linkage { l: [1.0, 3.0, 2.5], d: 3.0, m: 1.0, J: [0.1, 0.3, 0.4] };
/// About a hundred steps for each turn of the crank (s).
const STEP: f64 = 0.003;

/// The crank turns at 20 rad/s.
pub(crate) fn start() -> LinkageState {
    let rough = LinkageState { crank: 0.2, coupler: 0.9, rocker: 1.6, crank_dot: 20.0, ..Default::default() };
    LINKAGE.assemble_holding(0.0, &rough, &[LinkageCoordinate::crank]).expect("a crank of that length turns")
}

/// A line of the table: the largest errors of the energy after so many steps, and how far the loop was open.
fn line<M: Method<Linkage>>(name: &str, method: M) {
    let start = start();
    let energy = LINKAGE.energy(0.0, &start);
    let mut sim = Integrator::new(LINKAGE, method, 0.0, start);
    let (mut worst, mut open) = (0.0_f64, 0.0_f64);
    print!("{name:28}");
    for steps in 1..=100_000 {
        if let Err(error) = sim.step() {
            println!("  {error}");
            return;
        }
        let left = LINKAGE.equations(0.0, sim.state());
        open = open.max(left[0].hypot(left[1]));
        worst = worst.max((LINKAGE.energy(0.0, sim.state()) / energy - 1.0).abs());
        if [1_000, 10_000, 100_000].contains(&steps) {
            print!(" {worst:10.1e}");
        }
    }
    println!(" {open:12.1e}");
}

/// What methods keep of the energy of a linkage, and of its loop.
pub(crate) fn linkage() {
    println!(
        "A four-bar linkage, 100 steps a turn: the largest relative error of the energy after so many steps\n"
    );
    println!("{:28} {:>10} {:>10} {:>10} {:>12}", "", "1000", "10000", "100000", "loop open, m");
    line("Rk4", Rk4::new(STEP));
    line("ImplicitMidpoint", ImplicitMidpoint::new(STEP));
    line("  .symmetrically_projected()", ImplicitMidpoint::new(STEP).symmetrically_projected());
    line("    .fourth_order()", ImplicitMidpoint::new(STEP).symmetrically_projected().fourth_order());
    line("Rattle", Rattle::new(STEP));
    line("  .fourth_order()", Rattle::new(STEP).fourth_order());
    line("DiscreteGradient", DiscreteGradient::new(STEP));
    line("  .fourth_order()", DiscreteGradient::new(STEP).fourth_order());
    println!();
}

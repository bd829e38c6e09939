//! What methods of integration keep of what the motion keeps, and where such methods fail.
//!
//! `cargo run --release --example structure`, or with `-- long` for ten million steps of each recurrent motion
//!
//! 1. A table: order, energy, identities, constraints, momenta, reversibility, volume.
//! 2. The contact oscillator of McLachlan and Perlmutter: the error in the energy over the initial
//!    position.
//! 3. Their chaotic quartic system: how the error in the energy grows with the number of steps.
//! 4. The gearbox of Modin and Verdier: two energies are conserved separately. Where the motion has a
//!    reversal the methods keep both nearly; where it has none they fail, the one that keeps the sum of
//!    both exactly included.
//! 5. Suslov's problem in general position: every motion settles, and energy alone says nothing there.
//! 6. A four-bar linkage: returns after each step against steps that keep the loop closed by themselves.
//! 7. What returns cost: derivatives that are computed anew, and the time of a return beside that of a derivative.

mod keeps;
mod loops;
mod returns;
mod systems;

use keeps::{
    CONTACT, HEAVY, ON_TQ, Row, SPHERE, SUSLOV, Special, VESELOVA, larger, on_algebra, on_tq, row, run,
};
use nonholonomic::Method;
use nonholonomic::prelude::*;
use systems::{
    ChaoticQuartic, ChaoticQuarticOnTq, ChaoticQuarticOnTqState, ChaoticQuarticState,
    ContactOscillatorOnTqState, ContactOscillatorState, Gearbox, GearboxState, SuslovState,
};

fn main() {
    if std::env::args().nth(1).as_deref() == Some("long") {
        long_runs();
        return;
    }
    table();
    contact_oscillator();
    chaotic_quartic();
    gearbox();
    suslov();
    loops::linkage();
    returns::table();
}

/// The steps over which the table is measured.
const STEPS: u32 = 20_000;

/// The methods that take every system.
fn rows() -> Vec<Row> {
    vec![
        row("Rk4", STEPS, Rk4::new),
        row("Dop853::fixed", STEPS, Dop853::fixed),
        row("ImplicitMidpoint", STEPS, ImplicitMidpoint::new),
        row("  .fourth_order()", STEPS, |h| ImplicitMidpoint::new(h).fourth_order()),
        row("  .sixth_order()", STEPS, |h| ImplicitMidpoint::new(h).sixth_order()),
        row("GaussLegendre4", STEPS, GaussLegendre4::new),
        row("GaussLegendre6", STEPS, GaussLegendre6::new),
        row("DiscreteGradient", STEPS, DiscreteGradient::new),
        row("  .fourth_order()", STEPS, |h| DiscreteGradient::new(h).fourth_order()),
        row("  .sixth_order()", STEPS, |h| DiscreteGradient::new(h).sixth_order()),
    ]
}

fn table() {
    println!("What is kept, step 0.2\n");
    let columns = ["order", "energy", "|g| = 1", "g.w = 0", "momentum", "reversal", "volume"];
    let [order, energy, identity, constraint, momentum, reversal, volume] = columns;
    println!(
        "{:20} {order:>5}  {energy:14} {identity:14} {constraint:14} {momentum:14} {reversal:>8} {volume:>8}",
        "method"
    );
    for Row { name, order, energy, identity, constraint, momentum, reversal, volume } in rows() {
        println!(
            "{name:20} {order:5.2}  {energy:14} {identity:14} {constraint:14} {momentum:14} {reversal:8.0e} \
             {volume:8.0e}"
        );
    }
    for Special { name, order, energy, constraint, reversal } in specials() {
        let constraint = constraint.map_or("-".to_owned(), |kept| kept.to_string());
        println!("{name:20} {order:5.2}  {energy:14} {:14} {constraint:14} {:14} {reversal:8.0e}", "-", "-");
    }
    println!();
}

/// The methods that want a system on TQ, a constraint to project to, or a Lie algebra.
fn specials() -> Vec<Special> {
    vec![
        on_tq("ReflectedLeapfrog", STEPS, ReflectedLeapfrog::new),
        on_tq("Projected(Rk4)", STEPS, |h| Projected::new(Rk4::new(h), 1)),
        on_tq("Conserving(Rk4)", STEPS, |h| Conserving::new(Rk4::new(h))),
        on_algebra("DiscreteSuslov", DiscreteSuslov::new),
    ]
}

/// H = 1.5, ten initial z₀ in ±0.9√2, h = 2 sin(π/N).
fn contact_oscillator() {
    println!("Contact oscillator, N = 20: the largest error of the energy in 5000 steps\n");
    let columns = ["Rk4", "ReflectedLeapfrog", "ImplicitMidpoint", "DiscreteGradient"];
    println!("{:>8}{}", "z0", columns.map(|name| format!(" {name:>18}")).concat());
    let h = 2.0 * (std::f64::consts::PI / 20.0).sin();
    for k in 0..10 {
        let z = 0.9 * 2.0_f64.sqrt() * (f64::from(k) / 4.5 - 1.0);
        // all of the energy that is left is in the velocity of y
        let y_dot = (3.0 - z * z).max(0.0).sqrt();
        let start = ContactOscillatorState { x: 0.0, y: 0.0, z, y_dot, z_dot: 0.0 };
        let on_tq = ContactOscillatorOnTqState { z, y_dot, ..Default::default() };
        let of = |s: &ContactOscillatorState| CONTACT.energy(0.0, s);
        println!(
            "{z:8.3} {:18.1e} {:18.1e} {:18.1e} {:18.1e}",
            largest(&run(CONTACT, start, Rk4::new(h), 5000, of)),
            largest(&run(ON_TQ, on_tq, ReflectedLeapfrog::new(h), 5000, |s| ON_TQ.energy(0.0, s))),
            largest(&run(CONTACT, start, ImplicitMidpoint::new(h), 5000, of)),
            largest(&run(CONTACT, start, DiscreteGradient::new(h), 5000, of)),
        );
    }
    println!();
}

fn largest(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, larger)
}

/// A motion of the chaotic quartic system, for which D has a basis.
fn chaotic() -> ChaoticQuarticState {
    ChaoticQuarticState { x: 0.1, y: [0.4, -0.3, 0.5], z: [0.2, 0.6, -0.1], ..Default::default() }
}

/// h = 0.05, from rest.
fn chaotic_quartic() {
    println!("Chaotic quartic system, step 0.05: the largest error of the energy after so many steps\n");
    let counts = [1_000, 10_000, 100_000];
    println!("{:20}{}", "steps", counts.map(|count| format!(" {count:>10}")).concat());
    let at_rest = chaotic();
    let ChaoticQuarticState { x, y, z, .. } = at_rest;
    let on_tq = ChaoticQuarticOnTqState { x, y, z, ..Default::default() };
    let show = |name: &str, errors: &[f64]| {
        let until = counts.map(|count| format!(" {:10.1e}", largest(&errors[..count.min(errors.len())])));
        println!("{name:20}{}", until.concat());
    };
    let of = |s: &ChaoticQuarticState| ChaoticQuartic.energy(0.0, s);
    let of_tq = |s: &ChaoticQuarticOnTqState| ChaoticQuarticOnTq.energy(0.0, s);
    show("Rk4", &run(ChaoticQuartic, at_rest, Rk4::new(0.05), 100_000, of));
    show("ReflectedLeapfrog", &run(ChaoticQuarticOnTq, on_tq, ReflectedLeapfrog::new(0.05), 100_000, of_tq));
    show("ImplicitMidpoint", &run(ChaoticQuartic, at_rest, ImplicitMidpoint::new(0.05), 100_000, of));
    show("DiscreteGradient", &run(ChaoticQuartic, at_rest, DiscreteGradient::new(0.05), 100_000, of));
    println!();
}

/// The largest error of the oscillators' energy in the first and in the last tenth of a run.
fn growth<M: Method<Gearbox>>(gearbox: Gearbox, start: GearboxState, method: M) -> (f64, f64) {
    const MANY: usize = 40_000;
    let errors = run(gearbox, start, method, 40_000, |s| gearbox.outputs(0.0, s, &()).oscillators);
    // a run that stops early has no end
    if errors.len() < MANY {
        return (f64::NAN, f64::NAN);
    }
    let mean = |errors: &[f64]| errors.iter().sum::<f64>().abs() / 4000.0;
    (mean(&errors[..4000]), mean(&errors[MANY - 4000..]))
}

fn gearbox() {
    println!("Gearbox, step 0.1: mean error of the oscillators' energy, steps 0-4000 and 36000-40000\n");
    println!("{:40} {:>18} {:>18} {:>18}", "", "Rk4", "ImplicitMidpoint", "DiscreteGradient");
    for (what, skew, s_dot) in [
        ("the pendulum swings (reversible)", 0.0, 1.0),
        ("it turns over, symmetric potential", 0.0, 2.6),
        ("it turns over, skew potential", 0.4, 2.6),
    ] {
        let start = GearboxState { x: 0.4, y: 0.7, s: 0.3, y_dot: 0.5, s_dot };
        let gearbox = Gearbox { skew };
        let show = |(early, late): (f64, f64)| format!("{early:.1e} {late:.1e}");
        println!(
            "{what:40} {:>18} {:>18} {:>18}",
            show(growth(gearbox, start, Rk4::new(0.1))),
            show(growth(gearbox, start, ImplicitMidpoint::new(0.1))),
            show(growth(gearbox, start, DiscreteGradient::new(0.1))),
        );
    }
    println!();
}

fn suslov() {
    println!("Suslov's problem in general position, step 0.1, t = 100: settled, whatever the method\n");
    let system = SUSLOV;
    let start = SuslovState { w_0: 0.6, w_1: 0.8 };
    let energy = |s: &SuslovState| system.energy(0.0, s);
    let show = |name: &str, errors: &[f64]| {
        let last = errors.last().copied().unwrap_or(f64::NAN);
        println!("{name:20} error of the energy at the end {last:9.1e}");
    };
    show("Rk4", &run(system, start, Rk4::new(0.1), 1000, energy));
    show("DiscreteGradient", &run(system, start, DiscreteGradient::new(0.1), 1000, energy));
    show("DiscreteSuslov", &run(system, start, DiscreteSuslov::new(0.1), 1000, energy));
}

/// Numbers of steps after which the error of the energy is looked at.
const MANY: [u32; 3] = [100_000, 1_000_000, 10_000_000];

/// Ten million steps of recurrent motions.
fn long_runs() {
    println!("The largest relative error of the energy so far, DiscreteGradient plain and compensated\n");
    println!("{:20} {:>24} {:>24}", "steps", "plain", "compensated");
    long_run("contact oscillator", CONTACT, keeps::contact(), 0.1);
    long_run("heavy Suslov", HEAVY, keeps::heavy(), 0.1);
    long_run("Veselova", VESELOVA, keeps::veselova(), 0.1);
    long_run("Chaplygin sphere", SPHERE, keeps::sphere(), 0.1);
    long_run("chaotic quartic", ChaoticQuartic, chaotic(), 0.05);
}

/// A line for a system: the errors after each number of steps.
fn long_run<S>(name: &str, system: S, start: S::State, h: f64)
where
    S: AlmostPoisson<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
{
    let show = |errors: [f64; 3]| errors.map(|error| format!("{error:7.1e}")).join(" ");
    let plain = show(worst(system, start, DiscreteGradient::new(h)));
    let compensated = show(worst(system, start, DiscreteGradient::new(h).compensated()));
    println!("{name:20} {plain:>24} {compensated:>24}");
}

/// The largest relative error of the energy after each number of steps.
fn worst<S, M>(system: S, start: S::State, method: M) -> [f64; 3]
where
    S: Energy<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let first = system.energy(0.0, &start);
    let mut sim = Integrator::new(system, method, 0.0, start);
    let (mut worst, mut done) = (0.0_f64, 0);
    MANY.map(|steps| {
        while done < steps {
            if sim.step().is_err() {
                worst = f64::INFINITY;
                break;
            }
            worst = larger(worst, (system.energy(0.0, sim.state()) - first) / first);
            done += 1;
        }
        worst
    })
}

//! Model only what the scene requires: one robot in four fidelities, their cost and their error.
//!
//! `cargo run --release --example fidelities`
//!
//! The same drive, a slalom with wheel speeds held by motors, at three levels of haste. The full model
//! has the angles and spins of the wheels; the reduced one has eliminated them, which changes nothing
//! but the cost; the one that tracks only what an estimator of speeds needs drops the pose; the
//! kinematic one believes that commands come true at once.

use std::error::Error;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use nh_examples::{BLUE, Chart, MUTED, ORANGE, Page, Picture, Scale};
use nonholonomic::prelude::*;

/// The robot with wheels that turn: pose, angles and everything that the constraints know.
#[nonholonomic(
    base { x, y, theta, right, left }
    basis { v, side, omega, spin_right, spin_left }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
        der(right) = spin_right;
        der(left) = spin_left;
    }
    lagrangian {
        m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 + Jw / 2 * (spin_right^2 + spin_left^2)
    }
    constraints {
        no_skidding: side = 0;
        rolling_right: r * spin_right = v + c * omega;
        rolling_left: r * spin_left = v - c * omega;
    }
    independent { v, omega }
    forces { right: torque_right; left: torque_left; }
    inputs { torque_right, torque_left }
    assume { r > 0; c > 0; }
    units {
        x, y, l, c, r = m;
        theta, right, left = rad;
        m = kg;
        J, Jw = kg m^2;
        torque_right, torque_left = N m;
    }
)]
#[derive(Clone, Copy, Debug)]
struct Full {
    m: f64,
    J: f64,
    Jw: f64,
    l: f64,
    c: f64,
    r: f64,
}

/// The robot with the wheels eliminated by hand, declared with what else a fidelity says of it.
macro_rules! without_wheels {
    ($(#[doc = $doc:literal])* $Robot:ident, $($more:tt)*) => {
        $(#[doc = $doc])*
        #[nonholonomic(
            base { x, y, theta }
            basis { v, side, omega }
            anchor {
                der(x) = v * cos(theta) - side * sin(theta);
                der(y) = v * sin(theta) + side * cos(theta);
                der(theta) = omega;
            }
            lagrangian {
                m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 + Jw / r^2 * (v^2 + c^2 * omega^2)
            }
            constraints { side = 0; }
            forces { v: (torque_right + torque_left) / r; omega: c / r * (torque_right - torque_left); }
            inputs { torque_right, torque_left }
            assume { r > 0; }
    units { x, y, l, c, r = m; theta = rad; m = kg; J, Jw = kg m^2; torque_right, torque_left = N m; }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $Robot {
            m: f64,
            J: f64,
            Jw: f64,
            l: f64,
            c: f64,
            r: f64,
        }
    };
}

without_wheels! {
    /// All of it.
    Reduced,
}

without_wheels! {
    /// What an estimator of speeds needs of it.
    Speeds, track { v, omega }
}

/// A pose that moves as the speeds command: there is no mass, and the inputs are accelerations.
#[nonholonomic(
    base { x, y, theta }
    basis { v, side, omega }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    lagrangian { (v^2 + side^2 + omega^2) / 2 }
    constraints { side = 0; }
    forces { v: acceleration; omega: turning; }
    inputs { acceleration, turning }
 // lengths are pure numbers here: the kinetic energy of a command adds up squares of speeds and of rates
    units { x, y = 1; theta = rad; acceleration, turning = s^-2; lagrangian = s^-2; }
)]
#[derive(Clone, Copy, Debug)]
struct Kinematic;

/// Time between two ticks of the motor controllers (s), and their number.
const TICK: f64 = 0.002;
const TICKS: u32 = 5000;
/// Half the distance between the wheels and their radius (m).
const C: f64 = 0.18;
const R: f64 = 0.08;
/// How hasty the drives are.
const HASTES: [f64; 3] = [0.5, 1.0, 2.5];
const NAMES: [&str; 3] = ["gentle", "brisk", "violent"];

/// The commanded speed and rate of turning: a slalom, the faster the more `haste`.
fn commanded(haste: f64, t: f64) -> (f64, f64) {
    let (sin, cos) = (TAU * t * haste / 4.0).sin_cos();
    (haste * (0.5 - 0.2 * cos), 1.5 * haste * sin)
}

/// Proportional control of the wheels' speeds; the motors give at most 0.6 N m.
fn torques(haste: f64, t: f64, v: f64, omega: f64) -> [f64; 2] {
    let (speed, turning) = commanded(haste, t);
    let wheel = |side: f64| ((speed - v) + side * C * (turning - omega)) / R;
    [wheel(1.0), wheel(-1.0)].map(|error| (0.5 * error).clamp(-0.6, 0.6))
}

/// A model in the scene.
trait Fidelity: Dynamics<State: State<Scalar = f64>> {
    /// The state in which the drive starts, with the speed that is commanded.
    fn start(&self, v: f64) -> Self::State;
    /// The input of a tick.
    fn input(&self, haste: f64, t: f64, state: &Self::State) -> Self::Input;
    /// Where the robot is, if the model knows.
    fn pose(&self, state: &Self::State) -> Option<[f64; 3]>;
}

impl Fidelity for Full {
    fn start(&self, v: f64) -> FullState {
        FullState { v, ..FullState::default() }
    }
    fn input(&self, haste: f64, t: f64, state: &FullState) -> FullInput {
        torques(haste, t, state.v, state.omega).into()
    }
    fn pose(&self, state: &FullState) -> Option<[f64; 3]> {
        Some([state.x, state.y, state.theta])
    }
}

impl Fidelity for Reduced {
    fn start(&self, v: f64) -> ReducedState {
        ReducedState { v, ..ReducedState::default() }
    }
    fn input(&self, haste: f64, t: f64, state: &ReducedState) -> ReducedInput {
        torques(haste, t, state.v, state.omega).into()
    }
    fn pose(&self, state: &ReducedState) -> Option<[f64; 3]> {
        Some([state.x, state.y, state.theta])
    }
}

impl Fidelity for Speeds {
    fn start(&self, v: f64) -> SpeedsState {
        SpeedsState { v, omega: 0.0 }
    }
    fn input(&self, haste: f64, t: f64, state: &SpeedsState) -> SpeedsInput {
        torques(haste, t, state.v, state.omega).into()
    }
    fn pose(&self, _state: &SpeedsState) -> Option<[f64; 3]> {
        None
    }
}

impl Fidelity for Kinematic {
    fn start(&self, v: f64) -> KinematicState {
        KinematicState { v, ..KinematicState::default() }
    }
    fn input(&self, haste: f64, t: f64, _state: &KinematicState) -> KinematicInput {
        let (now, next) = (commanded(haste, t), commanded(haste, t + TICK));
        [(next.0 - now.0) / TICK, (next.1 - now.1) / TICK].into()
    }
    fn pose(&self, state: &KinematicState) -> Option<[f64; 3]> {
        Some([state.x, state.y, state.theta])
    }
}

/// The path of a drive in ticks, as far as the model knows it.
fn drive<F: Fidelity>(robot: &F, haste: f64) -> Vec<[f64; 3]> {
    let mut state = robot.start(commanded(haste, 0.0).0);
    let mut path = Vec::new();
    for tick in 0..=TICKS {
        let t = TICK * f64::from(tick);
        path.extend(robot.pose(&state));
        let input = robot.input(haste, t, &state);
        state = Rk4::step(robot, t, TICK, &state, &input);
    }
    path
}

/// The time of a step (ns): the best of several rounds.
fn cost<F: Fidelity>(robot: &F) -> f64 {
    let start = robot.start(0.5);
    let input = robot.input(1.0, 0.3, &start);
    let round = || {
        let mut state = start;
        let begun = Instant::now();
        for _ in 0..100_000 {
            state = Rk4::step(black_box(robot), 0.0, 1e-6, &state, black_box(&input));
        }
        black_box(state);
        begun.elapsed().as_secs_f64() * 1e4
    };
    (0..9).map(|_| round()).fold(f64::INFINITY, f64::min)
}

/// A row of the table.
struct Row {
    name: &'static str,
    variables: usize,
    nanoseconds: f64,
    /// Distance from the full model at the end of each drive (m).
    errors: Option<[f64; 3]>,
}

fn row<F: Fidelity>(name: &'static str, robot: &F, truth: &[Vec<[f64; 3]>; 3]) -> Row {
    let error = |index: usize| {
        let path = drive(robot, HASTES[index]);
        let (last, true_last) = (path.last()?, truth[index].last()?);
        Some((last[0] - true_last[0]).hypot(last[1] - true_last[1]))
    };
    let errors = (|| Some([error(0)?, error(1)?, error(2)?]))();
    Row { name, variables: <F::State as State>::names().as_ref().len(), nanoseconds: cost(robot), errors }
}

fn main() -> Result<(), Box<dyn Error>> {
    let full = Full { m: 9.0, J: 0.25, Jw: 0.006, l: 0.06, c: C, r: R };
    let Full { m, J: inertia, Jw: spin, l, c, r } = full;
    let reduced = Reduced { m, J: inertia, Jw: spin, l, c, r };
    let speeds = Speeds { m, J: inertia, Jw: spin, l, c, r };
    let truth = HASTES.map(|haste| drive(&full, haste));
    let rows = [
        row("full: with the wheels' angles", &full, &truth),
        row("reduced: wheels eliminated", &reduced, &truth),
        row("kinematic: commands come true", &Kinematic, &truth),
        row("tracked: speeds alone", &speeds, &truth),
    ];
    println!(
        "                                variables   ns per step    off the full model after {} s (m)",
        TICK * f64::from(TICKS)
    );
    println!("                                                            gentle      brisk    violent");
    for row in &rows {
        let errors = row.errors.map_or_else(
            || "         (no pose)".to_owned(),
            |errors| errors.map(|error| format!("{error:11.1e}")).concat(),
        );
        println!("{:32} {:8} {:13.1} {errors}", row.name, row.variables, row.nanoseconds);
    }
    println!();
    println!(
        "The reduction is exact: what it saves costs no accuracy, so keep the wheels only where a scene"
    );
    println!(
        "shows them or a force depends on their angles. Track what an estimator reads and drop the rest."
    );
    println!("The kinematic model is enough while the motors follow their commands: compare the columns.");
    let kinematic = HASTES.map(|haste| drive(&Kinematic, haste));
    draw(&truth, &kinematic).save("fidelities")?;
    Ok(())
}

fn draw(truth: &[Vec<[f64; 3]>; 3], kinematic: &[Vec<[f64; 3]>; 3]) -> Picture {
    let title = "When is a kinematic model enough?";
    let subtitle = "Its distance from the full model along a slalom, at three levels of haste.";
    let mut picture = Picture::new(960.0, 420.0, title, subtitle);
    let across = [0.0, TICK * f64::from(TICKS)];
    let mut chart = Chart::new(Page { x: 76.0, y: 130.0 }, [760.0, 220.0], across, [1e-4, 10.0])
        .scales(Scale::Linear, Scale::Logarithmic);
    let styles = [BLUE, "#be3074", ORANGE];
    for ((full, believed), (colour, name)) in truth.iter().zip(kinematic).zip(styles.iter().zip(NAMES)) {
        let distance = full.iter().zip(believed).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]).max(1e-4));
        let curve: Vec<(f64, f64)> =
            distance.zip(0_u32..).map(|(d, tick)| (TICK * f64::from(tick), d)).collect();
        let end = curve.last().map_or(Page { x: 0.0, y: 0.0 }, |(t, d)| chart.at(*t, *d));
        chart.line("", colour, curve);
        let beside = Page { x: end.x + 8.0, y: end.y + 4.0 };
        picture.text(beside, name, &format!(r#"font-size="13" fill="{colour}""#));
    }
    chart.draw(&mut picture, "Distance (m)", "s");
    let note = "Motors of at most 0.6 N m; proportional control of the wheels at 500 Hz";
    let at = Page { x: 836.0, y: 400.0 };
    picture.text(at, note, &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#));
    picture
}

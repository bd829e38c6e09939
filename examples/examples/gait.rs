//! A snakeboard finds out how to go: model predictive path integral control, a thousand rollouts at a
//! time.
//!
//! `cargo run --release --example gait`
//!
//! Nobody tells the rider that the rotor and the wheels have to swing in a rhythm. Forty times a second
//! 1024 futures of two and a half seconds are tried with random swings of rotor and wheels, in single precision and eight
//! at once in the lanes of the processor, and those that cost least have most weight in what is
//! done next (Williams, Drews, Goldfain, Rehg, Theodorou, ICRA 2016). The board that is driven is another
//! one: in double precision and with a tenth more mass.

use std::error::Error;
use std::time::Instant;

use nh_examples::{BLUE, Chart, INK, MUTED, ORANGE, Page, Picture, Pose, Random, View};
use nonholonomic::batch::{for_each, gather, par_for_each, scatter};
use nonholonomic::prelude::*;
use nonholonomic::wide::f32x8;

/// A snakeboard: its wheel pairs steer against each other, the rotor turns against the board.
#[nonholonomic(
    base { x, y, theta, psi, phi }
    basis {
        /// Speed along the board.
        u1,
        /// Speed across it.
        u2,
        /// Rate of turning.
        omega,
        /// Rate of the rotor against the board.
        dpsi,
        /// Rate of steering.
        dphi,
    }
    anchor {
        der(x) = u1 * cos(theta) - u2 * sin(theta);
        der(y) = u1 * sin(theta) + u2 * cos(theta);
        der(theta) = omega;
        der(psi) = dpsi;
        der(phi) = dphi;
    }
    lagrangian {
        m / 2 * (u1^2 + u2^2) + m * l^2 / 2 * omega^2 + J0 / 2 * dpsi^2 + J0 * dpsi * omega + J1 * dphi^2
    }
    constraints {
        front: sin(phi) * u1 = cos(phi) * (u2 + l * omega);
        back: sin(phi) * u1 = -cos(phi) * (u2 - l * omega);
    }
    independent { u1, dpsi, dphi }
    inputs { rotor, steering }
    forces {
        u1: -drag * u1;
        // servos, critically damped
        dpsi: J0 * rate^2 * (rotor - psi) - 2 * J0 * rate * dpsi;
        dphi: 2 * J1 * rate^2 * (steering - phi) - 4 * J1 * rate * dphi;
    }
    assume { m > 0; l > 0; J0 > 0; J1 > 0; }
    units {
        x, y, l = m;
        theta, psi, phi = rad;
        m = kg;
        J0, J1 = kg m^2;
        drag = kg/s;
        rate = s^-1;
        rotor, steering = rad;
    }
)]
#[derive(Clone, Copy, Debug)]
pub struct Snakeboard<T> {
    /// Mass (kg).
    pub m: T,
    /// Half the distance between the wheel pairs (m); the total inertia is m l².
    pub l: T,
    /// Moment of inertia of the rotor (kg m²).
    pub J0: T,
    /// Moment of inertia of each pair of wheels (kg m²).
    pub J1: T,
    /// Friction (kg/s).
    pub drag: T,
    /// How fast the servos of rotor and steering are (1/s).
    pub rate: T,
}

impl<T: Scalar> Snakeboard<T> {
    /// A board with this mass.
    fn weighing(m: f64) -> Self {
        let number = T::from_f64;
        Self {
            m: number(m),
            l: number(0.2),
            J0: number(0.072),
            J1: number(0.0013),
            drag: number(0.6),
            rate: number(12.0),
        }
    }
}

/// Time from tick to tick (s); ticks of a future, and of the ride.
const TICK: f64 = 0.025;
const HORIZON: u16 = 100;
const RIDE: u32 = 800;
/// Futures that are tried at every tick.
const TRIALS: u16 = 1024;
/// A trial's inputs differ from the plan by a broken line through so many points.
const POINTS: usize = 11;
const TICKS_PER_POINT: u16 = 10;
/// The standard deviations of those points, for the angles of rotor and steering that the servos get.
const SPREAD: [f32; 2] = [0.5, 0.25];
/// The largest angles.
const LARGEST: [f32; 2] = [1.5, 0.7];
/// The speed that is asked for (m/s).
const SPEED: f32 = 0.5;

/// The inputs of the ticks to come.
type Plan = [[f32; 2]; HORIZON as usize];

/// One of the futures.
#[derive(Clone, Copy)]
struct Trial {
    points: [[f32; 2]; POINTS],
    cost: f32,
}

/// The plan with the deviations of a trial, or those of several in lanes.
fn inputs<L: Lanes<Lane = f32>>(plan: &Plan, points: &[[L; 2]; POINTS]) -> impl Iterator<Item = [L; 2]> {
    let lines = points.iter().zip(&points[1..]);
    let deviations = lines.flat_map(|(from, to)| {
        (0..TICKS_PER_POINT).map(move |part| {
            let share = L::splat(f32::from(part) / f32::from(TICKS_PER_POINT));
            [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
        })
    });
    plan.iter().zip(deviations).map(|(planned, deviation)| {
        [0, 1].map(|i| {
            let largest = L::splat(LARGEST[i]);
            (L::splat(planned[i]) + deviation[i]).min(largest).max(-largest)
        })
    })
}

/// What a tick costs: to be slow, to leave the line, to turn away from it.
fn cost<T: Scalar>(state: &SnakeboardState<T>) -> T {
    let number = |value: f32| T::from_f64(f64::from(value));
    let square = |value: T| value * value;
    let slow = state.u1 * state.theta.cos() - number(SPEED);
    number(4.0) * square(slow) + number(2.0) * square(state.y) + number(0.3) * square(state.theta)
}

/// The costs of a group of futures, side by side in lanes.
fn roll_out<L: Lanes<Lane = f32>>(group: &mut [Trial], start: &SnakeboardState<f64>, plan: &Plan) {
    let board = Snakeboard::<L>::weighing(6.0);
    let mut state = SnakeboardState::<L>::from(start.to_array().map(L::from_f64));
    let points = std::array::from_fn(|k| [0, 1].map(|i| gather(group, |trial| trial.points[k][i])));
    let mut total = L::ZERO;
    for [rotor, steering] in inputs(plan, &points) {
        let input = SnakeboardInput { rotor, steering };
        state = Rk4::step(&board, L::ZERO, L::from_f64(TICK), &state, &input);
        total += cost(&state);
    }
    scatter(total, group, |trial, cost| trial.cost = cost);
}

/// Makes the plan better by the mean of the trials' deviations, weighted by their costs.
fn improve(plan: &mut Plan, trials: &[Trial]) {
    let least = trials.iter().map(|trial| trial.cost).fold(f32::INFINITY, f32::min);
    let finite = || trials.iter().filter(|trial| trial.cost.is_finite());
    let (count, sum) = finite().fold((0.0, 0.0), |(count, sum), trial| (count + 1.0_f32, sum + trial.cost));
    // how many of the trials count at all is decided by this
    let temperature = 0.1 * (sum / count - least) + f32::MIN_POSITIVE;
    let weight = |trial: &Trial| ((least - trial.cost) / temperature).exp();
    let total: f32 = finite().map(weight).sum();
    let mut mean = [[0.0; 2]; POINTS];
    for trial in finite() {
        for (mean, point) in mean.iter_mut().zip(&trial.points) {
            for (mean, point) in mean.iter_mut().zip(point) {
                *mean += weight(trial) / total * point;
            }
        }
    }
    let before = *plan;
    for (planned, better) in plan.iter_mut().zip(inputs::<f32>(&before, &mean)) {
        *planned = better;
    }
}

/// A moment of the ride.
struct Moment {
    t: f64,
    state: SnakeboardState<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let board = Snakeboard::<f64>::weighing(6.6);
    board.validate()?;
    let mut state = SnakeboardState::<f64>::default();
    let mut plan: Plan = [[0.0; 2]; HORIZON as usize];
    let mut trials = vec![Trial { points: [[0.0; 2]; POINTS], cost: 0.0 }; usize::from(TRIALS)];
    let mut random = Random::new(7);
    let mut film = Vec::new();
    let mut slowest = 0.0_f64;
    println!("    t (s)     x (m)     y (m)  speed (m/s)   rotor   steering (rad)");
    for tick in 0..RIDE {
        // the first trial is the plan itself
        for trial in &mut trials[1..] {
            for point in &mut trial.points {
                *point = SPREAD.map(|spread| spread * f32::from_f64(random.normal()));
            }
        }
        let begun = Instant::now();
        par_for_each::<f32x8, _>(&mut trials, |group| roll_out::<f32x8>(group, &state, &plan));
        improve(&mut plan, &trials);
        slowest = slowest.max(begun.elapsed().as_secs_f64());
        let [rotor, steering] = plan[0].map(f64::from);
        if tick % 80 == 0 {
            println!(
                "{:9.1} {:9.3} {:9.3} {:12.3} {:7.2} {:10.2}",
                TICK * f64::from(tick),
                state.x,
                state.y,
                state.u1,
                state.psi,
                state.phi
            );
        }
        film.push(Moment { t: TICK * f64::from(tick), state });
        state = Rk4::step(&board, 0.0, TICK, &state, &SnakeboardInput { rotor, steering });
        plan.rotate_left(1);
        if let [.., before, last] = plan.as_mut_slice() {
            *last = *before;
        }
    }
    println!("slowest replanning of the ride: {:.1} ms of the {:.0} ms there are", 1e3 * slowest, 1e3 * TICK);
    rates(&mut trials, &state, &plan);
    draw(&film).save("gait")?;
    Ok(())
}

/// How many futures a second can be tried.
fn rates(trials: &mut [Trial], state: &SnakeboardState<f64>, plan: &Plan) {
    println!("\n{:24}   futures/s   million steps/s   plans per second", "");
    let mut row = |name: &str, all: &mut dyn FnMut(&mut [Trial])| {
        let tries = (0..30).map(|_| {
            let begun = Instant::now();
            all(trials);
            begun.elapsed().as_secs_f64()
        });
        let plans = 1.0 / tries.fold(f64::INFINITY, f64::min);
        let futures = plans * f64::from(TRIALS);
        let steps = futures * f64::from(HORIZON) / 1e6;
        println!("{name:24} {futures:11.0} {steps:17.1} {plans:18.0}");
    };
    row("one by one", &mut |trials| {
        for_each::<f32, _>(trials, |group| roll_out::<f32>(group, state, plan));
    });
    row("eight lanes", &mut |trials| {
        for_each::<f32x8, _>(trials, |group| roll_out::<f32x8>(group, state, plan));
    });
    row("eight lanes, all cores", &mut |trials| {
        par_for_each::<f32x8, _>(trials, |group| roll_out::<f32x8>(group, state, plan));
    });
}

fn draw(film: &[Moment]) -> Picture {
    let title = "A snakeboard finds its gait";
    let subtitle = "Rotor and wheels are moved by path integral control; nobody prescribes the rhythm.";
    let mut picture = Picture::new(1000.0, 620.0, title, subtitle);
    let path: Vec<(f64, f64)> = film.iter().map(|moment| (moment.state.x, moment.state.y)).collect();
    let view = View::showing(path.iter().copied(), 0.35, Page { x: 40.0, y: 90.0 }, 920.0, 190.0);
    let line: Vec<Page> = path.iter().map(|point| view.at(*point)).collect();
    picture.line(&line, &format!(r#"stroke="{MUTED}" stroke-width="1.5""#));
    for moment in film.iter().step_by(80) {
        board(&mut picture, &view, &moment.state);
    }
    let end = film.last().map_or(1.0, |moment| moment.t);
    let chart =
        |y: f64, height: f64, up: [f64; 2]| Chart::new(Page { x: 76.0, y }, [848.0, height], [0.0, end], up);
    let mut angles = chart(330.0, 110.0, [-2.0, 2.0]);
    angles.line("rotor", ORANGE, film.iter().map(|m| (m.t, m.state.psi)));
    angles.line("steering", BLUE, film.iter().map(|m| (m.t, m.state.phi)));
    angles.draw(&mut picture, "Angles (rad)", "s");
    let mut speeds = chart(500.0, 80.0, [0.0, 0.75]);
    speeds.line("", INK, film.iter().map(|m| (m.t, m.state.u1)));
    speeds.draw(&mut picture, "Speed (m/s)", "s");
    picture
}

/// The board with its wheel pairs and rotor.
fn board(picture: &mut Picture, view: &View, state: &SnakeboardState<f64>) {
    let pose = Pose { x: state.x, y: state.y, heading: state.theta };
    let deck = [pose.point(-0.2, 0.0), pose.point(0.2, 0.0)].map(|point| view.at(point));
    picture.line(&deck, &format!(r#"stroke="{INK}" stroke-width="3""#));
    for (end, turn) in [(0.2, state.phi), (-0.2, -state.phi)] {
        let (x, y) = pose.point(end, 0.0);
        let axle = Pose { x, y, heading: state.theta + turn };
        let ends = [axle.point(0.0, -0.1), axle.point(0.0, 0.1)].map(|point| view.at(point));
        picture.line(&ends, r##"stroke="#5b7bb0" stroke-width="3""##);
    }
    let rotor = Pose { heading: state.theta + state.psi, ..pose };
    let ends = [rotor.point(-0.1, 0.0), rotor.point(0.1, 0.0)].map(|point| view.at(point));
    picture.line(&ends, r##"stroke="#e8623e" stroke-width="2.5""##);
}

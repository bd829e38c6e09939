//! A tractor with two trailers parks backwards between two vehicles, by the iterative linear-quadratic
//! regulator.
//!
//! `cargo run --release --example parking`
//!
//! Pushing trailers backwards is unstable, so a plan alone does not suffice: the feedback along the
//! plan, which the same algorithm leaves behind, holds trailers that are heavier and stand elsewhere
//! than planned. The derivatives of the dynamics are those of the generated `jacobian` through a step of
//! Runge and Kutta; those of the cost come from its definition by jets. At the end the same model and
//! cost go through the seam to a general optimiser, L-BFGS of the crate `argmin`.

use std::error::Error;
use std::time::Instant;

use argmin::core::{CostFunction, Executor, Gradient, State as _};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use nalgebra::{SVector, vector};
use nh_examples::{BACKGROUND, Chart, INK, MUTED, ORANGE, Page, Picture, Pose, View};
use nonholonomic::control::{
    ControlError, Ilqr, Model, Residuals, Sampled, Squares, shooting_cost, shooting_gradient,
};
use nonholonomic::prelude::*;

/// A tractor on two driven wheels and its trailers, each hitched on the axle before it.
#[nonholonomic(
    base {
        x, y,
        /// The heading of the tractor.
        theta,
        /// The heading of a trailer against what pulls it.
        bend[2]
    }
    basis { v, side, omega, dbend[2] }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
        for i in 0..2 { der(bend[i]) = dbend[i]; }
    }
    lagrangian {
        let angle[i in 0..2] = sum(j in 0..i+1: bend[j]);
        let turn[i in 0..2] = omega + sum(j in 0..i+1: dbend[j]);
        let ahead[i in 0..2] = v + sum(j in 0..i+1: d * sin(angle[j]) * turn[j]);
        let left[i in 0..2] = side - sum(j in 0..i+1: d * cos(angle[j]) * turn[j]);
        m / 2 * (v^2 + side^2) + J / 2 * omega^2
            + sum(i in 0..2: load / 2 * (ahead[i]^2 + left[i]^2) + load_J / 2 * turn[i]^2)
    }
    constraints {
        let angle[i in 0..2] = sum(j in 0..i+1: bend[j]);
        let turn[i in 0..2] = omega + sum(j in 0..i+1: dbend[j]);
        let ahead[i in 0..2] = v + sum(j in 0..i+1: d * sin(angle[j]) * turn[j]);
        let left[i in 0..2] = side - sum(j in 0..i+1: d * cos(angle[j]) * turn[j]);
        side = 0;
        for i in 0..2 { cos(angle[i]) * left[i] = sin(angle[i]) * ahead[i]; }
    }
    inputs { push, steer }
    forces { v: push - drag * v; omega: steer - drag * d^2 * omega; }
    assume { m > 0; J > 0; load > 0; d > 0; }
    units {
        x, y, d = m;
        theta, bend = rad;
        m, load = kg;
        J, load_J = kg m^2;
        drag = kg/s;
        push = N;
        steer = N m;
    }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Tractor {
    /// Mass of the tractor (kg).
    pub m: f64,
    /// Its moment of inertia (kg m²).
    pub J: f64,
    /// Mass of a trailer (kg).
    pub load: f64,
    /// Its moment of inertia (kg m²).
    pub load_J: f64,
    /// From axle to axle (m).
    pub d: f64,
    /// Friction (kg/s).
    pub drag: f64,
}

/// Time from tick to tick (s), and the ticks of the plan.
const TICK: f64 = 0.05;
const TICKS: usize = 300;
/// The bounds of push (N) and steer (N m).
const BOUNDS: [f64; 2] = [12.0, 6.0];
/// Where the parked vehicles stand, half their length, and half their width (m).
const PARKED: [[f64; 2]; 2] = [[-2.25, -1.5], [3.15, -1.5]];
const PARKED_SIZE: [f64; 2] = [1.0, 0.45];
/// Half the width of tractor and trailers, and where the kerb is (m).
const HALF_WIDTH: f64 = 0.25;
const KERB: f64 = -2.0;
/// The distance from axle to axle (m).
const HITCH: f64 = 0.9;

type Plan = Ilqr<f64, 7, 2, TICKS>;

/// What the manoeuvre is to achieve and to avoid.
struct Manoeuvre;

impl Manoeuvre {
    /// Where the tractor should stand at the end, and everything behind it in line and at rest.
    const GOAL: [f64; 7] = [1.3, -1.5, 0.0, 0.0, 0.0, 0.0, 0.0];
}

/// The axles of the tractor and the trailers.
fn axles<S: Scalar>(x: &[S; 7]) -> [[S; 2]; 3] {
    let d = S::from_f64(HITCH);
    let mut angle = x[2];
    let mut at = [x[0], x[1]];
    let mut axles = [at; 3];
    for (axle, bend) in axles[1..].iter_mut().zip(&x[3..5]) {
        angle += *bend;
        let (sin, cos) = angle.sin_cos();
        at = [at[0] - d * cos, at[1] - d * sin];
        *axle = at;
    }
    axles
}

impl Residuals<7, 2> for Manoeuvre {
    fn stage<S: Scalar>(&self, _tick: usize, x: &[S; 7], u: &[S; 2], mut add: impl FnMut(S)) {
        let number = S::from_f64;
        // effort
        add(number(0.02) * u[0]);
        add(number(0.04) * u[1]);
        // no trailer beside what pulls it
        for bend in &x[3..5] {
            add(number(30.0) * (bend.abs() - number(1.0)).max(S::ZERO));
        }
        // nothing on the kerb, nothing in another vehicle: superellipses around them
        for [px, py] in axles(x) {
            add(number(40.0) * (number(KERB + HALF_WIDTH) - py).max(S::ZERO));
            for centre in PARKED {
                let a = (px - number(centre[0])) / number(PARKED_SIZE[0] + HALF_WIDTH);
                let b = (py - number(centre[1])) / number(PARKED_SIZE[1] + HALF_WIDTH);
                let (a, b) = (a * a, b * b);
                add(number(20.0) * (S::ONE - a * a - b * b).max(S::ZERO));
            }
        }
    }

    fn end<S: Scalar>(&self, x: &[S; 7], mut add: impl FnMut(S)) {
        let weights = [60.0, 60.0, 60.0, 60.0, 60.0, 20.0, 20.0];
        for ((x, goal), weight) in x.iter().zip(Self::GOAL).zip(weights) {
            add(S::from_f64(weight) * (*x - S::from_f64(goal)));
        }
    }
}

/// The same problem for a general optimiser: inputs without bounds, of which those of the tractor are
/// the hyperbolic tangents.
#[derive(Clone)]
struct Shooting {
    model: Sampled<Tractor, f64>,
    start: SVector<f64, 7>,
}

impl Shooting {
    fn inputs(free: &[f64]) -> Vec<SVector<f64, 2>> {
        let bounded = |pair: &[f64]| SVector::from_fn(|i, _| BOUNDS[i] * pair[i].tanh());
        free.chunks_exact(2).map(bounded).collect()
    }
}

impl CostFunction for Shooting {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, free: &Vec<f64>) -> Result<f64, argmin::core::Error> {
        Ok(shooting_cost(&self.model, &Squares(Manoeuvre), &self.start, &Self::inputs(free)))
    }
}

impl Gradient for Shooting {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, free: &Vec<f64>) -> Result<Vec<f64>, argmin::core::Error> {
        let inputs = Self::inputs(free);
        let mut states = vec![SVector::zeros(); inputs.len()];
        let mut by_input = vec![SVector::zeros(); inputs.len()];
        let cost = Squares(Manoeuvre);
        shooting_gradient(&self.model, &cost, &self.start, &inputs, &mut states, &mut by_input)?;
        let by_free = inputs
            .iter()
            .zip(&by_input)
            .flat_map(|(u, by_input)| [0, 1].map(|i| by_input[i] * (BOUNDS[i] - u[i] * u[i] / BOUNDS[i])));
        Ok(by_free.collect())
    }
}

/// How far from the goal a manoeuvre ends (m, in the mean over the axles), and how much room it leaves
/// to the parked vehicles: the least distance from an axle to one.
fn summary(states: &[SVector<f64, 7>]) -> (f64, f64) {
    let goal = axles(&Manoeuvre::GOAL);
    let end = states.last().map_or(goal, |x| axles(&(*x).into()));
    let miss = goal.iter().zip(&end).map(|(g, e)| (g[0] - e[0]).hypot(g[1] - e[1])).sum::<f64>() / 3.0;
    let distance = |[px, py]: [f64; 2], [cx, cy]: [f64; 2]| {
        let outside = |offset: f64, half: f64| (offset.abs() - half).max(0.0);
        outside(px - cx, PARKED_SIZE[0]).hypot(outside(py - cy, PARKED_SIZE[1]))
    };
    let room = states
        .iter()
        .flat_map(|x| axles(&(*x).into()))
        .flat_map(|axle| PARKED.map(|centre| distance(axle, centre)))
        .fold(f64::INFINITY, f64::min);
    (miss, room)
}

/// Drives a tractor along a plan, with feedback or without.
fn driven(tractor: Tractor, plan: &Plan, start: &SVector<f64, 7>, feedback: bool) -> Vec<SVector<f64, 7>> {
    let model = Sampled { system: tractor, start: 0.0, dt: TICK };
    let mut x = *start;
    let mut film = vec![x];
    for tick in 0..TICKS {
        let mut u = plan.inputs()[tick];
        if feedback {
            u += plan.gains()[tick] * (x - plan.states()[tick]);
        }
        let u = u.zip_map(&SVector::from(BOUNDS), |u, bound| u.clamp(-bound, bound));
        x = model.step(tick, &x, &u);
        film.push(x);
    }
    film
}

fn main() -> Result<(), Box<dyn Error>> {
    let tractor = Tractor { m: 20.0, J: 0.8, load: 15.0, load_J: 0.6, d: HITCH, drag: 4.0 };
    tractor.validate()?;
    let model = Sampled { system: tractor, start: 0.0, dt: TICK };
    let cost = Squares(Manoeuvre);
    let start = vector![4.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];

    let begun = Instant::now();
    let (plan, iterations) = planned(&model, &start)?;
    let seconds = begun.elapsed().as_secs_f64();
    let reached = shooting_cost(&model, &cost, &start, plan.inputs());
    println!("optimiser           iterations      cost   ms in all   ms per iteration");
    println!(
        "{:18} {iterations:11} {reached:9.2} {:11.0} {:18.2}",
        "iLQR (ours)",
        1e3 * seconds,
        1e3 * seconds / f64::from(iterations)
    );

    let problem = Shooting { model, start };
    let begun = Instant::now();
    let search = LBFGS::new(MoreThuenteLineSearch::new(), 20);
    let result = Executor::new(problem, search)
        .configure(|state| state.param(vec![0.0; 2 * TICKS]).max_iters(2000))
        .run()?;
    let seconds = begun.elapsed().as_secs_f64();
    let count = u32::try_from(result.state().get_iter()).unwrap_or(u32::MAX);
    println!(
        "{:18} {count:11} {:9.2} {:11.0} {:18.2}",
        "L-BFGS (argmin)",
        result.state().get_best_cost(),
        1e3 * seconds,
        1e3 * seconds / f64::from(count)
    );

    // trailers with a load, and a start that is not where the plan begins
    let heavy = Tractor { load: 18.0, load_J: 0.7, ..tractor };
    let aside = start + vector![0.1, -0.05, 0.02, -0.04, 0.05, 0.0, 0.0];
    println!("\n                          at the end off by (m)   nearest to another vehicle (m)");
    let runs = [
        ("as planned", driven(tractor, &plan, &start, false)),
        ("disturbed, plan only", driven(heavy, &plan, &aside, false)),
        ("disturbed, feedback", driven(heavy, &plan, &aside, true)),
    ];
    for (name, film) in &runs {
        let (miss, room) = summary(film);
        println!("{name:22} {miss:22.3} {room:32.3}");
    }
    draw(&runs[2].1, &plan).save("parking")?;
    Ok(())
}

/// The plan, from no input at all.
fn planned(model: &Sampled<Tractor, f64>, start: &SVector<f64, 7>) -> Result<(Plan, u32), ControlError> {
    let bounds = SVector::from(BOUNDS);
    let mut plan = Plan::new(SVector::zeros()).bounds(-bounds, bounds);
    for iteration in 1..=400 {
        let last = plan.improve(model, &Squares(Manoeuvre), start)?;
        if last.promised < 1e-6 * last.cost {
            return Ok((plan, iteration));
        }
    }
    Ok((plan, 400))
}

/// The manoeuvre as it was driven: shadows of the train, and the inputs of the plan.
fn draw(film: &[SVector<f64, 7>], plan: &Plan) -> Picture {
    let title = "Two trailers park backwards";
    let subtitle =
        "Planned by iLQR; driven with its feedback by a tractor whose trailers are a fifth heavier.";
    let mut picture = Picture::new(1000.0, 640.0, title, subtitle);
    let frame = [(-3.8, KERB - 0.1), (7.6, 1.3)];
    let view = View::showing(frame, 0.1, Page { x: 40.0, y: 96.0 }, 920.0, 330.0);
    let kerb = [view.at((-3.8, KERB)), view.at((7.6, KERB))];
    picture.line(&kerb, &format!(r#"stroke="{INK}" stroke-width="2""#));
    for [x, y] in PARKED {
        let [a, b] = PARKED_SIZE;
        let corners = [(-a, -b), (a, -b), (a, b), (-a, b)].map(|(dx, dy)| view.at((x + dx, y + dy)));
        picture.polygon(&corners, &format!(r#"fill="{MUTED}" fill-opacity="0.35" stroke="{MUTED}""#));
    }
    let shown = 12;
    for step in 0..=shown {
        let Some(x) = film.get(step * (film.len() - 1) / shown) else { continue };
        train(&mut picture, &view, x, step == shown);
    }
    let end = TICK * 300.0;
    for (input, (name, up)) in
        [("push (N)", [-12.0, 12.0]), ("steer (N m)", [-6.0, 6.0])].into_iter().enumerate()
    {
        let corner = Page { x: 90.0 + 470.0 * if input == 0 { 0.0 } else { 1.0 }, y: 480.0 };
        let mut chart = Chart::new(corner, [370.0, 110.0], [0.0, end], up);
        let curve = (0u32..).zip(plan.inputs()).map(|(tick, u)| (TICK * f64::from(tick), u[input]));
        chart.line("", ORANGE, curve);
        chart.draw(&mut picture, name, "s");
    }
    picture
}

/// Tractor and trailers.
fn train(picture: &mut Picture, view: &View, x: &SVector<f64, 7>, last: bool) {
    let mut heading = x[2];
    let axles = axles(&(*x).into());
    let opacity = if last { 0.95 } else { 0.22 };
    let chain = axles.map(|[x, y]| view.at((x, y)));
    picture.line(&chain, &format!(r#"stroke="{INK}" stroke-width="1.5" stroke-opacity="{opacity}""#));
    for (body, [px, py]) in axles.into_iter().enumerate() {
        if body > 0 {
            heading += x[2 + body];
        }
        let pose = Pose { x: px, y: py, heading };
        let (back, front) = if body == 0 { (-0.2, 0.42) } else { (-0.32, 0.32) };
        let w = HALF_WIDTH;
        let corners =
            [(back, -w), (front, -w), (front, w), (back, w)].map(|(a, b)| view.at(pose.point(a, b)));
        let fill = if body == 0 { "#e8623e" } else { "#5b7bb0" };
        let style =
            format!(r#"fill="{fill}" fill-opacity="{opacity}" stroke="{BACKGROUND}" stroke-width="1""#);
        picture.polygon(&corners, &style);
    }
}

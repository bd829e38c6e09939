//! The benchmark bicycle: it rides by itself at one speed, weaves at another, and is steered at a third.
//!
//! `cargo run --release --example bicycle`
//!
//! The bicycle of Meijaard, Papadopoulos, Ruina and Schwab (2007) is declared by its geometry, in `nh_models`: bodies,
//! two wheels that roll, and a front wheel that stands on the ground, an equation that is not solved. Its linear model in
//! lean and steer comes of `linearize`, about the upright ride that `trim` finds: eigenvalues over the speed are the
//! picture of every paper on bicycles. The rides are those of the nonlinear machine.

use std::error::Error;

use nalgebra::{SMatrix, vector};
use nh_examples::{BLUE, Chart, GREEN, INK, MUTED, ORANGE, Page, Picture};
use nonholonomic::control::{Regulator, zero_order_hold};
use nonholonomic::prelude::*;
use nonholonomic::{Linearization, TrimError};

nh_models::bicycle! {
    /// The bicycle, with a torque about the steering axis.
    #[derive(Clone, Copy, Debug)]
    struct Bicycle<T>;
    forces { steer: torque; }
    inputs { torque }
    linearization { keep: lean, steer, der(lean), der(steer); }
}

/// The radius of the rear wheel (m).
const RADIUS: f64 = 0.3;
/// The push: how fast it begins to lean (rad/s).
const PUSH: f64 = 0.3;
/// A ride (s), and a tick of the regulator (s).
const RIDE: f64 = 20.0;
const TICK: f64 = 0.01;
/// It has fallen (rad).
const FALLEN: f64 = 1.0;

type Model = Linearization<f64, 4, 1, 0>;

/// Upright and straight ahead at a speed.
fn straight(speed: f64) -> BicycleState<f64> {
    BicycleState { rear_dot: -speed / RADIUS, ..BicycleState::default() }
}

/// The steady ride near to upright at a speed, and its linear model.
fn upright(bicycle: &Bicycle<f64>, speed: f64) -> Result<(BicycleState<f64>, Model), Box<dyn Error>> {
    use BicycleVariable::{rear_dot, torque};
    let guess = BicycleState { lean: 0.01, ..straight(speed) };
    let (state, input) = bicycle.trim(0.0, &guess, &BicycleInput::default(), &[rear_dot, torque])?;
    Ok((state, bicycle.linearize(0.0, &state, &input)?))
}

/// Real and imaginary parts of the eigenvalues at a speed, the least real part first.
fn eigenvalues(bicycle: &Bicycle<f64>, speed: f64) -> Result<[(f64, f64); 4], Box<dyn Error>> {
    let model = bicycle.linearize(0.0, &straight(speed), &BicycleInput::default())?;
    let found = model.a.complex_eigenvalues();
    let mut values = [0, 1, 2, 3].map(|index| (found[index].re, found[index].im.abs()));
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(values)
}

/// The speed between two at which the bicycle begins or ceases to be stable.
fn border(bicycle: &Bicycle<f64>, mut slow: f64, mut fast: f64) -> Result<f64, Box<dyn Error>> {
    let is_stable = |speed: f64| -> Result<bool, Box<dyn Error>> {
        Ok(eigenvalues(bicycle, speed)?.iter().all(|(re, _)| *re < 0.0))
    };
    let at_first = is_stable(slow)?;
    for _ in 0..40 {
        let middle = 0.5 * (slow + fast);
        if is_stable(middle)? == at_first { slow = middle } else { fast = middle }
    }
    Ok(0.5 * (slow + fast))
}

/// A moment of a ride.
struct Moment {
    t: f64,
    state: BicycleState<f64>,
}

/// A ride that is pushed at its start, steered or not, until it ends or the bicycle has fallen.
fn ride(
    bicycle: &Bicycle<f64>,
    speed: f64,
    regulator: Option<&Regulator<f64, 4, 1>>,
) -> Result<Vec<Moment>, Box<dyn Error>> {
    let (mut start, _) = upright(bicycle, speed)?;
    start.lean_dot = PUSH;
    bicycle.project(0.0, &mut start)?;
    let mut sim = Integrator::new(*bicycle, Dopri5::new().rtol(1e-8).atol(1e-8), 0.0, start);
    let mut film = vec![Moment { t: 0.0, state: start }];
    while sim.time() < RIDE - TICK / 2.0 && sim.state().lean.abs() < FALLEN {
        if let Some(regulator) = regulator {
            let BicycleState { lean, steer, lean_dot, steer_dot, .. } = *sim.state();
            let torque = regulator.input(&vector![lean, steer, lean_dot, steer_dot])[0];
            sim.set_input(BicycleInput { torque });
        }
        sim.advance_to(sim.time() + TICK)?;
        film.push(Moment { t: sim.time(), state: *sim.state() });
    }
    Ok(film)
}

fn main() -> Result<(), Box<dyn Error>> {
    let bicycle = nh_models::published_bicycle!(Bicycle, 9.81, |number: f64| number);
    bicycle.validate()?;
    let (weave, capsize) = (border(&bicycle, 4.0, 5.0)?, border(&bicycle, 5.0, 7.0)?);
    println!("stable by itself from {weave:.6} m/s (weave) to {capsize:.6} m/s (capsize)\n");
    // published: 4.292382536341 and 6.024262015388
    assert!((weave - 4.292_382_536_341).abs() < 1e-9 && (capsize - 6.024_262_015_388).abs() < 1e-9);
    // there, steady turns come off the straight ride, and nothing says how far it leans
    let held = [BicycleVariable::rear_dot, BicycleVariable::torque];
    let turning = bicycle.trim(0.0, &straight(capsize), &BicycleInput::default(), &held);
    assert_eq!(turning.err(), Some(TrimError::Undetermined { variable: "lean" }));

    let (_, model) = upright(&bicycle, 3.0)?;
    let (a, b) = zero_order_hold(&model.a, &model.b, TICK)?;
    let weights = SMatrix::<f64, 4, 4>::from_diagonal(&vector![10.0, 1.0, 1.0, 0.1]);
    let regulator = Regulator::stationary(&a, &b, &weights, &SMatrix::<f64, 1, 1>::from_element(0.01))?;
    let rides = [
        ("by itself", 4.6, ride(&bicycle, 4.6, None)?),
        ("by itself", 3.5, ride(&bicycle, 3.5, None)?),
        ("by LQR", 3.0, ride(&bicycle, 3.0, Some(&regulator))?),
    ];
    println!("speed (m/s)   steered     rode for (s)   most lean (rad)   lean, speed at the end");
    for (how, speed, film) in &rides {
        let most = film.iter().fold(0.0, |most: f64, moment| most.max(moment.state.lean.abs()));
        let last = film.last().ok_or("a ride without moments")?;
        let BicycleState { lean, rear_dot, .. } = last.state;
        println!(
            "{speed:11.1}   {how:9}   {:12.2}   {most:15.3}   {lean:15.4} {:6.3}",
            last.t,
            -RADIUS * rear_dot
        );
    }
    // how far it still swings in the last five seconds
    let swing = |index: usize| {
        let film = rides[index].2.iter().filter(|moment| moment.t > RIDE - 5.0);
        film.fold(0.0, |most: f64, moment| most.max(moment.state.lean.abs()))
    };
    println!("\nlean in the last five seconds: {:.4}, {:.4}, {:.4} rad", swing(0), swing(1), swing(2));
    assert!(swing(0) < 1e-3 && swing(1) > 0.3 && swing(2) < 1e-3);
    draw(&bicycle, [weave, capsize], &rides)?.save("bicycle")?;
    Ok(())
}

/// Eigenvalues over the speed, the tracks, and the lean.
fn draw(
    bicycle: &Bicycle<f64>,
    [weave, capsize]: [f64; 2],
    rides: &[(&str, f64, Vec<Moment>); 3],
) -> Result<Picture, Box<dyn Error>> {
    let title = "A bicycle rides by itself";
    let subtitle = "The benchmark bicycle, declared by its geometry. Eigenvalues in lean and steer over the speed, and \
                    three rides after a push.";
    let mut picture = Picture::new(1000.0, 800.0, title, subtitle);
    let mut chart = Chart::new(Page { x: 70.0, y: 110.0 }, [840.0, 330.0], [0.0, 10.0], [-10.0, 10.0]);
    chart.band("", "#e7efe4", [(weave, -10.0, 10.0), (capsize, -10.0, 10.0)]);
    let speeds = (0..=400_u32).map(|step| f64::from(step) / 40.0);
    let spectrum: Vec<(f64, [(f64, f64); 4])> = speeds
        .map(|speed| Ok((speed, eigenvalues(bicycle, speed)?)))
        .collect::<Result<_, Box<dyn Error>>>()?;
    // the k-th smallest real part is continuous in the speed, also where modes meet and part
    for (k, name) in ["real parts", "", "", ""].into_iter().enumerate() {
        let real = spectrum.iter().map(|(speed, values)| (*speed, values[k].0));
        chart.line(name, BLUE, real.filter(|(_, re)| re.abs() <= 10.0));
    }
    let swinging = spectrum
        .iter()
        .map(|(speed, values)| (*speed, values.iter().fold(0.0, |most: f64, (_, im)| most.max(*im))));
    chart.line("imaginary parts", ORANGE, swinging.filter(|(_, im)| *im > 1e-6 && *im <= 10.0));
    chart.draw(&mut picture, "Eigenvalues (1/s)", "m/s");
    for (speed, name) in [(weave, "weave"), (capsize, "capsize")] {
        let style = format!(r#"stroke="{MUTED}" stroke-width="1" stroke-dasharray="2 3""#);
        picture.line(&[chart.at(speed, -10.0), chart.at(speed, 10.0)], &style);
        let at = chart.at(speed, 9.0);
        let beside = Page { x: at.x + 6.0, ..at };
        picture.text(beside, &format!("{name} {speed:.3}"), &format!(r#"font-size="12" fill="{INK}""#));
    }
    let mut track = Chart::new(Page { x: 70.0, y: 540.0 }, [380.0, 200.0], [-6.0, 46.0], [-4.0, 9.0]);
    let mut lean = Chart::new(Page { x: 540.0, y: 540.0 }, [370.0, 200.0], [0.0, RIDE], [-0.5, 0.5]);
    for ((how, speed, film), colour) in rides.iter().zip([BLUE, ORANGE, GREEN]) {
        let path = film.iter().map(|moment| (moment.state.x, moment.state.y));
        track.line("", colour, path.take_while(|(x, y)| *x <= 46.0 && (-4.0..=9.0).contains(y)));
        let shown = film.iter().take_while(|moment| moment.state.lean.abs() <= 0.5);
        let name = if *how == "by LQR" { format!("{speed} m/s, LQR") } else { format!("{speed} m/s") };
        lean.line(&name, colour, shown.map(|moment| (moment.t, moment.state.lean)));
    }
    track.draw(&mut picture, "Where the rear wheel rolls, to the right upwards (m)", "m");
    lean.draw(&mut picture, "Lean (rad)", "s");
    Ok(picture)
}

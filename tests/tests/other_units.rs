//! Searches for states do not know units: the same machine in other units of mass, length and time has the same trims,
//! assemblies, linearisations and discrete motions.

use nonholonomic::prelude::*;
use nonholonomic::{Real, TrimError};

/// A cart on a spring with a pole that is held up by another, and a weight that hangs from it.
#[nonholonomic(
    base { x, tilt, z }
    lagrangian {
        (M + m) / 2 * der(x)^2 + m * l * cos(tilt) * der(x) * der(tilt) + m * l^2 / 2 * der(tilt)^2
            + m / 2 * der(z)^2 - m * g * (l * cos(tilt) + z)
            - k / 2 * x^2 - c / 2 * (z - x)^2 - q / 2 * tilt^2 - h / 2 * tilt * x
    }
    forces { x: push - d * der(x); tilt: twist; }
    inputs { push, twist }
    linearization { keep: x, tilt, z, der(x), der(tilt), der(z); }
)]
#[derive(Clone, Copy, Debug)]
struct Cart<T> {
    M: T,
    m: T,
    l: T,
    g: T,
    k: T,
    c: T,
    d: T,
    q: T,
    h: T,
}

/// Units of mass, length and time, as powers of ten.
const UNITS: [[i32; 3]; 16] = [
    [0, 0, 0],
    [15, 0, 0],
    [-15, 0, 0],
    [0, 6, 0],
    [0, -6, 0],
    [0, -12, 0],
    [0, 12, 0],
    [0, 0, 6],
    [0, 0, -6],
    [6, 6, 6],
    [-6, 6, -6],
    [12, -9, 3],
    [-9, -9, 9],
    [3, 0, 0],
    [0, 3, 0],
    [0, 0, 3],
];

/// Units in which no number leaves the range of single precision.
fn fits_single([mass, length, time]: [i32; 3]) -> bool {
    mass.abs() <= 3 && length.abs() <= 6 && time.abs() <= 6
}

struct Trimmed {
    /// x/l, tilt, z/l, push and twist in their units.
    motion: [f64; 5],
    /// Those of ẍ by x, tilt and ẋ, of the angular acceleration by twist.
    slopes: [f64; 4],
}

/// The trim of the cart in some units, with some variables held.
fn trimmed<T: Real + nalgebra::Scalar>(units: [i32; 3], held: &[CartVariable]) -> Result<Trimmed, TrimError> {
    let of = T::from_f64;
    let [mass, length, time] = units.map(|power| of(10.0_f64.powi(power)));
    let force = mass * length / time / time;
    let energy = force * length;
    let cart = Cart {
        M: of(2.0) * mass,
        m: mass,
        l: of(0.5) * length,
        g: of(9.81) * length / time / time,
        k: of(120.0) * force / length,
        c: of(80.0) * force / length,
        d: of(0.3) * force / length * time,
        q: of(30.0) * energy,
        h: of(2.0) * force,
    };
    let guess = CartState { x: of(0.1) * length, tilt: of(0.2), ..CartState::default() };
    let input = CartInput { push: of(3.0) * force, twist: of(0.2) * energy };
    let (state, input) = cart.trim(T::ZERO, &guess, &input, held)?;
    let motion = [state.x / length, state.tilt, state.z / length, input.push / force, input.twist / energy];
    let linear = cart.linearize(T::ZERO, &state, &input).expect("all that moves is kept");
    let slopes = [
        linear.a[(3, 0)] * time * time,
        linear.a[(3, 1)] * time * time / length,
        linear.a[(3, 3)] * time,
        linear.b[(4, 1)] * energy * time * time,
    ];
    Ok(Trimmed { motion: motion.map(T::to_f64), slopes: slopes.map(T::to_f64) })
}

fn the_same<T: Real + nalgebra::Scalar>(tolerance: f64, is_in_range: impl Fn([i32; 3]) -> bool) {
    use CartVariable::{push, tilt, twist, x};
    for held in [[push, twist], [tilt, push], [x, tilt], [x, twist]] {
        let plain = trimmed::<f64>([0; 3], &held).expect("plain units");
        for units in UNITS.into_iter().filter(|units| is_in_range(*units)) {
            let found =
                trimmed::<T>(units, &held).unwrap_or_else(|error| panic!("{units:?} {held:?}: {error}"));
            let pairs = [(found.motion.as_slice(), plain.motion.as_slice()), (&found.slopes, &plain.slopes)];
            for (found, plain) in pairs {
                for (a, b) in found.iter().zip(plain) {
                    assert!((a - b).abs() <= tolerance * b.abs(), "{units:?} {held:?}: {found:?} {plain:?}");
                }
            }
        }
    }
}

#[test]
fn a_trim_is_the_same_in_all_units() {
    the_same::<f64>(1e-12, |_| true);
    the_same::<f32>(1e-4, fits_single);
}

/// A crank with a rod, and the rod's end on a straight guide; the loop is closed a second time through the middle of the
/// rod, which says nothing new.
#[nonholonomic(
    base { crank, rod, slide }
    lagrangian { m / 2 * (r * der(crank))^2 + J / 2 * der(rod)^2 + m / 2 * der(slide)^2 }
    holonomic {
        along: r * cos(crank) + l * cos(rod) = slide;
        across: r * sin(crank) = l * sin(rod);
        middle: (slide - r * cos(crank))^2 + (r * sin(crank))^2 = l^2;
        redundant;
    }
)]
#[derive(Clone, Copy, Debug)]
struct SliderCrank {
    m: f64,
    J: f64,
    r: f64,
    l: f64,
}

#[test]
fn an_assembly_is_the_same_in_all_units() {
    let assembled = |unit: f64, crank: f64| {
        let machine = SliderCrank { m: 1.0, J: 0.1 * unit * unit, r: 0.3 * unit, l: unit };
        let guess = SliderCrankState { crank, rod: 0.1, slide: 1.2 * unit, ..SliderCrankState::default() };
        let found = machine.assemble(0.0, &guess).unwrap_or_else(|error| panic!("{unit:e} {crank}: {error}"));
        [found.crank, found.rod, found.slide / unit]
    };
    for crank in [0.4, 0.0, 1.5, -0.2] {
        let plain = assembled(1.0, crank);
        for unit in [1e-6, 1e-9, 1e-12, 1e-15, 1e6, 1e9, 1e12, 1e15] {
            let found = assembled(unit, crank);
            for (a, b) in found.iter().zip(&plain) {
                assert!((a - b).abs() <= 1e-14, "{unit:e} {crank}: {found:?} {plain:?}");
            }
        }
    }
}

/// The same crank on a carriage that has come far, its coordinates each in a unit of its own.
#[nonholonomic(
    base { crank, rod, slide, road }
    let at = slide / unit;
    lagrangian {
        m / 2 * (r * der(crank))^2 + J / 2 * der(rod)^2 + m / 2 * (der(slide) / unit)^2 + M / 2 * (der(road) / far)^2
            - m * g * r * sin(crank)
    }
    holonomic {
        along: r * cos(crank) + l * cos(rod) = at;
        across: r * sin(crank) = l * sin(rod);
    }
    assume { unit > 0; far > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Carriage {
    m: f64,
    M: f64,
    J: f64,
    r: f64,
    l: f64,
    g: f64,
    unit: f64,
    far: f64,
}

/// From beside the constraints, and along a motion: what is found has the digits of each coordinate, whatever the others are.
#[test]
fn returns_are_the_same_in_all_units() {
    let machine =
        |unit: f64, far: f64| Carriage { m: 1.0, M: 2.0, J: 0.1, r: 0.3, l: 1.0, g: 9.81, unit, far };
    let in_units = |state: &CarriageState, unit: f64, far: f64| {
        let CarriageState { crank, rod, slide, road, .. } = *state;
        let speeds = [state.crank_dot, state.rod_dot, state.slide_dot / unit, state.road_dot / far];
        let [a, b, c, d] = speeds;
        [crank, rod, slide / unit, road / far, a, b, c, d]
    };
    let ends = |unit: f64, far: f64, off: f64, crank: f64| {
        let carriage = machine(unit, far);
        let rod = (0.3 * crank.sin()).asin();
        let rod_dot = 0.6 * crank.cos() / rod.cos();
        let mut state = CarriageState {
            crank,
            rod: rod * (1.0 + off),
            slide: (0.3 * crank.cos() + rod.cos()) * unit * (1.0 - 2.0 * off),
            road: 5.0 * far,
            crank_dot: 2.0,
            rod_dot,
            slide_dot: -(0.6 * crank.sin() + rod_dot * rod.sin()) * unit,
            road_dot: 0.3 * far,
        };
        carriage.project(0.0, &mut state).unwrap_or_else(|error| panic!("{unit:e} {far:e} {off:e}: {error}"));
        let left: [f64; 4] = carriage.constraint_residual(0.0, &state).into();
        assert!(left.iter().all(|left| left.abs() < 1e-15), "{unit:e} {far:e} {off:e} {crank}: {left:?}");
        let mut sim = Integrator::new(carriage, Rk4::new(0.01), 0.0, state);
        sim.advance_to(1.0).unwrap_or_else(|error| panic!("{unit:e} {far:e} {off:e}: {error}"));
        let left: [f64; 4] = carriage.constraint_residual(1.0, sim.state()).into();
        assert!(left.iter().all(|left| left.abs() < 4e-15), "{unit:e} {far:e} {off:e} {crank}: {left:?}");
        (in_units(&state, unit, far), in_units(sim.state(), unit, far))
    };
    for off in [0.0, 1e-12, 1e-7, 1e-3] {
        for crank in [0.7, 0.0, 3.0] {
            let plain = ends(1.0, 1.0, off, crank);
            for (unit, far) in
                [(1e-8, 1.0), (1e8, 1.0), (1.0, 1e12), (1e-12, 1e9), (1e12, 1e-9), (1e-30, 1e30)]
            {
                let found = ends(unit, far, off, crank);
                for (a, b) in found.0.iter().zip(&plain.0).chain(found.1.iter().zip(&plain.1)) {
                    let close = (a - b).abs() <= 2e-12 * b.abs().max(0.1);
                    assert!(close, "{unit:e} {far:e} {off:e} {crank}: {found:?} {plain:?}");
                }
            }
        }
    }
}

/// A sleigh whose blade stands aside of its centre of mass.
#[nonholonomic(
    basis { w, u, v }
    brackets { [w, u] = v; [w, v] = -u; }
    lagrangian { J / 2 * w^2 + m / 2 * (u^2 + v^2) + m * a * w * v }
    constraints { v = b * w; }
    emit { euler_poincare_suslov }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    a: f64,
    b: f64,
    J: f64,
}

/// A turn and a speed: what the method compares has no unit.
#[test]
fn a_discrete_motion_is_the_same_in_all_units() {
    let ends = |mass: f64, length: f64, time: f64| {
        let sleigh =
            Sleigh { m: 2.0 * mass, a: 0.3 * length, b: 0.1 * length, J: 0.5 * mass * length * length };
        let start = SleighState { w: 0.7 / time, u: 1.3 * length / time };
        let mut sim = Integrator::new(sleigh, DiscreteSuslov::new(0.1 * time), 0.0, start);
        sim.advance_to(5.0 * time).unwrap_or_else(|error| panic!("{mass:e} {length:e} {time:e}: {error}"));
        [sim.state().w * time, sim.state().u / length * time]
    };
    let plain = ends(1.0, 1.0, 1.0);
    for [mass, length, time] in UNITS.map(|units| units.map(|power| 10.0_f64.powi(power))) {
        for (a, b) in ends(mass, length, time).iter().zip(&plain) {
            assert!((a - b).abs() <= 1e-12 * b.abs(), "{mass:e} {length:e} {time:e}: {a} {b}");
        }
    }
}

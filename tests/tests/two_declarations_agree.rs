//! A system declared in two ways moves in one way.
//!
//! Each pair comes with a map from the states of the first declaration to those of the second.
//! At random states, the map has to take the first derivative to the second, and the energies have
//! to agree, up to what rounding of the inputs explains.

use nh_tests::catalogue::Entry;
use nh_tests::comparison::{Pair, Worst, compare, paired, values_of};
use nh_tests::random::Random;
use nh_tests::systems::catalogue;
use nh_tests::values::{Moving, Values};

/// The time of each comparison.
const TIME: f64 = 0.7;
/// Random states at which each pair is compared.
const STATES: usize = 25;

struct Agreement {
    first: &'static str,
    second: &'static str,
    map: fn(&Values, &[Moving]) -> Vec<Moving>,
}

const AGREEMENTS: [Agreement; 22] = [
    Agreement { first: "FreeRigidBody", second: "FreeRigidBodyByEntries", map: |_, x| x.to_vec() },
    Agreement { first: "Suslov", second: "SuslovAlongAxis", map: |_, x| x.to_vec() },
    Agreement { first: "Sleigh", second: "ReducedSleigh", map: |_, x| x[3..].to_vec() },
    Agreement {
        first: "Sleigh",
        second: "SleighOnThePlane",
        map: |_, x| {
            let (sin, cos) = x[0].sin_cos();
            vec![x[0], x[1], x[2], x[3], x[4] * cos, x[4] * sin]
        },
    },
    Agreement { first: "VeselovaInEulerAngles", second: "Veselova", map: from_euler_angles },
    Agreement {
        first: "MobileRobotOnThePlane",
        second: "MobileRobot",
        map: |_, x| vec![x[0], x[1], x[5], x[6]],
    },
    Agreement { first: "VerticalDisk", second: "VerticalDiskMovingFrame", map: |_, x| x.to_vec() },
    Agreement { first: "Snakeboard", second: "SnakeboardOnThePlane", map: onto_the_plane },
    Agreement {
        first: "ChaplyginSphereWithAttitude",
        second: "ChaplyginSphere",
        map: |_, x| [&x[6..9], &x[11..]].concat(),
    },
    Agreement {
        first: "ChaplyginSphereWithAttitude",
        second: "RollingBall",
        map: |_, x| {
            let spatial = |i: usize| x[3 * i] * x[11] + x[3 * i + 1] * x[12] + x[3 * i + 2] * x[13];
            vec![x[9], x[10], spatial(0), spatial(1), spatial(2)]
        },
    },
    Agreement {
        first: "RigidBodyRotor",
        second: "RigidBodyRotorAbsolute",
        map: |_, x| vec![x[0], x[1], x[2], x[3], x[3] + x[4]],
    },
    Agreement { first: "ParticleYCoframe", second: "ParticleY", map: |_, x| x.to_vec() },
    Agreement { first: "ParticleXCoframe", second: "ParticleX", map: |_, x| x.to_vec() },
    Agreement {
        first: "CentralForceAreal",
        second: "CentralForceCartesian",
        map: |_, x| {
            let (sin, cos) = x[1].sin_cos();
            let turning = x[3] / x[0];
            vec![x[0] * cos, x[0] * sin, x[2] * cos - turning * sin, x[2] * sin + turning * cos]
        },
    },
    Agreement {
        first: "ChargedParticleCoframe",
        second: "ChargedParticle",
        map: |_, x| [&x[..3], &x[4..]].concat(),
    },
    Agreement { first: "ChargedParticleCoframe", second: "ChargedParticleOnTheBundle", map: onto_the_bundle },
    Agreement {
        first: "ChargedParticleByConnection",
        second: "ChargedParticleCoframe",
        map: |_, x| x.to_vec(),
    },
    Agreement { first: "SnakeboardBySpan", second: "SnakeboardOnThePlane", map: from_the_span },
    Agreement { first: "VeselovaOnRotations", second: "VeselovaOnSphere", map: |_, x| x[6..].to_vec() },
    Agreement { first: "ChaplyginSphereOnSphere", second: "ChaplyginSphere", map: |_, x| x.to_vec() },
    Agreement {
        first: "SteeredSleigh",
        second: "SteeredSleighOnThePlane",
        map: |p, x| {
            // v2 = tan δ v1, with δ = A sin(w t) as long as the comparison's time
            let angle = Moving {
                value: p["A"] * (p["w"] * TIME).sin(),
                rate: p["A"] * p["w"] * (p["w"] * TIME).cos(),
            };
            let (sin, cos) = (x[0] + angle).sin_cos();
            let along = x[4] / angle.sin_cos().1;
            vec![x[0], x[1], x[2], x[3], along * cos, along * sin]
        },
    },
    Agreement {
        first: "BallOnRotatingTableCoframe",
        second: "BallOnRotatingTable",
        map: |_, x| [&x[..2], &x[5..]].concat(),
    },
];

/// Checks mathematics (1) and (4).
#[test]
fn two_declarations_of_a_system_agree_at_random_states() {
    let entries = catalogue();
    let find = |name: &str| {
        let known = entries.iter().find(|entry| entry.name() == name);
        known.unwrap_or_else(|| panic!("{name} is in the catalogue"))
    };
    let mut random = Random::new(2024);
    let mut failures = Vec::new();
    for agreement in &AGREEMENTS {
        let (first, second) = (find(agreement.first), find(agreement.second));
        let mut worst = Worst::default();
        for _ in 0..STATES {
            let values = parameters(&mut random, agreement);
            let state = state(&mut random, &**first);
            match compare_at(agreement, &**first, &**second, &values, &state) {
                Ok(here) => worst.include(here),
                Err(lines) => failures.extend(lines),
            }
        }
        let (first, second) = (agreement.first, agreement.second);
        println!("{first:28} {second:28} {:.1e} {:.2}", worst.relative, worst.explained);
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

fn compare_at(
    agreement: &Agreement,
    first: &dyn Entry,
    second: &dyn Entry,
    values: &Values,
    state: &[f64],
) -> Result<Worst, Vec<String>> {
    let t = TIME;
    let inputs: Vec<f64> = values.iter().chain(state).copied().collect();
    let pairs = |inputs: &[f64]| {
        let (parameters, state) = inputs.split_at(values.len());
        let values = values.renewed(parameters.iter().copied());
        let rates = first.derivative(&values, t, state);
        let moving: Vec<Moving> =
            state.iter().zip(rates).map(|(&value, rate)| Moving { value, rate }).collect();
        let image = (agreement.map)(&values, &moving);
        let image_state = values_of(&image);
        let generated = second.derivative(&values, t, &image_state);
        let mut pairs = paired(&generated, image.iter().map(|x| x.rate));
        pairs.push(Pair {
            generated: second.energy(&values, t, &image_state),
            expected: first.energy(&values, t, state),
        });
        pairs
    };
    compare(&format!("{} and {}", agreement.first, agreement.second), &inputs, pairs)
}

/// Random parameters under every name that a declaration may ask for.
fn parameters(random: &mut Random, agreement: &Agreement) -> Values {
    let positive = "m m0 m1 l J J2 c R r k k2 I J0 J1 wr ws a B0 M w";
    let any = "b b1 a3 c1 c2 c3 ut up u Ar As G3 Omega A";
    let mut values: Vec<(String, f64)> = Vec::new();
    let named = |names: &'static str| names.split(' ').map(str::to_owned);
    values.extend(named(positive).map(|name| (name, random.between(0.5, 2.0))));
    values.extend(named(any).map(|name| (name, random.between(-1.0, 1.0))));
    // the second declaration of the Suslov problem knows one axis only, the rolling ball one moment
    values.extend([("G1".to_owned(), 0.0), ("G2".to_owned(), 0.0)]);
    let moment = values[10].1 * values[0].1;
    let homogeneous = agreement.second == "RollingBall";
    for (name, shift) in [("I11", 2.0), ("I22", 2.5), ("I33", 3.0)] {
        values.push((name.to_owned(), if homogeneous { moment } else { moment + shift }));
    }
    for name in ["I12", "I13", "I23", "Jt", "J3"] {
        let entry = random.between(0.05, 0.3);
        let product = name.starts_with('I');
        values.push((name.to_owned(), if homogeneous && product { 0.0 } else { entry }));
    }
    values.into_iter().collect()
}

fn state(random: &mut Random, entry: &dyn Entry) -> Vec<f64> {
    let length = entry.components().len();
    let mut state = random.list(length, -1.0, 1.0);
    match entry.name() {
        // away from the poles of the Euler angles
        "VeselovaInEulerAngles" => state[1] = random.between(0.4, 2.6),
        "CentralForceAreal" => state[0] = random.between(0.5, 2.0),
        "BallOnRotatingTableCoframe" => state[3] = random.between(-1.2, 1.2),
        "ChaplyginSphereOnSphere" => state[..3].copy_from_slice(&random.rotation()[..3]),
        "VeselovaOnRotations" => {
            state[..9].copy_from_slice(&random.rotation());
            // ⟨γ, ω⟩ = 0
            let along: f64 = (0..3).map(|i| state[6 + i] * state[9 + i]).sum();
            for i in 0..3 {
                state[9 + i] -= along * state[6 + i];
            }
        }
        "ChaplyginSphereWithAttitude" => state[..9].copy_from_slice(&random.rotation()),
        _ => {}
    }
    state
}

fn from_euler_angles(_: &Values, x: &[Moving]) -> Vec<Moving> {
    let (sin_theta, cos_theta) = x[1].sin_cos();
    let (sin_psi, cos_psi) = x[2].sin_cos();
    let (theta_dot, psi_dot) = (x[3], x[4]);
    let phi_dot = -cos_theta * psi_dot;
    vec![
        sin_theta * sin_psi,
        sin_theta * cos_psi,
        cos_theta,
        phi_dot * sin_theta * sin_psi + theta_dot * cos_psi,
        phi_dot * sin_theta * cos_psi - theta_dot * sin_psi,
        phi_dot * cos_theta + psi_dot,
    ]
}

fn onto_the_plane(values: &Values, x: &[Moving]) -> Vec<Moving> {
    let [u1, dpsi, dphi] = [x[5], x[6], x[7]];
    let (sin, cos) = x[2].sin_cos();
    let (sin_phi, cos_phi) = x[4].sin_cos();
    let dtheta = -u1 * sin_phi / (cos_phi * values["l"]);
    [&x[..5], &[u1 * cos, u1 * sin, dtheta, dpsi, dphi]].concat()
}

fn from_the_span(values: &Values, x: &[Moving]) -> Vec<Moving> {
    let (sin, cos) = x[2].sin_cos();
    let (sin_phi, cos_phi) = x[4].sin_cos();
    let along = -x[5] * cos_phi * values["l"];
    [&x[..5], &[along * cos, along * sin, x[5] * sin_phi, x[6], x[7]]].concat()
}

fn onto_the_bundle(values: &Values, state: &[Moving]) -> Vec<Moving> {
    let [x, y, dx, dy, dz, p] = [0, 1, 4, 5, 6, 7].map(|i| state[i]);
    let (uniform, gradient, transverse) = (values["B0"], values["b1"], values["a3"]);
    let potential = y * dx * (-uniform / 2.0)
        + (x * (uniform / 2.0) + x * x * (gradient / 2.0)) * dy
        + x * y * dz * transverse;
    [&state[..7], &[p - potential]].concat()
}

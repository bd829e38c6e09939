//! What the generated equations keep, and how fast the energy changes where they do not.
//!
//! Rates are taken along the generated derivative: a function f of time and state changes at
//! (f(t + h, x + h ẋ) − f(t − h, x − h ẋ)) / 2h, extrapolated to h = 0 from two step sizes.

use nh_tests::catalogue::Entry;
use nh_tests::comparison::values_of;
use nh_tests::reference::{ParameterSet, Sample};
use nh_tests::systems::catalogue;
use nh_tests::values::Values;

/// How often the estimated error of a difference quotient is allowed.
const MULTIPLE: f64 = 16.0;

#[test]
fn energy_changes_by_the_power_of_forces() {
    let mut failures = Vec::new();
    for entry in catalogue() {
        for (set, sample) in ordinary_samples(&*entry) {
            let energy = |t: f64, x: &[f64]| entry.energy(&set.values, t, x);
            let rate = rate(&*entry, &set.values, &sample, energy);
            // written so that a NaN fails
            let agrees = (rate.value - sample.power).abs() <= MULTIPLE * rate.error;
            if !agrees {
                let name = format!("{} ({})", entry.name(), set.name);
                failures.push(format!("{name}: {rate:?} instead of {:e}", sample.power));
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// A function that stays constant, by the names of a declaration and of the literature.
struct FirstIntegral {
    of: &'static str,
    name: &'static str,
    when: fn(&Values) -> bool,
    value: fn(&Values, &[f64]) -> f64,
}

fn always(_: &Values) -> bool {
    true
}

const FIRST_INTEGRALS: [FirstIntegral; 22] = [
    FirstIntegral {
        of: "FreeRigidBody",
        name: "square of the angular momentum",
        when: always,
        value: |p, w| square(momentum(p, [w[0], w[1], w[2]])),
    },
    FirstIntegral {
        of: "Veselova",
        name: "length of the vertical",
        when: always,
        value: |_, x| square([x[0], x[1], x[2]]),
    },
    FirstIntegral { of: "Veselova", name: "constraint", when: always, value: |_, x| dot(&x[..3], &x[3..]) },
    FirstIntegral {
        of: "Veselova",
        name: "square of the momentum orthogonal to the vertical (without potential)",
        when: |p| p["c1"] == 0.0 && p["c2"] == 0.0 && p["c3"] == 0.0,
        value: |p, x| {
            let momentum = momentum(p, [x[3], x[4], x[5]]);
            let along = dot(&momentum, &x[..3]);
            square([0, 1, 2].map(|i| momentum[i] - along * x[i]))
        },
    },
    FirstIntegral {
        of: "SleighOnThePlane",
        name: "constraint",
        when: always,
        value: |_, x| x[5] * x[0].cos() - x[4] * x[0].sin(),
    },
    FirstIntegral {
        of: "VerticalDisk",
        name: "rolling velocity (without torque)",
        when: |p| p["ut"] == 0.0,
        value: |_, x| x[4],
    },
    FirstIntegral {
        of: "VerticalDisk",
        name: "turning velocity (without torque)",
        when: |p| p["up"] == 0.0,
        value: |_, x| x[5],
    },
    FirstIntegral {
        of: "Snakeboard",
        name: "steering velocity (without torque)",
        when: |p| p["As"] == 0.0,
        value: |_, x| x[7],
    },
    FirstIntegral {
        of: "SnakeboardOnThePlane",
        name: "constraint of the back wheels",
        when: always,
        value: |p, x| {
            let (sin, cos) = (x[2] + x[4]).sin_cos();
            -sin * x[5] + cos * x[6] - p["l"] * x[4].cos() * x[7]
        },
    },
    FirstIntegral {
        of: "ChaplyginSphere",
        name: "vertical momentum about the contact",
        when: always,
        value: |p, x| dot(&contact_momentum(p, x), &x[..3]),
    },
    FirstIntegral {
        of: "ChaplyginSphere",
        name: "square of the momentum about the contact",
        when: always,
        value: |p, x| square(contact_momentum(p, x)),
    },
    FirstIntegral {
        of: "ChaplyginSphereWithAttitude",
        name: "momentum about the contact along the first axis of space",
        when: always,
        value: |p, x| {
            let reduced = [&x[6..9], &x[11..]].concat();
            dot(&contact_momentum(p, &reduced), &x[..3])
        },
    },
    FirstIntegral {
        of: "ChaplyginSphereWithAttitude",
        name: "length of a row of the rotation matrix",
        when: always,
        value: |_, x| square([x[3], x[4], x[5]]),
    },
    FirstIntegral {
        of: "RigidBodyRotor",
        name: "momentum of the rotor (without torque)",
        when: |p| p["u"] == 0.0,
        value: |p, x| p["J3"] * (x[3] + x[4]),
    },
    FirstIntegral {
        of: "RigidBodyRotor",
        name: "square of the angular momentum",
        when: always,
        value: |p, x| {
            let [first, second, third] = momentum(p, [x[1], x[2], x[3]]);
            square([first + p["Jt"] * x[1], second + p["Jt"] * x[2], third + p["J3"] * (x[3] + x[4])])
        },
    },
    FirstIntegral {
        of: "ParticleYCoframe",
        name: "momentum of the symmetry (without potential)",
        when: |p| p["k"] == 0.0,
        value: |_, x| x[3] * (1.0 + x[1] * x[1]).sqrt(),
    },
    FirstIntegral {
        of: "ParticleX",
        name: "leaf of the integrable constraint",
        when: always,
        value: |_, x| x[2] - x[0] * x[0] / 2.0,
    },
    FirstIntegral {
        of: "ParticleX",
        name: "speed along the leaf",
        when: always,
        value: |_, x| x[3] * (1.0 + x[0] * x[0]).sqrt(),
    },
    FirstIntegral { of: "CentralForceAreal", name: "areal velocity", when: always, value: |_, x| x[3] },
    FirstIntegral {
        of: "CentralForceCartesian",
        name: "areal velocity",
        when: always,
        value: |_, x| x[0] * x[3] - x[1] * x[2],
    },
    FirstIntegral { of: "ChargedParticle", name: "charge", when: always, value: |_, x| x[6] },
    FirstIntegral {
        of: "RollingBall",
        name: "spin about the vertical and momentum about the contact",
        when: always,
        value: |_, x| x[2] + 2.0 * x[3] + 3.0 * x[4],
    },
];

#[test]
fn first_integrals_of_the_literature_stay_constant() {
    let entries = catalogue();
    let mut failures = Vec::new();
    for integral in &FIRST_INTEGRALS {
        let entry = entries.iter().find(|entry| entry.name() == integral.of);
        let entry = entry.unwrap_or_else(|| panic!("{} is in the catalogue", integral.of));
        let mut samples = 0;
        for (set, sample) in ordinary_samples(&**entry) {
            if !(integral.when)(&set.values) {
                continue;
            }
            samples += 1;
            let value = |_: f64, x: &[f64]| (integral.value)(&set.values, x);
            let rate = rate(&**entry, &set.values, &sample, value);
            let constant = rate.value.abs() <= MULTIPLE * rate.error;
            if !constant {
                failures.push(format!("{} ({}), {}: {rate:?}", integral.of, set.name, integral.name));
            }
        }
        assert!(samples > 0, "{} of {} is checked somewhere", integral.name, integral.of);
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

fn ordinary_samples(entry: &dyn Entry) -> Vec<(ParameterSet, Sample)> {
    let sets = entry.reference().parameter_sets.into_iter();
    sets.filter(|set| !set.extreme && entry.covers(&set.values))
        .flat_map(|set| {
            let samples = set.samples.clone();
            samples.into_iter().map(move |sample| (set.clone(), sample))
        })
        .collect()
}

#[derive(Clone, Copy, Debug)]
struct Rate {
    value: f64,
    /// What truncation and rounding may have added.
    error: f64,
}

/// How fast a function changes along the generated derivative.
fn rate(entry: &dyn Entry, values: &Values, sample: &Sample, f: impl Fn(f64, &[f64]) -> f64) -> Rate {
    let state = values_of(&entry.state(&sample.state));
    let rates = entry.derivative(values, sample.t, &state);
    let fastest = rates.iter().fold(1.0_f64, |m, rate| m.max(rate.abs()));
    let step = 1e-3 / fastest;
    let at = |h: f64| {
        let moved: Vec<f64> = state.iter().zip(&rates).map(|(x, rate)| x + h * rate).collect();
        f(sample.t + h, &moved)
    };
    let quotient = |h: f64| (at(h) - at(-h)) / (2.0 * h);
    let (coarse, fine) = (quotient(step), quotient(step / 2.0));
    let size = at(0.0).abs().max((at(step) - at(0.0)).abs()).max(1.0);
    let truncation = (coarse - fine).abs() * (step * fastest).powi(2).max(1e-6);
    Rate { value: (4.0 * fine - coarse) / 3.0, error: truncation + 8.0 * f64::EPSILON * size / step }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn square(a: [f64; 3]) -> f64 {
    dot(&a, &a)
}

fn momentum(p: &Values, w: [f64; 3]) -> [f64; 3] {
    [
        p["I11"] * w[0] + p["I12"] * w[1] + p["I13"] * w[2],
        p["I12"] * w[0] + p["I22"] * w[1] + p["I23"] * w[2],
        p["I13"] * w[0] + p["I23"] * w[1] + p["I33"] * w[2],
    ]
}

/// I ω + m r² γ × (ω × γ) for a state (γ, ω) of the Chaplygin sphere.
fn contact_momentum(p: &Values, x: &[f64]) -> [f64; 3] {
    let (g, w) = (&x[..3], [x[3], x[4], x[5]]);
    let momentum = momentum(p, w);
    let factor = p["m"] * p["r"] * p["r"];
    let (length, along) = (dot(g, g), dot(g, &w));
    [0, 1, 2].map(|i| momentum[i] + factor * (length * w[i] - along * g[i]))
}

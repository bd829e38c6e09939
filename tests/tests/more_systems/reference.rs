//! Reference files of accelerations, and their comparison with compiled declarations.

use std::path::Path;

use nonholonomic::prelude::*;
use nonholonomic::{Dim, VecOf};

/// How far a number may be off, relative to the largest of its kind. The states are ordinary ones.
const ROUNDING: f64 = 1e-12;
/// The same after a trajectory, for the integrator's tolerance of 1e-12.
const TRAJECTORY: f64 = 1e-9;

/// A state with what it should bring about.
#[derive(Default)]
struct Sample {
    t: f64,
    state: Vec<f64>,
    rate: Vec<f64>,
    energy: f64,
    multipliers: Vec<f64>,
}

/// The states of a reference file, and where the first of them is later.
struct Reference {
    samples: Vec<Sample>,
    later: Option<Sample>,
}

impl Reference {
    /// Reads the components with these names.
    fn read(file: &str, components: &[&str]) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/more").join(format!("{file}.txt"));
        let text =
            std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut picked: Vec<usize> = Vec::new();
        let mut samples: Vec<Sample> = Vec::new();
        let mut later = None;
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let (key, rest) = line.split_once(' ').expect("a key and its values");
            let words: Vec<&str> = rest.split(' ').collect();
            if key == "names" {
                let position = |name: &&str| words.iter().position(|word| word == name);
                let found = components.iter().map(|name| position(name).expect("the component is given"));
                picked = found.collect();
                continue;
            }
            let numbers: Vec<f64> = words.iter().map(|word| word.parse().expect("a number")).collect();
            let own = || picked.iter().map(|&i| numbers[i]).collect();
            if key == "later" {
                later = Some(Sample { t: numbers[0], ..Sample::default() });
                continue;
            }
            if key == "at" {
                samples.push(Sample { t: numbers[0], ..Sample::default() });
                continue;
            }
            let sample = later.as_mut().or(samples.last_mut()).expect("a time comes first");
            match key {
                "state" => sample.state = own(),
                "rate" => sample.rate = own(),
                "energy" => sample.energy = numbers[0],
                "multipliers" => sample.multipliers = numbers,
                _ => panic!("{file}: {key}"),
            }
        }
        assert!(!samples.is_empty(), "{file} has no states");
        Self { samples, later }
    }
}

fn agree(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}: as many numbers");
    let scale = expected.iter().fold(1.0_f64, |scale, x| scale.max(x.abs()));
    let close = found.iter().zip(expected).all(|(x, y)| (x - y).abs() <= tolerance * scale);
    assert!(close, "{what}: found {found:?}, expected {expected:?}");
}

fn packed<S: Dynamics<State: State<Scalar = f64>>>(numbers: &[f64]) -> S::State {
    let mut array: VecOf<S> = <<S::State as State>::Dim as Dim>::vec(0.0);
    array.as_mut().copy_from_slice(numbers);
    S::State::from_array(array)
}

/// Accelerations, energy, and the first state later.
pub(crate) fn check<S>(file: &str, system: &S, input: S::Input)
where
    S: Energy + Dynamics<State: State<Scalar = f64>>,
{
    let what = format!("{file}, {}", std::any::type_name::<S>());
    system.validate().unwrap();
    let names = S::State::names();
    let reference = Reference::read(file, names.as_ref());
    for sample in &reference.samples {
        let state = packed::<S>(&sample.state);
        system.check_state(sample.t, &state).unwrap();
        let rate = system.derivative(sample.t, &state, &input).to_array();
        agree(&what, rate.as_ref(), &sample.rate, ROUNDING);
        agree(&what, &[system.energy(sample.t, &state)], &[sample.energy], ROUNDING);
    }
    if let Some(later) = reference.later {
        let start = &reference.samples[0];
        let method = Dopri5::new().rtol(1e-12).atol(1e-12);
        let mut integrator = Integrator::new(system, method, start.t, packed::<S>(&start.state));
        integrator.set_input(input);
        integrator.advance_to(later.t).unwrap();
        agree(&what, integrator.state().to_array().as_ref(), &later.state, TRAJECTORY);
    }
}

/// The multipliers, too.
pub(crate) fn check_with_multipliers<S, M, const K: usize>(
    file: &str,
    system: &S,
    input: S::Input,
    multipliers: impl Fn(f64, &S::State) -> M,
) where
    S: Energy + Dynamics<State: State<Scalar = f64>>,
    M: Into<[f64; K]>,
{
    check(file, system, input);
    for sample in Reference::read(file, S::State::names().as_ref()).samples {
        let found = multipliers(sample.t, &packed::<S>(&sample.state)).into();
        agree(&format!("multipliers of {file}"), &found, &sample.multipliers, ROUNDING);
    }
}

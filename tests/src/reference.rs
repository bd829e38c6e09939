//! The reference data: read from `tests/reference`, one file per system.

use std::path::Path;

use serde_json::Value;

use crate::values::{Moving, Reading, Values};

/// Numbers that are smaller than this, relative to the largest of their kind, stand for zero.
const NOISE: f64 = 1e-25;

/// A reference system.
#[derive(Clone, Debug)]
pub struct System {
    /// Its name, which is also the name of its file.
    pub name: String,
    /// Its parameter sets, each with samples.
    pub parameter_sets: Vec<ParameterSet>,
}

/// Numbers for the parameters, and what the system does with them.
#[derive(Clone, Debug)]
pub struct ParameterSet {
    /// The name of the set.
    pub name: String,
    /// Whether the set was chosen to be near singular.
    pub extreme: bool,
    /// The parameters.
    pub values: Values,
    /// Random states with their derivatives.
    pub samples: Vec<Sample>,
    /// Trajectories, sampled at a few times; the first sample is the start.
    pub trajectories: Vec<Vec<Sample>>,
}

/// What is known at one state.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The time.
    pub t: f64,
    /// The state with its derivative, dependent velocities included.
    pub state: Reading,
    /// The constraints' multipliers.
    pub multipliers: Values,
    /// The energy.
    pub energy: f64,
    /// The rate of the energy.
    pub power: f64,
    /// The energy gained since the start, on a trajectory.
    pub work: Option<f64>,
}

impl System {
    /// Reads a system.
    ///
    /// # Panics
    /// If its file is missing or malformed: the data are part of this package.
    #[must_use]
    pub fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference").join(format!("{name}.json"));
        let text =
            std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let value: Value =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self {
            name: name.to_owned(),
            parameter_sets: list(&value["parameter_sets"]).map(parameter_set).collect(),
        }
    }
}

fn parameter_set(value: &Value) -> ParameterSet {
    ParameterSet {
        name: value["name"].as_str().expect("a parameter set has a name").to_owned(),
        extreme: value["kind"] == "extreme",
        values: numbers(&value["values"]),
        samples: list(&value["rhs_samples"]).map(sample).collect(),
        trajectories: list(&value["trajectories"])
            .map(|trajectory| list(&trajectory["samples"]).map(sample).collect())
            .collect(),
    }
}

fn sample(value: &Value) -> Sample {
    let values = without_noise(&numbers(&value["state"]));
    let rates = without_noise(&numbers(&value["derivative"]));
    let state = entries(&value["state"])
        .map(|(name, _)| (name.to_owned(), Moving { value: values[name], rate: rates[name] }))
        .collect();
    Sample {
        t: number(&value["t"]),
        state,
        multipliers: numbers(&value["multipliers"]),
        energy: number(&value["energy"]),
        power: number(&value["power"]["dE_dt"]),
        work: value.get("work_done").map(number),
    }
}

/// Zero in place of what is below the digits that the data carry.
fn without_noise(values: &Values) -> Values {
    let largest = values.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    values.renewed(values.iter().map(|&x| if x.abs() < NOISE * largest { 0.0 } else { x }))
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().expect("a list").iter()
}

fn entries(value: &Value) -> impl Iterator<Item = (&str, &Value)> {
    value.as_object().expect("an object").iter().map(|(name, value)| (name.as_str(), value))
}

fn numbers(value: &Value) -> Values {
    entries(value).map(|(name, value)| (name.to_owned(), number(value))).collect()
}

/// The decimal string's nearest `f64`.
fn number(value: &Value) -> f64 {
    let text = value.as_str().expect("numbers are decimal strings");
    text.parse().unwrap_or_else(|error| panic!("`{text}`: {error}"))
}

#[cfg(test)]
mod tests {
    use super::System;

    #[test]
    fn a_system_is_read_with_its_numbers() {
        let sleigh = System::read("chaplygin_sleigh");
        let set = &sleigh.parameter_sets[0];
        assert!(!set.extreme);
        assert!((set.values["a"] - 0.35).abs() < f64::EPSILON);
        let sample = &set.samples[0];
        assert!((sample.state["theta"].rate - sample.state["omega"].value).abs() < f64::EPSILON);
        assert_eq!(set.trajectories[0].len(), 5);
    }
}

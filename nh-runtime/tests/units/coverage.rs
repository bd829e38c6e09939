//! That nothing which computes is left out: what the crate exports is tried, or is told here to be no method.

/// Where names are exported, and from which modules.
const EXPORTS: [(&str, &[&str]); 4] = [
    (include_str!("../../src/lib.rs"), &["methods", "events", "reduction", "__private"]),
    (
        include_str!("../../src/methods/mod.rs"),
        &["adaptive", "fixed", "implicit", "structure", "projected", "taylor"],
    ),
    (
        include_str!("../../src/control/mod.rs"),
        &[
            "hold",
            "horizon",
            "ilqr",
            "kalman",
            "noise",
            "regulator",
            "sampled",
            "shooting",
            "squares",
            "unscented",
        ],
    ),
    (
        include_str!("../../src/sensitivity/mod.rs"),
        &["across", "adjoint", "checkpoints", "column_tolerance", "crossing", "motion", "pull_back", "steps"],
    ),
];

/// What these tests try, by the files that do.
const TRIALS: [&str; 7] = [
    include_str!("methods.rs"),
    include_str!("motions.rs"),
    include_str!("series.rs"),
    include_str!("structure.rs"),
    include_str!("events.rs"),
    include_str!("blocks.rs"),
    include_str!("plans.rs"),
];

/// What is exported beside: data, settings, traits, and what the methods are made of.
const NO_METHODS: &[&str] = &[
    // results and settings
    "Direction",
    "Event",
    "Simultaneous",
    "Correction",
    "Improvement",
    "Expansion",
    "Gradient",
    "AfterEvent",
    "Jumped",
    "Controller",
    "Uniform",
    "PerComponent",
    // traits
    "Method",
    "Scheme",
    "OneStep",
    "Tolerance",
    "Linearization",
    "Symmetric",
    "Substeps",
    "Tableau",
    "Pair",
    "Reconstruction",
    "Reduction",
    // what methods with names of their own are made of
    "Adaptive",
    "Trial",
    "Step",
    "Fixed",
    "Compensated",
    "Analytic",
    "FiniteDifferences",
    "Gauss",
    "Midpoint",
    "Radau",
    "Rodas",
    "Composed",
    "DiscreteAction",
    "DiscreteMomentum",
    "DriftKickDrift",
    "Gonzalez",
    "KahanLi6",
    "Suzuki4",
    // takes the steps of another method, and computes nothing
    "Interruptible",
    // systems made of systems, which compute nothing but their derivatives
    "ByStages",
    "Reconstructed",
    // what `advance_across` computes, of given numbers
    "Crossing",
];

/// The names in `pub use module::Name;`, `pub use module::{…};` and `pub type Name`.
fn exported(source: &str, modules: &[&str]) -> Vec<String> {
    let mut names = Vec::new();
    for statement in source.split(';') {
        let Some(place) = statement.rfind("pub use ") else {
            if let Some(place) = statement.rfind("\npub type ") {
                let rest = &statement[place + 10..];
                names.extend(rest.split(|c: char| !c.is_alphanumeric()).next().map(str::to_owned));
            }
            continue;
        };
        let used = &statement[place + 8..];
        if let Some((module, list)) = used.split_once("::")
            && modules.contains(&module)
        {
            let words = list.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            names.extend(words.filter(|word| !word.is_empty()).map(str::to_owned));
        }
    }
    names
}

#[test]
fn nothing_is_left_out() {
    let mut missing = Vec::new();
    for (source, modules) in EXPORTS {
        let names = exported(source, modules);
        assert!(names.len() > 8, "{names:?}");
        for name in names {
            let is_word = |text: &str| {
                let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
                words.any(|word| word == name)
            };
            if !NO_METHODS.contains(&name.as_str()) && !TRIALS.iter().any(|text| is_word(text)) {
                missing.push(name);
            }
        }
    }
    assert!(missing.is_empty(), "neither tried under the law of units nor told to be no method: {missing:?}");
}

//! The reference systems, the machines of the benchmark of record, and arms on driven bases, as declarations.

use crate::{Declaration, declarations, families};
use std::path::Path;

/// The machines of the benchmark of record with their names there, in the order of its tables, up to the pendulum.
///
/// # Panics
/// If a file of the benchmark holds no declaration where it is looked for.
#[must_use]
pub fn record() -> Vec<(String, Declaration)> {
    let mut found: Vec<(String, Declaration)> = SHARED
        .iter()
        .map(|(name, model, source)| ((*name).to_owned(), shared(&of_model(model, source))))
        .collect();
    for trailers in 1..=6 {
        let plural = if trailers == 1 { "" } else { "s" };
        found.push((format!("tractor, {trailers} trailer{plural}"), shared(&tractor(trailers))));
    }
    for (name, source) in OWN {
        let declaration = declarations(source).into_iter().next().expect("a declaration");
        found.push(((*name).to_owned(), declaration));
    }
    found
}

/// The same with the arms and what comes after them.
///
/// # Panics
/// As [`record`].
#[must_use]
pub fn whole_record() -> Vec<(String, Declaration)> {
    let mut found = record();
    for links in [2, 4, 6] {
        found.push((format!("arm, {links} links"), shared(&arm(links))));
    }
    for source in LAST {
        for declaration in declarations(source) {
            // as the contest names it
            let (_, rest) = source.split_once(&format!("{} as \"", declaration.name)).expect("a contestant");
            let (name, _) = rest.split_once('"').expect("the end of its name");
            found.push((name.to_owned(), declaration));
        }
    }
    found
}

/// The reference systems with their names, one file after the other.
///
/// # Panics
/// If the catalogue cannot be read.
#[must_use]
pub fn references() -> Vec<(String, Declaration)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src/systems");
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).expect("the catalogue").flatten().map(|file| file.path()).collect();
    paths.sort();
    let texts = paths.iter().map(|path| std::fs::read_to_string(path).expect("text"));
    texts
        .flat_map(|text| declarations(&text))
        .map(|declaration| (declaration.name.clone(), declaration))
        .collect()
}

/// Planar arms of 2 to 8 links, on two driven wheels and on a driven skate.
///
/// # Panics
/// If there are no such families.
#[must_use]
pub fn arms() -> Vec<(String, Declaration)> {
    let of = |name: &str, links: usize| {
        let family = families().find(|family| family.name == name).expect("a family of arms");
        (format!("{name}, {links} links"), family.member(links))
    };
    ["arm on two wheels", "arm on a skate"]
        .into_iter()
        .flat_map(|name| (2..=8).map(move |links| of(name, links)))
        .collect()
}

/// Systems of `tests/models`: the name in tables, the macro, the file with the struct and further sections.
const SHARED: &[(&str, &str, &str)] = &[
    ("sleigh", "sleigh", include_str!("../../bench/src/systems/sleigh.rs")),
    ("veselova", "veselova", include_str!("../../bench/src/systems/veselova.rs")),
    ("snakeboard", "snakeboard", include_str!("../../bench/src/systems/snakeboard.rs")),
    ("robot", "robot", include_str!("../../bench/src/systems/robot.rs")),
    ("ball on table", "ball", include_str!("../../bench/src/systems/ball.rs")),
    ("car", "car", include_str!("../../bench/src/systems/car.rs")),
];

/// Systems that the benchmark alone declares.
const OWN: &[(&str, &str)] = &[
    ("roller racer", include_str!("../../bench/src/systems/roller_racer.rs")),
    ("hitched trailer", include_str!("../../bench/src/systems/hitched_trailer.rs")),
    ("balancing robot", include_str!("../../bench/src/systems/balancing_robot.rs")),
    ("satellite", include_str!("../../bench/src/systems/satellite.rs")),
    ("Chaplygin ball", include_str!("../../bench/src/systems/chaplygin_ball.rs")),
    ("pendulum", include_str!("../../bench/src/systems/pendulum.rs")),
];

/// Those of them that come after the arms.
const LAST: &[&str] = &[
    include_str!("../../bench/src/systems/quadrotor.rs"),
    include_str!("../../bench/src/systems/four_bar.rs"),
    include_str!("../../bench/src/systems/roller_walker.rs"),
    include_str!("../../bench/src/systems/rattleback.rs"),
    include_str!("../../bench/src/systems/four_wheels.rs"),
    include_str!("../../bench/src/systems/finned_body.rs"),
    include_str!("../../bench/src/systems/ball_with_rotors.rs"),
    include_str!("../../bench/src/systems/heavy_top.rs"),
    include_str!("../../bench/src/systems/disk.rs"),
    include_str!("../../bench/src/systems/rear_steered.rs"),
    include_str!("../../bench/src/systems/furuta.rs"),
    include_str!("../../bench/src/systems/leg.rs"),
    include_str!("../../bench/src/systems/elbow.rs"),
    include_str!("../../bench/src/systems/five_bar.rs"),
    include_str!("../../bench/src/systems/slider_crank.rs"),
    include_str!("../../bench/src/systems/off_axle.rs"),
];

/// What stands in `#[nonholonomic(…)]`, and the struct.
struct Text {
    attribute: String,
    item: String,
}

fn shared(text: &Text) -> Declaration {
    let source = format!("#[nonholonomic({})] {}", text.attribute, text.item);
    declarations(&source).into_iter().next().expect("a declaration")
}

/// A system of `tests/models` with the struct and the sections that a file of the benchmark adds.
fn of_model(model: &str, source: &str) -> Text {
    let models = include_str!("../../models/src/lib.rs");
    let (_, rule) = models.split_once(&format!("macro_rules! {model} {{")).expect("a model");
    let (_, rest) = rule.split_once("nonholonomic(").expect("a declaration");
    let (sections, _) = rest.split_once("$($sections)*").expect("the end of its sections");
    let (_, used) = source.split_once(&format!("nh_models::{model}! {{")).expect("its use");
    let (_, rest) = used.split_once("pub struct").expect("a struct");
    let (fields, rest) = rest.split_once('}').expect("the end of the struct");
    let (more, _) = rest.split_once("\n\n").expect("the end of its use");
    let more = more.trim_end().strip_suffix('}').expect("a brace");
    Text { attribute: format!("{sections}{more}"), item: format!("struct{fields}}}") }
}

/// The benchmark bicycle by its geometry, with further sections.
///
/// # Panics
/// If `tests/models` declares it no longer.
#[must_use]
pub fn bicycle(more: &str) -> Declaration {
    let models = include_str!("../../models/src/lib.rs");
    let (_, rule) = models.split_once("macro_rules! bicycle {").expect("the bicycle");
    let (_, rest) = rule.split_once("nonholonomic(").expect("a declaration");
    let (sections, rest) = rest.split_once("$($sections)*").expect("the end of its sections");
    let (_, fields) = rest.split_once('{').expect("its fields");
    let (fields, _) = fields.split_once("$(").expect("the end of its fields");
    let fields = fields.replace("$t", "f64");
    let source = format!("#[nonholonomic({sections} {more})] struct Bicycle {{ {fields} }}");
    declarations(&source).into_iter().next().expect("one declaration")
}

/// A tractor with trailers in relative angles.
fn tractor(trailers: usize) -> Text {
    let Text { attribute, item } = of_model("tractor", include_str!("../../bench/src/systems/tractor.rs"));
    let of_size = |text: &str| {
        text.replace("$trailers", &trailers.to_string())
            .replace("$n", &trailers.to_string())
            .replace("$bodies", &(trailers + 1).to_string())
            .replace("$Tractor", "Tractor")
    };
    Text { attribute: of_size(&attribute), item: of_size(&item) }
}

/// An arm on a skate.
fn arm(links: usize) -> Text {
    let source = include_str!("../../bench/src/systems/arm.rs");
    let (_, rest) = source.split_once("#[nonholonomic(").expect("a declaration");
    let (attribute, rest) = rest.split_once(")]").expect("the end of its sections");
    let (_, rest) = rest.split_once("pub struct").expect("a struct");
    let (fields, _) = rest.split_once('}').expect("the end of the struct");
    let of_size = |text: &str| text.replace("$links", &links.to_string()).replace("$Arm", "Arm");
    Text { attribute: of_size(attribute), item: of_size(&format!("struct{fields}}}")) }
}

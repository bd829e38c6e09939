//! Where the state keeps all velocities unasked, the report names some that would do: put into the declaration they are
//! accepted, and what the report says of them comes true.

use nh_stages::{Declaration, bicycle, declarations};
use nonholonomic_core::system::System;
use proc_macro2::{TokenStream, TokenTree};
use std::path::Path;

/// The declaration without `independent { … }`.
fn unchosen(declaration: &Declaration) -> Declaration {
    let mut attribute: Vec<TokenTree> = Vec::new();
    let mut tokens = declaration.attribute.clone().into_iter();
    while let Some(token) = tokens.next() {
        if matches!(&token, TokenTree::Ident(ident) if ident == "independent") {
            tokens.next();
        } else {
            attribute.push(token);
        }
    }
    Declaration { attribute: attribute.into_iter().collect(), ..declaration.clone() }
}

/// The line of the report that suggests something.
fn line(system: &System) -> Option<&str> {
    system.report.lines().map(str::trim).find(|line| line.starts_with("`independent {"))
}

/// The declaration with what the line says to write.
fn taken(declaration: &Declaration, line: &str) -> Declaration {
    let section = line.split('`').nth(1).expect("a section between quotes");
    let section: TokenStream = section.parse().expect("tokens");
    let attribute = declaration.attribute.clone().into_iter().chain(section).collect();
    Declaration { attribute, ..declaration.clone() }
}

/// What does not come true of what is suggested.
fn wrong(declaration: &Declaration, system: &System, line: &str) -> Option<String> {
    let chosen = match taken(declaration, line).system() {
        Ok(chosen) => chosen,
        Err(errors) => return Some(errors.join("\n")),
    };
    let formulation = chosen.report.lines().find(|line| line.contains("formulation:")).unwrap_or_default();
    let (all, kept) = (system.model.sections.len(), chosen.state_velocities.len());
    let said = [
        format!("would keep {kept} velocit"),
        format!("with {kept} acceleration"),
        format!("in place of {all} acceleration"),
        format!("and {} multiplier", all - kept),
    ];
    let unsaid = said.iter().find(|words| !line.contains(words.as_str()));
    let places = formulation.split_once("break down where ").map_or("", |(_, places)| places);
    let unnamed = places
        .split(" or ")
        .filter_map(|place| place.strip_suffix(" = 0"))
        .find(|place| !place.contains('…') && !line.contains(&format!("{place} != 0")));
    if !formulation.contains("adapted") || !formulation.contains("the declaration names") {
        return Some(formulation.to_owned());
    }
    if line.contains("valid everywhere") && !places.is_empty() {
        return Some(formulation.to_owned());
    }
    if !system.equations.iter().any(|documented| documented == line) {
        return Some("the documentation does not say it".to_owned());
    }
    unsaid.map(|words| format!("not said: {words}")).or(unnamed.map(|place| format!("not named: {place}")))
}

/// Judges the suggestions for declarations, of which there are so many at least.
fn assert_right(found: impl Iterator<Item = Declaration>, least: usize) {
    let mut count = 0;
    let mut failures: Vec<String> = Vec::new();
    for declaration in found {
        let declaration = unchosen(&declaration);
        let Ok(system) = declaration.system() else { continue };
        let report = &system.report;
        let failure = if let Some(line) = line(&system) {
            count += 1;
            wrong(&declaration, &system, line).map(|what| format!("{line}\n{what}"))
        } else {
            let is_by_default = report.contains("formulation: projected") && !report.contains("asks for it");
            let excepted = [
                "nonlinear in the velocities",
                "no points were found where",
                "could not be solved for coordinates or parameters",
            ];
            let is_excepted = excepted.iter().any(|reason| report.contains(reason));
            // levels of momenta, a density that is claimed of the whole state, and steps that are made of all velocities
            let model = &system.model;
            let is_about_state = !model.routh.is_empty()
                || model.volume.is_some()
                || model.requests.iter().any(|(request, _)| request.keeps_all_velocities());
            let has_to_be = is_by_default && !is_excepted && !is_about_state;
            has_to_be.then(|| "nothing is suggested".to_owned())
        };
        failures.extend(failure.map(|what| format!("{}: {what}", declaration.name)));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(count >= least, "{count} suggestions");
}

/// All that are declared in a folder of the repository.
fn declared_in(folder: &str) -> Vec<Declaration> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let mut files: Vec<_> =
        std::fs::read_dir(&path).expect("a folder").flatten().map(|file| file.path()).collect();
    files.sort();
    let texts = files.iter().filter_map(|file| std::fs::read_to_string(file).ok());
    texts.flat_map(|text| declarations(&text)).collect()
}

#[test]
fn what_is_suggested_for_reference_systems_is_accepted() {
    assert_right(declared_in("tests/src/systems").into_iter(), 6);
}

#[test]
fn what_is_suggested_for_the_gallery_is_accepted() {
    assert_right(declared_in("examples/gallery/machines/src/machines").into_iter(), 2);
}

#[test]
fn what_is_suggested_for_loops_is_accepted() {
    assert_right(declared_in("tests/tests/holonomic").into_iter(), 10);
    assert_right(declared_in("examples/examples/structure").into_iter(), 2);
}

#[test]
fn what_is_suggested_for_further_systems_is_accepted() {
    assert_right(declared_in("tests/tests/more_systems").into_iter(), 12);
}

/// The benchmark bicycle, which rides straight ahead: what keeps it from falling, and its rear wheel.
#[test]
fn the_bicycle_keeps_lean_steer_and_the_rear_wheel() {
    let declaration = bicycle("");
    let system = unchosen(&declaration).system().expect("a bicycle");
    let line = line(&system).expect("a suggestion").to_owned();
    assert_eq!(
        line,
        "`independent { der(lean), der(steer), der(rear) }` would keep 3 velocities in the state, with 3 accelerations \
         to solve for in place of 8 accelerations and 5 multipliers; it is valid where cos(lean) != 0 and 2 divisors \
         that are too long to be shown are not 0"
    );
    assert_right(std::iter::once(declaration), 1);
}

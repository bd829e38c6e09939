//! Nothing is missing in the lists that laws over everything of a kind run over.

use std::collections::BTreeSet;
use std::fs;

use super::{root, sources, words};

/// The lists of methods, each in one file or the other.
const METHODS: [&[&str]; 6] = [
    &["nh-runtime/tests/promises/systems.rs", "nh-runtime/tests/promises/own_systems.rs"],
    &["nh-runtime/tests/extremes.rs", "nh-runtime/tests/structure_extremes.rs"],
    &["nh-runtime/tests/non_finite.rs"],
    &["tests/bounded/src/methods.rs", "tests/bounded/src/structure.rs"],
    &["tests/bounded/src/main.rs"],
    &["tests/tests/no_allocation_methods.rs"],
];

/// The lists of tables of explicit methods.
const TABLES: [&[&str]; 3] = [
    &["nh-runtime/src/methods/explicit/order_conditions.rs"],
    &["nh-runtime/tests/sensitivity/columns.rs"],
    &["nh-runtime/tests/sensitivity/adjoints.rs"],
];

/// The statements of a file, without comments and imports, which try nothing.
fn code(file: &&str) -> String {
    let text = fs::read_to_string(root().join(file)).unwrap();
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let code = lines.join("\n");
    code.split(';').filter(|statement| !statement.trim_start().starts_with("use ")).collect()
}

/// The names that a file takes out of a module of its own.
fn exported(file: &str, module: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join(file)).unwrap();
    let (_, list) = text.split_once(&format!("pub use {module}::{{")).unwrap();
    words(list.split_once('}').unwrap().0).map(str::to_owned).collect()
}

/// A method of integration, and the table of an explicit one, is in every list over which a law of all methods is tried.
#[test]
fn every_method_is_in_every_list() {
    let methods = exported("nh-runtime/src/lib.rs", "methods");
    let tables = exported("nh-runtime/src/methods/mod.rs", "explicit");
    let mut missing: Vec<String> = Vec::new();
    for (names, lists) in [(&methods, &METHODS[..]), (&tables, &TABLES[..])] {
        for list in lists {
            let text: String = list.iter().map(code).collect();
            let tried: BTreeSet<&str> = words(&text).collect();
            let beside = ["Method", "Controller", "Pair", "Tableau"];
            let left_out = names.iter().filter(|name| !beside.contains(&name.as_str()));
            let left_out = left_out.filter(|name| !tried.contains(name.as_str()));
            missing.extend(left_out.map(|name| format!("{name} is not in {}", list.join(" or "))));
        }
    }
    let overview = fs::read_to_string(root().join("nh-runtime/src/methods/mod.rs")).unwrap();
    let prelude = fs::read_to_string(root().join("nh-runtime/src/prelude.rs")).unwrap();
    for name in methods.iter().filter(|name| !["Method", "Controller"].contains(&name.as_str())) {
        if !overview.lines().any(|line| line.starts_with("//! | ") && line.contains(&format!("[`{name}`]"))) {
            missing.push(format!("{name} has no line in the table of `methods/mod.rs`"));
        }
        if !words(&prelude).any(|word| word == name) {
            missing.push(format!("{name} is not in the prelude"));
        }
    }
    assert!(methods.len() > 20 && tables.len() > 8, "{methods:?} {tables:?}");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// A declaration that is described by reference data is in the list over which all checks run, and no data are unused.
#[test]
fn every_reference_system_is_checked() {
    let systems = sources(&root().join("tests/src/systems"));
    let text = |name: &str| -> String {
        systems.iter().filter(|(path, _)| path.ends_with(name)).map(|(_, text)| text.as_str()).collect()
    };
    let list = text("mod.rs");
    let list: BTreeSet<&str> = words(&list).collect();
    let (mut described, mut of) = (0, BTreeSet::new());
    for (path, text) in &systems {
        for block in text.split("catalogued! {").skip(1) {
            let name = words(block).next().unwrap_or_default();
            let data = block.split('"').nth(1).unwrap_or_default();
            assert!(list.contains(name), "{name} of {} is in no line of `systems/mod.rs`", path.display());
            described += 1;
            of.insert(data.to_owned());
        }
    }
    assert!(described > 30, "{described}");
    for entry in fs::read_dir(root().join("tests/reference")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let is_system = path.extension().is_some_and(|extension| extension == "json")
            && fs::read_to_string(&path).unwrap().contains("\"parameter_sets\"");
        assert!(!is_system || of.contains(&name), "nothing is declared for {}", path.display());
    }
}

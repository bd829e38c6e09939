//! The rules of the house, held against its files: formula numbers, directions of imports, lengths of files; what pages
//! say; that nothing is missing in a list.

mod least_versions;
mod lists;
mod pages;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use nonholonomic_core::functions::{TABLE, When};

/// The root of the repository.
fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().nth(2).unwrap_or(own).to_owned()
}

/// Every Rust file below a folder, with its text.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                if name != "target" && !name.starts_with('.') {
                    open.push(path);
                }
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                found.push((path, text));
            }
        }
    }
    found.sort();
    found
}

/// The words of a text, as Rust reads them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// Comments as running text: the marks at the beginnings of their lines are gone.
fn running(text: &str) -> String {
    let lines = text.lines().map(|line| line.trim_start().trim_start_matches(['/', '!']).trim());
    lines.collect::<Vec<_>>().join(" ")
}

/// The numbers that follow the word *mathematics*: `mathematics (8)`, `mathematics (7), (9) and (10)`.
fn cited(text: &str) -> BTreeSet<u32> {
    let mut numbers = BTreeSet::new();
    for behind in running(text).split("athematics ").skip(1) {
        let mut rest = behind;
        while let Some(inner) = rest.strip_prefix('(') {
            let Some((number, after)) = inner.split_once(')') else { break };
            let Ok(number) = number.parse() else { break };
            numbers.insert(number);
            rest = after.trim_start_matches([',', ' ']);
            rest = rest.strip_prefix("and ").unwrap_or(rest);
        }
    }
    numbers
}

/// The numbers of the displayed formulas of MATHEMATICS.md.
fn numbered() -> BTreeSet<u32> {
    let text = fs::read_to_string(root().join("MATHEMATICS.md")).unwrap();
    let displayed = text.lines().filter_map(|line| line.strip_prefix("    ("));
    displayed.filter_map(|line| line.split_once(')')?.0.parse().ok()).collect()
}

#[test]
fn every_formula_is_cited_where_it_is_computed_and_where_it_is_checked() {
    let (mut computed, mut checked) = (BTreeSet::new(), BTreeSet::new());
    for (path, text) in
        ["nh-core", "nh-macros", "nh-runtime", "tests"].iter().flat_map(|f| sources(&root().join(f)))
    {
        let inside = path.strip_prefix(root()).unwrap_or(&path);
        let path = inside.to_string_lossy().replace('\\', "/");
        if path.contains("tests/house/") {
            continue;
        }
        let is_test = path.starts_with("tests/") || path.contains("/tests/");
        let is_test = is_test || path.ends_with("_tests.rs") || path.contains("_tests/");
        let (product, test) = match text.split_once("#[cfg(test)]\nmod tests {") {
            _ if is_test => ("", text.as_str()),
            Some((product, test)) => (product, test),
            None => (text.as_str(), ""),
        };
        computed.extend(cited(product));
        checked.extend(cited(test));
    }
    let numbered = numbered();
    assert!(numbered.len() >= 28, "{numbered:?}");
    let missing = |cited: &BTreeSet<u32>| numbered.difference(cited).copied().collect::<Vec<_>>();
    assert_eq!(missing(&computed), [], "formulas that no function cites");
    assert_eq!(missing(&checked), [], "formulas that no test cites");
}

#[test]
fn citations_are_read_across_lines() {
    let text =
        "/// By mathematics (7),\n    /// (9) and (10), not (11).\n// Mathematics (3) says\nlet x = f(12);";
    assert_eq!(cited(text).into_iter().collect::<Vec<_>>(), [3, 7, 9, 10]);
}

/// What a crate or a module may not name, with the folder where it may not be named.
#[test]
fn imports_run_one_way() {
    let rules: [(&str, &[&str]); 9] = [
        ("nh-core/src", &["syn::", "quote!", "proc_macro", "nonholonomic_macros", "TokenStream"]),
        ("nh-runtime/src", &["nonholonomic_core", "proc_macro", "syn::"]),
        (
            "nh-core/src/algebra",
            &[
                "crate::geometry",
                "crate::mechanics",
                "crate::check",
                "crate::compile",
                "crate::program",
                "crate::model",
            ],
        ),
        (
            "nh-core/src/geometry",
            &["crate::mechanics", "crate::check", "crate::compile", "crate::program", "crate::model"],
        ),
        ("nh-core/src/mechanics", &["crate::check", "crate::compile", "crate::report", "crate::model"]),
        (
            "nh-core/src/program",
            &["crate::check", "crate::compile", "crate::report", "crate::geometry", "crate::model"],
        ),
        ("nh-core/src/check", &["crate::compile", "crate::report"]),
        ("nh-core/src/functions", &["crate::check", "crate::compile", "crate::report"]),
        ("nh-macros/src/syntax", &["crate::resolve", "crate::emit"]),
    ];
    let mut broken = Vec::new();
    for (folder, forbidden) in rules {
        for (path, text) in sources(&root().join(folder)) {
            let product = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            let code = product.lines().filter(|line| !line.trim_start().starts_with("//"));
            for line in code {
                broken.extend(
                    forbidden
                        .iter()
                        .filter(|name| line.contains(*name))
                        .map(|name| format!("{}: {name}", path.display())),
                );
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// A file is a room with one purpose: most have fewer than 400 lines, none more than 500.
#[test]
fn files_are_rooms() {
    const LONGEST: usize = 500;
    let folders = ["nh-core/src", "nh-macros/src", "nh-runtime/src"];
    let long = folders.iter().flat_map(|folder| sources(&root().join(folder)));
    let long = long.map(|(path, text)| (text.lines().count(), path)).filter(|(lines, _)| *lines > LONGEST);
    let long: Vec<String> = long.map(|(lines, path)| format!("{lines} {}", path.display())).collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}

/// A room has a name of its own: no two files of a crate are called the same, but for the heads of folders.
#[test]
fn no_two_files_have_one_name() {
    let mut twice = Vec::new();
    for folder in ["nh-core/src", "nh-macros/src", "nh-runtime/src"] {
        let mut seen = BTreeMap::new();
        for (path, _) in sources(&root().join(folder)) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name == "mod.rs" {
                continue;
            }
            if let Some(first) = seen.insert(name, path.clone()) {
                twice.push(format!("{} and {}", first.display(), path.display()));
            }
        }
    }
    assert!(twice.is_empty(), "{}", twice.join("\n"));
}

/// Only the zero test decides whether an expression vanishes: no code compares one with the zero of its graph.
#[test]
fn nothing_else_compares_with_zero() {
    let mut broken = Vec::new();
    for (path, text) in sources(&root().join("nh-core/src")) {
        let product = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let is_test = path.to_string_lossy().ends_with("_tests.rs");
        for (number, line) in product.lines().enumerate().filter(|_| !is_test) {
            if ["== graph.zero()", "!= graph.zero()", "== self.zero()", "!= self.zero()"]
                .iter()
                .any(|p| line.contains(p))
            {
                broken.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Beyond the algebra formulas are written with operators, `graph.formula(a * b - c)`, not as chains of calls.
#[test]
fn formulas_are_written_with_operators() {
    let mut chains = Vec::new();
    for folder in ["nh-core", "nh-macros"] {
        for (path, text) in sources(&root().join(folder)) {
            if path.starts_with(root().join("nh-core/src/algebra")) {
                continue;
            }
            // rustfmt may have broken a chain of calls into lines
            let text: String = text.lines().map(str::trim).collect();
            for call in ["add(", "sub(", "mul(", "div(", "neg("] {
                for graph in ["graph", "g"] {
                    let call = format!("{graph}.{call}");
                    let starts = text.match_indices(&call).map(|(start, _)| start);
                    let is_name =
                        |start: &usize| !text[..*start].ends_with(|c: char| c.is_alphanumeric() || c == '_');
                    chains.extend(starts.filter(is_name).map(|_| format!("{}: {call}", path.display())));
                }
            }
        }
    }
    assert!(chains.is_empty(), "{}", chains.join("\n"));
}

/// A library whose systems would be expanded twice is not compiled for its own tests: those are taken in by a file of
/// `tests`, so that none is left out.
#[test]
fn no_test_is_left_out() {
    for package in ["tests", "tests/accuracy", "tests/bench"].map(|name| root().join(name)) {
        let manifest = fs::read_to_string(package.join("Cargo.toml")).unwrap();
        assert!(manifest.contains("[lib]\ntest = false"), "{}: name it no longer here", package.display());
        let taken_in: String = sources(&package.join("tests")).into_iter().map(|(_, text)| text).collect();
        for (path, text) in sources(&package.join("src")) {
            let inside = path.strip_prefix(&package).unwrap();
            let mut files =
                inside.ancestors().flat_map(|part| [part.with_extension("rs"), part.join("mod.rs")]);
            let is_taken_in = files.any(|file| taken_in.contains(&format!("\"../{}\"", file.display())));
            assert!(is_taken_in || !text.contains("#[test]"), "nothing runs the tests of {}", path.display());
        }
    }
}

/// A function that is generated on request is told by name where it is called without: a line of `unasked.rs` for each.
#[test]
fn what_is_not_asked_for_is_told() {
    let told = fs::read_to_string(root().join("nh-runtime/src/unasked.rs")).unwrap();
    let asked = TABLE.iter().filter(|signature| matches!(signature.when, When::Asked(_)));
    let untold: Vec<&str> = asked
        .filter(|signature| {
            let arguments = if signature.takes_input { "(t, state, input)" } else { "(t, state)" };
            !told.contains(&format!(" {}{arguments}", signature.name))
        })
        .map(|signature| signature.name)
        .collect();
    assert!(untold.is_empty(), "called in vain without a word on how to ask for it: {untold:?}");
}

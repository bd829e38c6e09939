//! The rules of the house, held against its files: formula numbers, directions of imports, lengths of files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use nonholonomic_core::functions::{TABLE, When};
use nonholonomic_core::model::Request;

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
        if path.ends_with("house.rs") {
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

/// The pages of the repository that name its files and commands.
const PAGES: [&str; 6] =
    ["ARCHITECTURE.md", "CONTRIBUTING.md", "MATHEMATICS.md", "BENCHMARKS.md", "README.md", "tests/README.md"];

/// What a page puts between backquotes and calls a Rust file is the end of some file's path, braces multiplied out.
#[test]
fn pages_name_files_that_exist() {
    let files: Vec<String> = ["nh-core", "nh-macros", "nh-runtime", "tests", "examples"]
        .iter()
        .flat_map(|folder| sources(&root().join(folder)))
        .map(|(path, _)| path.to_string_lossy().replace('\\', "/"))
        .collect();
    let mut named = 0;
    let mut missing = Vec::new();
    for page in PAGES {
        let text = fs::read_to_string(root().join(page)).unwrap();
        let words = text
            .split('`')
            .skip(1)
            .step_by(2)
            .filter(|word| Path::new(word).extension() == Some("rs".as_ref()));
        for word in words.filter(|word| !word.contains([' ', '<', '*'])) {
            for name in multiplied_out(word) {
                named += 1;
                if !files.iter().any(|file| file.ends_with(&format!("/{name}"))) {
                    missing.push(format!("{page}: {name}"));
                }
            }
        }
    }
    assert!(named > 80, "{named}");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// `check/{volume,brackets}.rs` as the two names that it stands for.
fn multiplied_out(word: &str) -> Vec<String> {
    let parts = word.split_once('{').and_then(|(head, rest)| Some((head, rest.split_once('}')?)));
    match parts {
        Some((head, (choices, tail))) => {
            choices.split(',').map(|choice| format!("{head}{}{tail}", choice.trim())).collect()
        }
        None => vec![word.to_owned()],
    }
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

/// The strings of a list of words in a file, `NAME: [&str; n] = ["…", "…"];`.
fn listed(file: &str, name: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join(file)).unwrap();
    let list = text.split_once(&format!("{name}: [&str;")).and_then(|(_, rest)| rest.split_once("];"));
    let (list, _) = list.unwrap_or_else(|| panic!("{file} has no {name}"));
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// What stands between backquotes.
fn in_code(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// The words of a text, as Rust reads them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// Every word of the language stands in the documentation of the macro, and on the page of the guide: sections, and what
/// `emit` can ask for, in the first cell of a line of a table there.
#[test]
fn every_word_is_documented() {
    const VOCABULARY: &str = "nh-macros/src/syntax/vocabulary.rs";
    let reference = fs::read_to_string(root().join("nh-macros/src/lib.rs")).unwrap();
    let page = fs::read_to_string(root().join("nh-runtime/src/guide/language.md")).unwrap();
    let cells = reference.lines().filter_map(|line| line.strip_prefix("/// | ")?.split_once(" |"));
    let cells: BTreeSet<&str> = cells.flat_map(|(cell, _)| in_code(cell)).flat_map(words).collect();
    let anywhere: BTreeSet<&str> = in_code(&reference).flat_map(words).collect();
    let on_the_page: BTreeSet<&str> = in_code(&page).flat_map(words).collect();
    let (sections, functions) = (listed(VOCABULARY, "SECTIONS"), listed(VOCABULARY, "FUNCTIONS"));
    let asked: Vec<String> = Request::WORDS.iter().map(|(word, _)| (*word).to_owned()).collect();
    let mut missing: Vec<String> = Vec::new();
    for word in sections.iter().chain(&asked).filter(|word| !cells.contains(word.as_str())) {
        missing.push(format!("the documentation of the macro has no line for `{word}`"));
    }
    let roles = listed(VOCABULARY, "TYPES");
    for word in functions.iter().chain(&roles).filter(|word| !anywhere.contains(word.as_str())) {
        missing.push(format!("the documentation of the macro does not name `{word}`"));
    }
    let short = sections.iter().chain(&asked).chain(&functions);
    for word in short.filter(|word| !on_the_page.contains(word.as_str())) {
        missing.push(format!("the page `language` of the guide does not name `{word}`"));
    }
    assert!(sections.len() > 30 && asked.len() > 30 && functions.len() > 15 && roles.len() > 10);
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// A method of integration, and the table of an explicit one, is in every list over which a law of all methods is tried.
#[test]
fn every_method_is_in_every_list() {
    let code = |file: &&str| -> String {
        let text = fs::read_to_string(root().join(file)).unwrap();
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        let code: String = text.lines().filter(is_code).map(|line| format!("{line}\n")).collect();
        // imports try nothing
        code.split(';').filter(|statement| !statement.trim_start().starts_with("use ")).collect()
    };
    let exported = |file: &str, module: &str| -> Vec<String> {
        let text = fs::read_to_string(root().join(file)).unwrap();
        let (_, list) = text.split_once(&format!("pub use {module}::{{")).unwrap();
        words(list.split_once('}').unwrap().0).map(str::to_owned).collect()
    };
    const METHODS: [&[&str]; 6] = [
        &["nh-runtime/tests/promises/systems.rs", "nh-runtime/tests/promises/own_systems.rs"],
        &["nh-runtime/tests/extremes.rs", "nh-runtime/tests/structure_extremes.rs"],
        &["nh-runtime/tests/non_finite.rs"],
        &["tests/bounded/src/methods.rs", "tests/bounded/src/structure.rs"],
        &["tests/bounded/src/main.rs"],
        &["tests/tests/no_allocation_methods.rs"],
    ];
    const TABLES: [&[&str]; 3] = [
        &["nh-runtime/src/methods/explicit/order_conditions.rs"],
        &["nh-runtime/tests/sensitivity/columns.rs"],
        &["nh-runtime/tests/sensitivity/adjoints.rs"],
    ];
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

/// The packages of the workspace with their folders.
fn packages() -> BTreeMap<String, PathBuf> {
    let mut found = BTreeMap::new();
    let workspace = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let members = workspace.split_once("members = [").and_then(|(_, rest)| rest.split_once(']')).unwrap().0;
    for member in members.split('"').skip(1).step_by(2) {
        let folder = root().join(member);
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let name = manifest.split_once("name = \"").and_then(|(_, rest)| rest.split_once('"')).unwrap().0;
        found.insert(name.to_owned(), folder);
    }
    found
}

/// Packages, tests, programs and examples of the commands on the pages exist, and so do the scripts.
#[test]
fn pages_name_commands_that_exist() {
    let packages = packages();
    let (mut seen, mut missing) = (0, Vec::new());
    for page in PAGES {
        let text = fs::read_to_string(root().join(page)).unwrap();
        for command in text.split("cargo ").skip(1).filter_map(|rest| rest.split(['`', '#', '\n']).next()) {
            let own = command.split(" -- ").next().unwrap_or_default();
            let options: Vec<&str> = own.split_whitespace().collect();
            let after = |option: &str| {
                let at = options.iter().position(|word| *word == option)?;
                options.get(at + 1).copied()
            };
            let folder = after("-p").map(|package| packages.get(package).cloned());
            let mut is_there = folder != Some(None);
            let folder = folder.flatten().unwrap_or_else(|| root().join("examples"));
            for (option, place) in [("--test", "tests"), ("--bin", "src/bin"), ("--example", ".")] {
                let Some(name) = after(option) else { continue };
                seen += 1;
                let place =
                    if option == "--example" { root().join("examples/examples") } else { folder.join(place) };
                is_there &= ["", "/main"].iter().any(|end| place.join(format!("{name}{end}.rs")).exists());
            }
            if !is_there {
                missing.push(format!("{page}: cargo {command}"));
            }
        }
        let scripts = text.split("`.ci/").skip(1).filter_map(|rest| rest.split('`').next());
        let scripts = scripts.filter(|name| !root().join(".ci").join(name).exists());
        missing.extend(scripts.map(|name| format!("{page}: .ci/{name}")));
    }
    assert!(seen > 25, "{seen}");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// What pages link to is a file, with the heading that is named.
#[test]
fn pages_link_to_what_exists() {
    let anchor = |heading: &str| -> String {
        let kept = heading.chars().filter(|c| c.is_alphanumeric() || ['-', ' ', '_'].contains(c));
        kept.collect::<String>().to_lowercase().replace(' ', "-")
    };
    let (mut seen, mut missing) = (0, Vec::new());
    for page in PAGES {
        let text = fs::read_to_string(root().join(page)).unwrap();
        let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        for link in links.filter(|link| !link.starts_with("http")) {
            seen += 1;
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let folder = root().join(page).parent().map(Path::to_owned).unwrap();
            let target = if file.is_empty() { root().join(page) } else { folder.join(file) };
            let is_there = target.exists()
                && (heading.is_empty()
                    || fs::read_to_string(&target).unwrap().lines().any(|line| {
                        line.starts_with('#') && anchor(line.trim_matches(['#', ' '])) == heading
                    }));
            if !is_there {
                missing.push(format!("{page}: {link}"));
            }
        }
    }
    assert!(seen > 15, "{seen}");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

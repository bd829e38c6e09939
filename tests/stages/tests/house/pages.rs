//! What pages say of files, links, commands and words is so.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use nonholonomic_core::model::Request;

use super::{root, sources, words};

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

/// Each package of the tests has its line in both tables of folders.
#[test]
fn every_package_has_a_room() {
    let pages = ["ARCHITECTURE.md", "tests/README.md"];
    let [rooms, tests] = pages.map(|page| fs::read_to_string(root().join(page)).unwrap());
    let mut missing = Vec::new();
    for entry in fs::read_dir(root().join("tests")).unwrap() {
        let path = entry.unwrap().path();
        if !path.join("Cargo.toml").exists() {
            continue;
        }
        let folder = format!("`tests/{}`", path.file_name().unwrap_or_default().to_string_lossy());
        missing.extend(pages.iter().zip([&rooms, &tests]).filter_map(|(page, text)| {
            let is_there = text.lines().any(|line| line.starts_with('|') && line.contains(&folder));
            (!is_there).then(|| format!("{page}: {folder}"))
        }));
    }
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

/// Who depends on the runtime alone has its nalgebra without that crate's macros, which documentation is compiled with.
#[test]
fn examples_take_no_macros_from_the_nalgebra_of_the_runtime() {
    let folder = root().join("nh-runtime/src");
    let guide = fs::read_dir(folder.join("guide")).unwrap().map(|entry| entry.unwrap().path());
    let pages = guide.map(|path| (fs::read_to_string(&path).unwrap(), path));
    let files = sources(&folder).into_iter().map(|(path, text)| (text, path));
    let mut found = 0;
    for (text, path) in pages.chain(files) {
        for line in text.lines().filter(|line| line.contains("nonholonomic::nalgebra::")) {
            found += 1;
            let is_macro = |word: &str| ["vector", "matrix", "point", "stack"].contains(&word);
            assert!(!words(line).any(is_macro), "{}: {line}", path.display());
        }
    }
    assert!(found > 0, "the pages are elsewhere");
}

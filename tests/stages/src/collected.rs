//! The declarations that stand in the repository: in code, in tests of what is refused, in documentation.

use crate::{Declaration, Relation, declarations, relations};
use std::path::Path;

/// Every declaration in the files of the repository, in the order of their paths; none where this crate is built
/// without it.
#[must_use]
pub fn collected() -> Vec<Declaration> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut found = Vec::new();
    for folder in ["README.md", "MATHEMATICS.md", "nh-core", "nh-macros", "nh-runtime", "tests", "examples"] {
        from(&root.join(folder), &mut found);
    }
    found
}

/// Every map and quotient there of systems in the same file.
#[must_use]
pub fn collected_relations() -> Vec<Relation> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for folder in ["tests", "ui"] {
        relations_from(&root.join(folder), &mut found);
    }
    found
}

fn relations_from(path: &Path, found: &mut Vec<Relation>) {
    if let Ok(entries) = std::fs::read_dir(path) {
        let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        for path in &paths {
            relations_from(path, found);
        }
    } else if path.extension().is_some_and(|extension| extension == "rs") {
        found.extend(std::fs::read_to_string(path).iter().flat_map(|text| relations(text)));
    }
}

fn from(path: &Path, found: &mut Vec<Declaration>) {
    if path.is_dir() {
        let Ok(entries) = std::fs::read_dir(path) else { return };
        let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        paths.iter().filter(|path| !path.ends_with("target")).for_each(|path| from(path, found));
        return;
    }
    let Ok(text) = std::fs::read_to_string(path) else { return };
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("rs") => {
            found.extend(declarations(&text));
            let is_doc = |line: &&str| line.starts_with("///") || line.starts_with("//!");
            let docs: Vec<&str> =
                text.lines().map(str::trim_start).filter(is_doc).map(|line| line[3..].trim_start()).collect();
            found.extend(in_fences(&docs.join("\n")));
        }
        Some("md") => found.extend(in_fences(&text)),
        _ => {}
    }
}

/// What stands between lines of three backticks.
fn in_fences(text: &str) -> Vec<Declaration> {
    let blocks = text.split("\n```").skip(1).step_by(2);
    blocks.filter_map(|block| block.split_once('\n')).flat_map(|(_, code)| declarations(code)).collect()
}

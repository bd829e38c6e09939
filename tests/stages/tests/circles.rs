//! Imports have no circle of more than three files in any crate.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A module by the names that lead to it from the root of its crate.
type Module = Vec<String>;

/// The modules of a crate: their text, and what stands elsewhere under names that they hand on.
struct House {
    texts: BTreeMap<Module, String>,
    handed_on: BTreeMap<Module, BTreeMap<String, Vec<String>>>,
}

/// The text without comments and without the tests at its end.
fn product(text: &str) -> String {
    let product = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    product.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The modules that are there for tests alone.
fn tested(module: &Module, text: &str) -> Vec<Module> {
    let lines: Vec<&str> = text.lines().collect();
    let pairs = lines.windows(2).filter(|pair| pair[0] == "#[cfg(test)]");
    let names = pairs.filter_map(|pair| pair[1].strip_prefix("mod ")?.strip_suffix(';'));
    names.map(|name| [module.as_slice(), &[name.to_owned()]].concat()).collect()
}

impl House {
    fn open(root: &Path) -> Self {
        let mut texts = BTreeMap::new();
        let mut open: Vec<(PathBuf, Module)> = vec![(root.to_owned(), Module::new())];
        while let Some((folder, module)) = open.pop() {
            for entry in fs::read_dir(&folder).unwrap() {
                let path = entry.unwrap().path();
                let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let mut inner = module.clone();
                if !["mod", "lib"].contains(&stem.as_str()) {
                    inner.push(stem.clone());
                }
                if path.is_dir() {
                    open.push((path, inner));
                } else if path.extension().is_some_and(|extension| extension == "rs")
                    && !stem.ends_with("tests")
                {
                    texts.insert(inner, product(&fs::read_to_string(&path).unwrap()));
                }
            }
        }
        let only_tested: BTreeSet<Module> =
            texts.iter().flat_map(|(module, text)| tested(module, text)).collect();
        texts.retain(|module, _| !only_tested.contains(module));
        let mut house = Self { texts, handed_on: BTreeMap::new() };
        for (module, text) in &house.texts {
            let uses = uses(text);
            let public = uses.iter().filter(|(is_public, _)| *is_public);
            let names = public.filter_map(|(_, path)| Some((path.last()?.clone(), path.clone()))).collect();
            house.handed_on.insert(module.clone(), names);
        }
        house
    }

    /// The module in which the thing stands that a path in `from` leads to; `None` beyond the crate.
    fn place(&self, from: &Module, path: &[String], depth: usize) -> Option<Module> {
        let mut at = from.clone();
        let mut rest = path;
        match path.first()?.as_str() {
            "crate" => (at, rest) = (Module::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {}
            first => {
                at.push(first.to_owned());
                if !self.texts.contains_key(&at) {
                    return None;
                }
                rest = &path[1..];
            }
        }
        while let Some((first, behind)) = rest.split_first() {
            if first == "super" {
                at.pop();
                rest = behind;
                continue;
            }
            at.push(first.clone());
            if self.texts.contains_key(&at) {
                rest = behind;
                continue;
            }
            at.pop();
            let further = self.handed_on.get(&at).and_then(|names| names.get(first));
            return match further {
                Some(path) if depth < 8 => self.place(&at, path, depth + 1).or(Some(at)),
                _ => Some(at),
            };
        }
        Some(at)
    }

    /// Which module takes something from which.
    fn imports(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let of = |(module, text): (&'_ Module, &String)| {
            let private = uses(text).into_iter().filter(|(is_public, _)| !is_public).map(|(_, path)| path);
            let paths: Vec<_> = private.chain(written_out(text)).collect();
            paths
                .iter()
                .filter_map(|path| self.place(module, path, 0))
                .filter(|place| place != module)
                .collect()
        };
        self.texts.iter().map(|entry| (entry.0, of(entry))).collect()
    }

    /// Groups of modules each of which takes something from every other, if on the way of others.
    fn circles(&self) -> Vec<Vec<String>> {
        let imports = self.imports();
        let reached = |from: &Module| {
            let mut reached = BTreeSet::new();
            let mut open = vec![from.clone()];
            while let Some(module) = open.pop() {
                for next in imports.get(&module).into_iter().flatten() {
                    if reached.insert(next.clone()) {
                        open.push(next.clone());
                    }
                }
            }
            reached
        };
        let reached: BTreeMap<&Module, BTreeSet<Module>> =
            self.texts.keys().map(|module| (module, reached(module))).collect();
        let mut circles = BTreeSet::new();
        for (module, others) in &reached {
            let circle: Vec<String> = others
                .iter()
                .filter(|other| reached.get(other).is_some_and(|back| back.contains(*module)))
                .map(|other| other.join("::"))
                .collect();
            circles.insert(circle);
        }
        circles.into_iter().filter(|circle| circle.len() > 1).collect()
    }
}

/// The paths that a text imports, and whether it hands them on.
fn uses(text: &str) -> Vec<(bool, Vec<String>)> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find("use ") {
        let before = rest[..start].rsplit('\n').next().unwrap_or_default().trim();
        let statement = rest[start + 4..].split(';').next().unwrap_or_default();
        rest = &rest[start + 4..];
        let is_public = before.starts_with("pub");
        if before.is_empty() || is_public {
            let statement: String = statement.split_whitespace().collect::<Vec<_>>().join(" ");
            expand(&[], &statement, &mut |path| found.push((is_public, path)));
        }
    }
    found
}

/// The single paths of a tree of them.
fn expand(head: &[String], tree: &str, found: &mut impl FnMut(Vec<String>)) {
    let tree = tree.trim();
    if let Some((prefix, inner)) = tree.split_once('{') {
        let mut head = head.to_vec();
        head.extend(prefix.split("::").map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned));
        let inner = inner.rsplit_once('}').map_or(inner, |(inner, _)| inner);
        let (mut depth, mut start) = (0, 0);
        for (index, letter) in inner.char_indices().chain([(inner.len(), ',')]) {
            match letter {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expand(&head, &inner[start..index], found);
                    start = index + 1;
                }
                _ => {}
            }
        }
    } else if !tree.is_empty() {
        let tree = tree.split(" as ").next().unwrap_or_default();
        let names = tree.split("::").map(|name| name.trim().to_owned()).filter(|name| name != "self");
        found(head.iter().cloned().chain(names).collect());
    }
}

/// Paths from the root of the crate, or from above, in the midst of code.
fn written_out(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let lines = text.lines().filter(|line| !line.contains("use "));
    for line in lines {
        for start in ["crate::", "super::"] {
            for (index, _) in line.match_indices(start) {
                let is_end = |letter: char| !(letter.is_alphanumeric() || letter == '_' || letter == ':');
                let path = line[index..].split(is_end).next().unwrap_or_default();
                found.push(path.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect());
            }
        }
    }
    found
}

#[test]
fn no_circle_of_imports_has_more_than_three_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    for name in ["nh-core", "nh-macros", "nh-runtime"] {
        let house = House::open(&root.join(name).join("src"));
        assert!(house.imports().values().map(BTreeSet::len).sum::<usize>() > 100, "{name}");
        let long: Vec<_> = house.circles().into_iter().filter(|circle| circle.len() > 3).collect();
        assert!(long.is_empty(), "{name}: {long:#?}");
    }
}

#[test]
fn paths_are_read() {
    let text = "use a::{b, c::{self, D}};\npub use e::F;\nlet x = crate::g::h(super::i::J);";
    let path = |text: &str| text.split("::").map(str::to_owned).collect::<Vec<_>>();
    let expected = [(false, "a::b"), (false, "a::c"), (false, "a::c::D"), (true, "e::F")];
    assert_eq!(uses(text), expected.map(|(is_public, text)| (is_public, path(text))));
    assert_eq!(written_out(text), ["crate::g::h", "super::i::J"].map(path));
}

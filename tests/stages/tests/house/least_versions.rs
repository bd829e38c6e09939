//! What the packages need of others is tried at the least version that they allow.

use std::fs;

use super::root;

/// Every dependency of the three packages is locked at the least version that is allowed: so what is compiled and tested here
/// is what a user may have at worst. Newer ones are compatible by the rules of versions.
#[test]
fn dependencies_are_locked_at_the_least_version_allowed() {
    let read = |file: &str| fs::read_to_string(root().join(file)).unwrap();
    let (workspace, lock) = (read("Cargo.toml"), read("Cargo.lock"));
    let quoted = |text: &str| text.split('"').nth(1).map(str::to_owned);
    let required = |name: &str| {
        let line = workspace.lines().find_map(|line| line.strip_prefix(&format!("{name} = "))).unwrap();
        quoted(line.split_once("version = ").map_or(line, |(_, rest)| rest)).unwrap()
    };
    let (mut asked, mut wrong) = (0, Vec::new());
    for package in ["nh-core", "nh-macros", "nh-runtime"] {
        let manifest = read(&format!("{package}/Cargo.toml"));
        let section = manifest.split_once("\n[dependencies]\n").unwrap().1;
        let section = section.split("\n[").next().unwrap();
        let is_name = |line: &&str| line.starts_with(|c: char| c.is_ascii_lowercase());
        for line in section.lines().filter(is_name) {
            let name = line.split(['.', ' ']).next().unwrap();
            if name.starts_with("nonholonomic") {
                continue; // one of the three
            }
            asked += 1;
            let version = required(name);
            if !lock.contains(&format!("name = \"{name}\"\nversion = \"{version}\"\n")) {
                wrong.push(format!("{package} allows {name} {version}, with which nothing is compiled here"));
            }
        }
    }
    assert!(asked > 10, "{asked} dependencies");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

//! The README shows what the first example prints.

use std::path::Path;
use std::process::Command;

/// The lines of the table and of the counts.
fn told(text: &str) -> Vec<&str> {
    text.lines().map(str::trim_end).filter(|line| !line.is_empty() && !line.starts_with("picture:")).collect()
}

/// A line without the drift of the energy, which is round-off, and the drift.
fn taken_apart(line: &str) -> (&str, Option<f64>) {
    let (rest, last) = line.rsplit_once(' ').unwrap_or((line, ""));
    last.parse().map_or((line, None), |drift| (rest.trim_end(), Some(drift)))
}

#[test]
fn the_first_example_prints_what_the_readme_shows() {
    let readme = include_str!("../../README.md");
    let shown = readme.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a block");
    let tests = std::env::current_exe().expect("this program has a path");
    let profile = tests.parent().and_then(Path::parent).expect("target/…/deps");
    let example = profile.join("examples").join(format!("chaplygin_sleigh{}", std::env::consts::EXE_SUFFIX));
    let run = Command::new(&example).current_dir(env!("CARGO_TARGET_TMPDIR")).output();
    let run = run.unwrap_or_else(|error| {
        panic!("{}: {error}; `cargo test -p nh-examples` builds it", example.display())
    });
    let printed = String::from_utf8(run.stdout).expect("text");
    let (shown, printed) = (told(shown), told(&printed));
    assert_eq!(shown.len(), printed.len(), "{printed:#?}");
    for (shown, printed) in shown.into_iter().zip(printed) {
        let ((before, shown), (after, drift)) = (taken_apart(shown), taken_apart(printed));
        assert_eq!(before, after);
        // «its energy is kept to 1e-14»
        assert!(shown.into_iter().chain(drift).all(|drift| drift.abs() < 1e-14), "{printed}");
    }
}

//! Instruction counts: a command is run under callgrind, and the cost of its functions, what they call
//! included, is read from callgrind's profile.

use std::collections::HashMap;
use std::path::Path;
use std::process::Command;

/// Instructions per call of each function, by its name.
pub type Counts = HashMap<String, f64>;

/// Whether valgrind can be run.
#[must_use]
pub fn is_present() -> bool {
    Command::new("valgrind").arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Instructions per call of the functions whose name `wanted` accepts, in a run of the command.
///
/// # Errors
/// What went wrong, in words.
pub fn count(command: &[&str], profile: &Path, wanted: impl Fn(&str) -> bool) -> Result<Counts, String> {
    let output = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg(format!("--callgrind-out-file={}", profile.display()))
        .args(command)
        .output()
        .map_err(|error| format!("valgrind does not start: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let text = std::fs::read_to_string(profile).map_err(|error| error.to_string())?;
    Ok(per_call(&text, wanted))
}

/// Instructions in this program, called with arguments, from each beginning of one function to that of
/// another: their names as patterns, and how often they are called in turn.
///
/// # Errors
/// What went wrong, in words.
pub fn count_each(arguments: &[&str], [first, second]: [&str; 2], calls: usize) -> Result<Vec<u64>, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = std::env::temp_dir().join(format!("nh_bench_{}", std::process::id()));
    std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    let status = Command::new("valgrind")
        .args(["--tool=callgrind", "-q"])
        .arg(format!("--callgrind-out-file={}", folder.join("profile").display()))
        // writes what has been done since it did so last
        .args([format!("--dump-before={first}"), format!("--dump-before={second}")])
        .arg(program)
        .args(arguments)
        .status();
    let read = |call: usize| {
        let text = std::fs::read_to_string(folder.join(format!("profile.{call}"))).ok()?;
        text.lines().find_map(|line| line.strip_prefix("summary: "))?.trim().parse().ok()
    };
    // every other profile is of what lies between
    let counts: Option<Vec<u64>> = (1..=calls).map(|call| read(2 * call)).collect();
    let _ = std::fs::remove_dir_all(&folder);
    match status {
        Err(error) => Err(format!("valgrind does not start: {error}")),
        Ok(status) if !status.success() => Err(format!("valgrind gives up: {status}")),
        Ok(_) => counts.ok_or_else(|| format!("callgrind has not written {calls} profiles")),
    }
}

/// What a profile says of a function: its own instructions and those of its callees; how often it is
/// called.
#[derive(Default)]
struct Entry {
    instructions: u64,
    calls: u64,
}

/// Reads a profile in callgrind's format: `fn=` opens a function, `cfn=` names a callee, and the line
/// after `calls=` is the callee's share. Names are written once, `(7) name`, and then `(7)`.
fn per_call(profile: &str, wanted: impl Fn(&str) -> bool) -> Counts {
    let mut names: HashMap<&str, &str> = HashMap::new();
    let mut entries: HashMap<&str, Entry> = HashMap::new();
    let (mut function, mut callee) = ("", "");
    let mut name = |text| -> &str {
        let (key, name) = str::split_once(text, ' ').unwrap_or((text, ""));
        if !name.is_empty() {
            names.insert(key, name);
        }
        names.get(key).copied().unwrap_or(key)
    };
    for line in profile.lines() {
        if let Some(text) = line.strip_prefix("fn=") {
            function = name(text);
        } else if let Some(text) = line.strip_prefix("cfn=") {
            callee = name(text);
        } else if let Some(text) = line.strip_prefix("calls=") {
            let calls = text.split(' ').next().and_then(|count| count.parse::<u64>().ok());
            entries.entry(callee).or_default().calls += calls.unwrap_or(0);
        } else if line.starts_with(|first: char| first.is_ascii_digit() || "+-*".contains(first)) {
            // a position, and the instructions there
            let cost = line.split(' ').nth(1).and_then(|cost| cost.parse::<u64>().ok());
            entries.entry(function).or_default().instructions += cost.unwrap_or(0);
        }
    }
    let called = entries.into_iter().filter(|(name, entry)| entry.calls > 0 && wanted(name));
    called.map(|(name, entry)| (name.to_owned(), entry.instructions as f64 / entry.calls as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_is_read() {
        let profile = "events: Ir\n\nfn=(1) main\n10 5\ncfn=(2) work\ncalls=4 20\n+1 400\n\n\
                       fn=(2)\n20 240\ncfi=(3) libm.c\ncfn=(4) sincos\ncalls=4 7\n* 160\nfn=(4)\n7 160\n";
        let counts = per_call(profile, |name| name != "main");
        assert_eq!(counts.len(), 2);
        assert!((counts["work"] - 100.0).abs() < 1e-12);
        assert!((counts["sincos"] - 40.0).abs() < 1e-12);
    }
}

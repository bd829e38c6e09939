//! How much time and memory the macro takes for declarations of any size, as users have it: unoptimised, and with
//! code written out. Every declaration has a process of its own.
//!
//! ```sh
//! cargo run -p nh-stages --bin load              # every family at every size
//! cargo run -p nh-stages --bin load -- pendulum  # families whose name contains a word
//! cargo run -p nh-stages --bin load -- pendulum 7 12   # at these sizes
//! ```

use nh_stages::Family;
use nonholonomic_core::limits::{WORK, spent, within_limits};
use std::process::{Command, Stdio};
use std::time::Duration;

/// Whoever takes more seconds of processor time is stopped.
const PATIENCE: f64 = 40.0;
/// The argument with which this program measures one declaration.
const ONE: &str = "--one";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [one, name, size] = arguments.as_slice()
        && one == ONE
    {
        return measure(name, size.parse().expect("a size"));
    }
    let (sizes, words): (Vec<String>, Vec<String>) =
        arguments.into_iter().partition(|argument| argument.parse::<usize>().is_ok());
    println!("| family | size | seconds | thousand steps | MiB | outcome |\n|---|--:|--:|--:|--:|---|");
    for family in nh_stages::families() {
        if !words.is_empty() && !words.iter().any(|word| family.name.contains(word.as_str())) {
            continue;
        }
        let given: Vec<usize> = sizes.iter().filter_map(|size| size.parse().ok()).collect();
        for size in if given.is_empty() { family.sizes } else { &given } {
            watched(&family, *size);
        }
    }
}

/// Runs this program on one declaration, for as long as patience lasts.
fn watched(family: &Family, size: usize) {
    let this = std::env::current_exe().expect("this program");
    let mut child = Command::new(this)
        .args([ONE, family.name, &size.to_string()])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("a process");
    let (mut largest, mut stopped) = (0, false);
    while child.try_wait().expect("its state").is_none() {
        largest = memory(child.id()).unwrap_or(largest);
        if processor_time(child.id()).is_some_and(|seconds| seconds > PATIENCE) {
            child.kill().expect("stopped");
            println!("| {} | {size} | > {PATIENCE} | | > {largest} | stopped |", family.name);
            stopped = true;
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().expect("its output");
    print!("{}", String::from_utf8_lossy(&output.stdout));
    if !output.status.success() && !stopped {
        let error = String::from_utf8_lossy(&output.stderr).lines().take(3).collect::<Vec<_>>().join(" ");
        println!("| {} | {size} | | | | FAILED: {error} |", family.name);
    }
}

/// The largest resident memory of a process so far, in MiB, where the system tells.
fn memory(process: impl std::fmt::Display) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()? / 1024)
}

/// The seconds that a process has run so far, where the system tells: it counts them in hundredths.
fn processor_time(process: impl std::fmt::Display) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    let (_, fields) = status.rsplit_once(')')?;
    let mut fields = fields.split_whitespace().skip(11);
    let mut next = || fields.next()?.parse::<f64>().ok();
    Some((next()? + next()?) / 100.0)
}

fn measure(name: &str, size: usize) {
    let family = nh_stages::families().find(|family| family.name == name).expect("a family");
    let declaration = family.member(size);
    let before = processor_time("self");
    let expanded = within_limits(|| (declaration.expanded(), spent()));
    let seconds = processor_time("self").zip(before).map_or(f64::NAN, |(after, before)| after - before);
    let (outcome, spent) = match expanded {
        Err(too_large) => (format!("refused: {}", too_large.what()), WORK),
        Ok((tokens, spent)) => match nh_stages::errors(&tokens).as_slice() {
            [] => (format!("compiled, {} tokens", nh_stages::length(&tokens)), spent),
            [first, rest @ ..] => {
                (format!("refused: {} (and {} more)", first.replace('\n', " / "), rest.len()), spent)
            }
        },
    };
    let memory = memory("self").map_or_else(|| "?".to_owned(), |memory| memory.to_string());
    let thousands = spent / 1000;
    println!("| {name} | {size} | {seconds:.2} | {thousands} | {memory} | {outcome} |");
}

//! Instructions by callgrind: the program runs itself, and each case is a profile of its own.

use std::process::{Command, Stdio};

use crate::study::Ended;

/// Names the study whose cases are to be run once each.
const VARIABLE: &str = "NH_WORK_PRECISION";
/// Says with which case to begin.
const FIRST: &str = "NH_WORK_PRECISION_FIRST";
/// The function at whose beginning callgrind writes what has been done since it did so last.
const FUNCTION: &str = "*counted_run*";

/// The study that callgrind watches this process for, if it does.
pub(crate) fn counted() -> Option<String> {
    std::env::var(VARIABLE).ok()
}

/// Runs one after the other, each in a profile of its own.
pub(crate) fn run_counted<'a>(runs: impl Iterator<Item = &'a dyn Fn() -> Option<Ended>>) {
    let first = std::env::var(FIRST).ok().and_then(|first| first.parse().ok()).unwrap_or(0);
    runs.skip(first).for_each(counted_run);
    // the beginning of this one ends the profile of the last
    counted_run(&|| None);
}

#[inline(never)]
fn counted_run(run: &dyn Fn() -> Option<Ended>) {
    std::hint::black_box(run());
}

/// The instructions of every case; `None` where it is not to be had: without valgrind, or if valgrind
/// does not know an instruction of the processor that the case uses.
pub(crate) fn count(study: &str, cases: usize) -> Vec<Option<u64>> {
    let mut counts = Vec::with_capacity(cases);
    while counts.len() < cases {
        let Some(found) = count_from(study, counts.len(), cases) else { break };
        counts.extend(found.into_iter().map(Some));
        // valgrind has given up on this one
        counts.push(None);
    }
    counts.resize(cases, None);
    counts
}

/// The instructions of the cases from one on, as far as valgrind gets.
fn count_from(study: &str, first: usize, cases: usize) -> Option<Vec<u64>> {
    let program = std::env::current_exe().ok()?;
    let folder = std::env::temp_dir().join(format!("work_precision_{}", std::process::id()));
    std::fs::create_dir_all(&folder).ok()?;
    let status = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg(format!("--callgrind-out-file={}", folder.join("profile").display()))
        .arg(format!("--dump-before={FUNCTION}"))
        .arg(program)
        .args(std::env::args().skip(1))
        .env(VARIABLE, study)
        .env(FIRST, first.to_string())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    // the first profile is what came before the first case; a case that is not finished has none
    let read = |part: usize| totals(&folder.join(format!("profile.{part}")));
    let mut counts = Vec::new();
    while let Some(count) = (first + counts.len() < cases).then(|| read(counts.len() + 2)).flatten() {
        counts.push(count);
    }
    let _ = std::fs::remove_dir_all(&folder);
    let is_finished = status.ok()?.success();
    if !is_finished {
        // the last profile ends in the middle of a case
        counts.pop();
    }
    Some(counts)
}

/// The instructions in a profile.
fn totals(profile: &std::path::Path) -> Option<u64> {
    let text = std::fs::read_to_string(profile).ok()?;
    let line = text.lines().rev().find_map(|line| line.strip_prefix("totals: "));
    line.or_else(|| text.lines().find_map(|line| line.strip_prefix("summary: ")))?.trim().parse().ok()
}

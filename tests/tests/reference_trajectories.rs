//! Every declared system, integrated, follows the trajectories of the reference data.

use std::thread;

use nh_tests::catalogue::Entry;
use nh_tests::systems::catalogue;
use nh_tests::trajectories::deviations;

#[test]
fn ordinary_parameters() {
    follow(false);
}

#[test]
fn extreme_parameters() {
    follow(true);
}

fn follow(extreme: bool) {
    let catalogue = catalogue();
    let failures: Vec<String> = thread::scope(|scope| {
        let follow = |entry| scope.spawn(move || failures(entry, extreme));
        let threads: Vec<_> = catalogue.iter().map(|entry| follow(&**entry)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("a system that panics fails")).collect()
    });
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

fn failures(entry: &dyn Entry, extreme: bool) -> Vec<String> {
    let mut failures = Vec::new();
    for set in &entry.reference().parameter_sets {
        if set.extreme != extreme || !entry.covers(&set.values) {
            continue;
        }
        for trajectory in &set.trajectories {
            let name = format!("{} ({})", entry.name(), set.name);
            match deviations(entry, set, trajectory) {
                Ok(deviations) => {
                    let failed = deviations.iter().filter(|deviation| !deviation.passes());
                    failures.extend(failed.map(|deviation| format!("{name}: {deviation:?}")));
                    match deviations.as_slice() {
                        [_start, .., last] => println!(
                            "{name:40} error {:.1e} of {:.1e} at t = {}",
                            last.error, last.allowed, last.t
                        ),
                        _ => failures.push(format!("{name}: nothing to compare")),
                    }
                }
                Err(error) => failures.push(format!("{name}: {error}")),
            }
        }
    }
    failures
}

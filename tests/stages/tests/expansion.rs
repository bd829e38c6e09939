//! What expansions take, in counted steps of work, never in time.

use nh_stages::{Declaration, arms, record, references, whole_record};
use nonholonomic_core::limits::{spent, within_limits};

/// The most that a reference system may take, and all of them together.
const REFERENCE: u64 = 692_000;
const REFERENCES: u64 = 5_132_000;
/// The most that a machine of the benchmark of record may take up to the pendulum, and those after it.
const RECORD: u64 = 480_000;
const LATER: u64 = 1_950_000;
/// The most that arms of 2 to 8 links may take, in thousands: on two wheels, then on a skate.
const ARMS: [u64; 14] = [162, 182, 342, 241, 302, 349, 426, 369, 315, 357, 399, 310, 398, 476];

fn steps(declaration: &Declaration) -> u64 {
    let work = within_limits(|| {
        drop(declaration.expanded());
        spent()
    });
    work.unwrap_or_else(|too_large| panic!("{}: {}", declaration.name, too_large.what()))
}

/// Asserts that each takes no more than is allowed, and names all that do.
fn assert_within(found: impl Iterator<Item = (String, u64, u64)>) {
    let too_many: Vec<String> = found
        .filter(|(_, steps, allowed)| steps > allowed)
        .map(|(name, steps, allowed)| format!("{name}: {steps} steps, {allowed} allowed"))
        .collect();
    assert!(too_many.is_empty(), "{}", too_many.join("\n"));
}

#[test]
fn reference_systems_have_a_ceiling() {
    let found = references();
    assert!(found.len() > 30, "only {} declarations were found", found.len());
    let each: Vec<(String, u64, u64)> =
        found.into_iter().map(|(name, declaration)| (name, steps(&declaration), REFERENCE)).collect();
    let together: u64 = each.iter().map(|(_, steps, _)| steps).sum();
    assert!(together <= REFERENCES, "{together} steps together");
    assert_within(each.into_iter());
}

#[test]
fn machines_of_the_benchmark_have_a_ceiling() {
    let allowed = std::iter::repeat_n(RECORD, record().len()).chain(std::iter::repeat(LATER));
    let found = whole_record().into_iter().zip(allowed);
    assert_within(found.map(|((name, declaration), allowed)| (name, steps(&declaration), allowed)));
}

#[test]
fn arms_have_ceilings() {
    let arms = arms();
    assert_eq!(arms.len(), ARMS.len());
    assert_within(
        arms.iter().zip(ARMS).map(|((name, arm), thousands)| (name.clone(), steps(arm), 1000 * thousands)),
    );
}

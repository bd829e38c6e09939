//! Declarations of any size are compiled or refused, by work that is counted.

use nh_stages::{Verdict, families, judged};
use nonholonomic_core::limits::{WORK, spent, within_limits};

/// All families at their least size, at which nothing is refused for its size.
#[test]
fn ordinary_sizes_are_compiled() {
    for family in families() {
        let declaration = family.member(family.sizes[0]);
        let expanded = within_limits(|| (declaration.expanded(), spent()));
        let (items, work) =
            expanded.unwrap_or_else(|too_large| panic!("{}: {}", family.name, too_large.what()));
        for error in nh_stages::errors(&items) {
            assert!(!error.contains("too large"), "{}: {error}", family.name);
        }
        assert!(work < WORK / 4, "{}: {work} steps", family.name);
    }
}

/// What is too large says so, at once, by the steps that it takes.
#[test]
fn what_is_too_large_is_refused() {
    for family in families() {
        let declaration = family.member(family.sizes[1]);
        let verdict = judged(&declaration, 20_000);
        assert!(
            matches!(verdict, Ok(Verdict::Compiled | Verdict::Refused | Verdict::TooLarge)),
            "{}: {verdict:?}",
            family.name
        );
    }
}

/// Ceilings of the work, so that nothing gets slower by an order: sizes that are met, and steps in thousands.
#[test]
fn work_has_ceilings() {
    for (name, size, thousands) in [
        ("chain of exponentials", 20, 2_000),
        ("sum of sines", 400, 300),
        ("free coordinates", 100, 600),
        ("free velocities", 100, 250),
        ("dense mass matrix", 40, 3_500),
        ("pendulum, absolute angles", 10, 16_000),
        ("power of a sum", 20, 40),
        ("dense anchor of parameters", 30, 8_000),
    ] {
        let family = families().find(|family| family.name == name).expect(name);
        let declaration = family.member(size);
        let work = within_limits(|| (nh_stages::errors(&declaration.expanded()), spent()));
        let (errors, work) = work.unwrap_or_else(|too_large| panic!("{name}: {}", too_large.what()));
        assert!(errors.is_empty(), "{name}: {errors:?}");
        assert!(work <= thousands * 1000, "{name} {size}: {} thousand steps", work / 1000);
    }
}

/// The refusal names what is too large, by how much, and what can be done.
#[test]
fn the_refusal_of_a_dense_anchor_names_its_brackets() {
    let family = families().find(|family| family.name == "dense anchor of sines").expect("a family");
    assert_eq!(
        nh_stages::errors(&family.member(30).expanded()),
        ["this declaration is too large, because the brackets would take expressions of more than 2500000 \
          entries\nhelp: use a basis whose brackets are short: that of the coordinates, or of a known algebra"]
    );
}

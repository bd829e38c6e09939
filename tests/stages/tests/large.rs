//! Declarations of any size are compiled or refused, by work that is counted.

use nh_stages::{Declaration, Verdict, declarations, errors, families, judged};
use nonholonomic_core::limits::{Subject, WORK, spent, within, within_limits};
use proc_macro2::TokenStream;

/// All families at their least size, at which nothing is refused for its size.
#[test]
fn ordinary_sizes_are_compiled() {
    for family in families() {
        let declaration = family.member(family.sizes[0]);
        let expanded = within_limits(|| (declaration.expanded(), spent()));
        let (items, work) =
            expanded.unwrap_or_else(|too_large| panic!("{}: {}", family.name, too_large.what()));
        for error in errors(&items) {
            assert!(!error.contains("too large"), "{}: {error}", family.name);
        }
        assert!(work < WORK / 4, "{}: {work} steps", family.name);
    }
}

/// What is too large says so, at once, by the steps that it takes: where something is not counted, the processor's time
/// betrays it.
#[test]
fn what_is_too_large_is_refused() {
    for family in families() {
        for size in &family.sizes[1..] {
            let declaration = family.member(*size);
            let verdict = judged(&declaration, 20_000);
            assert!(
                matches!(verdict, Ok(Verdict::Compiled | Verdict::Refused | Verdict::TooLarge)),
                "{} {size}: {verdict:?}",
                family.name
            );
        }
    }
}

/// Ceilings of the work, so that nothing gets slower by an order: sizes that are met, and steps in thousands.
#[test]
fn work_has_ceilings() {
    let mut too_many = Vec::new();
    for (name, size, thousands) in [
        ("chain of exponentials", 20, 1_615),
        ("sum of sines", 400, 427),
        ("free coordinates", 100, 429),
        ("free velocities", 100, 194),
        ("dense mass matrix", 40, 2_412),
        ("pendulum, absolute angles", 10, 317),
        ("power of a sum", 20, 31),
        ("dense anchor of parameters", 30, 14_800),
        ("so(n)", 16, 2_080),
        ("closed loops", 5, 1_065),
        ("bodies in space", 5, 562),
        ("bodies by quaternions", 6, 474),
        ("long vectors", 300, 3_625),
        ("shared lets that double in functions", 40, 2_395),
    ] {
        let family = families().find(|family| family.name == name).expect(name);
        let declaration = family.member(size);
        let work = within_limits(|| (errors(&declaration.expanded()), spent()));
        let (errors, work) = work.unwrap_or_else(|too_large| panic!("{name}: {}", too_large.what()));
        assert!(errors.is_empty(), "{name}: {errors:?}");
        if work > thousands * 1000 {
            too_many.push(format!("{name} {size}: {} thousand steps, {thousands} allowed", work / 1000));
        }
    }
    assert!(too_many.is_empty(), "{}", too_many.join("\n"));
}

/// The refusal names what is too large, by how much, and what can be done.
#[test]
fn the_refusal_of_a_dense_anchor_names_its_brackets() {
    assert_eq!(errors(&dense_anchor().expanded()), [REFUSED]);
}

/// A map or a quotient of a system that is too large is refused likewise.
#[test]
fn maps_and_quotients_have_the_limits_of_declarations() {
    let full = dense_anchor();
    let quotient = full.quotient(&tokens(&format!("{} -> struct Reduced by {{ x[0] }}", full.name)));
    assert_eq!(errors(&quotient), [REFUSED]);
    let map = tokens(&format!("{0} -> {0} {{ base {{ x = x; }} velocities {{ v = v; }} }}", full.name));
    assert_eq!(errors(&full.morphism(&full, &map)), [REFUSED]);
}

/// Where the two systems are small and what relates them is not, the refusal names that.
#[test]
fn maps_and_quotients_are_named_where_they_take_too_much() {
    let system =
        "#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })] struct A { m: f64 }";
    let [full] = declarations(system).try_into().expect("one declaration");
    let map = tokens(
        "A -> A { base { x = x; y = y; } velocities { x_dot = der(x); y_dot = der(y); } parameters { m = m; } }",
    );
    let quotient = tokens("A -> struct B by { y }");
    assert!(subjects(|| full.morphism(&full, &map)).contains(&Subject::Map));
    assert!(subjects(|| full.quotient(&quotient)).contains(&Subject::Quotient));
}

const REFUSED: &str = "this declaration is too large, because the brackets would take expressions of more than \
                       2500000 entries\nhelp: use a basis whose brackets are short: that of the coordinates, or \
                       of a known algebra";

fn dense_anchor() -> Declaration {
    families().find(|family| family.name == "dense anchor of sines").expect("a family").member(30)
}

fn tokens(written: &str) -> TokenStream {
    written.parse().expect("tokens")
}

/// What takes the last of the work, for every amount of it that is not enough.
fn subjects(expansion: impl Fn() -> TokenStream) -> Vec<Subject> {
    let mut found = Vec::new();
    for work in 1.. {
        match within(work, &expansion) {
            Err(too_large) => found.push(too_large.subject),
            Ok(items) => {
                assert_eq!(errors(&items), <[String; 0]>::default());
                break;
            }
        }
    }
    found
}

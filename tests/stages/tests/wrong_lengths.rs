//! A wrong length where names are declared is one error, wherever the names stand.

use std::collections::BTreeSet;

use nh_stages::{Declaration, collected, declarations, errors};

/// One in so many of the slips is planted: all of them are too many for each run, and gave no more than one error each.
const EACH: usize = 9;

/// A declaration with other lengths of one index in a list of names.
fn with_other_lengths(declaration: &Declaration, list: &str) -> Vec<Declaration> {
    let text = declaration.attribute.to_string();
    let Some(start) = text.find(&format!("{list} {{")).map(|at| at + list.len() + 2) else {
        return Vec::new();
    };
    let end = text[start..].find('}').map_or(text.len(), |length| start + length);
    let mut changed = Vec::new();
    for (open, _) in text[start..end].match_indices('[') {
        let inside = start + open + 1;
        let close = text[inside..].find(']').map_or(end, |length| inside + length);
        let Ok(length) = text[inside..close].trim().parse::<u32>() else { continue };
        for other in [length.saturating_sub(1), length + 1].into_iter().filter(|other| *other > 0) {
            let attribute = format!("{}{other}{}", &text[..inside], &text[close..]).parse();
            changed.extend(attribute.map(|attribute| Declaration { attribute, ..declaration.clone() }));
        }
    }
    changed
}

#[test]
fn in_the_declarations_of_the_repository() {
    let mut known = BTreeSet::new();
    let mut slips = Vec::new();
    for declaration in collected() {
        if !known.insert(declaration.attribute.to_string()) {
            continue;
        }
        let changed: Vec<Declaration> = ["base", "basis", "inputs"]
            .iter()
            .flat_map(|list| with_other_lengths(&declaration, list))
            .collect();
        slips.extend(changed.into_iter().map(|slip| (declaration.clone(), slip)));
    }
    assert!(slips.len() > 300, "{}", slips.len());
    let mut refused = 0;
    for (right, slip) in slips.into_iter().step_by(EACH) {
        let told = errors(&slip.expanded());
        if told.len() > 1 {
            let of_right = errors(&right.expanded());
            assert!(!of_right.is_empty(), "{}: {told:#?}", slip.attribute);
        }
        refused += usize::from(told.len() == 1);
    }
    assert!(refused > 30, "{refused}");
}

fn told(attribute: &str) -> Vec<String> {
    let text = format!("#[nonholonomic({attribute})] struct S {{ m: f64, J: [f64; 2] }}");
    errors(&declarations(&text)[0].expanded())
}

#[test]
fn the_length_that_leaves_nothing_is_told() {
    let told_of_fields = told(
        "base { q[3] } lagrangian { dot(J, der(q))^2 + dot(der(q), der(q)) - m*q[2] } outputs { a = cross(J, q); }",
    );
    assert_eq!(
        told_of_fields,
        [
            "`J` is a vector of 2 entries, and stands where a vector of 3 entries fits\nas a vector of 3 entries it has a \
          meaning in 2 places where it has none now, first where `dot` takes two vectors of the same length: these are \
          a vector of 2 entries and a vector of 3 entries\nhelp: declare it as `[…; 3]`, or change what stands in those places"
        ]
    );
    let told_of_a_number =
        told("base { q[3] } lagrangian { dot(der(q), der(q)) - q[1]*sin(J) + cos(J)*q[2] }").join("\n");
    assert!(told_of_a_number.contains("help: declare it as a number, or change"), "{told_of_a_number}");
    // one place in error is told where it is
    let one = told("base { q[3] } lagrangian { dot(J, der(q))^2 + dot(der(q), der(q)) }");
    assert_eq!(one.len(), 1);
    assert!(one[0].starts_with("`dot` takes two vectors of the same length"), "{one:?}");
    // either of two names may be wrong
    let two = told("base { q[3] } lagrangian { dot(der(q), der(q)) + dot(J, q) + dot(q, J) }");
    assert!(two.len() == 2 && two.iter().all(|error| error.contains("`dot` takes")), "{two:?}");
    // what is wrong besides is told as well
    let besides = told("base { q[2] } lagrangian { der(q[0])^2 + der(q[1])^2 + der(q[2])^2 - m*q[2] + n }");
    assert_eq!(besides.len(), 2, "{besides:?}");
    assert!(besides[0].contains("help: declare `q[3]`") && besides[1].contains("`n`"), "{besides:?}");
}

//! What is assumed of signs is used where roots and their squares stand.

use nh_stages::{declarations, errors};

fn refusals(sections: &str) -> Vec<String> {
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ m: f64, k: f64, l: f64 }}");
    errors(&declarations(&text).pop().expect("one declaration").expanded())
}

/// Masses and constraints that are lost where the assumptions hold.
#[test]
fn what_is_lost_under_assumptions_is_refused() {
    for (sections, words) in [
        ("lagrangian { m/2*(der(x)^2 + (l + sqrt(l^2))*der(y)^2) - k*y } assume { l < 0; }", "singular"),
        (
            "lagrangian { m/2*(der(x)^2 + (l + k - sqrt(l^2 + 2*l*k + k^2))*der(y)^2) } assume { l > 0; k > 0; }",
            "singular",
        ),
        (
            "lagrangian { m/2*(der(x)^2 + der(y)^2) - k*x } constraints { a: sqrt(l^2)*der(x) = l*der(y); \
             b: der(x) = -der(y); } assume { l < 0; }",
            "follows",
        ),
    ] {
        let refusals = refusals(&format!("base {{ x, y }} {sections}"));
        assert!(refusals.len() == 1 && refusals[0].contains(words), "{sections}: {refusals:?}");
    }
}

/// Claims that are true there, and their mirrors that are not.
#[test]
fn claims_are_judged_where_assumptions_hold() {
    let machine = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) - k*y }";
    for claimed in [
        "conserved { c = (sqrt(l^2) + l)*x; } assume { l < 0; }",
        "conserved { c = (sqrt((l - k)^2) + l - k)*x; } assume { l < k; }",
        "conserved { c = (sqrt(l^2 - 2*l*k + k^2) - l + k)*x; } assume { l > k; }",
        "forces { x: abs(x*l) - l*abs(x); } conserved { c = der(x); } assume { l > 0; }",
        "forces { x: abs(x/l) + abs(x)/l; } conserved { c = der(x); } assume { l < 0; }",
        "forces { x: sign(l*x*k) + sign(x); } conserved { c = der(x); } assume { l < 0; k > 0; }",
        "forces { x: max(l*x, l*y) - l*max(x, y); } conserved { c = der(x); } assume { l > 0; }",
        "forces { x: min(l*x*k, l*y) - l*min(k*x, y); } conserved { c = der(x); } assume { l > 0; }",
    ] {
        let refusals = refusals(&format!("{machine} {claimed}"));
        assert!(refusals.is_empty(), "{claimed}: {refusals:?}");
    }
    for (claimed, words) in [
        ("conserved { c = (sqrt(l^2) - l)*x; } assume { l < 0; }", "`c` is not conserved"),
        ("conserved { c = (sqrt(l^2 - 2*l*k + k^2) - l + k)*x; } assume { l < k; }", "`c` is not conserved"),
        (
            "forces { x: abs(x*l) - l*abs(x); } conserved { c = der(x); } assume { l < 0; }",
            "`c` is not conserved",
        ),
        (
            "forces { x: max(l*x, l*y) - l*max(x, y); } conserved { c = der(x); } assume { l < 0; }",
            "`c` is not conserved",
        ),
        // true, and not decided: no point is named that the assumption excludes
        ("conserved { c = (atan(l) + atan(1/l) - pi/2)*x; } assume { l > 0; }", "could not be decided"),
    ] {
        let refusals = refusals(&format!("{machine} {claimed}"));
        assert!(refusals.len() == 1 && refusals[0].contains(words), "{claimed}: {refusals:?}");
    }
}

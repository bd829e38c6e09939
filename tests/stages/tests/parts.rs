//! Constraints that hold in several ways: what is claimed has to hold in all of them.

use nh_stages::{Declaration, declarations, errors};

fn declared(sections: &str) -> Declaration {
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ m: f64, k: f64, w: f64 }}");
    declarations(&text).pop().expect("one declaration")
}

fn refusals(sections: &str) -> Vec<String> {
    errors(&declared(sections).expanded())
}

const SPACE: &str = "base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2) - k*z }";

/// Each claim is true where one factor vanishes and false where another does.
#[test]
fn claims_of_one_factor_are_refused() {
    let plane = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) - k*x }";
    let slot = "base { x, z } lagrangian { m/2*(der(x)^2 + der(z)^2) - k*z }";
    let embedded = "base { n[3] } basis { v[2] } anchor { der(n[0]) = n[0]*v[0]; der(n[1]) = n[1]*v[1]; \
                    der(n[2]) = 0; } brackets { } lagrangian { m*(v[0]^2 + v[1]^2)/2 - k*w }";
    for (machine, claimed) in [
        (plane, "constraints { c: der(x)*der(y) = 0; } conserved { p = y; }"),
        (SPACE, "constraints { c: der(x)*(der(y) - der(z)) = 0; } conserved { p = y - z; }"),
        (
            SPACE,
            "constraints { c: (der(x) - der(y))*(der(x) - der(z) - 1) = 0; } conserved { p = x - z - t; }",
        ),
        (SPACE, "constraints { c: der(x)^2*der(y) = der(y)*w^2; } conserved { p = y; }"),
        (SPACE, "constraints { c: der(x)*der(z) = w*der(x); } conserved { p = z - w*t; }"),
        (slot, "holonomic { c: sin(2*x) = 2*z*cos(x); } conserved { p = sin(x) - z; }"),
        (SPACE, "holonomic { c: sin(x - y)*(x + y - 2*z) = 0; } conserved { p = x + y - 2*z; }"),
        (SPACE, "holonomic { c: (x - w*y)*(x^2 - y^2 - z^2 - 1) = 0; } conserved { p = x^2 - y^2 - z^2; }"),
        (plane, "holonomic { c: (x^2 + w^2)*(y - 1) = 0; } assume { w > 0; } conserved { p = x; }"),
        (embedded, "on { n[0]*n[1] = 0; n[2] = 1; } conserved { p = n[1]; }"),
    ] {
        let refusals = refusals(&format!("{machine} {claimed}"));
        assert_eq!(refusals.len(), 1, "{claimed}: {refusals:?}");
        // no word of a point that is none of the machine's
        let is_position = claimed.starts_with("holonomic");
        assert!(!is_position || refusals[0].contains("could not be decided"), "{claimed}: {refusals:?}");
    }
}

/// The same constraints without factors that vanish elsewhere.
#[test]
fn claims_of_all_parts_are_proved() {
    for claimed in [
        "constraints { c: der(y) - der(z) = 0; } conserved { p = y - z; }",
        "constraints { c: w*(der(y) - der(z)) = 0; } assume { w > 0; } conserved { p = y - z; }",
        "constraints { c: der(x)^2 = der(y)^2; } conserved { p = der(x)^2 - der(y)^2; }",
        "holonomic { c: x^2 + y^2 = w^2; } conserved { p = x^2 + y^2; }",
        "holonomic { c: w*(x - y) = 0; } conserved { p = x - y; }",
        "holonomic { c: x*cos(y) = z*sin(y); } conserved { p = x*cos(y) - z*sin(y); }",
    ] {
        let refusals = refusals(&format!("{SPACE} {claimed}"));
        assert!(refusals.is_empty(), "{claimed}: {refusals:?}");
    }
}

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

/// Roots that are those of a square where the constraints hold are asked with either sign of what is squared.
#[test]
fn roots_of_squares_are_asked_with_both_signs() {
    let mass = |mass: &str| {
        format!("base {{ x, y, z }} lagrangian {{ m/2*(({mass})*(der(x)^2 + der(y)^2) + der(z)^2) }}")
    };
    for (inertia, constraints, place) in [
        ("x - sqrt(1 + y^2)", "holonomic { c: x^2 = 1 + y^2; }", "where x = sqrt(y^2 + 1)"),
        ("x + sqrt(1 + y^2)", "holonomic { c: x^2 = 1 + y^2; }", "where x = -sqrt(y^2 + 1)"),
        ("x - sqrt(1 + y)", "holonomic { c: y = x^2 - 1; }", "where x = sqrt(y + 1)"),
        ("2*x - 3 - sqrt(1 + y)", "holonomic { c: y = (2*x - 3)^2 - 1; }", "where x = "),
        ("x - w + sqrt(1 + y)", "holonomic { c: y = (x - w)^2 - 1; }", "where x = w - sqrt(y + 1)"),
    ] {
        let refusals = refusals(&format!("{} {constraints}", mass(inertia)));
        assert_eq!(refusals.len(), 1, "{inertia}: {refusals:?}");
        assert!(refusals[0].contains("singular") && refusals[0].contains(place), "{inertia}: {refusals:?}");
    }
    let row = "holonomic { c: y = x^2 - 1; } constraints { d: (x - sqrt(1 + y))*der(z) = 0; }";
    let refused = refusals(&format!("{SPACE} {row}"));
    assert!(refused.len() == 1 && refused[0].contains("`d` says nothing"), "{refused:?}");
    // neither sign makes these vanish
    for (inertia, constraints) in [
        ("3 + x^2 - sqrt(1 + y)", "holonomic { c: y = x^2 - 1; }"),
        ("2*x - sqrt(1 + y^2)", "holonomic { c: x^2 = 1 + y^2; }"),
    ] {
        let refusals = refusals(&format!("{} {constraints}", mass(inertia)));
        assert!(refusals.is_empty(), "{inertia}: {refusals:?}");
    }
}

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
        let is_solved = !claimed.contains("sin(");
        assert!(is_solved || refusals[0].contains("could not be decided"), "{claimed}: {refusals:?}");
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

const PLANE: &str = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) }";

/// Each claim is true on one branch of a root, and false on the other.
#[test]
fn claims_of_one_branch_are_refused() {
    let still = "base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2) }";
    for (machine, claimed) in [
        (PLANE, "constraints { der(x)^2 = 4; } conserved { c = x - 2*t; }"),
        (PLANE, "constraints { der(x)^2 = 1 + y^2; } conserved { c = der(x) - sqrt(1 + y^2); }"),
        (PLANE, "constraints { (der(x) + 5)^2 = 1 + y^2; } conserved { c = der(x) - sqrt(1 + y^2); }"),
        (PLANE, "constraints { (der(x) - 5)^2 = (1 + y^2)^2; } conserved { c = der(x) - y^2; }"),
        (PLANE, "constraints { der(x)^2 = 3; } conserved { c = x - sqrt(3)*t; }"),
        (PLANE, "constraints { der(x)^2 = 3; } conserved { c = x - 2*cos(pi/6)*t; }"),
        (PLANE, "constraints { der(x)^2 = 2 + 2*cos(y); } conserved { c = der(x) - 2*cos(y/2); }"),
        (PLANE, "holonomic { h: x^2 = 2*(1 + y^2)^2; } conserved { c = x - sqrt(2)*y^2; }"),
        (PLANE, "holonomic { h: x^2 = 1 + sinh(y)^2; } conserved { c = x - cosh(y); }"),
        (PLANE, "holonomic { h: x^2 = (1 + y^2)^2; } conserved { c = x - y^2; }"),
        (PLANE, "holonomic { h: x^2 = (2 + cos(y))^2; } conserved { c = x - cos(y); }"),
        (still, "holonomic { h: x^2 = 4; } conserved { c = z*(x - 2); }"),
        (
            still,
            "constraints { a: der(x)^2 = 1 + y^2; b: der(z) = (der(x) - sqrt(1 + y^2))*der(y); } conserved { c = z; }",
        ),
        (
            still,
            "holonomic { h: x^2 = (1 + y^2)^2; } constraints { b: der(z) = (x - 1 - y^2)*der(y); } conserved { c = z; }",
        ),
        (
            still,
            "holonomic { h: x^2 = 1 + y^2; } constraints { b: der(z) = (x - sqrt(1 + y^2))*der(y); } \
             conserved { c = z; }",
        ),
    ] {
        let refusals = refusals(&format!("{machine} {claimed}"));
        assert_eq!(refusals.len(), 1, "{claimed}: {refusals:?}");
        let is_said =
            ["could not be decided", "is not conserved"].into_iter().any(|word| refusals[0].contains(word));
        assert!(is_said, "{claimed}: {refusals:?}");
    }
    // what holds on both is proved
    for claimed in [
        "constraints { der(x)^2 = 4; } conserved { p = der(y); }",
        "constraints { der(x)^2 = 3; } conserved { p = der(y); }",
        "constraints { der(x)^2 = 1 + y^2; } conserved { e = der(x)^2 - y^2; }",
        "constraints { der(x)^2 + der(y)^2 = 1; } conserved { e = der(x)^2 + der(y)^2; }",
        "holonomic { h: sqrt(x^2 + y^2) + sqrt((x - w)^2 + y^2) = k; } conserved { e = der(x)^2 + der(y)^2; }",
    ] {
        let refusals = refusals(&format!("{PLANE} {claimed}"));
        assert!(refusals.is_empty(), "{claimed}: {refusals:?}");
    }
}

/// Forces that are zero where points of order one are: stops, pegs, limits, and roots with the other sign.
#[test]
fn forces_of_other_branches_are_seen() {
    let force =
        |force: &str| refusals(&format!("{PLANE} forces {{ y: {force}; }} conserved {{ p = der(y); }}"));
    for kinked in [
        "min(x + 1, 0)",
        "min(x + 10, 0)",
        "abs(x + 3) - x - 3",
        "max(1/1000 - x^2, 0)",
        "max(0.0004 - x^2 - y^2, 0)*y",
        "max(exp(-x) - 1e5, 0)",
        "sign(x^2 - 1e-7) - 1",
        "max(der(x) - 1000000, 0)",
        "k*max(-y - 1, 0)*max(-der(y), 0)",
        "max(sin(x) - 0.99999, 0)",
        "sqrt((x + 2)^2) - 2 - x",
        "sqrt((x + pi)^2) - x - pi",
        "((4 + x)^2)^(3/2) - (4 + x)^3",
        "sqrt(1 + sin(x)) - sin(x/2) - cos(x/2)",
        "sqrt((1 + cos(x/2))/2) - cos(x/4)",
        "atan(1/(x + 5)) + atan(x + 5) - pi/2",
        "atan2(1, x + 5) - atan(1/(x + 5))",
        "acos((1 - (x + 5)^2)/(1 + (x + 5)^2)) - 2*atan(x + 5)",
        "sqrt((exp(x) - 0.01)^2) - exp(x) + 0.01",
    ] {
        assert_eq!(force(kinked).len(), 1, "{kinked}");
    }
    for zero in [
        "abs(x) - max(x, -x)",
        "sqrt(x^2) - abs(x)",
        "max(x, y) + min(x, y) - x - y",
        "abs(x^2 + 1) - x^2 - 1",
        "sqrt((x^2 + 1)^2) - x^2 - 1",
        "asin(sin(atan(x))) - atan(x)",
        "sqrt(1 - sin(x)^2) - abs(cos(x))",
        "max(x^2 + 1, 0) - x^2 - 1",
    ] {
        assert!(force(zero).is_empty(), "{zero}: {:?}", force(zero));
    }
    let volume =
        refusals("base { x } lagrangian { m/2*der(x)^2 } forces { x: -k*min(der(x) + 2, 0); } volume;");
    assert_eq!(volume.len(), 1, "{volume:?}");
    let report = declared("base { x } lagrangian { m/2*der(x)^2 } forces { x: -k*min(x + 1, 0); }");
    let report = report.system().expect("well posed").report;
    assert!(!report.contains("the momentum of x") && !report.contains("the energy"), "{report}");
}

/// What is well-posed where one sign of a root is taken and ill-posed where the other is.
#[test]
fn each_part_is_well_posed() {
    let on_slope = "base { x, y } lagrangian { m/2*(2 + x)*(der(x)^2 + der(y)^2) }";
    for (machine, constraints, place) in [
        (on_slope, "holonomic { c: x^2 = 4; }", "where x = -2"),
        (on_slope, "holonomic { c: x^4 = 16; }", "where x = -16^(1/4)"),
        (on_slope, "holonomic { c: x^2 = (2 + y^2)^2; }", ""),
        (
            SPACE,
            "holonomic { c: x^2 = 4; d: (x + 2)*(y + z) = 0; }",
            "`d` follows from the constraints before it",
        ),
        (
            SPACE,
            "holonomic { c: x^2 = w^2; } constraints { d: (x - w)*(der(y) - der(z)) = 0; }",
            "where w = x",
        ),
        (
            SPACE,
            "constraints { c: der(x)^2 = 4; d: (der(x) + 2)*(der(y) - der(z)) = 0; }",
            "`d` follows from the constraints before it where x_dot = -2",
        ),
        (
            SPACE,
            "holonomic { c: x^2 = 4; d: y^2 = 9; } constraints { e: (x + y - 1)*der(z) = 0; }",
            "where x = -2 and y = 3",
        ),
        (
            "base { x, y } lagrangian { m/2*(der(x)^2 + (x + w)*der(y)^2) }",
            "holonomic { c: x^2 = w^2; } assume { w > 0; }",
            "where w = -x",
        ),
        (
            "base { x, y } lagrangian { m/2*(der(x)^2 + (x + sqrt(3))*der(y)^2) }",
            "holonomic { c: x^2 = 3; }",
            "where x = -sqrt(3)",
        ),
        (
            SPACE,
            "constraints { c: der(x)^2 = 1 + y^2; d: (der(x) + sqrt(1 + y^2))*der(z) = 0; }",
            "`d` says nothing about velocities where x_dot = -sqrt(y^2 + 1)",
        ),
    ] {
        let refusals = refusals(&format!("{machine} {constraints}"));
        if place.is_empty() {
            assert!(refusals.is_empty(), "{constraints}: {refusals:?}");
        } else {
            assert_eq!(refusals.len(), 1, "{constraints}: {refusals:?}");
            assert!(refusals[0].contains(place), "{constraints}: {refusals:?}");
        }
    }
}

/// Edges lie where they lie, not among numbers of order one.
#[test]
fn edges_far_from_order_one_are_seen() {
    for edge in [
        "sqrt((x + pi)^2)",
        "sqrt(x^2 + 2*pi*x + pi^2)",
        "sqrt((x + sqrt(2))^2)",
        "sqrt((x + 1000)^2*(1 + y^2))",
        "((x - 2e6)^2)^(3/2)",
        "sqrt(x^2 + 1e-3*x + 25e-8)",
        "sqrt((exp(x) - 0.001)^2)",
        "sqrt((x + y - 50)^2)",
    ] {
        let found =
            refusals(&format!("base {{ x, y }} lagrangian {{ m/2*(der(x)^2 + der(y)^2) - k*{edge} }}"));
        assert_eq!(found.len(), 1, "{edge}: {found:?}");
        assert!(found[0].contains("not smooth"), "{edge}: {found:?}");
    }
    for smooth in
        ["sqrt((exp(x) + 0.001)^2)", "sqrt((x^2 + 1e-9)^2)", "((x + 1000)^4)^(1/2)", "sqrt(x + 1000)"]
    {
        let found =
            refusals(&format!("base {{ x, y }} lagrangian {{ m/2*(der(x)^2 + der(y)^2) - k*{smooth} }}"));
        assert!(found.is_empty(), "{smooth}: {found:?}");
    }
}

/// Sums of squares and what touches 0: no constraint is independent where it has no slope.
#[test]
fn what_touches_zero_exerts_no_force() {
    for constraint in [
        "holonomic { c: x^2 + (y - 1)^2 + z^2 = 0; }",
        "holonomic { c: 1 - cos(x) = 0; }",
        "holonomic { c: sin(x) + cos(y) = 2; }",
        "holonomic { c: cosh(x - y) = 1; }",
        "holonomic { c: sqrt(x^2 + y^2 + 1) = 1; }",
        "holonomic { c: (x^2 + y^2 - 1)^2 + z^2 = 0; }",
        "holonomic { c: w*(x - y)^4*(1 + z^2) = 0; }",
        "constraints { c: der(x)^2 + (der(y) - 1)^2 = 0; }",
        "constraints { c: (der(x) - 2*der(y))^2 = 0; }",
        "constraints { c: der(x)^4*(1 + der(y)^2) = 0; }",
    ] {
        let found = refusals(&format!("{SPACE} {constraint}"));
        assert_eq!(found.len(), 1, "{constraint}: {found:?}");
        assert!(found[0].starts_with("`c` exerts no force"), "{constraint}: {found:?}");
    }
    for constraint in [
        "holonomic { c: x^2 + y^2 + z^2 = w^2; }",
        "holonomic { c: cosh(x - y) = 2; }",
        "holonomic { c: x^2 + y^2 = z; }",
        "constraints { c: der(x)^2 + der(y)^2 = w^2; }",
        "constraints { c: der(x)^2 + der(y)^2 = der(z)^2; }",
    ] {
        let found = refusals(&format!("{SPACE} {constraint}"));
        assert!(found.is_empty(), "{constraint}: {found:?}");
    }
}

/// Equations that hold on one sign of a root alone, or on each factor of a product, and functions that are inverted.
#[test]
fn every_way_to_hold_is_asked() {
    for constraints in [
        "constraints { der(x)^2 = 4; der(y)^2 + 1 = -der(x); }",
        "constraints { der(x)^2 = 4; der(y)^2 = der(x); }",
        "constraints { sqrt(der(x)^2 + 1) = 2; }",
        "constraints { exp(der(x)) = 1; }",
        "constraints { ln(der(x)) = der(y); }",
        "constraints { (der(x)^2 + der(y)^2 - 1)^2 = 4; }",
        "constraints { der(x)*der(y) = 0; } conserved { p = der(x)*der(y)*z; }",
        "holonomic { x^2 = 4; y^2 + 1 = -x; }",
        "holonomic { (x - 2)*(y - 1) = 0; } conserved { p = (x - 2)*(y - 1)*z; }",
        "holonomic { exp(x) = 1 + y^2; }",
        "constraints { tanh(der(x)) = 1/2; }",
        "constraints { cosh(der(x)) = 2; sinh(der(y)) = k; }",
    ] {
        let declared = declared(&format!("{SPACE} {constraints}"));
        let report = declared.system().unwrap_or_else(|why| panic!("{constraints}: {why:?}")).report;
        assert!(
            !report.contains("decided") && !report.contains("nothing was asked"),
            "{constraints}: {report}"
        );
    }
    for (constraints, place) in [
        ("holonomic { (x + 2)*(y - 1) = 0; }", "of 4 where x = -2"),
        ("holonomic { (y - 1)*(x + 2)*(x - 3) = 0; }", "of 4 where x = -2"),
        ("holonomic { y^2 = 4; x + 3 = -y/2; }", "of 5 where "),
        (
            "constraints { a: (der(x) - 2)*(der(y) - 1) = 0; b: (der(x) - 2)*der(z) = 0; }",
            "`b` follows from the constraints before it where x_dot = 2",
        ),
        (
            "constraints { a: der(x)^2 = 4; b: der(y)^2 + 1 = -der(x); c: (der(x) + 2)*der(z) = 0; }",
            "`c` follows from the constraints before it",
        ),
    ] {
        let machine = "base { x, y, z } lagrangian { m/2*((x + 2)*(x + 6)*der(x)^2 + (x + 2)*(x + 6)*der(y)^2 + (x + 2)*(x + 6)*der(z)^2) }";
        let found = refusals(&format!("{machine} {constraints}"));
        assert_eq!(found.len(), 1, "{constraints}: {found:?}");
        assert!(found[0].contains(place), "{constraints}: {found:?}");
    }
    let open = declared(&format!(
        "{SPACE} constraints {{ der(x)^2 = 4; (der(x) - 2)*der(y)^5 + der(y) = der(x) - 2; }}"
    ));
    let report = open.system().expect("one part is well posed").report;
    assert!(report.contains("the constraints may hold as well where x_dot = -2"), "{report}");
}

/// What is 0 on one part and not on another is refuted there, at a point of it.
#[test]
fn claims_are_refuted_on_other_parts() {
    let embedded = "base { a, b } basis { u } lagrangian { m/2*u^2 } on { a^2 = (1 + b^2)^2; }";
    for (sections, words) in [
        (
            format!("{embedded} anchor {{ der(a) = 2*b*u; der(b) = u; }}"),
            "the anchor does not keep this identity",
        ),
        (format!("{PLANE} constraints {{ der(x)^2 = 4; }} conserved {{ c = x - 2*t; }}"), "at x_dot = -2"),
        (
            format!("{PLANE} constraints {{ der(x)*der(y) = 0; }} conserved {{ c = y; }}"),
            "`c` is not conserved",
        ),
        (format!("{SPACE} holonomic {{ h: x^2 = 4; }} conserved {{ c = (x - 2)*y; }}"), "x = -2"),
    ] {
        let found = refusals(&sections);
        assert_eq!(found.len(), 1, "{sections}: {found:?}");
        assert!(found[0].contains(words), "{sections}: {found:?}");
    }
    let pushed =
        "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) - k*(x - 2)*y } holonomic { x^2 = 4; }";
    let pushed =
        declared(&format!("{pushed} symmetries {{ s: der(y); }}")).system().expect("s is in D").report;
    assert!(
        pushed.contains("s: y_dot; in D, L is not invariant") && !pushed.contains("momentum of s"),
        "{pushed}"
    );
    let kept = format!("{embedded} anchor {{ der(a) = 2*b*a/(1 + b^2)*u; der(b) = u; }}");
    assert!(refusals(&kept).is_empty(), "{:?}", refusals(&kept));
}

/// A line in a plane is no part of its own, and what follows on one part is said to follow there.
#[test]
fn dependent_rates_are_told_where_they_are() {
    for (constraints, words) in [
        ("a: x*y = 0; b: x*z = 0;", "`b` follows from the position constraints before it where x = 0"),
        ("a: x*y = 0; b: y*z = 0;", "`b` follows from the constraints before it where y = 0"),
        (
            "a: x*y = 0; b: x + y = 0;",
            "`a` exerts no force: its derivative vanishes where all position constraints hold",
        ),
        ("a: x*y = 0; b: 2*x*y = 0;", "`b` follows from the position constraints before it\n"),
    ] {
        let found = refusals(&format!("{SPACE} holonomic {{ {constraints} }}"));
        assert_eq!(found.len(), 1, "{constraints}: {found:?}");
        assert!(found[0].contains(words), "{constraints}: {found:?}");
    }
    let gap = refusals(&format!("{SPACE} holonomic {{ x^2 = 4; }} impacts {{ f: (x + 2)*y >= 0; }}"));
    assert!(gap.len() == 1 && gap[0].contains("where it acts: so it is where x = -2"), "{gap:?}");
    let gap = refusals(&format!("{SPACE} holonomic {{ x^2 = 4; }} impacts {{ f: (x + 3)*y >= 0; }}"));
    assert!(gap.is_empty(), "{gap:?}");
    let crossing = declared(&format!("{SPACE} holonomic {{ x^2 = y^2; z^2 = y^2; }}"));
    let report = crossing.system().expect("well posed").report;
    assert!(report.contains("where x = 0 and z = 0, or x = 0 and y = 0, or y = 0 and z = 0;"), "{report}");
}

/// Nothing leads back to what touches 0: such an identity defines no embedded base.
#[test]
fn identities_have_a_derivative_where_they_hold() {
    let still = "base { x, y, z } basis { u } anchor { der(x) = 0; der(y) = 0; der(z) = z*u; } brackets { } \
                 lagrangian { m/2*u^2 }";
    for identity in ["x^2 + y^2 = 0", "(x - y)^2 = 0", "1 - cos(x) = 0", "(x^2 + y^2 - 1)^2 = 0"] {
        let found = refusals(&format!("{still} on {{ {identity}; }}"));
        assert_eq!(found.len(), 1, "{identity}: {found:?}");
        assert!(found[0].starts_with("the derivative of this identity vanishes"), "{identity}: {found:?}");
    }
    for identity in ["x^2 + y^2 = 1", "x = y", "exp(x) = 1"] {
        let found = refusals(&format!("{still} on {{ {identity}; }}"));
        assert!(found.is_empty(), "{identity}: {found:?}");
    }
}

/// Where constraints hold on more parts than are looked at, the report says that some were not.
#[test]
fn parts_beyond_those_that_are_looked_at_are_told() {
    let text = "#[nonholonomic(
            base { x[7], y[7] }
            lagrangian { sum(i in 0..7: (der(x[i])^2 + der(y[i])^2*(2 + sqrt(1 + y[i]^2)))/2) }
            holonomic { for i in 0..7 { x[i]^2 = 1 + y[i]^2; } }
        )] struct Hyperbolas {}";
    let report = declarations(text).pop().expect("one declaration").system().expect("a system").report;
    assert!(report.contains("parts more, where nothing was asked"), "{report}");
}

/// A position constraint that touches the embedded base has no rate where it holds, as a square has none.
#[test]
fn levels_that_touch_the_base_are_refused() {
    let refusals = |position: &str| {
        let text = format!(
            "#[nonholonomic(base {{ g[3] }} basis {{ w[3] }} on {{ dot(g, g) = 1; }}
                anchor {{ for i in 0..3 {{ der(g[i]) = cross(g, w)[i]; }} }} brackets so(3) {{ w }}
                lagrangian {{ dot(w, w)/2 + w[0]^2 }} holonomic {{ {position} }}
            )] struct Top {{}}"
        );
        errors(&declarations(&text).pop().expect("one declaration").expanded())
    };
    for position in ["g[2] = 1;", "g[0] + 1 = 0;", "g[0]*g[1] = 1/2;"] {
        let refused = refusals(position);
        assert!(refused.len() == 1 && refused[0].contains("exerts no force"), "{position}: {refused:?}");
    }
    for position in ["g[2] = 1/2;", "3*g[0] + 4*g[1] = 4;", "g[0]*g[1] = 1/3;"] {
        assert_eq!(refusals(position), [""; 0], "{position}");
    }
}

/// Bars of one length may lie on one another, where fewer rates are independent: that is told. Which factor of a product is
/// meant can be written, and is asked.
#[test]
fn folded_bars_are_told() {
    let plane =
        "base { x, y, u, v, s } lagrangian { (der(x)^2 + der(y)^2 + der(u)^2 + der(v)^2 + der(s)^2)/2 }";
    let space = "base { x, y, z, u, v, r, s }
        lagrangian { (der(x)^2 + der(y)^2 + der(z)^2 + der(u)^2 + der(v)^2 + der(r)^2 + der(s)^2)/2 }";
    for machine in [
        format!(
            "{plane} holonomic {{ x^2 + y^2 = k^2; x^2 + (y - s)^2 = k^2; u^2 + v^2 = k^2; u^2 + (v - s)^2 = k^2; }}"
        ),
        // the links first, and the load upside down
        format!(
            "{plane} holonomic {{ x^2 + (y + s)^2 = k^2; u^2 + (v + s)^2 = k^2; x^2 + y^2 = k^2; u^2 + v^2 = k^2; }}"
        ),
        format!(
            "{space} holonomic {{ x^2 + y^2 + z^2 = k^2; x^2 + y^2 + (z + s)^2 = k^2; u^2 + v^2 + r^2 = k^2;
                u^2 + v^2 + (r + s)^2 = k^2; }}"
        ),
    ] {
        let machine = format!("{machine} assume {{ k > 0; }}");
        let report = declared(&machine).system().unwrap_or_else(|why| panic!("{machine}: {why:?}")).report;
        let told = report.lines().find(|line| line.contains("they hold as well where")).unwrap_or_default();
        let rest = "with 3 of the rates independent there: what is said is said of the part where 4 are";
        assert!(told.contains("s = 0") && told.contains(rest), "{report}");
    }
    let one = format!(
        "{plane} holonomic {{ x^2 + y^2 = k^2; s*(s - 2*y) = 0; u^2 + v^2 = k^2; s*(s - 2*v) = 0; }}"
    );
    let found = refusals(&one);
    assert!(
        found.len() == 1 && found[0].contains("follows from the constraints before it where s = 0"),
        "{found:?}"
    );
}

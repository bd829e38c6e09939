//! Parameters for which the equations determine no accelerations are refused by `validate`, although what divides by
//! them may have cancelled in the emitted equations.

use nh_stages::declarations;

/// What `validate` checks not to be 0.
fn checks(sections: &str) -> Vec<String> {
    let fields = "m: f64, M: f64, a: f64, b: f64, g: f64, J: [f64; 3]";
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ {fields} }}");
    let system = declarations(&text).pop().expect("one declaration").system();
    let system = system.unwrap_or_else(|errors| panic!("{sections}: {errors:?}"));
    system.parameter_checks.into_iter().map(|check| check.text).collect()
}

/// Each with all that is checked of it.
#[test]
fn validate_checks_what_makes_the_equations_singular() {
    let cases: &[(&str, &[&str])] = &[
        // a particle that is free beside one that is constrained
        (
            "base { x, y, z } lagrangian { m/2*der(x)^2 + M/2*(der(y)^2 + der(z)^2) } \
             constraints { der(z) = x*der(y); } assume { m >= 0; M > 0; }",
            &["m"],
        ),
        ("base { x } lagrangian { m/2*der(x)^2 - m*g*x } assume { m >= 0; }", &["m"]),
        ("base { x } lagrangian { m/2*der(x)^2 - m*g*x } assume { m > 0; }", &[]),
        ("base { x } lagrangian { m/2*der(x)^2 - m*g*x }", &["m"]),
        // differences and products at the edge of what is assumed
        ("base { x } lagrangian { (a - b)/2*der(x)^2 } assume { a >= b; }", &["a - b"]),
        ("base { x } lagrangian { (a - b)/2*der(x)^2 } assume { a > b; }", &[]),
        ("base { x } lagrangian { a*b/2*der(x)^2 } assume { a >= 0; b <= 1; b > -1; }", &["a", "b"]),
        ("base { x } lagrangian { (a - 1)/2*der(x)^2 } assume { a >= 1; }", &["a - 1"]),
        // two that may be 0, not both
        ("base { x } lagrangian { (m + M)/2*der(x)^2 } assume { m >= 0; M >= 0; }", &["m + M"]),
        // more rows than a determinant is written out of; what is 0 where a pivot is follows from it
        (
            "base { x[4] } lagrangian { sum(i in 0..4: der(x[i])^2)*m/2 + b*sum(i in 0..3: der(x[i])*der(x[i+1])) \
             + sum(i in 0..4: x[i]*m) } assume { m >= 0; b >= 0; m >= 2*b; }",
            &["m", "m - b^2/m", "m - b^2/m - b^2/(m - b^2/m)"],
        ),
        // what the declaration divides by, and the equations do not
        ("base { x } lagrangian { (der(x)^2 - x^2)/(2*a) }", &["a"]),
        ("base { x, y } lagrangian { der(x)^2 + der(y)^2 } constraints { der(x)/a = x*der(y)/a; }", &["a"]),
        // inertias that constraints make harmless
        (
            "base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + J[0]/2*der(th)^2 } \
             constraints { der(x) = a*der(th); } assume { m > 0; J[0] >= 0; a > 0; }",
            &[],
        ),
        // multipliers: the rows, and inertias along what is left
        (
            "base { x, y, z } lagrangian { m/2*der(x)^2 + M/2*(der(y)^2 + der(z)^2) } \
             holonomic { y^2 + z^2 = 1; } assume { m >= 0; M >= 0; }",
            &["M", "m"],
        ),
        // two that make it so in every state, though none of them does
        (
            "base { x, y } lagrangian { (m*x^2 + M*y^2)/2*der(x)^2 + der(y)^2 } assume { m >= 0; M >= 0; }",
            &["m + M"],
        ),
        (
            "base { x, y } lagrangian { (m*x^2 - M*y^2)/2*der(x)^2 + der(y)^2 } assume { m >= 0; M <= 0; }",
            &["m - M"],
        ),
        // a body without inertia
        (
            "basis { w[3] } brackets so(3) { w } lagrangian { sum(i in 0..3: J[i]*w[i]^2)/2 } \
             constraints { w[0] = 0; } assume { J[0] >= 0; J[1] >= 0; J[2] > 0; }",
            &["J[1]"],
        ),
    ];
    for (sections, expected) in cases {
        assert_eq!(&checks(sections), expected, "{sections}");
    }
}

/// Roots, logarithms and arcs of parameters have a value for some of these alone.
#[test]
fn the_report_tells_for_which_parameters_there_are_values() {
    let report = |assumed: &str| {
        let sections = "base { x } lagrangian { der(x)^2/2 - sqrt(a)*x + ln(b)*x + asin(g)*x }";
        let text = format!("#[nonholonomic({sections} {assumed})]\nstruct M {{ a: f64, b: f64, g: f64 }}");
        declarations(&text).pop().expect("one declaration").system().expect("a system").report
    };
    let told = report("");
    for condition in ["a >= 0", "b > 0", "|g| <= 1"] {
        assert!(told.contains(&format!("the equations have a value only where {condition}\n")), "{told}");
    }
    let told = report("assume { a >= 0; b > 0; g >= -1; g <= 1; }");
    assert!(!told.contains("only where"), "{told}");
}

//! Brackets that are declared in part: what the anchor determines is derived, mathematics (2).

use nh_stages::declarations;

/// What the stages make of the sections of an attribute: the lines on structure functions, or the errors.
fn structure(sections: &str) -> Result<Vec<String>, Vec<String>> {
    let source = format!("#[nonholonomic({sections})] struct S {{ m: f64 }}");
    let report = declarations(&source)[0].system()?.report;
    let lines = report.lines().skip_while(|line| *line != "Structure functions").skip(1);
    Ok(lines.take_while(|line| !line.is_empty()).map(|line| line.trim().to_owned()).collect())
}

/// A body in the plane with more sections, of which `squares` is twice the kinetic energy.
fn body(squares: &str) -> String {
    format!(
        "base {{ theta, x, y }} anchor {{
            der(theta) = omega; der(x) = v1 * cos(theta) - v2 * sin(theta);
            der(y) = v1 * sin(theta) + v2 * cos(theta);
        }} lagrangian {{ m / 2 * (omega^2 + v1^2 + v2^2 + {squares}) }}"
    )
}

#[test]
fn wheels_whose_turns_are_no_coordinates_undo_no_brackets() {
    let expected = ["[omega, v1] = v2", "[omega, v2] = -v1"];
    let without = structure(&format!("basis {{ omega, v1, v2 }} {}", body("0"))).unwrap();
    assert_eq!(without, expected);
    let with =
        structure(&format!("basis {{ left, omega, v1, right, v2 }} {}", body("left^2 + right^2"))).unwrap();
    assert_eq!(with[..2], expected);
    let taken =
        "the anchor does not see left, right: brackets and components along it that no line gives are 0";
    assert_eq!(with[2..], [taken]);
    // a body turns inside, by the brackets that are declared
    let inside =
        structure(&format!("basis {{ omega, v1, v2, w[3] }} brackets so(3) {{ w }} {}", body("dot(w, w)")))
            .unwrap();
    let of_body = ["[w[0], w[1]] = w[2]", "[w[0], w[2]] = -w[1]", "[w[1], w[2]] = w[0]"];
    assert_eq!(inside, [expected.as_slice(), &of_body].concat());
}

#[test]
fn a_line_beside_what_is_derived_is_kept_and_checked() {
    // a magnetic term: what the anchor does not see is declared, the rest is the anchor's
    let declared = "basis { omega, v1, v2, charge } brackets { [v1, v2] = 3 * charge; }";
    let found = structure(&format!("{declared} {}", body("charge^2"))).unwrap();
    assert_eq!(found[..3], ["[omega, v1] = v2", "[omega, v2] = -v1", "[v1, v2] = 3*charge"]);
    let wrong = "basis { omega, v1, v2, charge } brackets { [omega, v1] = -v2 + charge; }";
    let errors = structure(&format!("{wrong} {}", body("charge^2"))).unwrap_err();
    assert!(errors[0].contains("not a homomorphism of brackets on the pair [omega, v1]"), "{errors:?}");
    // a declared algebra gives all pairs of its sections, those that commute too
    let known = "basis { omega, v1, v2 } brackets se(2) { v1, omega, v2 }";
    let errors = structure(&format!("{known} {}", body("0"))).unwrap_err();
    assert!(errors[0].contains("not a homomorphism"), "{errors:?}");
}

#[test]
fn pairs_that_need_a_line_are_named_one_by_one() {
    let sections = "base { x, y } basis { a, b, c, d } lagrangian { m / 2 * (a^2 + b^2 + c^2 + d^2) }
        anchor { der(x) = a + b; der(y) = x * a + x^2 * d + c; }";
    let errors = structure(sections).unwrap_err().join("\n");
    assert!(errors.contains("a line is needed for [a, b], [a, d], [b, d], which"), "{errors}");
    let lines = "brackets { [a, b] = -c; [a, d] = 2 * x * c; }";
    let errors = structure(&format!("{sections} {lines}")).unwrap_err().join("\n");
    assert!(errors.contains("not derivable from the anchor: [b, d]\n"), "{errors}");
    assert!(structure(&format!("{sections} {lines} almost;")).is_ok());
}

//! Entries of vector equations that are 0 = 0 are left out, and told in the report; an equation of which nothing is left
//! is refused. And which velocities of many constraints leave out.

use nh_stages::declarations;

/// A ball on a level ground, by the velocity of the point where it touches.
const BALL: &str = "#[nonholonomic(
    base { x, y, q[4] } on { unit: dot(q, q) = 1; }
    basis { v[2], w[3] }
    anchor { der(x) = v[0]; der(y) = v[1]; der(q[0]) = -(q[1]*w[0] + q[2]*w[1] + q[3]*w[2])/2;
        der(q[1]) = (q[0]*w[0] - q[3]*w[1] + q[2]*w[2])/2; der(q[2]) = (q[3]*w[0] + q[0]*w[1] - q[1]*w[2])/2;
        der(q[3]) = (q[1]*w[1] - q[2]*w[0] + q[0]*w[2])/2; }
    lagrangian { m/2*dot(v, v) + J/2*dot(w, w) }
    constraints { ORDER }
)] struct Ball { m: f64, J: f64, r: f64 }";

/// The report of a declaration, or its errors.
fn read(source: &str) -> Result<String, String> {
    let found = declarations(source);
    found[0].system().map(|system| system.report).map_err(|errors| errors.join("\n"))
}

#[test]
fn an_entry_of_a_constraint_that_says_nothing_is_left_out() {
    for (constraints, left_out) in [
        ("contact: [v[0], v[1], 0] + cross(w, [0, 0, -r]) = 0;", "`contact[2]`"),
        ("contact: [0, v[0], v[1]] + [r*w[0] - w[0]*r, -r*w[1], r*w[0]] = 0;", "`contact[0]`"),
        ("contact: [v[0], v[1]*dot(q, q) - v[1], v[1]] + [-r*w[1], 0, r*w[0]] = 0;", "`contact[1]`"),
    ] {
        let report = read(&BALL.replace("ORDER", constraints)).expect("a rolling ball");
        let told = format!("{left_out} is left out: its sides are equal everywhere");
        assert!(report.contains(&told), "{constraints}\n{report}");
        assert!(report.contains("constraints: 2, linear in the velocities"), "{constraints}\n{report}");
    }
}

#[test]
fn an_equation_of_which_nothing_is_left_is_refused() {
    let constraints = "contact: [v[0] - r*w[1], v[1] + r*w[0]] = 0; lost: [v[0] - v[0], 0*w[2]] = 0;";
    let errors = read(&BALL.replace("ORDER", constraints)).expect_err("nothing is said");
    assert!(errors.contains("`lost[0]` says nothing: its two sides are equal"), "{errors}");
    let lost = "#[nonholonomic(base { x, y, z } holonomic { l: [x - x, 0*y] = 0; }
        lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 })] struct S {}";
    let errors = read(lost).expect_err("nothing is said");
    assert!(errors.contains("`l[0]` says nothing: its two sides are equal"), "{errors}");
    let one = lost.replace("0*y", "y - z");
    let report = read(&one).expect("one of two is left");
    assert!(report.contains("`l[0]` is left out: its sides are equal everywhere"), "{report}");
}

/// Whichever velocities of many are in constraints, those that can be eliminated are found.
#[test]
fn a_choice_among_many_velocities_is_found() {
    for row in ["der(z[j]) = der(z[j + 1])", "der(z[j]) - der(z[j + 1]) = 0"] {
        let source = format!(
            "#[nonholonomic(base {{ z[36] }} lagrangian {{ m / 2 * dot(der(z), der(z)) }}
             constraints {{ for j in 6..9 {{ row: {row}; }} }} assume {{ m > 0; }})] struct Masses {{ m: f64 }}"
        );
        let report = declarations(&source)[0].system().expect("in order").report.clone();
        assert!(report.contains("adapted, 36 coordinates and 33 velocities"), "{report}");
    }
}

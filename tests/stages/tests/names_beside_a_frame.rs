//! What names mean in the basis of a `frame`.

use nh_stages::declarations;

fn report(sections: &str) -> String {
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ m: f64, a: f64 }}");
    declarations(&text)[0].system().unwrap_or_else(|errors| panic!("{errors:?}")).report
}

/// A section of the frame takes the place of a declared one, and velocities along the others change with it.
#[test]
fn reports_say_which_velocities_keep_their_name_and_have_another_value() {
    let declared =
        "base { x, y } basis { u, v } anchor { der(x) = u; der(y) = v; } lagrangian { m/2*(u^2 + v^2) }";
    let told = |frame: &str| {
        let report = report(&format!("{declared} frame {{ {frame} }}"));
        let lines = report.lines().filter(|line| line.contains("in the basis of the frame"));
        lines.map(|line| line.trim().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(
        told("h = u + a*v;"),
        ["`v` is the velocity along v in the basis of the frame: that in the declared basis is v + a*h"]
    );
    assert!(told("h = 2*u;").is_empty());
    assert!(told("h = u + a*v; k = v - a*u;").is_empty());
    let rates =
        report("base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) } frame { roll = x_dot + a*y_dot; }");
    assert!(rates.contains("`y_dot` is the velocity along y_dot in the basis of the frame"), "{rates}");
    assert!(rates.contains("is y_dot + a*roll"), "{rates}");
}

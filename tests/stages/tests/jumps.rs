//! Roots of squares over what vanishes with them are signs, x/sqrt(x^2): what is differentiated has none, nor sections,
//! maps and claims; and reports say along which motions a claim has a value.

use nh_stages::{constant, declarations, errors, relations};

fn refusals(sections: &str) -> Vec<String> {
    let text = format!("#[nonholonomic({sections})] struct Machine {{ k: f64 }}");
    let declaration = declarations(&text).pop().expect("one declaration");
    errors(&declaration.expanded())
}

fn report(sections: &str) -> String {
    let text = format!("#[nonholonomic({sections})] struct Machine {{ k: f64 }}");
    let declaration = declarations(&text).pop().expect("one declaration");
    constant(declaration.expanded(), "REPORT")
        .unwrap_or_else(|| panic!("{sections}: {:?}", refusals(sections)))
}

const LINE: &str = "base { x } lagrangian { der(x)^2/2 - k*x^2/2 }";
const PLANE: &str = "base { x, y } lagrangian { (der(x)^2 + der(y)^2)/2 }";

/// Each of these is constant, linear or invariant on either side of a place that motions pass, and jumps there.
#[test]
fn signs_in_disguise_are_refused_wherever_they_stand() {
    for sections in [
        format!("{LINE} conserved {{ s = der(x)/sqrt(der(x)^2); }}"),
        format!("{LINE} conserved {{ s = sqrt(der(x)^2)/der(x); }}"),
        format!("{LINE} conserved {{ s = sin(x)/sqrt(x^2)*x/sin(x); }}"),
        format!("{LINE} conserved {{ s = sin(x/2)/sqrt(1 - cos(x)); }}"),
        format!("{LINE} volume {{ 2 + x/sqrt(x^2); }}"),
        format!("{PLANE} symmetries {{ s: x/sqrt(x^2)*der(y); }}"),
        format!("{PLANE} symmetries {{ s: sqrt(x^2)*der(y); }}"),
        format!("{PLANE} symmetries {{ s: der(y) up to x/sqrt(x^2); }}"),
        format!("{PLANE} hamilton_jacobi {{ der(x): x/sqrt(x^2); der(y): 0; }}"),
        format!("{PLANE} constraints {{ der(y) = x/sqrt(x^2)*der(x); }}"),
        format!("{PLANE} constraints {{ der(y) = x^3/sqrt(x^2)*der(x); }}"),
        format!("{PLANE} constraints {{ der(y) = (x + x^2)/sqrt(x^2)*der(x); }}"),
        format!("{PLANE} constraints {{ der(y) = sin(x)/sqrt(x^2)*der(x); }}"),
        format!("{PLANE} constraints {{ der(y) = x/(x^2)^(1/3)*der(x); }}"),
        "base { x, y } velocities { u = x/sqrt(x^2)*der(x); v = der(y); } lagrangian { u^2 + v^2 }".into(),
        "base { x } basis { a, b } anchor { der(x) = a; } brackets { [a, b] = x/sqrt(x^2)*b; }
         lagrangian { a^2 + b^2 }"
            .into(),
        "base { x, y } basis { a, b } anchor { der(x) = a; der(y) = b; } frame { u = a + sqrt(x^2)*b; v = b; }
         lagrangian { u^2 + v^2 }"
            .into(),
    ] {
        let refusals = refusals(&sections);
        // claims and densities may have edges
        let is_claim = sections.contains("conserved") || sections.contains("volume");
        let said = if is_claim { "is not continuous: it uses `" } else { "is not smooth: it uses `" };
        assert!(refusals.len() == 1 && refusals[0].contains(said), "{sections}: {refusals:?}");
    }
}

/// Roots of squares below, which are poles and no jumps, and even ones.
#[test]
fn poles_and_even_powers_are_no_jumps() {
    for sections in [
        "base { x } lagrangian { der(x)^2/2 + k/sqrt(x^2) }".to_owned(),
        "base { x } lagrangian { der(x)^2/2 + k*x/sqrt(x^2)^3 }".to_owned(),
        "base { x, y } lagrangian { (der(x)^2 + der(y)^2)/2 + k*x/sqrt(x^2 + y^2) }".to_owned(),
        format!("{PLANE} constraints {{ der(y) = x^2/sqrt(x^4 + 1)*der(x); }}"),
        format!("{PLANE} constraints {{ der(y) = (x + 1)/sqrt(x^2)*der(x); }}"),
        format!("{PLANE} conserved {{ s = sqrt(der(x)^2); }}"),
    ] {
        let refusals = refusals(&sections);
        assert!(refusals.is_empty(), "{sections}: {refusals:?}");
    }
}

/// A free particle that passes the origin goes on; its image under |a| turns back.
#[test]
fn maps_with_edges_are_refused() {
    let one = "#[nonholonomic(base { a } lagrangian { der(a)^2/2 })] struct One;";
    let other = "#[nonholonomic(base { x } lagrangian { der(x)^2/2 })] struct Other;";
    let algebra = "#[nonholonomic(basis { w } brackets {} lagrangian { w^2/2 })] struct Algebra;";
    let map = |written: &str| {
        let [relation] = relations(&format!("{one} {other} {algebra} {written}")).try_into().expect("one");
        let expanded = relation.expanded();
        (errors(&expanded), constant(expanded, "REPORT").unwrap_or_default())
    };
    for written in [
        "morphism! { One -> Other { base { x = sqrt(a^2); } } }",
        "morphism! { One -> Algebra { velocities { w = a/sqrt(a^2)*der(a); } } }",
        "quotient! { One -> struct Rest by { a } { velocities { w = a/sqrt(a^2)*der(a); } } }",
    ] {
        let (errors, _) = map(written);
        assert!(errors.len() == 1 && errors[0].contains("is not smooth"), "{written}: {errors:?}");
    }
    // the same where it is not 0, as the report says
    let (errors, report) = map("morphism! { One -> Other { base { x = a + 0/a; } } }");
    assert!(errors.is_empty() && !report.contains("has a value only"), "{errors:?}\n{report}");
    let (errors, report) = map("#[nonholonomic(base { y } lagrangian { exp(2*y)*der(y)^2/2 })] struct Third;
         morphism! { One -> Third { base { y = ln(a); } } }");
    assert!(errors.is_empty() && report.contains("has a value only where a > 0"), "{errors:?}\n{report}");
}

/// Neither the Jacobi identity nor impacts go along unsaid.
#[test]
fn maps_say_between_what_they_are() {
    let report = |source: &str, target: &str| {
        let written = "morphism! { Source -> Target {} }";
        let text = format!(
            "#[nonholonomic({source})] struct Source; #[nonholonomic({target})] struct Target; {written}"
        );
        let [relation] = relations(&text).try_into().expect("one");
        let expanded = relation.expanded();
        let errors = errors(&expanded);
        constant(expanded, "REPORT").unwrap_or_else(|| panic!("{source}: {errors:?}"))
    };
    let skew =
        "basis { w[3] } brackets { [w[0], w[1]] = w[2] + w[0]; [w[1], w[2]] = w[0]; [w[2], w[0]] = w[1]; }
                almost; lagrangian { dot(w, w)/2 }";
    let lie = "basis { w[3] } brackets so(3) { w } lagrangian { dot(w, w)/2 }";
    let wall = format!("{PLANE} impacts {{ wall: x >= 0 with restitution 1/2; }}");
    let (is_lie, is_almost) = ("A morphism of Lie algebroids", "A morphism of almost Lie algebroids");
    let impacts = "between impacts";
    for (source, target, said, unsaid) in [
        (skew, skew, is_almost, is_lie),
        (lie, lie, is_lie, is_almost),
        (&wall, PLANE, impacts, is_almost),
        (PLANE, PLANE, is_lie, impacts),
    ] {
        let report = report(source, target);
        assert!(report.contains(said) && !report.contains(unsaid), "{source}: {report}");
    }
}

#[test]
fn reports_say_along_which_motions_a_claim_has_a_value() {
    for (claim, said) in [
        (
            "s = atan(x/der(x)) + atan(der(x)/x)",
            "proved for motions along which it has a value: x_dot != 0 and x != 0)",
        ),
        ("s = der(x)^2 + k*x^2", "s (claimed, and proved)"),
        ("s = (der(x)^2 + k*x^2)/(1 + x^2)*(1 + x^2)", "s (claimed, and proved)"),
        (
            "s = sqrt(der(x)^2 + k*x^2)",
            "proved for motions along which it has a value: x_dot^2 + k*x^2 >= 0)",
        ),
    ] {
        let report = report(&format!("{LINE} conserved {{ {claim}; }}"));
        assert!(report.contains(said), "{claim}: {report}");
    }
    let angle =
        report("base { x } lagrangian { der(x)^2/2 - x^2/2 } conserved { s = atan2(x, der(x)) - t; }");
    assert!(angle.contains("up to whole turns of its angle"), "{angle}");
    let casimir = "base { g, x } basis { v } anchor { der(g) = 0*v; der(x) = v; } brackets {}
                   lagrangian { v^2/2 - g*x }";
    let density = report(&format!("{casimir} volume {{ g; }}"));
    assert!(density.contains("it changes its sign where g = 0"), "{density}");
    let density = report(&format!("{casimir} volume {{ 1 + g^2; }}"));
    assert!(density.contains("is kept (claimed, and proved)\n"), "{density}");
    let wall = report(&format!("{PLANE} impacts {{ wall: x >= 0 with restitution 1/2; }}"));
    assert!(wall.contains("Conserved between impacts\n"), "{wall}");
}

/// A potential that is an angle makes the energy jump where the angle does.
#[test]
fn energies_with_angles_are_kept_up_to_turns() {
    let told = report("base { x, y } lagrangian { (der(x)^2 + der(y)^2)/2 - k*atan2(y, x) }");
    assert!(told.contains("the energy, up to whole turns of its angle ("), "{told}");
    assert!(report(LINE).contains("the energy ("));
}

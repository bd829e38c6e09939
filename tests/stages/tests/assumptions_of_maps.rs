//! What the target of a map assumes has to follow from what the source does, through the parameters that the map gives.

use nh_stages::{constant, errors, relations};

/// A map between two particles of masses m and n: what the first assumes, n by m and k, and what the second assumes.
fn mapped(source: &str, parameter: &str, target: &str) -> (Vec<String>, String) {
    let text = format!(
        "#[nonholonomic(base {{ x }} lagrangian {{ ({parameter})/2*der(x)^2 }} assume {{ {source} }})]
         struct One {{ m: f64, k: f64 }}
         #[nonholonomic(base {{ x }} lagrangian {{ n/2*der(x)^2 }} assume {{ {target} }})]
         struct Other {{ n: f64 }}
         morphism! {{ One -> Other {{ parameters {{ n = {parameter}; }} base {{ x = x; }} velocities {{ x_dot = der(x); }} }} }}"
    );
    let text = text.replace("assume {  }", "").replace("velocities { x_dot = der(x); }", "");
    let [relation] = relations(&text).try_into().expect("one map");
    let expanded = relation.expanded();
    (errors(&expanded), constant(expanded, "REPORT").unwrap_or_default())
}

#[test]
fn what_the_target_assumes_follows_or_is_refused() {
    for (source, parameter, target) in [
        ("", "m", ""),
        ("m > 0;", "m", "n > 0;"),
        ("m > 2;", "m", "n > 1; n != 0;"),
        ("m > 0; k > m;", "k - m", "n > 0;"),
        ("", "1 + m^2", "n >= 1;"),
        ("m > 0; k > 0;", "m*k", "n > 0;"),
    ] {
        let (errors, report) = mapped(source, parameter, target);
        assert!(errors.is_empty(), "{source} {parameter} {target}: {errors:?}");
        assert!(!report.contains("was not decided"), "{source} {parameter} {target}: {report}");
    }
    for (source, parameter, target) in [
        ("", "m", "n > 0;"),
        ("m > 0;", "m", "n > 1;"),
        ("m > 0; k > 0;", "k - m", "n > 0;"),
        ("m > 0;", "m", "n > 0; n < 100;"),
    ] {
        let (errors, _) = mapped(source, parameter, target);
        assert!(
            errors.len() == 1 && errors[0].starts_with("`Other` assumes `n "),
            "{source} {parameter} {target}: {errors:?}"
        );
    }
    // no proof, and no numbers that break it
    let (errors, report) = mapped("m > 0;", "m^2 - m + 1/4 + exp(k)", "n != 1/7;");
    assert!(errors.is_empty(), "{errors:?}");
    assert!(report.contains("Other assumes `n != 1/7`: that this follows"), "{report}");
}

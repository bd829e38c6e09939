//! Units are asked across a map: what it gives for a quantity of the target has the unit that the target declares.

use nh_stages::{errors, relations};

/// What is wrong with a map from a particle on a line to a wheel that turns.
fn refusals(parts: &str, units_of_source: &str, units_of_target: &str) -> Vec<String> {
    let text = format!(
        "#[nonholonomic(base {{ x }} inputs {{ f }} forces {{ x: f; }} lagrangian {{ m/2*der(x)^2 }} {units_of_source})]
         struct Particle {{ m: f64, r: f64 }}
         #[nonholonomic(base {{ th }} inputs {{ q }} forces {{ th: q; }} lagrangian {{ J/2*der(th)^2 }} {units_of_target})]
         struct Wheel {{ J: f64 }}
         morphism! {{ Particle -> Wheel {{ {parts} }} }}"
    );
    let [relation] = relations(&text).try_into().expect("one map");
    errors(&relation.expanded())
}

const METRES: &str = "units { x, r = m; m = kg; }";
const RADIANS: &str = "units { th = rad; }";

#[test]
fn a_map_keeps_units() {
    let rolls = "parameters { J = m*r^2; } base { th = x/r; } inputs { q = r*f; }";
    let slips = "parameters { J = m; } base { th = x; } inputs { q = f; }";
    for (parts, source, target) in [
        (rolls, METRES, RADIANS),
        // where one of them declares none there is nothing to compare
        (slips, METRES, ""),
        (slips, "", RADIANS),
        // what is not determined is whatever it has to be
        (slips, "units { m = kg; }", ""),
        (slips, METRES, "units { th = m; }"),
    ] {
        assert_eq!(refusals(parts, source, target), [""; 0], "{parts} {source} {target}");
    }
    let refused = refusals(slips, METRES, RADIANS);
    for name in ["J", "th", "q"] {
        let said = format!("`{name}` of `Wheel`");
        assert!(refused.iter().any(|error| error.contains(&said)), "{name}: {refused:?}");
    }
    // sums inside of a map, whatever the target says
    let refused =
        refusals("parameters { J = m + r - r; } base { th = x + m - m; } inputs { q = f; }", METRES, "");
    assert_eq!(refused.len(), 2, "{refused:?}");
}

#[test]
fn a_quotient_adds_what_has_one_unit() {
    let refusals = |velocity: &str| {
        let text = format!(
            "#[nonholonomic(base {{ x, th }} lagrangian {{ m/2*der(x)^2 + J/2*der(th)^2 }} \
             units {{ x, r = m; m = kg; th = 1; }})]
             struct Roller {{ m: f64, J: f64, r: f64 }}
             quotient! {{ Roller -> struct Rest by {{ x }} {{ velocities {{ u = {velocity}; w = der(th); }} }} }}"
        );
        let [relation] = relations(&text).try_into().expect("one quotient");
        errors(&relation.expanded())
    };
    assert_eq!(refusals("der(x) - r*der(th)"), [""; 0]);
    let refused = refusals("der(x) - der(th)");
    assert_eq!(refused.len(), 1, "{refused:?}");
}

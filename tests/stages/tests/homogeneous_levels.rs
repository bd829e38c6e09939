//! Units of what stands for momenta and for velocities that are no sections: levels of `routh`, names of `orthonormal`.

use nh_stages::{declarations, errors};

fn refusals(sections: &str) -> Vec<String> {
    let text = format!("#[nonholonomic({sections})] struct Machine {{ m: f64, k: f64, mu: f64 }}");
    errors(&declarations(&text).pop().expect("one declaration").expanded())
}

#[test]
fn a_level_has_the_unit_of_its_momentum() {
    let polar = "base { r, th } lagrangian { m/2*(der(r)^2 + r^2*der(th)^2) + k/r } assume { m > 0; }";
    let labelled = format!("{polar} symmetries {{ spin: der(th); }} routh {{ spin = mu; }}");
    let cyclic = format!("{polar} routh {{ th = mu; }}");
    for (system, unit, is_right) in [
        (&cyclic, "kg m^2/s", true),
        (&cyclic, "kg m/s", false),
        (&cyclic, "J", false),
        (&labelled, "J s", true),
        (&labelled, "N s", false),
    ] {
        let refusals = refusals(&format!("{system} units {{ r = m; m = kg; mu = {unit}; }}"));
        assert_eq!(refusals.is_empty(), is_right, "{unit}: {refusals:?}");
    }
}

#[test]
fn orthonormal_velocities_are_roots_of_energies() {
    let plane = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) } orthonormal { u, v }";
    for (units, is_right) in
        [("u = J^(1/2);", true), ("u = m/s;", false), ("lagrangian = m^2/s^2; u = m/s; m = 1;", true)]
    {
        let units = if units.contains("m = 1") { units.to_owned() } else { format!("m = kg; {units}") };
        let refusals = refusals(&format!("{plane} units {{ x, y = m; {units} }}"));
        assert_eq!(refusals.is_empty(), is_right, "{units}: {refusals:?}");
    }
}

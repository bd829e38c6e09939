//! Constraints that are solved by divisions, with a part as large as the rest where the divisors vanish: what is claimed has
//! to hold there as well.

use nh_stages::{Declaration, declarations, errors};

fn declared(sections: &str) -> Declaration {
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ m: f64, k: f64 }}");
    declarations(&text).pop().expect("one declaration")
}

fn refusals(sections: &str) -> Vec<String> {
    errors(&declared(sections).expanded())
}

const SPACE: &str = "base { x, y, z, u, v, w } \
                     lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2 + der(u)^2 + der(v)^2 + der(w)^2) }";

/// x u = y z and y v = x w hold where u v = z w, and where x = y = 0 whatever the others are.
const PLANES: &str = "holonomic { a: x*u = y*z; b: y*v = x*w; }";

/// The same of rates, with s for the integral of what vanishes on one part.
const RATES: &str = "base { x, y, z, u, v, w, s } \
                     lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2 + der(u)^2 + der(v)^2 + der(w)^2 + der(s)^2) } \
                     constraints { a: der(x)*der(u) = der(y)*der(z); b: der(y)*der(v) = der(x)*der(w); \
                                   c: der(s) = der(u)*der(v) - der(z)*der(w); }";

const EMBEDDED: &str = "base { x, y, z, u, v, w } on { x*u = y*z; y*v = x*w; } basis { p, q } \
                        anchor { der(x) = 0; der(y) = 0; der(z) = p*z; der(u) = p*u; der(v) = q*v; der(w) = q*w; } \
                        brackets { } lagrangian { m/2*(p^2 + q^2) }";

#[test]
fn claims_of_the_part_that_charts_reach_are_refused() {
    for (claimed, place) in [
        (format!("{SPACE} {PLANES} conserved {{ c = u*v - z*w; }}"), "x = 0.0000, y = 0.0000"),
        (format!("{SPACE} {PLANES} conserved {{ c = m*(u*v - z*w); }}"), "x = 0.0000, y = 0.0000"),
        (format!("{EMBEDDED} conserved {{ c = (u*v - z*w)*p; }}"), "x = 0.0000, y = 0.0000"),
    ] {
        let refusals = refusals(&claimed);
        assert_eq!(refusals.len(), 1, "{claimed}: {refusals:?}");
        assert!(refusals[0].contains("`c` is not conserved") && refusals[0].contains(place), "{refusals:?}");
    }
    let refusals = refusals(&format!("{RATES} conserved {{ c = s; }}"));
    assert_eq!(refusals.len(), 1, "{refusals:?}");
}

/// Twice the same, of other coordinates: where both divisors vanish is a part of its own, and this claim is false there alone.
const TWICE: &str = "base { x, y, z, u, v, w, p, q, r, s, o, n } \
                     lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2 + der(u)^2 + der(v)^2 + der(w)^2 + der(p)^2 \
                                  + der(q)^2 + der(r)^2 + der(s)^2 + der(o)^2 + der(n)^2) } \
                     holonomic { a: x*u = y*z; b: y*v = x*w; c: q*p = r*s; d: r*o = q*n; }";

#[test]
fn parts_where_several_divisors_vanish_are_asked() {
    let product = "(u*v - z*w)*(p*o - s*n)";
    let refused = refusals(&format!("{TWICE} conserved {{ c = {product}; }}"));
    assert!(refused.len() == 1 && refused[0].contains("`c` is not conserved"), "{refused:?}");
    let proved = refusals(&format!("{TWICE} conserved {{ c = x*{product}; d = r*{product} + x*u - y*z; }}"));
    assert!(proved.is_empty(), "{proved:?}");
}

#[test]
fn claims_of_both_parts_are_proved() {
    for claimed in [
        format!("{SPACE} {PLANES} conserved {{ c = x*(u*v - z*w); d = x*u - y*z; }}"),
        format!("{EMBEDDED} conserved {{ c = x*(u*v - z*w); d = x*y; }}"),
    ] {
        let refusals = refusals(&claimed);
        assert!(refusals.is_empty(), "{claimed}: {refusals:?}");
    }
}

/// What vanishes on one part alone does not follow from the others.
#[test]
fn what_follows_on_one_part_does_not_follow() {
    let refusals = refusals(&format!("{SPACE} holonomic {{ a: x*u = y*z; b: y*v = x*w; c: u*v = z*w; }}"));
    assert_eq!(refusals.len(), 1, "{refusals:?}");
    let said = "`c` follows from the position constraints before it, but not where x = 0 and y = 0";
    assert!(refusals[0].contains(said), "{refusals:?}");
}

//! Everything that can be asked for, beside levels of momenta: derived, or refused in the field's words.

use super::{messages, model};
use crate::expand::nonholonomic;
use nonholonomic_core::model::Request;

/// A particle in a plane under a central force, turned about the origin: x ẏ − y ẋ determines neither
/// velocity everywhere. A claim holds on the level alone.
const TURNED: &str = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) - k/2*(x^2 + y^2) }
    symmetries { turn: x*der(y) - y*der(x); } routh { turn = mu; } outputs { r = x^2 + y^2; }
    conserved { amended = m/2*(x*der(x) + y*der(y))^2/(x^2 + y^2) + mu^2/(2*m*(x^2 + y^2)) + k/2*(x^2 + y^2); }";

/// Declarations with levels: kept like constraints, by the user's choice, with constraints and a coordinate
/// that leaves the state, over an embedded base, several of them with the time.
const SYSTEMS: [(&str, &str); 5] = [
    (TURNED, ""),
    (TURNED, "independent { der(y) }"),
    (
        "base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2) } routh { y = mu; }
         constraints { slope: der(z) = x*der(x); } outputs { s = der(y); }
         conserved { w = (1 + x^2)*der(x)^2 + k; }",
        "",
    ),
    (
        "base { g[3] } basis { w[3] } on { dot(g, g) = 1; }
         anchor { der(g[0]) = g[1]*w[2] - g[2]*w[1]; der(g[1]) = g[2]*w[0] - g[0]*w[2]; der(g[2]) = g[0]*w[1] - g[1]*w[0]; }
         brackets so(3) { w[0], w[1], w[2] } lagrangian { m/2*(w[0]^2 + w[1]^2) + k/2*w[2]^2 - g[2] }
         symmetries { axial: w[2]; } routh { axial = mu; } outputs { s = g[2]; }
         conserved { upright = m*(g[0]*w[0] + g[1]*w[1]) + mu*g[2]; }",
        "",
    ),
    (
        "base { a, x, y } routh { x = mu; y = 2*mu; } outputs { s = der(a); }
         lagrangian { m/2*(der(a)^2 + der(x)^2 + der(y)^2) + sin(t)*der(x)*der(y)/3 + k*a*der(x)*der(a) }
         conserved { p = m*der(x) + sin(t)*der(y)/3 + k*a*der(a); }",
        "assume { m > 1; }",
    ),
];

/// What is derived on levels; where there are no constraints, less what belongs to these.
const DERIVED: [&str; 17] = [
    "latex",
    "power",
    "c",
    "jacobian",
    "jacobian_product",
    "adjoint_product",
    "sparse_jacobian",
    "explain",
    "taylor",
    "parameter_jacobian",
    "prepared",
    "angle_cache",
    "momenta",
    "gibbs_appell",
    "invariants",
    "multipliers",
    "reactions",
];

#[test]
fn everything_is_derived_or_refused() {
    for (attribute, more) in SYSTEMS {
        for (word, _) in Request::WORDS {
            let attribute = format!("{attribute} {more} emit {{ {word} }}");
            let item = "struct S { m: f64, k: f64, mu: f64 }";
            let tokens = nonholonomic(attribute.parse().unwrap(), item.parse().unwrap());
            let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
            let error =
                text.split_once("compile_error! {").map(|(_, rest)| rest.lines().nth(1).unwrap_or(rest));
            let expected = match word {
                "multipliers" | "reactions" if !attribute.contains("constraints {") => {
                    Some("without constraints")
                }
                _ if DERIVED.contains(&word) => None,
                "return_jacobian" => Some("there is no return to position constraints"),
                "gyroscopic" => Some("puts the momentum of `"),
                _ => Some("this is not derived on a level of a momentum"),
            };
            match (error, expected) {
                (None, None) => {}
                (Some(error), Some(expected)) => assert!(error.contains(expected), "{attribute}\n{error}"),
                (error, _) => panic!("{attribute}\n{error:?}"),
            }
        }
    }
}

/// The formulation in the report of a declaration, or the error.
fn outcome(attribute: &str) -> String {
    let item = "struct S { m: f64, k: f64, mu: f64 }";
    let tokens = nonholonomic(attribute.parse().unwrap(), item.parse().unwrap());
    let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
    let line = |marker: &str| {
        let (_, rest) = text.split_once(marker)?;
        Some(rest.split("\\n").next().unwrap_or_default().trim().to_owned())
    };
    line("compile_error! {").or(line("formulation: ")).unwrap_or(text)
}

#[test]
fn which_velocities_the_levels_determine() {
    let plane =
        "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) } symmetries { turn: x*der(y) - y*der(x); }
                 routh { turn = mu; }";
    let cases = [
        (plane.to_owned(), "projected"),
        (
            format!("{plane} formulation {{ adapted }}"),
            "no choice of velocities on the levels is valid everywhere",
        ),
        (format!("{plane} independent {{ der(x) }}"), "adapted, 2 coordinates and 1 velocity"),
        (
            format!("{plane} independent {{ der(x) }}"),
            "the levels are solved for `y_dot`, which breaks down where x = 0",
        ),
        (format!("{plane} independent {{ der(x), der(y) }}"), "projected"),
    ];
    for (attribute, expected) in cases {
        let found = outcome(&attribute);
        assert!(found.contains(expected), "{attribute}\n{found}");
    }
}

#[test]
fn vectors_of_momenta_are_on_vectors_of_levels() {
    let level = |routh: &str| {
        let symmetries = "symmetries { shift: der(q[0..2]); } lagrangian { m/2*dot(der(q), der(q)) }";
        model(
            &format!("base {{ q[3] }} {symmetries} routh {{ {routh} }}"),
            "struct S { m: f64, mu: [f64; 2], k: f64 }",
        )
        .routh
        .iter()
        .map(|level| level.symmetry.clone())
        .collect::<Vec<_>>()
    };
    assert_eq!(level("shift = mu;"), ["shift_0", "shift_1"]);
    assert_eq!(level("shift = [k, 2 * k]; q[2] = 0;"), ["shift_0", "shift_1", "q[2]"]);
    assert_eq!(level("q = [mu[0], mu[1], k];"), ["q[0]", "q[1]", "q[2]"]);
    assert_eq!(level("q = 0;"), ["q[0]", "q[1]", "q[2]"]);
    let refused = messages(
        "base { q[3] } lagrangian { m/2*dot(der(q), der(q)) } routh { q = m; }",
        "struct S { m: f64 }",
    );
    assert_eq!(
        refused,
        ["the two sides have different shapes\non the left is a vector of 3 entries, on the right a number"]
    );
}

//! Ceilings on the work of machines with trailers, wheels and a pendulum: growth is a failing test.

use nonholonomic_core::program::Cost;
use proc_macro2::TokenStream;
use syn::parse_quote;

use super::constants::{Declaration, compiled, derivative, tractor};

/// The operations of the derivative.
fn operations(declaration: &Declaration) -> usize {
    Cost::of(&derivative(&compiled(declaration).expect("regular"))).operations()
}

/// The tractor whose trailers are all alike.
fn alike(trailers: usize) -> Declaration {
    let (attribute, _) = tractor(trailers);
    let mut text = attribute.to_string();
    for name in ["m", "J", "d"] {
        for index in ["0", "i", "j", "i + 1", "i+1"] {
            for indexed in [format!("{name} [{index}]"), format!("{name}[{index}]")] {
                text = replaced(&text, &indexed, name);
            }
        }
    }
    let attribute: TokenStream = text.parse().expect("tokens");
    (
        attribute,
        parse_quote!(
            struct Tractor {
                m: f64,
                J: f64,
                d: f64,
                a: f64,
            }
        ),
    )
}

/// A text with other words in place of some, of which they are not the ends of longer ones.
fn replaced(text: &str, words: &str, other: &str) -> String {
    let mut result = String::new();
    let mut rest = text;
    while let Some(position) = rest.find(words) {
        let (before, after) = rest.split_at(position);
        let is_end = before.ends_with(|last: char| last.is_alphanumeric() || last == '_');
        result.extend([before, if is_end { words } else { other }]);
        rest = &after[words.len()..];
    }
    result + rest
}

/// An expert's recursion takes 17 operations and a sine with its cosine for each trailer: here one more, and
/// one where a long sum is taken in halves.
#[test]
fn a_trailer_takes_one_operation_more_than_by_hand() {
    let costs = [2, 5].map(|trailers| operations(&tractor(trailers)));
    assert!(costs[1] - costs[0] <= 3 * (18 + 1) + 1, "{costs:?}");
    assert!(costs[0] <= 43, "{costs:?}");
}

/// Equal masses do not hide which velocities are those of one point.
#[test]
fn trailers_that_are_alike_are_no_dearer() {
    for trailers in [2, 3, 6] {
        let (same, different) = (operations(&alike(trailers)), operations(&tractor(trailers)));
        assert!(same <= different, "{trailers} trailers: {same} operations, {different} if they differ");
    }
}

/// A momentum that a bracket turns is computed once: a satellite with three wheels takes less than in
/// differences of its moments of inertia.
#[test]
fn momenta_are_named_where_brackets_turn_them() {
    let attribute = "basis { w[3], s[3] }
        brackets { [w[0], w[1]] = -w[2]; [w[1], w[2]] = -w[0]; [w[2], w[0]] = -w[1]; }
        lagrangian { sum(i in 0..3: I[i] / 2 * w[i]^2 + J[i] / 2 * (w[i] + s[i])^2) }
        inputs { torque[3] } forces { for i in 0..3 { s[i]: torque[i]; } }";
    let item = "struct Satellite { I: [f64; 3], J: [f64; 3] }";
    let satellite = (attribute.parse().expect("tokens"), item.parse().expect("tokens"));
    assert!(operations(&satellite) <= 27);
}

/// A rolling disk that tilts: the inertia C + mR² about the contact is a factor of the determinant of its pair of
/// equations, and divides no more for one unknown's going by the other.
#[test]
fn a_pivot_that_the_determinant_has_makes_one_unknown_short() {
    let attribute = "base { x, y, th, phi, psi }
        lagrangian {
            let xc = der(x) + R*(cos(phi)*der(phi)*sin(th) + sin(phi)*cos(th)*der(th));
            let yc = der(y) - R*(cos(phi)*der(phi)*cos(th) - sin(phi)*sin(th)*der(th));
            m/2*(xc^2 + yc^2 + (R*sin(phi)*der(phi))^2) + A/2*(der(phi)^2 + (der(th)*cos(phi))^2)
                + C/2*(der(psi) + der(th)*sin(phi))^2 - m*g*R*cos(phi)
        }
        constraints { der(x) = R*cos(th)*der(psi); der(y) = R*sin(th)*der(psi); }";
    let item = "struct Disk { m: f64, A: f64, C: f64, R: f64, g: f64 }";
    let system = nonholonomic_core::compile::compile(super::model(attribute, item)).expect("regular");
    let found = Cost::of(&derivative(&system)).operations();
    assert!(found <= 30, "{found} operations");
    let checks: Vec<&str> = system.parameter_checks.iter().map(|check| check.text.as_str()).collect();
    assert_eq!(checks, ["A", "A + R^2*m", "C + R^2*m"]);
}

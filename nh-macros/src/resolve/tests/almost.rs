//! Almost Lie algebroids: what rests on the structure equations is refused where they are broken.

use crate::expand::nonholonomic;
use nonholonomic_core::model::Request;

/// The errors of a declaration, or nothing.
fn errors(attribute: &str) -> Vec<String> {
    let tokens = nonholonomic(attribute.parse().unwrap(), "struct S { m: f64, k: f64 }".parse().unwrap());
    let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
    let errors = text.split("compile_error! {").skip(1);
    errors.map(|rest| rest.lines().nth(1).unwrap_or(rest).trim().to_owned()).collect()
}

#[test]
fn what_is_asked_for_is_derived_or_refused_in_words() {
    let over_a_base = "base { x, y, q } basis { v, w } brackets { [w, v] = k*w + x*v; } almost;
        anchor { der(x) = v*cos(q); der(y) = v*sin(q); der(q) = w; }
        lagrangian { m/2*(v^2 + w^2) - k/2*x^2 } outputs { s = v^2; } conserved { e = m*(v^2 + w^2) + k*x^2; }";
    let algebra = "basis { a, b, c } brackets { [a, b] = c; [b, c] = a + b; [c, a] = b + c; } almost;
        lagrangian { m/2*a^2 + b^2 + k*c^2 } outputs { s = a; } conserved { e = m*a^2 + 2*b^2 + 2*k*c^2; }";
    let refused = |attribute: &str| -> Vec<&str> {
        let words = Request::WORDS.map(|(word, _)| word).into_iter();
        words.filter(|word| !errors(&format!("{attribute} emit {{ {word} }}")).is_empty()).collect()
    };
    assert_eq!(
        refused(over_a_base),
        [
            "return_jacobian",
            "multipliers",
            "reactions",
            "momenta",
            "gyroscopic",
            "splitting",
            "symmetric_projection",
            "volume",
            "leapfrog",
            "rattle",
            "euler_poincare_suslov"
        ]
    );
    let of_algebra = errors(&format!("{algebra} emit {{ euler_poincare_suslov }}"));
    assert!(of_algebra[0].contains("break the Jacobi identity"), "{of_algebra:?}");
    assert!(
        errors(&format!("{algebra} emit {{ hamiltonian, bracket, discrete_gradient, connection }}"))
            .is_empty()
    );
}

#[test]
fn brackets_that_are_not_declared_have_to_exist() {
    let found = errors(
        "base { x, y, z } basis { a, b } anchor { der(x) = a; der(y) = b; der(z) = x*b; } almost;
         lagrangian { m/2*(a^2 + b^2) }",
    );
    assert!(found[0].contains("their vector fields do not close"), "{found:?}");
    assert!(found[0].contains("declare the `brackets` of an almost Lie algebroid"), "{found:?}");
}

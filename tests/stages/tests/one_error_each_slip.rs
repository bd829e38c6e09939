//! One slip is one error: what follows from it is not reported as well.

use nh_stages::{declarations, errors};

const BODY: &str = "base { R[3][3], p[3] } on { transpose(R) * R = identity(3); } basis { w[3], v[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } for i in 0..3 { der(p[i]) = dot(R[i], v); } }
    brackets se(3) { w, v } lagrangian { dot(w, I * w) + dot(v, v) }";

const SLEIGH: &str = "base { x, y, theta } basis { v, side, omega }
    anchor { der(x) = v * cos(theta) - side * sin(theta); der(y) = v * sin(theta) + side * cos(theta); der(theta) = omega; }
    brackets se(2) { omega, v, side } lagrangian { v^2 + side^2 + c * omega^2 } constraints { side = 0; }
    emit { multipliers, reactions }";

const GRAVITY: &str = "base { g1, g2, g3 } basis { w1, w2, w3 }
    anchor { der(g1) = g2 * w3 - g3 * w2; der(g2) = g3 * w1 - g1 * w3; der(g3) = g1 * w2 - g2 * w1; }
    brackets { [w1, w2] = w3; [w2, w3] = w1; [w3, w1] = w2; } lagrangian { w1^2 + 2 * w2^2 + 3 * w3^2 - c * g3 }";

const CYLINDER: &str =
    "base { phi, z } basis { vphi, vz, wr, wt, wz } anchor { der(phi) = vphi; der(z) = vz; }
    brackets { [wr, wt] = -wz; [wt, wz] = -wr; [wz, wr] = -wt; [vphi, wr] = wt; [vphi, wt] = -wr; }
    lagrangian { vphi^2 + vz^2 + wr^2 + wt^2 + wz^2 }";

const WHEEL: &str = "base { x, phi, psi } lagrangian { der(x)^2 + c * der(phi)^2 + der(psi)^2 }
    frame { roll = phi_dot + c * x_dot; spin = psi_dot; } distribution { roll, spin } track { roll, phi }";

const LEVEL: &str = "base { x, y } lagrangian { der(x)^2 + c * der(y)^2 - x^2 } symmetries { turn: c * der(y); } routh { turn = c; }";

const FIXED_LEVEL: &str = "base { x, y } lagrangian { der(x)^2 + c * der(y)^2 - x^2 } routh { y = c; }";

/// The messages about a declaration.
fn told(sections: &str) -> Vec<String> {
    let text = format!("#[nonholonomic({sections})] struct S {{ c: f64, I: [[f64; 3]; 3] }}");
    errors(&declarations(&text)[0].expanded())
}

#[test]
fn what_follows_from_a_slip_is_not_told() {
    for (right, slip, wrong, what) in [
        (
            BODY,
            "cross(R[i], w)",
            "cross(w, R[i])",
            "with the other sign of the right-hand side in this line it is one",
        ),
        (
            SLEIGH,
            "sin(theta) + side",
            "sin(theta) - side",
            "with the other sign of `v` or of `side` in this line it is one",
        ),
        (
            SLEIGH,
            "= v * cos(theta)",
            "= -v * cos(theta)",
            "with the other sign of `v` or of `side` in this line it is one",
        ),
        (SLEIGH, "constraints { side = 0; }", "", "there are no multipliers without constraints"),
        (SLEIGH, "basis { v, side, omega }", "", "`anchor` and `brackets` without `basis`"),
        (
            GRAVITY,
            "g2 * w3 - g3 * w2",
            "g2 * w3 + g3 * w2",
            "with the other sign of `w2` in this line it is one",
        ),
        (GRAVITY, "[w2, w3] = w1;", "[w2, w3] = -w1;", "on the pair [w2, w3]"),
        (GRAVITY, "[w3, w1] = w2;", "[w3, w1] = w1;", "on the pair [w1, w3]"),
        (CYLINDER, "[wz, wr] = -wt;", "", "enter into it, and into another sum that should be 0"),
        (
            CYLINDER,
            "[vphi, wr] = wt;",
            "[vphi, wr] = -wt;",
            "enter into it, and into another sum that should be 0",
        ),
        (WHEEL, "c * x_dot", "c * x_dott", "unknown name `x_dott`"),
        (WHEEL, "spin = psi_dot;", "spin = psi_dot; roll = psi_dot;", "`roll` is defined twice"),
        (LEVEL, "c * der(y); }", "cc * der(y); }", "unknown name `cc`"),
        (FIXED_LEVEL, "base { x, y }", "base { x, yy }", "there is no base coordinate `y`"),
    ] {
        assert_eq!(told(right), [""; 0], "{right}");
        let declared = right.replacen(slip, wrong, 1);
        assert_ne!(declared, right);
        let told = told(&declared);
        assert!(told.len() == 1 && told[0].contains(what), "{declared}:\n{}", told.join("\n"));
    }
}

#[test]
fn two_slips_are_two_errors() {
    let declared = GRAVITY.replacen("[w2, w3] = w1;", "[w2, w3] = -w1;", 1).replacen("= w2;", "= -w2;", 1);
    assert_eq!(told(&declared).len(), 2, "{:?}", told(&declared));
}

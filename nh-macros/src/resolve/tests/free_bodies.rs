//! The rates of attitudes that velocities of the state turn: these velocities, and no derivatives.

use super::model;

const BODY: &str = "struct S { M: f64, I: [f64; 3] }";

const QUATERNION: &str = "base { p[3], q[4] } on { dot(q, q) = 1; } basis { w[3], v[3] }
    anchor {
        der(q) = [
            -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2, (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2,
            (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2, (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2
        ];
        der(p) = v;
    }
    let R = [
        [1 - 2 * (q[2]^2 + q[3]^2), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])],
        [2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1]^2 + q[3]^2), 2 * (q[2] * q[3] - q[0] * q[1])],
        [2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1]^2 + q[2]^2)]
    ];";

const ANGLES: &str = "base { p[3], e[3] } let R = rot_z(e[2]) * rot_y(e[1]) * rot_x(e[0]);
    velocities { w = body_rate(R); v = der(p); }";

const MATRIX: &str = "base { p[3], R[3][3] } on { transpose(R) * R = identity(3); } basis { w[3], v[3] }
    anchor { der(R) = R * hat(w); der(p) = v; }";

#[test]
fn the_energy_of_a_free_body_is_that_of_its_velocities() {
    for attitude in [QUATERNION, ANGLES, MATRIX] {
        let wanted = model(&format!("{attitude} lagrangian {{ dot(w, diag(I) * w) / 2 + 0 * M }}"), BODY);
        let found = model(&format!("{attitude} lagrangian {{ kinetic(0, I, p, R) + 0 * M }}"), BODY);
        let text = |model: &nonholonomic_core::model::Model| model.graph.text(model.lagrangian.value);
        assert_eq!(text(&found), text(&wanted), "{attitude}");
    }
}

/// What turns otherwise than its velocities say is differentiated: another scale, another order of the angles.
#[test]
fn other_attitudes_are_differentiated() {
    let wrong = [
        QUATERNION
            .replace("q[1] * w[0] + q[2]", "2 * q[1] * w[0] + q[2]")
            .replace("on { dot(q, q) = 1; }", ""),
        ANGLES.replace("velocities { w = body_rate(R)", "velocities { w = body_rate(transpose(R))"),
    ];
    for attitude in wrong {
        let found = model(&format!("{attitude} lagrangian {{ kinetic(0, I, p, R) + 0 * M }}"), BODY);
        assert!(found.graph.text(found.lagrangian.value).len() > 100, "{attitude}");
    }
}

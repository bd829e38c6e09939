//! The derived equations of a few systems against formulas worked out by hand.

use crate::systems;

use nonholonomic_core::compile::compile;
use nonholonomic_core::id::Id;
use nonholonomic_core::model::{Formulation, Model};
use nonholonomic_core::program::{interpret, schedule};
use nonholonomic_core::system::System;
use nonholonomic_core::violation::Law;

/// The derivative of a system at named values.
fn derivative(system: &System, values: &[(&str, f64)]) -> Vec<f64> {
    let graph = &system.model.graph;
    interpret(&schedule(graph, &system.derivative), |symbol| {
        let name = &graph.symbols()[symbol];
        values.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("no value for {name}")).1
    })
}

fn compiled(model: Model) -> System {
    compile(model).unwrap_or_else(|violations| panic!("{violations:#?}"))
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-13 * (1.0 + b.abs()), "{found:?} is not {expected:?}");
    }
}

#[test]
fn sleigh_keeps_two_velocities() {
    let system = compiled(systems::sleigh());
    assert_eq!(system.formulation, Formulation::Adapted);
    assert_eq!(system.state_velocities.len(), 2);
    let (m, j, a, b, omega, v1, theta) = (1.3, 0.7, 0.4, 0.0, 0.9, -1.1, 0.6f64);
    let values =
        [("m", m), ("J", j), ("a", a), ("b", b), ("omega", omega), ("v1", v1), ("theta", theta), ("t", 0.0)];
    let found = derivative(&system, &values);
    // CLMM section 6.1 with b = 0
    let omega_dot = -m * a * omega * v1 / (j + m * a * a);
    let v1_dot = a * omega * omega;
    assert_close(&found, &[omega, v1 * theta.cos(), v1 * theta.sin(), omega_dot, v1_dot]);
}

#[test]
fn a_knife_edge_on_the_plane_is_projected_and_agrees() {
    let reduced = compiled(systems::sleigh());
    let full = compiled(systems::sleigh_on_the_plane());
    assert_eq!(full.formulation, Formulation::Projected);
    assert!(full.report.contains("(nonholonomic)"), "{}", full.report);
    for theta in [0.0, 0.6, std::f64::consts::FRAC_PI_2, 3.0] {
        let (omega, v1) = (0.9, -1.1);
        let common = [("m", 1.3), ("J", 0.7), ("a", 0.4), ("b", 0.2), ("theta", theta), ("t", 0.0)];
        let mut values = common.to_vec();
        values.extend([("omega", omega), ("v1", v1)]);
        let small = derivative(&reduced, &values);
        let (s, c) = f64::sin_cos(theta);
        let mut values = common.to_vec();
        values.extend([("theta_dot", omega), ("x_dot", v1 * c), ("y_dot", v1 * s)]);
        let large = derivative(&full, &values);
        let expected =
            [omega, v1 * c, v1 * s, small[3], small[4] * c - v1 * omega * s, small[4] * s + v1 * omega * c];
        assert_close(&large, &expected);
    }
}

#[test]
fn robot_eliminates_the_last_declared_first() {
    let system = compiled(systems::robot());
    let names: Vec<&str> =
        system.state_velocities.iter().map(|s| system.model.graph.symbols()[*s].as_str()).collect();
    assert_eq!(names, ["theta_dot", "psi1_dot"]);
    let checks: Vec<&str> = system.parameter_checks.iter().map(|check| check.text.as_str()).collect();
    // the pivot, then the determinant of the mass matrix
    assert_eq!(checks, ["R", "2*J2*(J*R^2 + c^2*(2*J2 + m1*R^2)) + m1*J*R^4"]);
}

#[test]
fn robot_keeps_its_wheels_when_asked() {
    let mut model = systems::robot();
    let wheels = [3, 4].map(|index| model.sections[Id::from_index(index)].symbol);
    model.independent = Some(wheels.map(|symbol| (symbol, systems::origin())).to_vec());
    let system = compiled(model);
    assert_eq!(system.formulation, Formulation::Adapted);
    let names: Vec<&str> =
        system.state_velocities.iter().map(|s| system.model.graph.symbols()[*s].as_str()).collect();
    assert_eq!(names, ["psi1_dot", "psi2_dot"]);
    let checks: Vec<&str> = system.parameter_checks.iter().map(|check| check.text.as_str()).collect();
    assert_eq!(checks, ["c", "2*J2 + m1*R^2", "2*J2 + J*R^2/c^2"]);
    // mathematics section 9: psi1'' = −U (psi2' − psi1')(P psi2' + S psi1')/(P² − S²)
    let (m0, m1, l, j, j2, c, r) = (0.8, 1.9, 0.3, 0.6, 0.05, 0.4, 0.25);
    let (d1, d2, theta) = (1.2, -0.7, 0.9);
    let p = r * r / (4.0 * c * c) * (m1 * c * c + j) + j2;
    let s = r * r / (4.0 * c * c) * (m1 * c * c - j);
    let u = r * r * r / (4.0 * c * c) * m0 * l;
    let values = [
        ("m0", m0),
        ("m1", m1),
        ("l", l),
        ("J", j),
        ("J2", j2),
        ("c", c),
        ("R", r),
        ("theta", theta),
        ("psi1_dot", d1),
        ("psi2_dot", d2),
        ("t", 0.0),
    ];
    let found = derivative(&system, &values);
    let determinant = p * p - s * s;
    let expected1 = -u * (d2 - d1) * (p * d2 + s * d1) / determinant;
    let expected2 = u * (d2 - d1) * (p * d1 + s * d2) / determinant;
    assert_close(&found[5..], &[expected1, expected2]);
}

#[test]
fn veselova_is_finite_at_the_poles() {
    let system = compiled(systems::veselova());
    assert_eq!(system.formulation, Formulation::Projected);
    for g in [[0.6, 0.0, 0.8], [0.0, 0.0, 1.0], [0.48, -0.8, 0.36], [1.0, 0.0, 0.0]] {
        // w orthogonal to g
        let seed = [0.3, -0.7, 0.5];
        let along: f64 = g.iter().zip(&seed).map(|(a, b)| a * b).sum();
        let w: Vec<f64> = g.iter().zip(&seed).map(|(g, s)| s - along * g).collect();
        let inertia = [1.1, 2.3, 1.7];
        let mut values = vec![("t", 0.0)];
        values.extend(["g1", "g2", "g3"].into_iter().zip(g));
        values.extend(["w1", "w2", "w3"].into_iter().zip(w.iter().copied()));
        values.extend(["I1", "I2", "I3"].into_iter().zip(inertia));
        let found = derivative(&system, &values);
        // I w' = I w × w + λ g with g·w' = 0 (CLMM (6.12), V = 0; g' = g × w is orthogonal to w)
        let cross = |a: &[f64], b: &[f64]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let momentum: Vec<f64> = inertia.iter().zip(&w).map(|(i, w)| i * w).collect();
        let torque = cross(&momentum, &w);
        let top: f64 = (0..3).map(|i| g[i] * torque[i] / inertia[i]).sum();
        let bottom: f64 = (0..3).map(|i| g[i] * g[i] / inertia[i]).sum();
        let expected: Vec<f64> = (0..3).map(|i| (torque[i] - top / bottom * g[i]) / inertia[i]).collect();
        assert_close(&found[..3], &cross(&g, &w));
        assert_close(&found[3..], &expected);
    }
}

#[test]
fn affine_constraints_keep_the_drift_in_every_term() {
    let system = compiled(systems::ball_on_rotating_table());
    assert_eq!(system.formulation, Formulation::Adapted);
    let (r, k2, omega) = (0.7, 0.3, 1.9);
    let (x, y, dx, dy) = (0.4, -1.2, 0.8, 0.5);
    // the state keeps dx, dy and w1..w3 less two: ζ̈ = iΩ k²/(k² + r²) ζ̇ in every choice
    let (w1, w2, w3) = ((omega * x - dy) / r, (dx + omega * y) / r, 0.6);
    let values = [
        ("r", r),
        ("k2", k2),
        ("Omega", omega),
        ("x", x),
        ("y", y),
        ("dx", dx),
        ("dy", dy),
        ("w1", w1),
        ("w2", w2),
        ("w3", w3),
        ("t", 0.0),
    ];
    let rate = omega * k2 / (k2 + r * r);
    let (ddx, ddy) = (-rate * dy, rate * dx);
    let all = [ddx, ddy, (omega * dx - ddy) / r, (ddx + omega * dy) / r, 0.0];
    let mut expected = vec![dx, dy];
    for (section, value) in system.model.sections.iter().zip(all) {
        if system.state_velocities.contains(&section.symbol) {
            expected.push(value);
        }
    }
    assert_close(&derivative(&system, &values), &expected);
}

#[test]
fn the_moving_energy_of_the_rotating_table_is_found() {
    let report = compiled(systems::ball_on_rotating_table()).report;
    assert!(report.contains("moving energy E - xi.p with xi = (-Omega*y)*dx + (Omega*x)*dy"), "{report}");
    assert!(!report.contains("the energy (CLMM"), "{report}");
}

#[test]
fn nonlinear_constraints_by_chetaev() {
    // two points with parallel velocities: homogeneous, so that the energy is conserved
    let system = compiled(systems::parallel_velocities());
    assert_eq!(system.formulation, Formulation::Projected);
    assert!(system.report.contains("nonlinear in the velocities"), "{}", system.report);
    assert!(system.report.contains("the energy"), "{}", system.report);
    // at m = 1 and g = 0 ... with gravity on the second point only: W ẏ = Υ + Jᵀλ, J ẏ = 0
    let v = [0.6, 0.9, -0.4, -0.6];
    let values =
        [("x1_dot", v[0]), ("y1_dot", v[1]), ("x2_dot", v[2]), ("y2_dot", v[3]), ("g", 9.81), ("t", 0.0)];
    let found = derivative(&system, &values);
    // φ = ẋ₁ẏ₂ − ẋ₂ẏ₁
    let j = [v[3], -v[2], -v[1], v[0]];
    let force = [0.0, 0.0, 0.0, -9.81];
    let norm: f64 = j.iter().map(|x| x * x).sum();
    let lambda = -j.iter().zip(&force).map(|(a, b)| a * b).sum::<f64>() / norm;
    let expected: Vec<f64> = v.into_iter().chain((0..4).map(|i| force[i] + lambda * j[i])).collect();
    assert_close(&found, &expected);
}

#[test]
fn a_constant_speed_is_kept_and_does_work() {
    let system = compiled(systems::constant_speed());
    assert!(!system.report.contains("the energy"), "{}", system.report);
    let (vx, vy, g) = (0.6, 0.8, 9.81);
    let found = derivative(&system, &[("x_dot", vx), ("y_dot", vy), ("c", 1.0), ("g", g), ("t", 0.0)]);
    // the component of gravity along the velocity is taken away
    assert_close(&found, &[vx, vy, g * vy * vx, -g + g * vy * vy]);
}

#[test]
fn claims_are_judged_where_the_constraints_hold() {
    let mut b = systems::Builder { model: systems::veselova() };
    // |g|² is conserved everywhere, g·w only where it is 0, and w1 is not
    let norm = b.sum(&[(1, 1, "g1*g1"), (1, 1, "g2*g2"), (1, 1, "g3*g3")]);
    let along = b.sum(&[(1, 1, "g1*w1"), (1, 1, "g2*w2"), (1, 1, "g3*w3")]);
    b.claim("norm", norm);
    b.claim("along", along);
    let proved = compile(b.model.clone()).unwrap();
    assert!(proved.report.contains("norm (claimed, and proved)"));
    let wrong = b.sum(&[(1, 1, "w1")]);
    b.claim("wrong", wrong);
    let violations = compile(b.model).unwrap_err();
    assert_eq!(violations.iter().map(|v| v.law).collect::<Vec<_>>(), [Law::Conservation]);
    assert!(violations[0].what.contains("`wrong` is not conserved"), "{violations:?}");
}

#[test]
fn an_embedded_base_has_a_way_back() {
    let mut b = systems::Builder { model: systems::veselova() };
    let norm = b.sum(&[(1, 1, "g1*g1"), (1, 1, "g2*g2"), (1, 1, "g3*g3")]);
    let one = b.model.graph.one();
    let identity = b.model.graph.formula(norm - one);
    b.model.identities.push(nonholonomic_core::model::Located { value: identity, origin: systems::origin() });
    let system = compiled(b.model.clone());
    let embedding = system.embedding.unwrap();
    let mut g = [0.3, -1.0, 0.4];
    for _ in 0..6 {
        let moved = interpret(&schedule(&system.model.graph, &embedding.step), |symbol| {
            let name = &system.model.graph.symbols()[symbol];
            g[["g1", "g2", "g3"].iter().position(|n| n == name).unwrap()]
        });
        g.copy_from_slice(&moved);
    }
    assert_close(&[g.iter().map(|x| x * x).sum::<f64>()], &[1.0]);
    // a plane is left by the anchor
    let plane = b.sum(&[(1, 1, "g1"), (1, 1, "g2")]);
    b.model.identities[0].value = b.model.graph.formula(plane - one);
    assert_eq!(compile(b.model).unwrap_err()[0].law, Law::Embedding);
}

#[test]
fn constraints_may_depend_on_time() {
    let system = compiled(systems::steered_blade());
    assert!(system.report.contains("nonholonomic"), "dy - t dx is not integrable: {}", system.report);
    let (t, v) = (0.7, 1.3);
    // m (ẍ + t (t ẍ + ẋ)) = 0
    let found = derivative(&system, &[("t", t), ("m", 2.0), ("x_dot", v), ("x", 0.0), ("y", 0.0)]);
    assert_close(&found, &[v, t * v, -t * v / (1.0 + t * t)]);
}

#[test]
fn a_distribution_by_span_is_that_of_the_constraints() {
    let (by_span, by_constraints) =
        (compiled(systems::snakeboard(true)), compiled(systems::snakeboard(false)));
    assert_eq!(by_span.formulation, Formulation::Adapted);
    let (phi, s, dpsi, dphi) = (0.7f64, 0.9, -0.4, 0.3);
    let (m, l, j0, j1) = (1.4, 0.6, 0.2, 0.05);
    let (xi1, xi3) = (-l * phi.cos() * s, phi.sin() * s);
    let values = [
        ("m", m),
        ("l", l),
        ("J0", j0),
        ("J1", j1),
        ("psi", 0.1),
        ("phi", phi),
        ("s", s),
        ("xi1", xi1),
        ("xi3", xi3),
        ("dpsi", dpsi),
        ("dphi", dphi),
        ("t", 0.0),
    ];
    let spanned = derivative(&by_span, &values);
    let constrained = derivative(&by_constraints, &values);
    let names: Vec<&str> = by_constraints
        .state_velocities
        .iter()
        .map(|v| by_constraints.model.graph.symbols()[*v].as_str())
        .collect();
    assert_eq!(names, ["xi1", "dpsi", "dphi"]);
    assert!(
        by_constraints.report.contains("they are dependent where cos(phi) = 0"),
        "{}",
        by_constraints.report
    );
    // ξ₁ = −l cosφ s
    let expected = (constrained[2] - l * phi.sin() * dphi * s) / (-l * phi.cos());
    assert_close(&spanned[2..], &[expected, constrained[3], constrained[4]]);
    // and where cosφ = 0 the span is still regular
    let mut singular = values;
    singular[5].1 = std::f64::consts::FRAC_PI_2;
    assert!(derivative(&by_span, &singular).iter().all(|rate| rate.is_finite()));
}

#[test]
fn a_frame_is_a_change_of_basis() {
    let (framed, plain) =
        (compiled(systems::charged_particle(true)), compiled(systems::charged_particle(false)));
    let (m, b, x, y, d1, d2, vertical) = (1.3, 0.8, 0.2, -0.7, 0.5, 1.1, 0.4);
    let common = [("m", m), ("b", b), ("x", x), ("y", y), ("t", 0.0), ("d2", d2)];
    let mut values = common.to_vec();
    values.extend([("h1", d1), ("xi", vertical)]);
    let found = derivative(&framed, &values);
    let mut values = common.to_vec();
    values.extend([("d1", d1), ("xi", vertical - b * y * d1)]);
    let expected = derivative(&plain, &values);
    // xi in the frame is xi + b y d1
    let vertical_rate = expected[4] + b * d2 * d1 + b * y * expected[2];
    assert_close(&found, &[d1, d2, expected[2], expected[3], vertical_rate]);
    // the curvature of the connection is in the brackets: [h1, d2] = b xi
    assert!(framed.report.contains("[h1, d2] = (b)*xi"), "{}", framed.report);
}

/// Shared forty times over, an expression would have 3⁴⁰ letters.
#[test]
fn texts_of_what_is_shared_are_cut() {
    let mut b = systems::Builder::new(&["m"], &["x"], &["w"]);
    b.anchor(&[&[(1, 1, "w")]]);
    let [mut shared, w, x] = ["m", "w", "x"].map(|name| b.sum(&[(1, 1, name)]));
    let graph = &mut b.model.graph;
    for _ in 0..40 {
        let (sin, cos) = (graph.sin(shared), graph.cos(shared));
        shared = graph.formula(sin * shared + cos);
    }
    let square = graph.square(w);
    b.model.lagrangian.value = graph.formula(square * shared + x);
    let system = compiled(b.model);
    assert!(!system.parameter_checks.is_empty());
    for check in &system.parameter_checks {
        assert!(check.text.len() < 1000, "{}", check.text);
    }
}

/// Checks mathematics (3).
#[test]
fn broken_laws_are_named() {
    let mut b = systems::Builder::new(&[], &[], &["w1", "w2", "w3"]);
    b.bracket(0, 1, &[(1, 1, "w3")]);
    b.bracket(1, 2, &[(1, 1, "w2")]);
    b.lagrangian(&[(1, 2, "w1*w1"), (1, 2, "w2*w2"), (1, 2, "w3*w3")]);
    let violations = compile(b.model).unwrap_err();
    assert_eq!(violations.iter().map(|v| v.law).collect::<Vec<_>>(), [Law::Jacobi]);

    let mut model = systems::sleigh();
    model.constraints.push(model.constraints.iter().next().unwrap().clone());
    let violations = compile(model).unwrap_err();
    assert_eq!(violations[0].law, Law::Independence);
}

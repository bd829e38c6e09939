//! The words of machines: shared lets and functions, rates of expressions, derivatives, rotations, bodies. Values
//! are compared with formulas written out by hand, and rates with differences along a motion.

use nonholonomic_core::model::Model;

use super::{evaluated, model, of_name};

const STRUCT: &str = "struct S { m: f64, c: f64, I: [f64; 3], A: [[f64; 3]; 3] }";

/// The value of an expression, with lines between the sections before it.
fn value(shared: &str, expression: &str) -> f64 {
    let model = model(&format!("{shared} base {{ x, y, z, q[3] }} lagrangian {{ {expression} }}"), STRUCT);
    evaluated(&model, model.lagrangian.value)
}

fn close(shared: &str, expression: &str, expected: f64) {
    let found = value(shared, expression);
    assert!(
        (found - expected).abs() <= 1e-12 * (1.0 + expected.abs()),
        "{shared} {expression}: {found}, not {expected}"
    );
}

/// Both expressions have the same value.
fn agree(shared: &str, one: &str, other: &str) {
    close(shared, one, value(shared, other));
}

/// The value of the Lagrangian where the coordinates are moved along their rates for a time h.
fn moved(model: &Model, h: f64) -> f64 {
    let value = |name: &str| match name {
        "t" => of_name("t") + h,
        "x" | "y" | "z" | "q[0]" | "q[1]" | "q[2]" => of_name(name) + h * of_name(&rate_name(name)),
        _ => of_name(name),
    };
    model.graph.evaluate(&[model.lagrangian.value], |symbol| value(&model.graph.symbols()[symbol]))[0].value
}

/// The velocity of a coordinate where E = TM.
fn rate_name(name: &str) -> String {
    match name.split_once('[') {
        Some((family, index)) => format!("{family}_dot[{index}"),
        None => format!("{name}_dot"),
    }
}

/// The rate of an expression, by central differences of fourth order.
fn differences(shared: &str, expression: &str) -> f64 {
    let model = model(&format!("{shared} base {{ x, y, z, q[3] }} lagrangian {{ {expression} }}"), STRUCT);
    let h = 1e-3;
    let at = |k: f64| moved(&model, k * h);
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// mathematics (31)
fn rate_is_right(shared: &str, expression: &str) {
    let (found, expected) = (value(shared, &format!("der({expression})")), differences(shared, expression));
    assert!(
        (found - expected).abs() <= 1e-9 * (1.0 + expected.abs()),
        "{expression}: {found}, not {expected}"
    );
}

#[test]
fn lets_between_sections_are_known_in_any_order() {
    let (x, y, m) = (of_name("x"), of_name("y"), of_name("m"));
    let shared = "let twice = 2 * once; let once = square(x) + y; let square(u) = u^2;";
    close(shared, "m * twice", m * 2.0 * (x * x + y));
    close("let p[i in 0..3] = (i + 1) * x;", "p[0] + p[1] * p[2]", x + 6.0 * x * x);
    close("let n = 2; let e(u) = [cos(u), sin(u)];", "sum(i in 0..n: e(x)[i]^2)", 1.0);
    close("let f(u, v) = u * v; let g(u) = f(u, u);", "g(g(x))", x.powi(4));
    close("let s(B, v) = dot(v, B * v);", "s(A, q) - dot(q, A * q)", 0.0);
}

#[test]
fn a_long_chain_of_lets_is_no_deep_recursion() {
    let lines: Vec<String> = (0..4000).map(|k| format!("let a{k} = a{} + 1;", k + 1)).collect();
    let lines = lines.concat();
    close(&format!("{lines} let a4000 = x;"), "a0", of_name("x") + 4000.0);
}

#[test]
fn shared_lets_serve_every_section() {
    let model = model(
        "let slope = k * x; let p = [x, slope]; let v = der(p); let k = 2;
         base { x, y } lagrangian { m / 2 * dot(v, v) } constraints { c: der(y) = der(slope); }
         outputs { height = slope; } conserved { e = m * dot(v, v) / 2; } forces { x: -slope; }",
        STRUCT,
    );
    let (x, rate, m) = (of_name("x"), of_name("x_dot"), of_name("m"));
    let close =
        |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
    close(evaluated(&model, model.lagrangian.value), 2.5 * m * rate * rate);
    close(evaluated(&model, model.outputs[0].value), 2.0 * x);
    close(evaluated(&model, model.forces[0].value), -2.0 * x);
    let constraint = model.constraints.iter().next().unwrap();
    close(evaluated(&model, constraint.residual), of_name("y_dot") - 2.0 * rate);
}

#[test]
fn rates_follow_the_motion() {
    for expression in ["sin(x) * y^2", "m * x / (y + t)", "sqrt(x^2 + y^2 + z^2)", "dot(q, A * q) * t"] {
        rate_is_right("", expression);
    }
    rate_is_right("let h(u, v) = c * u^2 * exp(v);", "h(x, y + t)");
    rate_is_right("let p = rot_z(x) * rot_x(y) * q;", "p[1]");
    close("", "der(m * c)", 0.0);
    close("", "der([x, 2 * y])[1]", 2.0 * of_name("y_dot"));
}

#[test]
fn derivatives_by_what_has_a_name() {
    let (x, y, m, t) = (of_name("x"), of_name("y"), of_name("m"), of_name("t"));
    close("", "diff(x^3 * y, x)", 3.0 * x * x * y);
    close("", "diff(m * x + t^2, t) + diff(m * x, m)", 2.0 * t + x);
    close("", "diff(der(x)^2, der(x))", 2.0 * of_name("x_dot"));
    close("", "diff(x * y^2, [x, y])[1]", 2.0 * x * y);
    close("", "diff([x * y, m * x], [x, y])[0][1]", x);
    close("", "dot(diff(dot(q, q), q), q) - 2 * dot(q, q)", 0.0);
    let shared = "let h(a, b) = c * a^2 + a * b; let h_a(a, b) = diff(h(a, b), a); let slope(v) = diff(h(v[0], v[1]), v);";
    close(shared, "h_a(x, y)", 2.0 * of_name("c") * x + y);
    close(shared, "h_a(x^2, m)", 2.0 * of_name("c") * x * x + m);
    close(shared, "slope([x, y])[1]", x);
}

#[test]
fn derivatives_see_what_rates_depend_on() {
    let declaration = "base { x, y } basis { u, w } anchor { der(x) = y * u; der(y) = w; }
                       lagrangian { diff(m * der(x)^2, y) + diff(der(x), u) }";
    let model = model(declaration, STRUCT);
    let (y, u, m) = (of_name("y"), of_name("u"), of_name("m"));
    let found = evaluated(&model, model.lagrangian.value);
    assert!((found - (2.0 * m * y * u * u + y)).abs() < 1e-12, "{found}");
}

#[test]
fn parts_and_the_zero_of_any_shape() {
    let q = |k: usize| of_name(&format!("q[{k}]"));
    close("", "q[1..3][1]", q(2));
    close("", "dot(A[0][0..2], q[0..2])", of_name("A[0][0]") * q(0) + of_name("A[0][1]") * q(1));
    close("", "A[1..3][0][2]", of_name("A[1][2]"));
    close("", "(q + 0)[1] + (0 - q)[2] + sum(i in 0..0: q)", q(1) - q(2) + 0.0);
}

#[test]
fn functions_of_vectors_and_matrices() {
    agree("", "dot(I, hat(q) * [x, y, z])", "dot(I, cross(q, [x, y, z]))");
    agree("", "dot(I, vee(hat(q) + identity(3)))", "dot(I, q)");
    agree("", "transpose(A)[0][2] + (transpose(A) * A)[1][1]", "A[2][0] + A[0][1]^2 + A[1][1]^2 + A[2][1]^2");
    agree("", "norm(q)", "sqrt(dot(q, q))");
    agree("", "(diag(x, y, z) * q)[1] + (diag(I) * q)[2]", "y * q[1] + I[2] * q[2]");
    // a name that stands alone is no function
    close("let norm = 3;", "norm + norm([3, 4])", 8.0);
}

#[test]
fn rotations_are_active() {
    let x = of_name("x");
    for (axis, from, to) in [("z", 0, 1), ("x", 1, 2), ("y", 2, 0)] {
        close("", &format!("rot_{axis}(x)[{to}][{from}]"), x.sin());
        close("", &format!("rot_{axis}(x)[{from}][{to}]"), -x.sin());
        close("", &format!("rot_{axis}(x)[{from}][{from}]"), x.cos());
    }
    agree("", "(rot([0, 1, 0], x) * q)[2]", "(rot_y(x) * q)[2]");
    agree("let n = q / norm(q);", "(rot(n, x) * n)[1]", "q[1] / norm(q)");
    agree("let n = [3/5, 0, 4/5];", "(rot(n, x) * rot(n, y))[0][1]", "rot(n, x + y)[0][1]");
}

/// mathematics (32)
#[test]
fn angular_velocities() {
    // of a product of rotations as of the matrix of its entries
    let r = "let R = rot_z(x) * rot_x(y) * rot([3/5, 0, 4/5], z * c) * transpose(rot_y(x)) * rot(q / norm(q), y);";
    let rates = "let E[i in 0..3, j in 0..3] = R[i][j] + 0 * x; let V = der(R);";
    for k in 0..3 {
        agree(&format!("{r} {rates}"), &format!("body_rate(R)[{k}]"), &format!("vee(transpose(E) * V)[{k}]"));
        agree(
            &format!("{r} {rates}"),
            &format!("space_rate(R)[{k}]"),
            &format!("vee(V * transpose(E))[{k}]"),
        );
        agree(r, &format!("space_rate(R)[{k}]"), &format!("(R * body_rate(R))[{k}]"));
    }
    close("", "space_rate(x * y)", value("", "der(x * y)"));
    close("", "body_rate(rot_x(x) * rot_z(y))[0]", of_name("x_dot") * of_name("y").cos());
}

/// mathematics (32), an attitude made of coordinates
#[test]
fn attitudes_that_the_anchor_turns() {
    let declaration = |expression: &str| {
        format!(
            "base {{ R[3][3] }} on {{ transpose(R) * R = identity(3); }} basis {{ w[3] }}
             anchor {{ der(R) = R * hat(w); }} lagrangian {{ {expression} }}"
        )
    };
    let model = model(&declaration("body_rate(R)[0] + 10 * space_rate(R)[1]"), STRUCT);
    let w = |k: usize| of_name(&format!("w[{k}]"));
    let r = |k: usize| of_name(&format!("R[1][{k}]"));
    let expected = w(0) + 10.0 * (r(0) * w(0) + r(1) * w(1) + r(2) * w(2));
    assert!((evaluated(&model, model.lagrangian.value) - expected).abs() < 1e-12);
    assert!(!model.claimed.is_empty(), "the attitude is proved to be a rotation");
}

#[test]
fn velocities_of_material_points() {
    let body = "let p = [x, y, z]; let R = rot_z(q[0]) * rot_y(q[1]); let at = p + R * I;";
    for k in 0..3 {
        agree(body, &format!("velocity_at(p, R, at)[{k}]"), &format!("der(at)[{k}]"));
    }
    let plane = "let p = [x, y]; let at = p + m * [cos(z), sin(z)];";
    agree(plane, "velocity_at(p, z, at)[0]", "der(at)[0]");
    agree(plane, "velocity_at(p, z, at)[1]", "der(at)[1]");
    // a point that stands at a fixed place in space is no material point
    agree(plane, "velocity_at(p, z, 0)[0]", "der(x) + der(z) * y");
}

/// mathematics (33)
#[test]
fn kinetic_energies() {
    agree("", "kinetic(m, [x, y])", "m / 2 * (der(x)^2 + der(y)^2)");
    agree("", "kinetic(m, c, [x, y], z)", "m / 2 * (der(x)^2 + der(y)^2) + c / 2 * der(z)^2");
    let body = "let p = [x, y, z]; let R = rot_z(q[0]) * rot_x(q[1]); let w = body_rate(R);";
    let along = "m / 2 * (der(x)^2 + der(y)^2 + der(z)^2)";
    agree(body, "kinetic(m, c, p, R)", &format!("{along} + c / 2 * dot(w, w)"));
    agree(body, "kinetic(m, I, p, R)", &format!("{along} + sum(i in 0..3: I[i] * w[i]^2) / 2"));
    agree(body, "kinetic(m, A, p, R)", &format!("{along} + dot(w, A * w) / 2"));
    agree(body, "kinetic(0, c, 0, R)", "c / 2 * dot(w, w)");
    let declared =
        model("base { x, y, z } lagrangian { kinetic(m, [x, y]) + kinetic(m, c, [x, y], z) }", STRUCT);
    assert_eq!(declared.bodies.len(), 2);
}

/// Entries (i, j) and (j, i) are one parameter.
#[test]
fn symmetric_parameters() {
    let model = model(
        "base { q[3] } lagrangian { dot(der(q), J * der(q)) }",
        "struct S { #[nh(symmetric)] J: [[f64; 3]; 3] }",
    );
    let names = model.graph.symbols_in(&[model.lagrangian.value]);
    let names: Vec<&str> = names.into_iter().map(|symbol| model.graph.symbols()[symbol].as_str()).collect();
    assert!(names.contains(&"J[0][2]") && !names.contains(&"J[2][0]"), "{names:?}");
    assert_eq!(model.symmetric.len(), 3);
}

//! Machines of many bodies, as engineers declare them.

use std::fmt::Write;

use super::{Family, declared, separated};

pub(super) const FAMILIES: &[Family] = &[
    Family { name: "pendulum, absolute angles", source: absolute, sizes: &[5, 10, 20, 40] },
    Family { name: "pendulum, relative angles", source: relative, sizes: &[3, 6, 10, 20, 40] },
    Family { name: "snake with blades", source: snake, sizes: &[4, 8, 16, 30] },
    Family { name: "particles that attract", source: particles, sizes: &[3, 10, 30] },
    Family { name: "lattice", source: lattice, sizes: &[5, 10, 20] },
    Family { name: "trailers, relative angles", source: trailers, sizes: &[2, 5, 10, 20] },
    Family { name: "arm on two wheels", source: arm_on_wheels, sizes: &[2, 5, 8, 16] },
    Family { name: "arm on a skate", source: arm_on_skate, sizes: &[2, 5, 8, 16] },
    Family { name: "arm in a vertical plane", source: vertical_arm, sizes: &[2, 5, 8, 16] },
    Family { name: "fast arms in pairs", source: pairs_of_arms, sizes: &[2, 5, 8, 16] },
    Family { name: "bodies in space", source: bodies, sizes: &[1, 5, 30] },
    Family { name: "bodies by quaternions", source: bodies_by_quaternions, sizes: &[1, 6, 20] },
    Family { name: "closed loops", source: loops, sizes: &[1, 5, 20] },
    Family { name: "four-bars side by side", source: four_bars, sizes: &[1, 5, 10, 20] },
    Family { name: "units of a pendulum", source: units, sizes: &[3, 10, 40] },
    Family { name: "lags one behind the other", source: lags, sizes: &[5, 50, 400] },
];

fn absolute(n: usize) -> String {
    declared(
        &format!(
            "base {{ th[{n}] }} lagrangian {{ let vx[i in 0..{n}] = sum(j in 0..i + 1: l[j] * cos(th[j]) * der(th[j])); let vy[i in 0..{n}] = sum(j in 0..i + 1: l[j] * sin(th[j]) * der(th[j])); sum(i in 0..{n}: m[i] / 2 * (vx[i]^2 + vy[i]^2) + m[i] * g * sum(j in 0..i + 1: l[j] * cos(th[j]))) }}"
        ),
        &format!("m: [f64; {n}], l: [f64; {n}], g: f64"),
    )
}

fn relative(n: usize) -> String {
    declared(
        &format!(
            "base {{ q[{n}] }} lagrangian {{ let th[i in 0..{n}] = sum(j in 0..i + 1: q[j]); let w[i in 0..{n}] = sum(j in 0..i + 1: der(q[j])); let vx[i in 0..{n}] = sum(j in 0..i + 1: l[j] * cos(th[j]) * w[j]); let vy[i in 0..{n}] = sum(j in 0..i + 1: l[j] * sin(th[j]) * w[j]); sum(i in 0..{n}: m[i] / 2 * (vx[i]^2 + vy[i]^2) + J[i] / 2 * w[i]^2 + m[i] * g * sum(j in 0..i + 1: l[j] * cos(th[j]))) }}"
        ),
        &format!("m: [f64; {n}], J: [f64; {n}], l: [f64; {n}], g: f64"),
    )
}

fn snake(n: usize) -> String {
    declared(
        &format!(
            "base {{ x, y, th[{n}] }} lagrangian {{ let vx[i in 0..{n}] = der(x) - sum(j in 0..i: l * sin(th[j]) * der(th[j])); let vy[i in 0..{n}] = der(y) + sum(j in 0..i: l * cos(th[j]) * der(th[j])); sum(i in 0..{n}: m / 2 * (vx[i]^2 + vy[i]^2) + J / 2 * der(th[i])^2) }} constraints {{ for i in 0..3 {{ cos(th[i]) * (der(y) + sum(j in 0..i: l * cos(th[j]) * der(th[j]))) = sin(th[i]) * (der(x) - sum(j in 0..i: l * sin(th[j]) * der(th[j]))); }} }} inputs {{ u[{n}] }} forces {{ for i in 1..{n} {{ th[i]: u[i]; }} }}"
        ),
        "m: f64, J: f64, l: f64",
    )
}

fn particles(n: usize) -> String {
    declared(
        &format!(
            "base {{ q[{n}][3] }} lagrangian {{ sum(i in 0..{n}: m[i] / 2 * sum(k in 0..3: der(q[i][k])^2)) + sum(i in 0..{n}, j in 0..i: m[i] * m[j] / sqrt(sum(k in 0..3: (q[i][k] - q[j][k])^2))) }}"
        ),
        &format!("m: [f64; {n}]"),
    )
}

fn lattice(n: usize) -> String {
    declared(
        &format!(
            "base {{ u[{n}][{n}] }} lagrangian {{ sum(i in 0..{n}, j in 0..{n}: m / 2 * der(u[i][j])^2) - sum(i in 1..{n}, j in 1..{n}: k / 2 * ((u[i][j] - u[i - 1][j])^2 + (u[i][j] - u[i][j - 1])^2) + u[i][j]^4) }}"
        ),
        "m: f64, k: f64",
    )
}

fn trailers(n: usize) -> String {
    let b = n + 1;
    declared(
        &format!(
            "base {{ x, y, q[{b}] }} lagrangian {{ let th[i in 0..{b}] = sum(j in 0..i + 1: q[j]); let w[i in 0..{b}] = sum(j in 0..i + 1: der(q[j])); let vx[i in 0..{b}] = der(x) + sum(j in 1..i + 1: d * sin(th[j]) * w[j]); let vy[i in 0..{b}] = der(y) - sum(j in 1..i + 1: d * cos(th[j]) * w[j]); sum(i in 0..{b}: m / 2 * (vx[i]^2 + vy[i]^2) + J / 2 * w[i]^2) }} constraints {{ let th[i in 0..{b}] = sum(j in 0..i + 1: q[j]); let w[i in 0..{b}] = sum(j in 0..i + 1: der(q[j])); for i in 0..{b} {{ cos(th[i]) * (der(y) - sum(j in 1..i + 1: d * cos(th[j]) * w[j])) = sin(th[i]) * (der(x) + sum(j in 1..i + 1: d * sin(th[j]) * w[j])); }} }} inputs {{ push, steer }} forces {{ x: push * cos(q[0]); y: push * sin(q[0]); q[0]: steer; }}"
        ),
        "m: f64, J: f64, d: f64",
    )
}

/// A planar arm that is hinged ahead of the axle of a robot with two driven wheels, in coordinates.
fn arm_on_wheels(n: usize) -> String {
    declared(
        &format!(
            "base {{ x, y, th, right, left, q[{n}] }} lagrangian {{ let ang[i in 0..{n}] = th + sum(j in 0..i + 1: q[j]); let w[i in 0..{n}] = der(th) + sum(j in 0..i + 1: der(q[j])); let vx[i in 0..{n}] = der(x) - a * sin(th) * der(th) - sum(j in 0..i: l[j] * sin(ang[j]) * w[j]) - c[i] * sin(ang[i]) * w[i]; let vy[i in 0..{n}] = der(y) + a * cos(th) * der(th) + sum(j in 0..i: l[j] * cos(ang[j]) * w[j]) + c[i] * cos(ang[i]) * w[i]; M / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(th)^2 + Jw / 2 * (der(right)^2 + der(left)^2) + sum(i in 0..{n}: m[i] / 2 * (vx[i]^2 + vy[i]^2) + J[i] / 2 * w[i]^2) }} constraints {{ der(x) = r / 2 * (der(right) + der(left)) * cos(th); der(y) = r / 2 * (der(right) + der(left)) * sin(th); der(th) = r / (2 * b) * (der(right) - der(left)); }} inputs {{ drive[2], torque[{n}] }} forces {{ right: drive[0]; left: drive[1]; for i in 0..{n} {{ q[i]: torque[i]; }} }}"
        ),
        &format!(
            "M: f64, I: f64, Jw: f64, a: f64, b: f64, r: f64, m: [f64; {n}], J: [f64; {n}], l: [f64; {n}], c: [f64; {n}]"
        ),
    )
}

/// The same on a skate that is pushed and steered, in the axes of the skate.
fn arm_on_skate(n: usize) -> String {
    declared(
        &format!(
            "base {{ x, y, th, q[{n}] }} basis {{ v, side, omega, qd[{n}] }} anchor {{ der(x) = v * cos(th) - side * sin(th); der(y) = v * sin(th) + side * cos(th); der(th) = omega; for i in 0..{n} {{ der(q[i]) = qd[i]; }} }} lagrangian {{ let ang[i in 0..{n}] = sum(j in 0..i + 1: q[j]); let w[i in 0..{n}] = omega + sum(j in 0..i + 1: qd[j]); let vx[i in 0..{n}] = v - sum(j in 0..i: l[j] * sin(ang[j]) * w[j]) - c[i] * sin(ang[i]) * w[i]; let vy[i in 0..{n}] = side + a * omega + sum(j in 0..i: l[j] * cos(ang[j]) * w[j]) + c[i] * cos(ang[i]) * w[i]; M / 2 * (v^2 + side^2) + I / 2 * omega^2 + sum(i in 0..{n}: m[i] / 2 * (vx[i]^2 + vy[i]^2) + J[i] / 2 * w[i]^2) }} constraints {{ side = 0; }} inputs {{ push, steer, torque[{n}] }} forces {{ v: push; omega: steer; for i in 0..{n} {{ qd[i]: torque[i]; }} }}"
        ),
        &format!("M: f64, I: f64, a: f64, m: [f64; {n}], J: [f64; {n}], l: [f64; {n}], c: [f64; {n}]"),
    )
}

/// A planar arm on the ground, by its bodies, against gravity.
fn vertical_arm(n: usize) -> String {
    let (mut places, mut bodies) = (String::new(), Vec::new());
    for i in 0..n {
        let (joint, angle) = match i.checked_sub(1) {
            None => ("[0, 0]".to_owned(), format!("th[{i}]")),
            Some(h) => (format!("(o{h} + l[{h}] * [cos(q{h}), sin(q{h})])"), format!("q{h} + th[{i}]")),
        };
        let _ = write!(places, "let q{i} = {angle}; let o{i} = {joint}; ");
        let _ = write!(places, "let p{i} = o{i} + c[{i}] * [cos(q{i}), sin(q{i})]; ");
        bodies.push(format!("kinetic(m[{i}], J[{i}], p{i}, q{i}) - m[{i}] * g * p{i}[1]"));
    }
    declared(
        &format!(
            "base {{ th[{n}] }} lagrangian {{ {places} {} }} inputs {{ u[{n}] }} forces {{ for i in 0..{n} {{ th[i]: u[i]; }} }}",
            bodies.join(" + ")
        ),
        &format!("m: [f64; {n}], J: [f64; {n}], l: [f64; {n}], c: [f64; {n}], g: f64"),
    )
}

/// Two arms on a body that floats in the plane, in absolute angles, with springs in the joints: a tree. The bounds on
/// rounding errors of the balanced level prefer the whole mass matrix here, since a light body carries heavy arms.
fn pairs_of_arms(n: usize) -> String {
    declared(
        &format!(
            "base {{ x, y, th, q[2][{n}] }} lagrangian {{ let wx[k in 0..2, i in 0..{n}] = -sum(j in 0..i: l * sin(q[k][j]) * der(q[k][j])) - l / 2 * sin(q[k][i]) * der(q[k][i]); let wy[k in 0..2, i in 0..{n}] = sum(j in 0..i: l * cos(q[k][j]) * der(q[k][j])) + l / 2 * cos(q[k][i]) * der(q[k][i]); M / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(th)^2 + sum(k in 0..2, i in 0..{n}: m / 2 * ((der(x) + (1 - 2 * k) * a * sin(th) * der(th) + wx[k][i])^2 + (der(y) - (1 - 2 * k) * a * cos(th) * der(th) + wy[k][i])^2) + J / 2 * der(q[k][i])^2) - sum(k in 0..2, i in 1..{n}: s / 2 * (q[k][i] - q[k][i - 1])^2) }} accuracy {{ fast }}"
        ),
        "M: f64, I: f64, a: f64, m: f64, J: f64, l: f64, s: f64",
    )
}

/// Bodies with rotations by angles, each joined to the one before it by a spring.
fn bodies(n: usize) -> String {
    declared(
        &format!(
            "base {{ p[{n}][3], q[{n}][3] }} lagrangian {{ {} - sum(i in 1..{n}, k in 0..3: s / 2 * (p[i][k] - p[i - 1][k])^2) }}",
            (0..n)
                .map(|i| format!(
                    "kinetic(m, I, p[{i}], rot_z(q[{i}][0]) * rot_x(q[{i}][1]) * rot_z(q[{i}][2]))"
                ))
                .collect::<Vec<_>>()
                .join(" + ")
        ),
        "m: f64, I: [f64; 3], s: f64",
    )
}

/// Bodies with springs between neighbours, their attitudes by quaternions.
fn bodies_by_quaternions(n: usize) -> String {
    let bodies = separated(n, " + ", |i| format!("kinetic(m, I, p[{i}], turned(q[{i}]))"));
    declared(
        &format!(
            "base {{ p[{n}][3], q[{n}][4] }} on {{ for i in 0..{n} {{ dot(q[i], q[i]) = 1; }} }} basis {{ w[{n}][3], v[{n}][3] }}
             let rates(e, z) = [
                 -(e[1] * z[0] + e[2] * z[1] + e[3] * z[2]) / 2, (e[0] * z[0] + e[2] * z[2] - e[3] * z[1]) / 2,
                 (e[0] * z[1] + e[3] * z[0] - e[1] * z[2]) / 2, (e[0] * z[2] + e[1] * z[1] - e[2] * z[0]) / 2
             ];
             let turned(e) = [
                 [1 - 2 * (e[2]^2 + e[3]^2), 2 * (e[1] * e[2] - e[0] * e[3]), 2 * (e[1] * e[3] + e[0] * e[2])],
                 [2 * (e[1] * e[2] + e[0] * e[3]), 1 - 2 * (e[1]^2 + e[3]^2), 2 * (e[2] * e[3] - e[0] * e[1])],
                 [2 * (e[1] * e[3] - e[0] * e[2]), 2 * (e[2] * e[3] + e[0] * e[1]), 1 - 2 * (e[1]^2 + e[2]^2)]
             ];
             anchor {{ for i in 0..{n} {{ der(p[i]) = v[i]; der(q[i]) = rates(q[i], w[i]); }} }}
             lagrangian {{ {bodies} - sum(i in 1..{n}, k in 0..3: s / 2 * (p[i][k] - p[i - 1][k])^2) }}"
        ),
        "m: f64, I: [f64; 3], s: f64",
    )
}

/// Particles on rods between neighbours, closed.
/// Four-bar linkages one beside the other, each with a crank of the one before; rods with mass all along.
fn four_bars(n: usize) -> String {
    declared(
        &format!(
            "base {{ a[{cranks}], b[{n}] }} holonomic {{ for i in 0..{n} {{ [l * cos(a[i]) + l * cos(b[i]) - l * cos(a[i + 1]) - l, l * sin(a[i]) + l * sin(b[i]) - l * sin(a[i + 1])] = 0; }} }} lagrangian {{ sum(i in 0..{cranks}: m * l^2 / 6 * der(a[i])^2 - m * g * l / 2 * sin(a[i])) + sum(i in 0..{n}: m * l^2 / 2 * (der(a[i])^2 + der(b[i])^2 / 3 + cos(a[i] - b[i]) * der(a[i]) * der(b[i])) - m * g * l * (sin(a[i]) + sin(b[i]) / 2)) }}",
            cranks = n + 1
        ),
        "m: f64, l: f64, g: f64",
    )
}

fn loops(n: usize) -> String {
    let b = n + 2;
    declared(
        &format!(
            "base {{ x[{b}], y[{b}] }} lagrangian {{ sum(i in 0..{b}: m[i] / 2 * (der(x[i])^2 + der(y[i])^2) - m[i] * g * y[i]) }} holonomic {{ for i in 0..{n} {{ (x[i] - x[i + 1])^2 + (y[i] - y[i + 1])^2 = l^2; }} }}"
        ),
        &format!("m: [f64; {b}], g: f64, l: f64"),
    )
}

fn units(n: usize) -> String {
    declared(
        &format!(
            "base {{ th[{n}] }} lagrangian {{ let vx[i in 0..{n}] = sum(j in 0..i + 1: l[j] * cos(th[j]) * der(th[j])); let vy[i in 0..{n}] = sum(j in 0..i + 1: l[j] * sin(th[j]) * der(th[j])); sum(i in 0..{n}: m[i] / 2 * (vx[i]^2 + vy[i]^2) + m[i] * g * sum(j in 0..i + 1: l[j] * cos(th[j]))) }} units {{ th = rad; m = kg; l = m; g = m/s^2; }}"
        ),
        &format!("m: [f64; {n}], l: [f64; {n}], g: f64"),
    )
}

fn lags(n: usize) -> String {
    let lines = (0..n).map(|k| {
        let source = if k == 0 { "u".to_owned() } else { format!("z{}", k - 1) };
        format!("der(z{k}) = ({source} - z{k}) / (T * (1 + x^2));")
    });
    declared(
        &format!(
            "base {{ x }} lagrangian {{ m / 2 * der(x)^2 }} inputs {{ u }} auxiliary {{ {} }} forces {{ x: z{}; }}",
            lines.collect::<String>(),
            n - 1
        ),
        "m: f64, T: f64",
    )
}

//! Machines of many bodies, as engineers declare them.

use super::{Family, declared};

pub(super) const FAMILIES: &[Family] = &[
    Family { name: "pendulum, absolute angles", source: absolute, sizes: &[5, 10, 20, 40] },
    Family { name: "pendulum, relative angles", source: relative, sizes: &[3, 6, 10, 20] },
    Family { name: "snake with blades", source: snake, sizes: &[4, 8, 16, 30] },
    Family { name: "particles that attract", source: particles, sizes: &[3, 10, 30] },
    Family { name: "lattice", source: lattice, sizes: &[5, 10, 20] },
    Family { name: "trailers, relative angles", source: trailers, sizes: &[2, 5, 10, 20] },
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

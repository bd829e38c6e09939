//! Many coordinates and sections: anchors, coframes, brackets, frames, constraints.

use super::{Family, declared, joined, separated};

pub(super) const FAMILIES: &[Family] = &[
    Family { name: "free coordinates", source: free, sizes: &[50, 200, 500] },
    Family { name: "free velocities", source: free_velocities, sizes: &[50, 200, 500] },
    Family { name: "dense mass matrix", source: dense_mass, sizes: &[10, 20, 40, 100] },
    Family { name: "dense mass matrix of cosines", source: dense_cosines, sizes: &[5, 10, 20, 40] },
    Family { name: "dense anchor of sines", source: |n| anchor(n, "sin(x[@] * #)"), sizes: &[4, 8, 12, 30] },
    Family {
        name: "dense anchor of numbers",
        source: |n| anchor(n, "(@ * # + 1) % 7"),
        sizes: &[4, 8, 12, 30],
    },
    Family { name: "dense anchor of parameters", source: anchor_parameters, sizes: &[4, 8, 12, 30] },
    Family {
        name: "dense anchor of polynomials",
        source: |n| anchor(n, "(1 + x[@]^2 * #)"),
        sizes: &[4, 8, 12],
    },
    Family {
        name: "dense coframe of cosines",
        source: |n| coframe(n, "cos(x[@] * #)"),
        sizes: &[3, 5, 8, 20],
    },
    Family {
        name: "dense coframe of numbers",
        source: |n| coframe(n, "1 / (@ + #)"),
        sizes: &[5, 10, 20, 60],
    },
    Family { name: "dense coframe of parameters", source: coframe_parameters, sizes: &[3, 5, 8, 20] },
    Family { name: "dense frame", source: frame, sizes: &[3, 5, 8, 20] },
    Family { name: "so(n)", source: special_orthogonal, sizes: &[4, 6, 8, 16, 32] },
    Family { name: "heisenberg(n)", source: heisenberg, sizes: &[4, 16, 64, 250] },
    Family { name: "dense Lie algebra", source: general_linear, sizes: &[2, 3, 4, 6] },
    Family {
        name: "projected constraints, dense",
        source: |n| constraints(500.min(10 * n), n, "formulation { projected }"),
        sizes: &[5, 20, 50],
    },
    Family { name: "adapted constraints, dense", source: |n| constraints(10 * n, n, ""), sizes: &[2, 5, 20] },
    Family { name: "knife edges", source: knife_edges, sizes: &[2, 10, 50] },
    Family { name: "nonlinear constraints", source: nonlinear, sizes: &[1, 3, 10] },
    Family { name: "distribution by sections", source: distribution, sizes: &[3, 6, 12, 30] },
    Family { name: "orthonormal basis", source: orthonormal, sizes: &[3, 6, 12] },
    Family { name: "spheres", source: spheres, sizes: &[2, 10, 50] },
    Family { name: "rotations", source: rotations, sizes: &[1, 3, 10] },
    Family { name: "forces along many", source: forces, sizes: &[10, 50, 200] },
];

fn free(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m[i] / 2 * der(x[i])^2 - k * cos(x[i])) }}"
        ),
        &format!("m: [f64; {n}], k: f64"),
    )
}

fn free_velocities(n: usize) -> String {
    declared(
        &format!(
            "basis {{ w[{n}] }} brackets {{ }} lagrangian {{ sum(i in 0..{n}: m[i] / 2 * w[i]^2) }} forces {{ for i in 0..{n} {{ w[i]: -w[i]^3; }} }}"
        ),
        &format!("m: [f64; {n}]"),
    )
}

fn dense_mass(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}, j in 0..{n}: M[i][j] * der(x[i]) * der(x[j])) / 2 - sum(i in 0..{n}: cos(x[i])) }}"
        ),
        &format!("M: [[f64; {n}]; {n}]"),
    )
}

fn dense_cosines(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}, j in 0..{n}: cos(x[i] - x[j]) * der(x[i]) * der(x[j])) / 2 + m * sum(i in 0..{n}: der(x[i])^2) }}"
        ),
        "m: f64",
    )
}

fn entry(pattern: &str, i: usize, j: usize) -> String {
    if pattern.contains('%') {
        return ((i * j + 1 + 3 * usize::from(i == j)) % 7).to_string();
    }
    pattern.replace('@', &i.to_string()).replace('#', &(j + 1).to_string())
}

fn anchor(n: usize, pattern: &str) -> String {
    let rows = joined(n, |i| {
        format!("der(x[{i}]) = {};", separated(n, " + ", |j| format!("{} * v[{j}]", entry(pattern, i, j))))
    });
    declared(
        &format!(
            "base {{ x[{n}] }} basis {{ v[{n}] }} anchor {{ {rows} }} lagrangian {{ m / 2 * dot(v, v) }}"
        ),
        "m: f64",
    )
}

fn anchor_parameters(n: usize) -> String {
    let rows = format!("for i in 0..{n} {{ der(x[i]) = sum(j in 0..{n}: A[i][j] * v[j]); }}");
    declared(
        &format!(
            "base {{ x[{n}] }} basis {{ v[{n}] }} anchor {{ {rows} }} lagrangian {{ m / 2 * dot(v, v) }}"
        ),
        &format!("m: f64, A: [[f64; {n}]; {n}]"),
    )
}

fn coframe(n: usize, pattern: &str) -> String {
    let rows = joined(n, |i| {
        format!("v{i} = {};", separated(n, " + ", |j| format!("{} * der(x[{j}])", entry(pattern, i, j))))
    });
    let energy = separated(n, " + ", |i| format!("v{i}^2"));
    declared(
        &format!("base {{ x[{n}] }} velocities {{ {rows} }} lagrangian {{ m / 2 * ({energy}) }}"),
        "m: f64",
    )
}

fn coframe_parameters(n: usize) -> String {
    let rows = joined(n, |i| format!("v{i} = sum(j in 0..{n}: A[{i}][j] * der(x[j]));"));
    let energy = separated(n, " + ", |i| format!("v{i}^2"));
    declared(
        &format!("base {{ x[{n}] }} velocities {{ {rows} }} lagrangian {{ m / 2 * ({energy}) }}"),
        &format!("m: f64, A: [[f64; {n}]; {n}]"),
    )
}

fn frame(n: usize) -> String {
    let rows = joined(n, |i| {
        format!("h{i} = {};", separated(n, " + ", |j| format!("cos({} * x[{j}]) * v[{j}]", i + j + 1)))
    });
    let energy = separated(n, " + ", |i| format!("h{i}^2"));
    declared(
        &format!(
            "base {{ x[{n}] }} basis {{ v[{n}] }} anchor {{ for i in 0..{n} {{ der(x[i]) = v[i]; }} }} frame {{ {rows} }} lagrangian {{ m / 2 * ({energy}) }}"
        ),
        "m: f64",
    )
}

fn special_orthogonal(n: usize) -> String {
    let s = n * (n - 1) / 2;
    declared(
        &format!(
            "basis {{ w[{s}] }} brackets so({n}) {{ w }} lagrangian {{ sum(i in 0..{s}: I[i] / 2 * w[i]^2) }}"
        ),
        &format!("I: [f64; {s}]"),
    )
}

fn heisenberg(n: usize) -> String {
    let s = 2 * n + 1;
    declared(
        &format!(
            "basis {{ w[{s}] }} brackets heisenberg({n}) {{ w }} lagrangian {{ sum(i in 0..{s}: I[i] / 2 * w[i]^2) }}"
        ),
        &format!("I: [f64; {s}]"),
    )
}

fn general_linear(n: usize) -> String {
    let s = n * n;
    // [E_ij, E_kl] = δ_jk E_il − δ_li E_kj
    let line = |first: usize, second: usize| {
        let (i, j, k, l) = (first / n, first % n, second / n, second % n);
        let forth = if j == k { format!("+ e[{}]", i * n + l) } else { String::new() };
        let back = if l == i { format!("- e[{}]", k * n + j) } else { String::new() };
        if forth.is_empty() && back.is_empty() {
            return String::new();
        }
        format!("[e[{first}], e[{second}]] = 0 {forth} {back};")
    };
    let pairs = (0..s).flat_map(|first| (first + 1..s).map(move |second| (first, second)));
    let lines: String = pairs.map(|(first, second)| line(first, second)).collect();
    declared(
        &format!(
            "basis {{ e[{s}] }} brackets {{ {lines} }} lagrangian {{ sum(i in 0..{s}, j in 0..{s}: M[i][j] / 2 * e[i] * e[j]) }}"
        ),
        &format!("M: [[f64; {s}]; {s}]"),
    )
}

fn constraints(n: usize, rows: usize, more: &str) -> String {
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m[i] / 2 * der(x[i])^2) }} constraints {{ for k in 0..{rows} {{ der(x[k]) + sum(i in 0..{n}: sin(x[i] * (k + 1)) * der(x[i])) = 0; }} }} {more}"
        ),
        &format!("m: [f64; {n}]"),
    )
}

fn knife_edges(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}], y[{n}], th[{n}] }} lagrangian {{ sum(i in 0..{n}: m / 2 * (der(x[i])^2 + der(y[i])^2) + J / 2 * der(th[i])^2) - sum(i in 0..{n}, j in 0..i: k * ((x[i] - x[j])^2 + (y[i] - y[j])^2)) }} constraints {{ for i in 0..{n} {{ cos(th[i]) * der(y[i]) = sin(th[i]) * der(x[i]); }} }}"
        ),
        "m: f64, J: f64, k: f64",
    )
}

fn nonlinear(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}], y[{n}], z[{n}] }} lagrangian {{ sum(i in 0..{n}: m / 2 * (der(x[i])^2 + der(y[i])^2 + der(z[i])^2) - cos(x[i] - z[i])) }} constraints {{ for i in 0..{n} {{ der(z[i])^2 = a^2 * (der(x[i])^2 + der(y[i])^2); }} }} assume {{ a > 0; m > 0; }}"
        ),
        "m: f64, a: f64",
    )
}

fn distribution(n: usize) -> String {
    let rows = joined(n, |i| {
        format!("h{i} = {};", separated(2 * n, " + ", |j| format!("cos({} * x[{j}]) * v[{j}]", i + 1)))
    });
    let listed = separated(n, ", ", |i| format!("h{i}"));
    let more = joined(n, |i| format!("g{i} = v[{}];", i + n));
    declared(
        &format!(
            "base {{ x[{0}] }} basis {{ v[{0}] }} anchor {{ for i in 0..{0} {{ der(x[i]) = v[i]; }} }} frame {{ {rows} {more} }} lagrangian {{ m / 2 * dot(v, v) }} distribution {{ {listed} }}",
            2 * n
        ),
        "m: f64",
    )
}

fn orthonormal(n: usize) -> String {
    let names = separated(n - 1, ", ", |i| format!("u{i}"));
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m[i] / 2 * der(x[i])^2) }} constraints {{ der(x[{}]) = sum(i in 0..{}: sin(x[i]) * der(x[i])); }} orthonormal {{ {names} }}",
            n - 1,
            n - 1
        ),
        &format!("m: [f64; {n}]"),
    )
}

fn spheres(n: usize) -> String {
    declared(
        &format!("base {{ g[{n}][3] }} basis {{ w[{n}][3] }} anchor {{ for i in 0..{n} {{ for k in 0..3 {{ der(g[i][k]) = cross(g[i], w[i])[k]; }} }} }} on {{ for i in 0..{n} {{ dot(g[i], g[i]) = 1; }} }} brackets {{ for i in 0..{n} {{ [w[i][0], w[i][1]] = w[i][2]; [w[i][1], w[i][2]] = w[i][0]; [w[i][2], w[i][0]] = w[i][1]; }} }} lagrangian {{ sum(i in 0..{n}: m / 2 * dot(w[i], w[i]) - g[i][2] - sum(j in 0..i: dot(g[i], g[j]))) }}"),
        "m: f64",
    ).replace("cross(g[i], w[i])[k]", "(g[i][(k + 1) % 3])")
    .replace("for k in 0..3 { der(g[i][k]) = (g[i][(k + 1) % 3]); }", "der(g[i][0]) = g[i][1] * w[i][2] - g[i][2] * w[i][1]; der(g[i][1]) = g[i][2] * w[i][0] - g[i][0] * w[i][2]; der(g[i][2]) = g[i][0] * w[i][1] - g[i][1] * w[i][0];")
}

fn rotations(n: usize) -> String {
    let base = separated(n, ", ", |k| format!("R{k}[3][3]"));
    let basis = separated(n, ", ", |k| format!("w{k}[3]"));
    let anchor = joined(n, |k| {
        format!(
            "for i in 0..3 {{ der(R{k}[i][0]) = R{k}[i][1] * w{k}[2] - R{k}[i][2] * w{k}[1]; der(R{k}[i][1]) = R{k}[i][2] * w{k}[0] - R{k}[i][0] * w{k}[2]; der(R{k}[i][2]) = R{k}[i][0] * w{k}[1] - R{k}[i][1] * w{k}[0]; }}"
        )
    });
    let on =
        joined(n, |k| format!("for i in 0..3, j in 0..i + 1 {{ dot(R{k}[i], R{k}[j]) = delta[i][j]; }}"));
    let brackets = joined(n, |k| format!("brackets so(3) {{ w{k} }}"));
    let energy = separated(n, " + ", |k| format!("dot(w{k}, I * w{k}) / 2 + R{k}[2][2]"));
    declared(
        &format!(
            "constants {{ delta = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; }} base {{ {base} }} basis {{ {basis} }} anchor {{ {anchor} }} on {{ {on} }} {brackets} lagrangian {{ {energy} }}"
        ),
        "I: [[f64; 3]; 3]",
    )
}

fn forces(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m / 2 * der(x[i])^2) }} forces {{ for i in 0..{n} {{ x[i]: sum(j in 0..{n}: sin(x[i] - x[j]) * der(x[j])); }} }}"
        ),
        "m: f64",
    )
}

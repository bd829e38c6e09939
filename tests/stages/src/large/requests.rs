//! Ordinary systems of which much is asked.

use super::{Family, declared, joined, separated};

pub(super) const FAMILIES: &[Family] = &[
    Family { name: "inputs and a Jacobian", source: inputs, sizes: &[10, 50, 200] },
    Family { name: "outputs", source: outputs, sizes: &[50, 500, 4000] },
    Family { name: "brackets of outputs", source: brackets, sizes: &[5, 20, 60] },
    Family {
        name: "Jacobian of a pendulum",
        source: |n| pendulum(n, "emit { jacobian, parameter_jacobian }"),
        sizes: &[3, 6, 10, 20],
    },
    Family {
        name: "Taylor series of a pendulum",
        source: |n| pendulum(n, "emit { taylor }"),
        sizes: &[3, 6, 10, 20],
    },
    Family {
        name: "phase space of a pendulum",
        source: |n| pendulum(n, "emit { hamiltonian, discrete_gradient }"),
        sizes: &[3, 6, 10],
    },
    Family {
        name: "connection of a pendulum",
        source: |n| pendulum(n, "emit { connection }"),
        sizes: &[3, 6, 10],
    },
    Family {
        name: "divergence of a pendulum",
        source: |n| pendulum(n, "emit { divergence, gibbs_appell }"),
        sizes: &[3, 6, 10],
    },
    Family {
        name: "careful pendulum",
        source: |n| pendulum(n, "accuracy { careful }"),
        sizes: &[3, 6, 10, 20],
    },
    Family { name: "fast pendulum", source: |n| pendulum(n, "accuracy { fast }"), sizes: &[3, 6, 10, 20] },
    Family { name: "volume of a pendulum", source: |n| pendulum(n, "volume;"), sizes: &[3, 6, 10] },
    Family { name: "volume of a snake", source: |n| snake(n, "volume;"), sizes: &[3, 5, 8] },
    Family {
        name: "multipliers of a snake",
        source: |n| snake(n, "emit { multipliers, reactions, jacobian }"),
        sizes: &[3, 5, 8],
    },
    Family { name: "splitting of a snake", source: |n| snake(n, "emit { splitting }"), sizes: &[3, 5, 8] },
    Family { name: "energy as a claim", source: claims, sizes: &[3, 6, 10] },
    Family { name: "many claims", source: many_claims, sizes: &[10, 50, 200] },
    Family { name: "symmetries", source: symmetries, sizes: &[5, 20, 60] },
    Family { name: "momenta on levels", source: levels, sizes: &[3, 10, 30] },
    Family { name: "Hamilton and Jacobi", source: hamilton_jacobi, sizes: &[3, 8, 16] },
    Family { name: "Suslov's problem", source: suslov, sizes: &[4, 6, 8] },
    Family { name: "method calls", source: methods, sizes: &[10, 50, 200] },
    Family { name: "tracked variables", source: tracked, sizes: &[10, 100, 400] },
    Family { name: "invariants", source: invariants, sizes: &[3, 8, 20] },
];

const PENDULUM: &str = "base { th[#] } lagrangian { let vx[i in 0..#] = sum(j in 0..i + 1: l[j] * cos(th[j]) * der(th[j])); let vy[i in 0..#] = sum(j in 0..i + 1: l[j] * sin(th[j]) * der(th[j])); sum(i in 0..#: m[i] / 2 * (vx[i]^2 + vy[i]^2) + m[i] * g * sum(j in 0..i + 1: l[j] * cos(th[j]))) }";

fn pendulum(n: usize, more: &str) -> String {
    let sections = PENDULUM.replace('#', &n.to_string());
    declared(&format!("{sections} {more}"), &format!("m: [f64; {n}], l: [f64; {n}], g: f64"))
}

fn snake(n: usize, more: &str) -> String {
    declared(
        &format!(
            "base {{ x, y, th[{n}] }} lagrangian {{ let vx[i in 0..{n}] = der(x) - sum(j in 0..i: l * sin(th[j]) * der(th[j])); let vy[i in 0..{n}] = der(y) + sum(j in 0..i: l * cos(th[j]) * der(th[j])); sum(i in 0..{n}: m / 2 * (vx[i]^2 + vy[i]^2) + J / 2 * der(th[i])^2) }} constraints {{ for i in 0..2 {{ cos(th[i]) * (der(y) + sum(j in 0..i: l * cos(th[j]) * der(th[j]))) = sin(th[i]) * (der(x) - sum(j in 0..i: l * sin(th[j]) * der(th[j]))); }} }} {more}"
        ),
        "m: f64, J: f64, l: f64",
    )
}

fn inputs(n: usize) -> String {
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m / 2 * der(x[i])^2 - cos(x[i])) }} inputs {{ u[{n}] }} forces {{ for i in 0..{n} {{ x[i]: u[i] * sin(x[i]) + sum(j in 0..{n}: u[j]); }} }} emit {{ jacobian }}"
        ),
        "m: f64",
    )
}

fn outputs(n: usize) -> String {
    let lines = joined(n, |k| format!("o{k} = sin({} * x) * der(x)^{};", k + 1, k % 5));
    declared(&format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 }} outputs {{ {lines} }}"), "m: f64")
}

fn brackets(n: usize) -> String {
    let lines = joined(n, |k| format!("o{k} = sin({} * x) * der(y)^2 + y * der(x)^{};", k + 1, k % 5));
    declared(
        &format!(
            "base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - cos(x - y) }} outputs {{ {lines} }} emit {{ bracket }}"
        ),
        "m: f64",
    )
}

fn claims(n: usize) -> String {
    let vx = format!(
        "let vx[i in 0..{n}] = sum(j in 0..i + 1: l[j] * cos(th[j]) * der(th[j])); let vy[i in 0..{n}] = sum(j in 0..i + 1: l[j] * sin(th[j]) * der(th[j]));"
    );
    pendulum(
        n,
        &format!(
            "conserved {{ {vx} energy = sum(i in 0..{n}: m[i] / 2 * (vx[i]^2 + vy[i]^2) - m[i] * g * sum(j in 0..i + 1: l[j] * cos(th[j]))); }}"
        ),
    )
}

fn many_claims(n: usize) -> String {
    let lines = joined(n, |k| {
        format!(
            "p{k} = der(x[{k}]) * m[{k}]; q{k} = (m[{k}] * der(x[{k}]))^2 / 2 + cos(der(x[{}])); ",
            (k + 1) % n
        )
    });
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m[i] / 2 * der(x[i])^2) }} conserved {{ {lines} }}"
        ),
        &format!("m: [f64; {n}]"),
    )
}

fn symmetries(n: usize) -> String {
    let lines = joined(n, |k| format!("s{k}: x[{k}] * der(x[{0}]) - x[{0}] * der(x[{k}]);", (k + 1) % n));
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ m / 2 * sum(i in 0..{n}: der(x[i])^2) - k * sum(i in 0..{n}: x[i]^2)^2 }} symmetries {{ {lines} }}"
        ),
        "m: f64, k: f64",
    )
}

fn levels(n: usize) -> String {
    let lines = joined(n, |k| format!("x[{k}] = mu[{k}];"));
    declared(
        &format!(
            "base {{ x[{n}], r }} lagrangian {{ m / 2 * (der(r)^2 + sum(i in 0..{n}: (1 + r^2 + i) * der(x[i])^2)) }} routh {{ {lines} }}"
        ),
        &format!("m: f64, mu: [f64; {n}]"),
    )
}

fn hamilton_jacobi(n: usize) -> String {
    let lines = joined(n, |k| format!("x[{k}]: c[{k}];"));
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ m / 2 * sum(i in 0..{n}: der(x[i])^2) }} hamilton_jacobi {{ {lines} }}"
        ),
        &format!("m: f64, c: [f64; {n}]"),
    )
}

fn suslov(n: usize) -> String {
    let s = n * (n - 1) / 2;
    declared(
        &format!(
            "basis {{ w[{s}] }} brackets so({n}) {{ w }} lagrangian {{ sum(i in 0..{s}, j in 0..{s}: I[i][j] / 2 * w[i] * w[j]) }} constraints {{ for i in {}..{s} {{ w[i] = 0; }} }}",
            n - 1
        ),
        &format!("I: [[f64; {s}]; {s}]"),
    )
}

fn methods(n: usize) -> String {
    let lines = joined(n, |k| format!("x[{k}]: self.motor(x[{k}], der(x[{}]));", (k + 1) % n));
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ m / 2 * sum(i in 0..{n}: der(x[i])^2) }} forces {{ {lines} }} derivative {{ motor: [self.first, self.second]; }} emit {{ jacobian }}"
        ),
        "m: f64",
    )
}

fn tracked(n: usize) -> String {
    let names = separated(n / 2, ", ", |k| format!("x{k}"));
    let all = separated(n, ", ", |k| format!("x{k}"));
    let energy = separated(n, " + ", |k| format!("m / 2 * der(x{k})^2 - cos(x{k})"));
    declared(&format!("base {{ {all} }} lagrangian {{ {energy} }} track {{ {names} }}"), "m: f64")
}

fn invariants(n: usize) -> String {
    let lines = joined(n, |k| format!("e{k} = m / 2 * der(x[{k}])^2 + k * x[{k}]^4;"));
    declared(
        &format!(
            "base {{ x[{n}] }} lagrangian {{ sum(i in 0..{n}: m / 2 * der(x[i])^2 - k * x[i]^4) }} conserved {{ {lines} }} emit {{ invariants, jacobian, divergence }}"
        ),
        "m: f64, k: f64",
    )
}

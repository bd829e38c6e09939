//! Expressions that grow, nest, or would be long when they are multiplied out.

use super::{Family, declared, joined, separated};

pub(super) const FAMILIES: &[Family] = &[
    Family { name: "chain of exponentials", source: |n| chain(n, "@ * exp(@)"), sizes: &[10, 40, 140] },
    Family { name: "chain of sines", source: |n| chain(n, "@ + sin(@) / 2"), sizes: &[10, 40, 140] },
    Family { name: "chain of roots", source: |n| chain(n, "sqrt(1 + @ ^ 2)"), sizes: &[10, 40, 140] },
    Family { name: "chain of tangents", source: |n| chain(n, "tan(@) * cos(@ + 1)"), sizes: &[10, 40, 140] },
    Family { name: "chain of quotients", source: |n| chain(n, "@ / (1 + x * @)"), sizes: &[10, 40, 140] },
    Family { name: "chain of squares", source: |n| chain(n, "@ ^ 2 + x"), sizes: &[5, 10, 19] },
    Family {
        name: "chain of products of two",
        source: |n| chain(n, "(@ + x) * (@ - cos(@))"),
        sizes: &[5, 20, 60],
    },
    Family { name: "chain of logarithms", source: |n| chain(n, "ln(2 + @ ^ 2) * @"), sizes: &[10, 40, 140] },
    Family {
        name: "chain of hyperbolic tangents",
        source: |n| chain(n, "tanh(@ + x) * @"),
        sizes: &[10, 40, 140],
    },
    Family { name: "mass that is a chain", source: mass_chain, sizes: &[10, 40, 140] },
    Family { name: "sum of sines", source: sines, sizes: &[100, 1000, 4000] },
    Family { name: "sum of sines of odd multiples", source: odd_sines, sizes: &[100, 2000] },
    Family { name: "sum of shifted sines", source: shifted, sizes: &[100, 1000, 4000] },
    Family { name: "sum of powers", source: powers, sizes: &[30, 300, 1000] },
    Family { name: "power of a sum", source: |n| multinomial(n, 40), sizes: &[3, 10, 100] },
    Family { name: "high power of a sum", source: |n| multinomial(6, n), sizes: &[10, 100, 1000] },
    Family { name: "product of sums", source: product_of_sums, sizes: &[5, 20, 100] },
    Family { name: "product of cosines", source: product_of_cosines, sizes: &[5, 20, 200] },
    Family { name: "nested functions", source: nested, sizes: &[10, 30, 60] },
    Family {
        name: "nested parentheses",
        source: |n| {
            declared(
                &format!(
                    "base {{ x }} lagrangian {{ m / 2 * der(x)^2 - {}x{} }}",
                    "(".repeat(n),
                    ")".repeat(n)
                ),
                "m: f64",
            )
        },
        sizes: &[30, 60, 1000],
    },
    Family { name: "long rational numbers", source: rationals, sizes: &[10, 100, 1000] },
    Family { name: "long coefficients", source: coefficients, sizes: &[10, 100, 1000] },
    Family { name: "fractional powers", source: fractional, sizes: &[10, 100, 1000] },
    Family { name: "roots of sums", source: roots, sizes: &[10, 100, 1000] },
    Family { name: "abbreviations", source: abbreviations, sizes: &[100, 1000, 4000] },
    Family { name: "large quotients", source: quotients, sizes: &[5, 20, 100] },
    Family { name: "many facts", source: facts, sizes: &[20, 200, 1000] },
    Family { name: "many constants", source: constants, sizes: &[20, 200, 1000] },
    Family { name: "matrix powers", source: matrix_powers, sizes: &[4, 8, 16] },
    Family { name: "rotations that double", source: rotations, sizes: &[4, 20, 60] },
    Family { name: "square matrices", source: square_matrices, sizes: &[10, 40, 100] },
    Family { name: "long vectors", source: long_vectors, sizes: &[30, 300, 1000] },
    Family { name: "lets that nest", source: nested_lets, sizes: &[30, 300, 3000] },
    Family { name: "shared lets that double", source: |n| shared(n, "@ + @ ^ 2"), sizes: &[5, 19, 140] },
    Family {
        name: "shared lets that double in functions",
        source: |n| shared(n, "@ + sin(@)"),
        sizes: &[5, 40, 200],
    },
    Family { name: "functions that call functions", source: calls, sizes: &[5, 40, 400] },
    Family { name: "powers of powers", source: power_tower, sizes: &[2, 60, 1000] },
    Family { name: "signs", source: signs, sizes: &[10, 100, 5000] },
];

/// An oscillator in a potential that is the last of n abbreviations, each made of the one before it, `@`.
fn chain(n: usize, step: &str) -> String {
    let lines = joined(n, |k| format!("let a{} = {};", k + 1, step.replace('@', &format!("a{k}"))));
    declared(&format!("base {{ x }} lagrangian {{ let a0 = x; {lines} m / 2 * der(x)^2 - a{n} }}"), "m: f64")
}

/// The same as a factor of the kinetic energy.
fn mass_chain(n: usize) -> String {
    let lines = joined(n, |k| format!("let a{} = a{k} * exp(a{k});", k + 1));
    declared(
        &format!("base {{ x }} lagrangian {{ let a0 = x; {lines} (m + a{n}^2) / 2 * der(x)^2 }}"),
        "m: f64",
    )
}

fn sines(n: usize) -> String {
    declared(
        &format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - sum(i in 0..{n}: sin(i * x)) }}"),
        "m: f64",
    )
}

/// Of no two of the angles the sum is a third one.
fn odd_sines(n: usize) -> String {
    declared(
        &format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - sum(i in 0..{n}: sin((2 * i + 1) * x)) }}"),
        "m: f64",
    )
}

fn shifted(n: usize) -> String {
    declared(
        &format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - sum(i in 0..{n}: cos(x + i)) }}"),
        "m: f64",
    )
}

fn powers(n: usize) -> String {
    declared(
        &format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - sum(i in 0..{n}: x^i / (i + 1)) }}"),
        "m: f64",
    )
}

fn multinomial(terms: usize, power: usize) -> String {
    declared(
        &format!(
            "base {{ x[{terms}] }} lagrangian {{ m / 2 * sum(i in 0..{terms}: der(x[i])^2) - sum(i in 0..{terms}: x[i])^{power} }}"
        ),
        "m: f64",
    )
}

fn product_of_sums(n: usize) -> String {
    let factors = separated(n, " * ", |k| format!("(x + {} * y - sin(x) + {k})", k + 1));
    declared(&format!("base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - {factors} }}"), "m: f64")
}

fn product_of_cosines(n: usize) -> String {
    let factors = separated(n, " * ", |k| format!("cos({} * x + y)", k + 1));
    declared(&format!("base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - {factors} }}"), "m: f64")
}

fn nested(n: usize) -> String {
    let names = ["sin", "cos", "exp", "tanh", "atan", "sinh"];
    let opened = joined(n, |k| format!("{}(x + ", names[k % names.len()]));
    declared(
        &format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - {opened} x {} }}", ")".repeat(n)),
        "m: f64",
    )
}

fn rationals(n: usize) -> String {
    let terms = separated(n, " + ", |k| format!("1 / {} * x^{}", "7".repeat(k % 300 + 1), k % 50 + 1));
    declared(&format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - ({terms}) }}"), "m: f64")
}

fn coefficients(n: usize) -> String {
    let terms = separated(n, " + ", |k| format!("{}{k}.{k} * sin(x + {k})", "9".repeat(900)));
    declared(&format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - ({terms}) }}"), "m: f64")
}

fn fractional(n: usize) -> String {
    let terms = separated(n, " + ", |k| format!("(1 + x^2)^({} / {})", k + 1, k % 97 + 2));
    declared(&format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - ({terms}) }}"), "m: f64")
}

fn roots(n: usize) -> String {
    let terms = separated(n, " + ", |k| format!("sqrt(1 + (x - {k})^2 + (y - {})^2)", k * k % 17));
    declared(&format!("base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - ({terms}) }}"), "m: f64")
}

fn abbreviations(n: usize) -> String {
    let lines = joined(n, |k| format!("let a{} = a{} + sin(x + {k}) * a{k};", k + 1, k / 2));
    declared(&format!("base {{ x }} lagrangian {{ let a0 = x; {lines} m / 2 * der(x)^2 - a{n} }}"), "m: f64")
}

fn quotients(n: usize) -> String {
    let terms = separated(n, " + ", |k| format!("(x + {k}) / (y^2 + x^2 + {} * x * y + {})", k % 2, k + 1));
    declared(
        &format!("base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) * (1 + ({terms})^2) }}"),
        "m: f64",
    )
}

fn facts(n: usize) -> String {
    let facts = joined(n, |k| format!("a[{k}] > a[{}]; a[{k}] * a[{}] < {};", (k + 1) % n + n, k + n, k + 1));
    declared(
        &format!(
            "base {{ x }} lagrangian {{ m / 2 * der(x)^2 - sum(i in 0..{n}: a[i] * x^2) }} assume {{ {facts} }}"
        ),
        &format!("m: f64, a: [f64; {}]", 2 * n),
    )
}

fn constants(n: usize) -> String {
    let lines = joined(n, |k| format!("c{k} = {}.{k};", k % 7));
    let terms = separated(n, " + ", |k| format!("c{k} * cos(x + c{})", (k + 1) % n));
    declared(
        &format!("constants {{ {lines} }} base {{ x }} lagrangian {{ m / 2 * der(x)^2 - ({terms}) }}"),
        "m: f64",
    )
}

fn matrix_powers(n: usize) -> String {
    declared(
        &format!(
            "base {{ q[{n}] }} lagrangian {{ let v[i in 0..{n}] = der(q[i]); let a = A * v; let b = A * a; let c = A * b; dot(c, c) / 2 + dot(v, v) }}"
        ),
        &format!("A: [[f64; {n}]; {n}]"),
    )
}

fn rotations(n: usize) -> String {
    let lines = joined(n, |k| format!("let turn{} = turn{k} * turn{k};", k + 1));
    declared(
        &format!(
            "base {{ x, y }} let turn0 = rot_z(x) * rot_x(y); {lines} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) }}"
        ),
        "m: f64",
    )
}

fn square_matrices(n: usize) -> String {
    declared(
        &format!(
            "base {{ x }} lagrangian {{ let C = A * B; let D = C + A - B; m / 2 * der(x)^2 - x * sum(i in 0..{n}: C[i][i] * D[0][i]) }}"
        ),
        &format!("m: f64, A: [[f64; {n}]; {n}], B: [[f64; {n}]; {n}]"),
    )
}

fn long_vectors(n: usize) -> String {
    declared(
        &format!(
            "base {{ x }} lagrangian {{ let v[i in 0..{n}] = a[i] * cos(i * x); let w = 2 * v + a; m / 2 * der(x)^2 - dot(v, w) }}"
        ),
        &format!("m: f64, a: [f64; {n}]"),
    )
}

fn nested_lets(n: usize) -> String {
    let lines = joined(n, |k| format!("let a{} = (a{k});", k + 1));
    declared(
        &format!("base {{ x }} lagrangian {{ let a0 = x; {lines} m / 2 * der(x)^2 - a{n}^2 }}"),
        "m: f64",
    )
}

/// Abbreviations for all sections.
fn shared(n: usize, step: &str) -> String {
    let lines = joined(n, |k| format!("let a{} = {};", k + 1, step.replace('@', &format!("a{k}"))));
    declared(
        &format!(
            "base {{ x, y }} let a0 = x; {lines} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - a{n} }} constraints {{ der(y) = a1 * der(x); }}"
        ),
        "m: f64",
    )
}

/// Functions, each of which calls the one before it twice.
fn calls(n: usize) -> String {
    let lines = joined(n, |k| format!("let f{}(u) = f{k}(u) + f{k}(u + 1);", k + 1));
    declared(
        &format!("base {{ x }} let f0(u) = sin(u); {lines} lagrangian {{ m / 2 * der(x)^2 - f{n}(x) }}"),
        "m: f64",
    )
}

fn power_tower(n: usize) -> String {
    let powers = "^2".repeat(n);
    declared(&format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - x{powers} }}"), "m: f64")
}

fn signs(n: usize) -> String {
    let signs = "-".repeat(n);
    declared(&format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 - {signs}x^2 }}"), "m: f64")
}

//! What expressions mean: their values.

use super::{evaluated, messages, model, of_name};

const STRUCT: &str = "struct S { m: f64, I: [f64; 3], A: [[f64; 3]; 3], B: [[f64; 2]; 3] }";

/// The value of an expression in the Lagrangian, with `let`s before it perhaps.
fn value(expression: &str) -> f64 {
    let model = model(&format!("base {{ x, q[3] }} lagrangian {{ {expression} }}"), STRUCT);
    evaluated(&model, model.lagrangian.value)
}

fn close(expression: &str, expected: f64) {
    let found = value(expression);
    assert!(
        (found - expected).abs() <= 1e-12 * (1.0 + expected.abs()),
        "{expression}: {found}, not {expected}"
    );
}

/// The values of the three entries of a family.
fn triple(name: &str) -> [f64; 3] {
    [0, 1, 2].map(|k| of_name(&format!("{name}[{k}]")))
}

fn a(i: usize, j: usize) -> f64 {
    of_name(&format!("A[{i}][{j}]"))
}

#[test]
fn numbers_are_exact() {
    close("1 / 3 + .5 + 1e-3", 1.0 / 3.0 + 0.5 + 0.001);
    close("-2^2 + 2^-1 + 2^3^2", -4.0 + 0.5 + 512.0);
    close("12345678901234567890123 / 1e22", 1.234_567_890_123_456_8);
    close("8^(1/3) + 2^0.5 + pi", 2.0 + 2.0_f64.sqrt() + std::f64::consts::PI);
}

#[test]
fn names_and_functions() {
    let (x, m, t, rate) = (of_name("x"), of_name("m"), of_name("t"), of_name("x_dot"));
    close("m * x^2 / 2 - t * der(x)", m * x * x / 2.0 - t * rate);
    close("x_dot - der(x)", 0.0);
    close("sin(x) + cos(x) * tan(x)", 2.0 * x.sin());
    close("asin(x / 4) + acos(x / 4) + atan(x)", std::f64::consts::FRAC_PI_2 + x.atan());
    close("atan2(x, m)", x.atan2(m));
    close("sinh(x) + cosh(x) + tanh(x)", x.exp() + x.tanh());
    close("exp(x) + ln(m) + sqrt(x)", x.exp() + m.ln() + x.sqrt());
}

#[test]
fn vectors_and_matrices() {
    let (i, q) = (triple("I"), triple("q"));
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let image = |v: [f64; 3]| [0, 1, 2].map(|r| a(r, 0) * v[0] + a(r, 1) * v[1] + a(r, 2) * v[2]);
    close("dot(I, q)", dot(i, q));
    close("dot(q, A * q) / 2", dot(q, image(q)) / 2.0);
    close("dot(q, A * A * q)", dot(q, image(image(q))));
    close("dot(q, 2 * A * q * m / 2)", dot(q, image(q)) * of_name("m"));
    close("dot([1, x, 0], q - I)", q[0] - i[0] + of_name("x") * (q[1] - i[1]));
    close("cross(I, q)[2]", i[0] * q[1] - i[1] * q[0]);
    close("dot(cross(I, q), I)", 0.0);
    close("A[1][2] + A[1 + 1][3 - 2] + (A * A)[0][1]", {
        let entry = a(0, 0) * a(0, 1) + a(0, 1) * a(1, 1) + a(0, 2) * a(2, 1);
        a(1, 2) + a(2, 1) + entry
    });
    close("dot(A[1], q)", image(q)[1]);
    close("[[1, 2], [3, 4]][1][0]", 3.0);
    close("([[1, 2], [3, 4]] * [x, 1])[1]", 3.0 * of_name("x") + 4.0);
    close("dot(-q, q) + dot(q, q)", 0.0);
    close("dot(B * [1, 0], I)", {
        let column = [0, 1, 2].map(|r| of_name(&format!("B[{r}][0]")));
        dot(column, i)
    });
}

#[test]
fn sums_and_abbreviations() {
    let (i, q) = (triple("I"), triple("q"));
    close("sum(i in 0..3: I[i] * q[i]^2)", (0..3).map(|k| i[k] * q[k] * q[k]).sum());
    close("sum(i in 0..3, j in 0..i: i * q[j])", q[0] + 2.0 * (q[0] + q[1]));
    close("sum(i in 2..2: q[i]) + sum(i in 3..1: q[i])", 0.0);
    close("sum(i in 0..3: q)[1]", 3.0 * q[1]);
    close("let e = 2 * x; let f = e^2; f - e", {
        let e = 2.0 * of_name("x");
        e * e - e
    });
    close(
        "let s[i in 0..3] = q[i] + i; dot(s, I)",
        (0..3_u8).map(|k| (q[usize::from(k)] + f64::from(k)) * i[usize::from(k)]).sum(),
    );
    close("let S[i in 0..2, j in 0..3] = A[j][i]; S[1][2]", a(2, 1));
    close("let S[i in 0..2] = A[i]; S[1][2]", a(1, 2));
    close("let S = A; dot(S * q, q) - dot(A * q, q)", 0.0);
    close("let n = 3; sum(k in 0..n: q[n - 1 - k] * 2 * k)", 2.0 * q[1] + 4.0 * q[0]);
}

#[test]
fn what_is_not_an_integer_is_not_an_index() {
    let of =
        |expression: &str| messages(&format!("base {{ x, q[3] }} lagrangian {{ {expression} }}"), STRUCT);
    let integer = "an index or bound must be an integer known here\n";
    let way_out = "\nhelp: write it with integers and loop variables: `i`, `i + 1`, `3 - i`";
    for (expression, evidence) in [
        ("q[m]", "`m` is a parameter"),
        ("q[x]", "`x` is a base coordinate"),
        ("q[0.5]", "`0.5` is no integer, or too large"),
        ("q[pi]", "`pi` is no integer"),
        ("let u = x; q[u]", "`u` is not an integer"),
        ("q[2 / 2]", "this is something else"),
        ("sum(i in 0..m: x)", "`m` is a parameter"),
    ] {
        assert_eq!(of(expression), [format!("{integer}{evidence}{way_out}")], "{expression}");
    }
    for (expression, message) in [
        ("q[3]", "the index 3 is out of range\n`q` has 3 entries, counted from 0"),
        ("q[0 - 1]", "the index -1 is out of range\n`q` has 3 entries, counted from 0"),
        ("B[0][2]", "the index 2 is out of range\na row of `B` has 2 entries, counted from 0"),
        ("sum(i in 0..9: q[i])", "the index 3 is out of range\n`q` has 3 entries, counted from 0"),
        ("m[0]", "`m` is a number and has no entries\nhelp: leave this index out"),
        ("q[0][1]", "`q` has only one index\nhelp: leave this index out"),
        ("(q + I)[4]", "the index 4 is out of range\nthis has 3 entries, counted from 0"),
        ("q[9223372036854775807 + 1]", "this index is too large"),
        ("sum(i in 0..4097: x)", "a range of 4097 values\nhelp: ranges have at most 4096 values"),
    ] {
        assert_eq!(of(expression), [message], "{expression}");
    }
}

#[test]
fn shapes_are_checked() {
    let of =
        |expression: &str| messages(&format!("base {{ x, q[3] }} lagrangian {{ {expression} }}"), STRUCT);
    for (expression, message) in [
        (
            "q",
            "expected a number, this is a vector of 3 entries\nhelp: take an entry of it, as in `w[0]`, or a \
             product such as `dot(w, w)`",
        ),
        (
            "x + q",
            "only what has the same shape can be added\nthis is a vector of 3 entries, what stands before it is a number",
        ),
        (
            "q * I",
            "the product of two vectors\nhelp: write `dot(u, v)` or `cross(u, v)`; a diagonal inertia is \
             `diag(I[0], I[1], I[2]) * w`",
        ),
        ("q^2", "a power of a vector of 3 entries\nhelp: for the square of a length write `dot(v, v)`"),
        ("x / q", "a division by a vector of 3 entries\nhelp: divide by numbers only"),
        (
            "q * A",
            "a vector of 3 entries times a matrix of 3 × 3 entries\nhelp: write the matrix first: `A * v`",
        ),
        (
            "B * q",
            "the shapes of this product do not match\n2 columns meet 3 entries: a matrix of 3 × 2 entries times \
             a vector of 3 entries",
        ),
        (
            "dot(q, m)",
            "`dot` takes two vectors of the same length\nthese are a vector of 3 entries and a number",
        ),
        (
            "cross([1, 2], q)",
            "`cross` takes two vectors of 3 entries\nthese are a vector of 2 entries and a vector of 3 entries",
        ),
        (
            "[x, q]",
            "the entries of a vector have the same shape\nthis is a vector of 3 entries, the first entry is a number",
        ),
        ("[A, A]", "a vector of matrices\nhelp: name each of them with `let`"),
        (
            "let s[i in 1..3] = x; s[0]",
            "the indices of a `let` count from 0\nhelp: write `i in 0..…`, and shift the index in the value",
        ),
        (
            "let s[i in 0..3, j in 0..i] = x; s[0][0]",
            "the rows of a `let` have the same length\nhelp: let the second range not depend on the first index",
        ),
        (
            "let s[i in 0..3] = A; s[0][0]",
            "a `let` has at most two indices\neach of its entries is a matrix of 3 × 3 entries\nhelp: make it a function, \
             `let s(a) = …;` between the sections, whose argument is what differs, or define single entries",
        ),
    ] {
        assert_eq!(of(expression), [message], "{expression}");
    }
}

#[test]
fn calls_and_powers_are_checked() {
    let of = |expression: &str| messages(&format!("base {{ x }} lagrangian {{ {expression} }}"), STRUCT);
    let smooth = |name: &str| {
        format!(
            "`{name}` cannot be used in `lagrangian`\n`{name}` has no derivative where its branches meet, and the \
             equations need one\nhelp: use a smooth expression, such as sqrt(x^2 + eps^2) for abs(x); `abs`, \
             `sign`, `min` and `max` are at home in `forces` and `outputs`"
        )
    };
    let too_large = "this exponent is too large\nhelp: exponents are fractions with numerator and denominator of at most 1000";
    for (expression, message) in [
        ("m(x)", "`m` is not a function\nhelp: for a product write `m * (…)`".to_owned()),
        ("sine(x)", "unknown function `sine`\nhelp: did you mean `sin`?".to_owned()),
        ("ddt(x)", "unknown function `ddt`\nhelp: write `der(x)`".to_owned()),
        ("log(x)", "unknown function `log`\nhelp: write `ln(x)`".to_owned()),
        ("sin(x, m)", "`sin` takes 1 argument, and 2 are given\nhelp: write `sin(x)`".to_owned()),
        ("atan2(x)", "`atan2` takes 2 arguments, and 1 are given\nhelp: write `atan2(y, x)`".to_owned()),
        (
            "x^m",
            "an exponent must be a rational number\nthis one is not known when the equations are derived\nhelp: \
             write a^b as `exp(b * ln(a))`, for a > 0"
                .to_owned(),
        ),
        ("x^1001", too_large.into()),
        ("x^(-9223372036854775808)", too_large.into()),
        ("abs(x)", smooth("abs")),
        ("max(x, m)", smooth("max")),
        (
            "self.motor(x)",
            "`self.motor(…)` cannot be used in `lagrangian`\nwhat a method computes is not known when the equations \
             are derived\nhelp: methods have their place in `forces` and `outputs`"
                .to_owned(),
        ),
    ] {
        assert_eq!(of(expression), [message], "{expression}");
    }
    let of_family = messages("base { q[2] } lagrangian { q(0) }", STRUCT);
    assert_eq!(
        of_family,
        ["`q` is not a function\nhelp: an entry is written `q[…]`, for a product write `q * (…)`"]
    );
    let unknown = of("quux(x)");
    assert!(unknown[0].starts_with("unknown function `quux`\nhelp: functions are sin, cos"), "{unknown:?}");
    assert!(unknown[0].contains(", transpose,") && unknown[0].contains(", kinetic,"), "{unknown:?}");
}

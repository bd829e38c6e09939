//! Errors of shared lets, functions, rates, vectors and bodies.

use super::messages;

const STRUCT: &str = "struct S { m: f64, A: [[f64; 3]; 3] }";

/// The one error of a declaration with these lines between the sections and this Lagrangian.
fn error(shared: &str, lagrangian: &str) -> String {
    let attribute =
        format!("{shared} base {{ x, y, q[3] }} inputs {{ force }} lagrangian {{ {lagrangian} }}");
    let found = messages(&attribute, STRUCT);
    assert_eq!(found.len(), 1, "{attribute}: {found:?}");
    found[0].clone()
}

#[track_caller]
fn starts(shared: &str, lagrangian: &str, text: &str) {
    let found = error(shared, lagrangian);
    assert!(found.starts_with(text), "{shared} {lagrangian}:\n{found}\nnot\n{text}");
}

#[test]
fn cycles_are_shown() {
    starts(
        "let a = 2 * b; let b = c; let c = a;",
        "x",
        "`a` is defined by itself\n`a` needs `b`, which needs `c`, which needs `a`\nhelp:",
    );
    starts("let f(u) = f(u / 2);", "x", "the function `f` calls itself\n`f` needs `f`");
    starts(
        "let f(u) = g(u); let g(u) = f(u);",
        "f(x)",
        "the function `f` leads back to itself\n`f` needs `g`, which needs `f`",
    );
    starts(
        "let f(u) = u * k; let k = f(2);",
        "x",
        "the function `f` leads back to itself\n`f` needs `k`, which needs `f`",
    );
}

#[test]
fn functions_that_nothing_calls_are_looked_at() {
    starts("let f(u) = g(u);", "x", "unknown function `g`");
    starts("let f(u) = zz * u;", "x", "unknown name `zz`");
    starts("let f(u) = sin(u, u);", "x", "`sin` takes 1 argument, and 2 are given");
    starts("let f(u) = diff(u);", "x", "`diff` takes 2 arguments, and 1 are given");
    starts("let g(u) = u; let f(u) = g(u, u);", "x", "`g` takes 1 argument, and 2 are given");
    starts("let g(u) = u; let f(u) = g * u;", "x", "`g` is a function and needs its arguments");
    starts("let f(u) = m(u);", "x", "`m` is not a function");
}

#[test]
fn one_name_has_one_meaning() {
    starts("let k = 1;", "let k = 2; x", "`k` is declared twice\nit is an abbreviation (a `let`) already");
    starts(
        "let k = 1;",
        "sum(k in 0..2: x)",
        "`k` is declared twice\nit is an abbreviation (a `let`) already",
    );
    starts("let f(x) = x;", "f(1)", "`x` is declared twice\nit is a base coordinate already");
    starts("let f(x) = x;", "1", "`x` is declared twice\nit is a base coordinate already");
    starts("let f(u, u) = u;", "f(x, y)", "two arguments are called `u`");
    starts("let f(u, u) = u;", "x", "two arguments are called `u`");
    starts("let f(u) = sum(u in 0..3: x);", "x", "`u` is declared twice\nit is an argument already");
    starts("let norm(v) = v;", "x", "`norm` is a function already");
    starts("let m = 1;", "x", "`m` is declared twice\nit is a parameter (a field of the struct) already");
}

#[test]
fn a_section_is_told_what_it_cannot_take() {
    let cases = [
        (
            "let v = 2 * w; let w = der(x); base { x } on { v = 0; } lagrangian { 1 }",
            "`der(…)` cannot be used in `on`\nit is in `v`, which needs `w`\nidentities are functions of the base",
        ),
        (
            "let push = gain * u; let gain = 2; base { x } inputs { u } lagrangian { m * der(x)^2 }
             constraints { der(x) = push; }",
            "the input `u` cannot be used in `constraints`\nit is in `push`\na constraint holds at all times, and an input may jump\nhelp: command its rate",
        ),
        (
            "let f(z) = abs(z); base { x } lagrangian { m * der(x)^2 - f(x) }",
            "`abs` cannot be used in `lagrangian`\nit is in `f`\n`abs` has no derivative",
        ),
        (
            "let f(z) = max(z, 0); base { x, y } lagrangian { m * (der(x)^2 + der(y)^2) - f(x) - f(y) - f(x + y) }",
            "`max` cannot be used in `lagrangian`\nit is in `f`\n`max` has no derivative",
        ),
        (
            "let k = 2; constants { l = k; } base { x } lagrangian { m * der(x)^2 }",
            "the `let` `k` cannot be used in `constants`",
        ),
    ];
    for (attribute, text) in cases {
        let found = messages(attribute, STRUCT);
        assert!(found.len() == 1 && found[0].starts_with(text), "{attribute}: {found:?}");
    }
}

#[test]
fn a_let_of_another_section_is_named_with_its_section() {
    let found = messages("base { x } lagrangian { let k = 2; m * der(x)^2 } outputs { y = k; }", STRUCT);
    assert_eq!(
        found,
        [
            "unknown name `k`\n`k` is a `let` of `lagrangian`, where it stays, from its line on\nhelp: put that `let` \
          between the sections, where all of them know it"
        ]
    );
}

#[test]
fn functions_are_called_with_what_they_take() {
    starts("let f(u, v) = u * v;", "f(x)", "`f` takes 2 arguments, and 1 are given\nhelp: write `f(u, v)`");
    starts("let f(u) = u;", "f", "`f` is a function and needs its arguments\nhelp: write `f(u)`");
    starts(
        "let f(u) = u^2;",
        "f([x, y])",
        "a power of a vector of 2 entries\nhere `u` is a vector of 2 entries\nhelp: for the square",
    );
    starts("let f(u) = u + unheard;", "1", "unknown name `unheard`");
}

#[test]
fn rates_that_are_not_known() {
    starts(
        "",
        "der(x * der(y))",
        "the rate of this is not known, because it depends on `y_dot`\n`y_dot` is a velocity; `der` takes expressions \
         of base coordinates, auxiliary states, parameters and `t`\nhelp: accelerations are what is derived",
    );
    let found =
        messages("base { x } inputs { u } lagrangian { m * der(x)^2 } outputs { s = der(x * u); }", STRUCT);
    assert!(
        found[0].starts_with("the rate of this is not known, because it depends on `u`\n`u` is an input"),
        "{found:?}"
    );
}

#[test]
fn derivatives_by_what_is_no_variable() {
    starts(
        "",
        "diff(x^2, 2)",
        "`2` is nothing that a derivative is taken by\nhelp: a derivative is taken by",
    );
    starts("let k = x + y;", "diff(k^2, k)", "`x + y` is nothing that a derivative is taken by");
    starts("", "diff(A, q)[0][0]", "a derivative with more than two indices\na matrix of 3 × 3 entries is");
}

#[test]
fn shapes_are_shown() {
    starts("", "q[1..5][0]", "the part 1..5 is out of range\n`q` has 3 entries, counted from 0");
    starts("", "q[2..2][0]", "the part 2..2 has no entries");
    starts("", "dot(q, hat(A) * q)", "`hat` takes a vector of 3 entries\nthis is a matrix of 3 × 3 entries");
    starts("", "vee(q)[0]", "`vee` takes a matrix of 3 × 3 entries\nthis is a vector of 3 entries");
    starts("", "transpose(q)[0]", "`transpose` takes a matrix\nthis is a vector of 3 entries");
    starts("", "norm(A)", "`norm` takes a vector\nthis is a matrix of 3 × 3 entries");
    starts("", "diag(q, x)[0][0]", "expected a number, this is a vector of 3 entries");
    starts("", "identity(0)[0][0]", "an identity matrix of 0 rows");
    starts(
        "",
        "rot([1, 0], x)[0][0]",
        "the axis of `rot` is a vector of 3 entries\nthis is a vector of 2 entries",
    );
    starts(
        "",
        "body_rate(q)[0]",
        "`body_rate` takes a matrix of 3 × 3 entries, or an angle\nthis is a vector",
    );
    starts(
        "",
        "velocity_at(q, x, [x, y])[0]",
        "`velocity_at` takes a point of the body, its attitude, and where the material point is\nthese are a vector of 3 \
         entries, a number, a vector of 2 entries\nhelp: in space a point is",
    );
    starts(
        "",
        "kinetic(m, q, [x, y], x)",
        "`kinetic` takes a mass, an inertia, the centre of mass and the attitude\nthese are a number, a vector of 3 \
         entries, a vector of 2 entries, a number",
    );
    starts(
        "",
        "kinetic(m, 1, q)",
        "`kinetic` takes 2 or 4 arguments, and 3 are given\nhelp: write `kinetic(m, p)` or",
    );
    let parameters = "an expression of parameters\nit depends on `q[0]`\nhelp: `kinetic` takes `(m, p)` or";
    starts("", "kinetic(m, q, A[0], A)", &format!("the inertia of a body is {parameters}"));
    starts("", "kinetic(m * q[0], A[0], q, rot_z(x))", &format!("the mass of a body is {parameters}"));
    starts("", "kinetic(dot(q, q), [x, y])", &format!("the mass of a point is {parameters}"));
    starts(
        "",
        "kinetic(m, x)",
        "`kinetic(m, p)` takes a point: a vector of 2 or 3 entries\nthis is a number",
    );
    starts(
        "",
        "dot([x, y], q[0..2] + q)",
        "only what has the same shape can be added\nthis is a vector of 3 entries",
    );
}

//! Tests of expressions: what binds how, and every error text.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use super::testing::{expression, shown};

fn read(text: &str) -> String {
    match expression(text.parse().expect("tokens")) {
        Ok(expr) => shown(&expr),
        Err(error) => panic!("{text}: {error}"),
    }
}

fn refused(text: &str) -> String {
    match expression(text.parse().expect("tokens")) {
        Ok(expr) => panic!("{text} was read as {}", shown(&expr)),
        Err(error) => error.to_string(),
    }
}

#[test]
fn operators_bind_as_in_mathematics() {
    for (text, meaning) in [
        ("a + b * c", "(a + (b * c))"),
        ("a - b - c", "(a - b - c)"),
        ("a - (b - c)", "(a - (b - c))"),
        ("a / b / c * d", "(a / b / c * d)"),
        ("-a^2", "(-(a^2))"),
        ("-a * b", "((-a) * b)"),
        ("a * -b", "(a * (-b))"),
        ("--a", "(-(-a))"),
        ("a^b^c", "(a^(b^c))"),
        ("2^-3^2", "(2^(-(3^2)))"),
        ("a^2 * b^(1/2)", "((a^2) * (b^(1 / 2)))"),
        ("(J + m * (a^2 + b^2)) / 2 * omega^2", "((J + (m * ((a^2) + (b^2)))) / 2 * (omega^2))"),
    ] {
        assert_eq!(read(text), meaning);
    }
}

#[test]
fn values() {
    for (text, meaning) in [
        ("0.5", "0.5"),
        (".5", ".5"),
        ("-.5e3 + 2.", "((-.5e3) + 2.)"),
        ("1e-3", "1e-3"),
        ("I[0] * A[i][j + 1]", "(I[0] * A[i][(j + 1)])"),
        ("(a + b)[0]", "(a + b)[0]"),
        ("der(x) + der(theta[0])", "(der(x) + der(theta[0]))"),
        ("atan2(y, x,)", "atan2(y, x)"),
        ("dot(w, I * w)", "dot(w, (I * w))"),
        ("cross([1, 2, 3], u)[2]", "cross([1, 2, 3], u)[2]"),
        ("self.motor(omega, 2)", "self.motor(omega, 2)"),
        ("sum(i in 0..4: m[i])", "sum(i in 0..4: m[i])"),
        ("sum(i in i..n - 1, j in 0..i: i*j)", "sum(i in i..(n - 1), j in 0..i: (i * j))"),
        ("sum(i in 0..3: sum(j in i..3: A[i][j]))", "sum(i in 0..3: sum(j in i..3: A[i][j]))"),
        ("r#type + pi * t", "(type + (pi * t))"),
    ] {
        assert_eq!(read(text), meaning);
    }
}

#[test]
fn fragments_of_other_macros_are_opened() {
    let hidden = |text: &str| {
        let inside: TokenStream = text.parse().expect("tokens");
        TokenTree::Group(Group::new(Delimiter::None, inside))
    };
    let twice = |text: &str| TokenTree::Group(Group::new(Delimiter::None, hidden(text).into()));
    let read = |before: &str, fragment: TokenTree, after: &str| {
        let mut tokens: TokenStream = before.parse().expect("tokens");
        tokens.extend([fragment]);
        tokens.extend(after.parse::<TokenStream>().expect("tokens"));
        shown(&expression(tokens).expect("an expression"))
    };
    assert_eq!(read("2 *", hidden("a + b"), ""), "(2 * (a + b))");
    assert_eq!(read("", hidden("x"), "^2"), "(x^2)");
    assert_eq!(read("", twice("x"), "[0]"), "x[0]");
    assert_eq!(read("", twice("-3"), "* y"), "((-3) * y)");
    assert_eq!(read(".", hidden("5"), ""), ".5");
    assert_eq!(read("sin", hidden("(x)"), ""), "sin(x)");
    let negative = TokenTree::Literal(proc_macro2::Literal::i32_unsuffixed(-2));
    assert_eq!(read("x +", negative, ""), "(x + (-2))");
}

#[test]
fn long_expressions_are_not_deep() {
    assert!(read(&format!("x{}", " + x * y".repeat(20_000))).len() > 20_000);
}

#[test]
fn deep_expressions_are_refused() {
    let deep = "this expression is nested more than 64 levels deep\nhelp: name its inner parts with `let`";
    for text in [
        format!("{}x", "-".repeat(100_000)),
        format!("{}x", "x^".repeat(100_000)),
        format!("{}x{}", "(".repeat(10_000), ")".repeat(10_000)),
        format!("{}x{}", "sin(".repeat(10_000), ")".repeat(10_000)),
        format!("{}x{}", "[".repeat(10_000), "]".repeat(10_000)),
        format!("{}x{}", "x[".repeat(10_000), "]".repeat(10_000)),
        format!("{}0..1: x){}", "sum(i in ".repeat(10_000), "..1: x)".repeat(9_999)),
    ] {
        assert_eq!(refused(&text), deep);
    }
    assert!(read(&format!("{}x{}", "(".repeat(60), ")".repeat(60))).contains('x'));
}

#[test]
fn habits_are_corrected() {
    for (text, message) in [
        ("a ** 2", "`**` is not an operator\nhelp: write `^` for a power"),
        ("a += 2", "`+=` is not an operator\nhelp: write equations out, with a single `=`"),
        ("a -> b", "`->` is not an operator"),
        ("a == 2", "`==` is not part of an equation\nhelp: write a single `=`"),
        ("m·v", "`m·v` is a single name to Rust, not a product\nhelp: write `m * v`"),
        ("2x", "`2x` is a single number to Rust\nhelp: for a product write `2 * x`"),
        ("x.sin()", "functions are not called as methods\nhelp: write `sin(x)`"),
        ("(a+b).powi(2)", "functions are not called as methods\nhelp: write `(a + b)^2`"),
        ("x.powf(1/2)", "functions are not called as methods\nhelp: write `x^(1 / 2)`"),
        ("x.atan2(y)", "functions are not called as methods\nhelp: write `atan2(x, y)`"),
        ("x.sin_cos()", "functions are not called as methods\nhelp: write `sin(x)` and `cos(x)`"),
        ("x.signum()", "functions are not called as methods\nhelp: write `sign(x)`"),
        ("x.recip()", "functions are not called as methods\nhelp: write `1 / x`"),
        (
            "body.mass",
            "`body.mass` is not an expression here\nhelp: parameters, coordinates and velocities are \
             written by their names alone",
        ),
        ("x .5", "a `.` behind a value\nhelp: numbers are written `0.5` or `.5`; a product takes a `*`"),
        ("self.m", "fields are written without `self`\nhelp: write `m`"),
        (
            "self",
            "`self` alone is no number\nhelp: write the name of a field, or call a method: \
             `self.motor(omega)`",
        ),
        ("self.(x)", "expected the name of a method, found parentheses"),
        ("sin x", "`sin` is a function and needs its parentheses\nhelp: write `sin(x)`"),
        ("sin 2", "`sin` is a function and needs its parentheses\nhelp: write `sin(2)`"),
        ("sin", "`sin` is a function and needs its parentheses\nhelp: write `sin(…)`"),
        ("sin^2(x)", "`sin` is a function\nhelp: a power of its value is written `sin(…)^2`"),
        (
            "std::f64::consts::PI",
            "paths are not part of expressions\nhelp: `pi` is π; other constants become fields of the \
             struct, or are written as numbers",
        ),
        ("vec![1]", "macros are not expanded here: `vec!`"),
        (
            "if a { b } else { c }",
            "`if` has no place in an expression\nhelp: expressions do not branch; forces and outputs have \
             `abs`, `sign`, `min`, `max`",
        ),
        (
            "1 + for",
            "`for` has no place in an expression\nhelp: a sum is written `sum(i in 0..4: …)`; `for` goes \
             around whole items",
        ),
        (
            "1 + let",
            "`let` has no place in an expression\nhelp: put `let name = …;` on a line of its own, before \
             it is used",
        ),
        ("true", "`true` is no number"),
        ("x as f64", "`as` has no place in an expression\nhelp: numbers are exact: there is nothing to cast"),
        ("+ a", "a `+` with nothing before it\nhelp: leave it out"),
        ("{ a }", "braces do not group an expression\nhelp: write parentheses"),
        ("&a", "expected an expression, found `&`\nhelp: values are not references here"),
        ("*a", "expected an expression, found `*`\nhelp: values are not references here"),
        ("a && b", "conditions are not joined with `&&`\nhelp: write one condition per line, ended with `;`"),
        ("a || b", "conditions are not joined with `||`\nhelp: write one condition per line, ended with `;`"),
        ("a < b", "a comparison has no place here\nhelp: facts about parameters stand in `assume`"),
        (
            "a >= 0",
            "a comparison has no place here\nhelp: facts about parameters stand in `assume`, gaps that close in \
             `impacts { stop: x >= 0; }`",
        ),
        ("a % b", "`%` is not an operator\nhelp: expressions have `+ - * / ^`"),
        ("!a", "`!` is not an operator\nhelp: expressions have `+ - * / ^`"),
        ("|a|", "`|` is not an operator\nhelp: a length is written `sqrt(dot(v, v))`, a magnitude `abs(x)`"),
        ("A @ b", "`@` is not an operator\nhelp: a matrix times a vector is written with `*`"),
        ("x 'a", "a prime is not part of a name\nhelp: the velocity of `x` is written `der(x)`"),
        ("0..4", "a range has no place here\nhelp: ranges stand in `sum`, `for` and `let x[i in 0..4]`"),
        ("#[a] x", "attributes have no place here\nhelp: doc comments stand before declared names"),
    ] {
        assert_eq!(refused(text), message, "{text}");
    }
}

#[test]
fn malformed_expressions_are_explained() {
    for (text, message) in [
        ("", "expected an expression, found nothing"),
        ("a +", "expected an expression after `+`"),
        ("a * / b", "expected an expression, found `/`"),
        ("()", "expected an expression between the parentheses"),
        ("(a, b)", "expected `)`, found `,`"),
        ("[]", "an empty vector\nhelp: list its components: `[a, b, c]`"),
        (".x", "expected an expression, found `.`"),
        (".5.5", "`.5.5` is not a number"),
        ("A[i, j]", "two indices in one bracket\nhelp: write `A[i][j]`"),
        ("A[0][1][2]", "a third index\nhelp: families and arrays have one or two indices"),
        ("A[]", "expected an expression, found nothing"),
        (
            "(a)(b)",
            "an operator or a `;` is missing between `(a)` and `(b)`\nhelp: a product is written \
             `(a) * (b)`",
        ),
        ("2 x", "an operator or a `;` is missing between `2` and `x`\nhelp: a product is written `2 * x`"),
        (
            "2[x]",
            "an operator or a `;` is missing between `2` and `[x]`\nhelp: a product is written with `*`",
        ),
        ("f(a b)", "an operator or a `;` is missing between `a` and `b`\nhelp: a product is written `a * b`"),
        ("f(a; b)", "expected `,` or `)`, found `;`"),
        (
            "type + 1",
            "expected an expression, found `type`, a word that Rust keeps for itself\nhelp: choose another name, or write `r#type`",
        ),
        (
            "der()",
            "`der` of nothing\nhelp: `der` takes a base coordinate or an expression of them: `der(x)`, `der(p - q)`",
        ),
        (
            "sum(i in 0..2, x[i])",
            "expected another range, found `x`\nhelp: a summand stands behind a `:`, as in `sum(i in 0..4: …)`; a \
             range reads `j in 0..4`",
        ),
        ("sum(m[i])", "expected `in` and a range, found brackets\nhelp: a range reads `i in 0..4`"),
        ("sum(0)", "expected a variable, found `0`\nhelp: a range reads `i in 0..4`"),
        (
            "sum(i in 3: i)",
            "expected `..` and the end of the range, found `:`\nhelp: a range reads `i in 0..4`",
        ),
        ("sum(i in 0..=3: i)", "a range leaves out its end\nhelp: write `0..4` for 0, 1, 2, 3"),
        (
            "sum(i in 0..3)",
            "expected `:` and what is summed after `3`\nhelp: a sum reads `sum(i in 0..4: m[i] * v[i]^2)`",
        ),
    ] {
        assert_eq!(refused(text), message, "{text}");
    }
}

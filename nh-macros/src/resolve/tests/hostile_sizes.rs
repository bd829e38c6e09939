//! No declaration hangs the compiler: what is too large is refused, and soon.

use nonholonomic_core::limits::timed;

use super::messages;

/// The texts one after the other.
fn joined(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().concat()
}

/// The first lines of the errors. Unoptimised this takes its time on the processor, but not much.
fn first_lines(attribute: &str, item: &str) -> Vec<String> {
    let (found, seconds) = timed(|| messages(attribute, item));
    assert!(seconds < 20.0, "{seconds} s");
    found.iter().map(|message| message.lines().next().unwrap_or_default().to_owned()).collect()
}

fn too_large(attribute: &str, item: &str) {
    assert_eq!(
        first_lines(attribute, item),
        ["this declaration is too large, because up to here it takes more than 400000 steps to write out"],
        "{attribute}"
    );
}

#[test]
fn sums_and_loops() {
    too_large("base { x } lagrangian { sum(i in 0..4096, j in 0..4096: x^i * j) }", "struct S;");
    too_large("base { x } lagrangian { sum(i in 0..4096, j in 0..4096: 0) }", "struct S;");
    too_large("base { x } lagrangian { x } constraints { for i in 0..4096, j in 0..4096 { } }", "struct S;");
    too_large(
        "base { x } lagrangian { sum(i in 0..100, j in 0..100, k in 0..100: sin(x + i * j + k)) }",
        "struct S;",
    );
    let nested = (0..8).fold("x = 0;".to_owned(), |body, k| format!("for i{k} in 0..9 {{ {body} }}"));
    too_large(&format!("base {{ x }} lagrangian {{ x }} constraints {{ {nested} }}"), "struct S;");
}

#[test]
fn matrices() {
    too_large("base { x } lagrangian { let B = A * A * A; x * B[0][0] }", "struct S { A: [[f64; 64]; 64] }");
    too_large("base { x } lagrangian { let B = A * A; x * B[0][0] }", "struct S { A: [[f64; 64]; 64] }");
}

const LONG: &str = "the numbers in this expression become too long";

/// Two hundred abbreviations, each made of the one before it, which is `@`.
/// A matrix that is asked for what it is made of has been multiplied thousands of times.
#[test]
fn products_of_products() {
    let steps =
        joined((1..3000).map(|k| format!("let A{k} = A{} * [[1, 0, 0], [0, 1, 0], [0, 0, 1]];", k - 1)));
    let attribute = format!(
        "base {{ q[4] }} let A0 = [[q[0], q[1], 0], [0, q[2], 0], [0, 0, q[3]]]; {steps}
         lagrangian {{ kinetic(1, 1, [q[0], q[1], q[2]], A2999) }}"
    );
    assert!(first_lines(&attribute, "struct S;").is_empty());
}

fn doubling(start: &str, step: &str) -> String {
    let line = |k: i32| format!("let a{k} = {};", step.replace('@', &format!("a{}", k - 1)));
    let lines = joined((1..200).map(line));
    format!("base {{ x }} lagrangian {{ let a0 = {start}; {lines} a199 }}")
}

#[test]
fn numbers_that_double() {
    assert_eq!(first_lines(&doubling("3", "@ * @"), "struct S;"), [LONG]);
    let steep = ["an exponent in this expression becomes too large"];
    assert_eq!(first_lines(&doubling("3 * x + 5", "@^9"), "struct S;"), steep);
    assert_eq!(first_lines(&doubling("x", "@ * @"), "struct S;"), steep);
    assert!(first_lines(&doubling("x", "@ + sin(@)"), "struct S;").is_empty());
}

#[test]
fn long_fractions() {
    too_large("base { x } lagrangian { x * sum(i in 1..4096: 1 / i) }", "struct S;");
    let digits = "9".repeat(900);
    let long = joined((0..1000).map(|k| format!("+ 1 / (1{digits} - {k})")));
    too_large(&format!("base {{ x }} lagrangian {{ x {long} }}"), "struct S;");
    let two = format!("base {{ x }} lagrangian {{ x + 1 / {digits} + 1 / (1 + {digits}) }}");
    assert_eq!(first_lines(&two, "struct S;"), [LONG]);
}

#[test]
fn growing_sums() {
    let lines = joined((1..2000).map(|k| format!("let a{k} = a{} + sin(x + {k}) * a{};", k - 1, k / 2)));
    too_large(&format!("base {{ x }} lagrangian {{ let a0 = x; {lines} a1999 }}"), "struct S;");
}

#[test]
fn indices_at_the_ends_of_the_integers() {
    for (ranges, found) in [
        ("i in 0..3, j in (i - 1) * 9e18..(i - 1) * 9e18 + 1", "the rows of a `let` have the same length"),
        ("i in 0..2, j in i * 9e18..i * 9e18 + 2", "the rows of a `let` have the same length"),
        ("i in -9223372036854775807..-9223372036854775806", "the indices of a `let` count from 0"),
        ("i in 9223372036854775806..9223372036854775807", "the indices of a `let` count from 0"),
        ("i in -9e18..9e18", "a range of 9223372036854775807 values"),
    ] {
        let declaration = format!("base {{ x }} lagrangian {{ let a[{ranges}] = x; x }}");
        assert_eq!(first_lines(&declaration, "struct S;"), [found], "{ranges}");
    }
}

#[test]
fn dimensions() {
    assert_eq!(
        messages("base { x[4096] } lagrangian { x[0] }", "struct S;"),
        ["`base` declares 4096 entries\nhelp: at most 512 can be treated; split the system"]
    );
}

/// What a compiler gets of a declaration in error is no longer than that of a large system: records of many thousand entries
/// let it run out of stack.
#[test]
fn the_expansion_of_an_error_is_short() {
    for attribute in [
        "base { x[9] } lagrangian { dot(der(x), der(x)) }
         constraints { for i in 0..4000 { for j in 0..4000 { der(x[0]) = i * j; } } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } constraints { for i in 0..20000 { der(x[0]) = i; } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } on { for i in 0..20000 { x[0] = i; } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } holonomic { for i in 0..20000 { x[0] = i; } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } symmetries { for i in 0..20000 { turn[i]: der(x[0]); } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } outputs { for i in 0..20000 { o[i] = i; } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } conserved { for i in 0..20000 { o[i] = i; } }",
        "base { x[9] } lagrangian { dot(der(x), der(x)) } impacts { for i in 0..20000 { floor: x[0] >= i; } }",
    ] {
        let tokens = crate::expand::nonholonomic(attribute.parse().unwrap(), "struct S;".parse().unwrap());
        let length = tokens.to_string().len();
        assert!(length < 1_000_000, "{attribute}: {length}");
    }
}

#[test]
fn many_errors() {
    let names = joined((0..5000).map(|k| format!("+ name{k}")));
    let found = first_lines(&format!("base {{ x }} lagrangian {{ x {names} }}"), "struct S;");
    assert_eq!(found.len(), 200);
}

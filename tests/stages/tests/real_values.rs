//! What has a real value somewhere, and what has none: potentials, assumptions, constraints and identities, some of
//! them just inside of their range and some just outside.

use nh_stages::{declarations, errors};

/// Functions of x and y without a real value anywhere.
const UNDEFINED: [&str; 59] = [
    "sqrt(sin(x)+cos(x)-3/2)",
    "ln(3*sin(x)+4*cos(x)-5)",
    "(3*sin(x)+4*cos(x)-51/10)^(1/2)",
    "ln(sin(x)+cos(x)+sin(y)+cos(y)-3)",
    "sqrt(sin(x)*cos(x)-1)",
    "sqrt(sin(x)*cos(x)-3/4)",
    "ln(sin(x)^2+2*cos(x)^2-5/2)",
    "sqrt(sin(x)+cos(2*x)-2)",
    "acos(2+sin(x)/2)*x",
    "asin(cosh(x)+1/1000)*y",
    "acos(1+x^2+y^2-2*x*y+1/10)",
    "sqrt(2*x*y-x^2-2*y^2-1)",
    "sqrt(x-exp(x))",
    "sqrt(ln(x)-x)",
    "ln(tanh(x)-1)",
    "sqrt(atan(x)-2)",
    "ln(cos(x)-cosh(x))",
    "sqrt(sinh(x)-cosh(x))",
    "sqrt(x/(1+x^2)-1)",
    "ln(x^2*y^2 - x^4 - y^4 - 1)",
    "sqrt(1-sqrt(2+x^2))",
    "sqrt(x-sqrt(x^2+1))",
    "sqrt(x-1)+ln(-x)",
    "sqrt(x+y-1)+ln(-x)+ln(-y)",
    "sqrt(1-x^2-y^2)*ln(x+y-2)",
    "(sin(x)-2)^(3/2)",
    "sqrt(sin(x)*cos(y) - cos(x)*sin(y) - 1)",
    "ln(sin(x)*sin(y)+cos(x) - 3/2)",
    "ln(x*y - x^2 - y^2)",
    "sqrt(2*sin(x)*y - y^2 - 2)",
    "acos(2 + sin(x)*cos(x))",
    "asin(sin(x)+cos(x)+3)",
    "ln(exp(x)*exp(-x) - 1 - y^2)",
    "sqrt(1 - cosh(x)^2 - y^2)",
    "sqrt(sinh(x)^2 - cosh(x)^2)",
    "ln(tanh(x)^2 + 1/cosh(x)^2 - 1 - x^2)",
    "sqrt(x^2 - sqrt(x^4 + 1))",
    "sqrt(sqrt(x) - x - 1)",
    "ln(x/(x^2+1) - 3/5)",
    "ln(1/(1+x^2) + 1/(1+y^2) - 2)",
    "sqrt(x*y/(x^2+y^2+1) - 1/2)",
    "ln(cos(x) - exp(y^2))",
    "ln(cos(x) - 1)*y",
    "sqrt(cos(x)^2 - 2*cos(x) + 1/2 - 4)",
    "ln(x) + ln(y) + sqrt(-x*y)",
    "ln(x*y)+ln(-x)+ln(y)",
    "acos(x)*ln(x-1)",
    "acos(x)*acos(y)*ln(x+y-2)",
    "acos(x)*acos(y)*ln(x^2+y^2-2)",
    "sqrt(atan(x)+atan(y)-4)",
    "(x^2+1)^(1/2)*(cos(3*x)*cos(5*y) - 2)^(1/3)",
    "acos((x^2+y^2+5)/4)*x + 1/sqrt(x)*0",
    "sqrt(sin(x)^4 + cos(x)^4 - 11/10)",
    "sqrt(1/3 - sin(x)^4 - cos(x)^4)",
    "ln(x^3*y - x^4 - y^4 - 1)",
    "ln(2*x - exp(x))",
    "sqrt(ln(x) - sqrt(x))",
    "sqrt(sin(x) - x^2 - 1)",
    "ln(sin(x) - x - 4) + ln(x)",
];

/// Functions with one somewhere.
const DEFINED: [&str; 32] = [
    "acos(-1)*x",
    "asin(1)*x^2",
    "acos(cos(x)^2 + sin(x)^2)*y",
    "sqrt(sin(x)+cos(x)+3/2)",
    "sqrt(3*sin(x)+4*cos(x)-4)",
    "ln(sin(x)+cos(x)+sin(y)+cos(y)-2)",
    "sqrt(sin(x)*cos(x)-1/4)",
    "sqrt(sin(x)+cos(2*x)-1)",
    "sqrt(3*x*y-x^2-2*y^2-1)",
    "sqrt(ln(x)-x+2)",
    "ln(1-tanh(x))",
    "sqrt(atan(x)-3/2)",
    "sqrt(x/(1+x^2)-1/3)",
    "ln(3*x^2*y^2 - x^4 - y^4 - 1)",
    "ln(3*x^2*y^2 - x^4*y^2 - x^2*y^4 - 1/2)",
    "sqrt(sqrt(x^2+1)-x)",
    "sqrt(1-x^2-y^2)*ln(x+y-1)",
    "sqrt(sin(x)*cos(y) - cos(x)*sin(y) - 9/10)",
    "ln(sin(x)*sin(y)+cos(x) - 7/5)",
    "sqrt(2*sin(x)*y - y^2 - 1/2)",
    "acos(1/3 + sin(x)*cos(x))",
    "sqrt(x^2 - sqrt(x^4 - 1))",
    "sqrt(sqrt(x) - x)",
    "ln(x/(x^2+1) - 2/5)",
    "sqrt(x*y/(x^2+y^2+1) - 1/3)",
    "ln(x*y)+ln(-x)+ln(-y)",
    "acos(x)*acos(y)*ln(x^2+y^2-1)",
    "sqrt((x-1)^2+y^2) + 1/sqrt((x+1)^2+y^2)",
    "(sqrt(x^2+y^2) - 1)^2 + ln(x^2+y^2)",
    "sqrt(5 + 4*cos(x) - cos(y)) + sqrt(3 - 2*cos(x-y))",
    "acos((x^2+y^2-5)/4) + atan2(y, x)",
    "sqrt(sin(x)^4 + cos(x)^4 - 9/10)",
];

/// The same for parameters as they are assumed.
const UNDEFINED_AS_ASSUMED: [(&str, &str); 3] = [
    ("sqrt(a*sin(x)+b*cos(x)-c)", "a^2+b^2 < 1; c > 1;"),
    ("sqrt(-a*x^2-b)", "a > 0; b > 0;"),
    ("sqrt(a*sin(x)+a*cos(x)-2*a)", "a > 0;"),
];

/// And what is defined so.
const DEFINED_AS_ASSUMED: [(&str, &str); 1] = [("sqrt(a*sin(x)+a*cos(x)-a)", "a > 0;")];

/// Assumptions that no numbers satisfy.
const CONTRADICTORY: [&str; 55] = [
    "a/b + b/a < 2; a > 0; b > 0;",
    "a + b + c < 3*(a*b*c)^(1/3); a > 0; b > 0; c > 0;",
    "a^2 + 2/a < 2.9; a > 0;",
    "a/b > 0; b^3*c > 0; a/c < 0;",
    "a*b > 0; b*c > 0; c*m < 0; a*m > 0;",
    "atan(a) > pi/2;",
    "acos(a) > pi;",
    "asin(a) + 2*atan(b) >= 3*pi/2;",
    "atan2(a, b) > pi;",
    "a*sin(b) > c; a > 0; c > a;",
    "a*sin(b) + a*cos(c) > 2*a; a > 0;",
    "a*tanh(b) >= a; a > 0;",
    "sin(a)+cos(a) > 3/2;",
    "a > exp(a);",
    "a^2+b^2 < 1; a+b > 3/2;",
    "a > 0; b > 0; a+b < 1; a*b > 1/3;",
    "a*b > 0; b*c > 0; a*c < 0;",
    "a > 0; a < 1; a^2 > a;",
    "a > 2; sqrt(a) < 1.4;",
    "a/b > 2; b > 0; a < b;",
    "ln(a) > a;",
    "a^3 > b^3; a < b;",
    "a != a;",
    "tanh(a)^2 > 1;",
    "(a-b)^2 < 0;",
    "a >= b; b >= c; c >= a; a != c;",
    "a^2 < b^2; a > 0; b > 0; a > b;",
    "1/a > 1; a > 2;",
    "a^2 + b^2 + c^2 < a*b + b*c + c*a;",
    "a > 0; b > 0; (a+b)^2 < 4*a*b;",
    "a > b; b > 0; a/b < 1;",
    "sqrt(a) + sqrt(b) < 0;",
    "sqrt(a*b) > (a+b)/2; a > 0; b > 0;",
    "a + 1/a < 2; a > 0;",
    "exp(a) < 1 + a;",
    "cosh(a) < 1 + a^2/2;",
    "a > b; b > c; c > 0; a < c;",
    "a^2 > 4; a > -2; a < 2;",
    "a*b*c > 0; a > 0; b < 0; c > 0;",
    "a + b > c; b + c > a; c + a > b; a < 0;",
    "a > 0; a^3 < 0;",
    "a >= 1; b >= 1; a*b < 1;",
    "sin(a)*cos(a) > 3/5;",
    "a != 0; a^2 <= 0;",
    "a > 1; ln(a) < 0;",
    "a > 1; b > a^2; b < a;",
    "asin(a) > 1; a < 1/2;",
    "acos(a) < 1; a < 1/2;",
    "sinh(a) > 2; tanh(a) < 1/2;",
    "cosh(a) < 2; a > 1.4;",
    "atan(a) > 1; ln(a) < 0.4;",
    "a > 0; a < 3; sin(a) < 0;",
    "a > 4; a < 6; sin(a) > -1/4;",
    "a > -1; a < 1; cos(a) < 1/2;",
    "a > 1; a < 2; b > 0; b < 1; cos(a*b) < -0.42;",
];

/// Assumptions that some do.
const CONSISTENT: [&str; 22] = [
    "a/b + b/a <= 2; a > 0; b > 0;",
    "a + b + c < 3.1*(a*b*c)^(1/3); a > 0; b > 0; c > 0;",
    "a^2 + 2/a < 3.1; a > 0;",
    "a*b < 0; b*c < 0; c*m < 0; a*m < 0;",
    "atan(a) > 3/2; atan(a) < pi/2;",
    "acos(a) >= pi;",
    "a*sin(b) > c; a > 0; c > a/2;",
    "a*tanh(b) >= c; a > 0; c > a - 1;",
    "a^2+b^2 < 1; a+b > 7/5;",
    "a^2 + b^2 + c^2 < 2*a*b + b*c;",
    "a > 0; b > 0; (a+b)^2 < 5*a*b;",
    "a + 1/a < 3; a > 0;",
    "a^2 >= 4; a > -2; a < 3;",
    "a + b > c; b + c > a; c + a > b; a > 0;",
    "a > 1/2; b > a^2; b < a;",
    "asin(a) > 1; a < 0.9;",
    "acos(a) < 1; a < 3/5;",
    "sinh(a) > 2; tanh(a) < 0.9;",
    "atan(a) > 1; ln(a) < 0.5;",
    "a > 4; a < 6; sin(a) > -0.29;",
    "a > 1.5; a < 1.6; sin(a) > 0.9999;",
    "a > 100; sin(a) > 0.999999; cos(a) < 0;",
];

/// Constraints on x, y and z that hold at no real point.
const NOWHERE: [&str; 33] = [
    "constraints { der(x)*(sin(x)+cos(x)-3/2)^(1/2) = der(y); }",
    "holonomic { sin(x)+cos(x) = 2; }",
    "holonomic { x^4+y^4+1 = x*y; }",
    "holonomic { x^2+y^2 = 1; x+y = 2; }",
    "constraints { der(x)^2+der(y)^2 = 1; der(x)+der(y) = 2; }",
    "holonomic { cos(x)*cos(y) + sin(x)*sin(y) = 3/2; }",
    "holonomic { exp(x) + exp(-x) = 1; }",
    "holonomic { x*y = 1; x + y = 1; }",
    "holonomic { (x-1)^2 + y^2 = 1; (x+2)^2 + y^2 = 1; }",
    "holonomic { x^2 + y^2 + z^2 = 2*x - 2*y - 3; }",
    "constraints { der(x)^2 + der(y)^2 + 2 = 2*der(x)*sin(z); }",
    "holonomic { x^2 + y^2 = -a; } assume { a > 0; }",
    "holonomic { x^2 + y^2 = -a^2; } assume { a > 0; }",
    "holonomic { sin(x) = a; } assume { a > 1; }",
    "holonomic { a*sin(x) + b*cos(y) = c; } assume { a > 0; b > 0; c > a + b; }",
    "holonomic { a*sin(x) - b*cos(y) = c; } assume { a > 0; b < 0; c > a - b; }",
    "holonomic { a*sin(x) + b*cos(x) = c; } assume { c > 0; c^2 > a^2 + b^2; }",
    "holonomic { a*sin(x) = c; } assume { c^2 > a^2; }",
    "holonomic { (a - b)*sin(x) = c; } assume { a > b; c > a - b; }",
    "holonomic { a*sin(x)*cos(y) = c; } assume { a > 0; c < -a; }",
    "holonomic { (a + b*cos(x))*sin(y) = c; } assume { a > 0; b > 0; c > a + b; }",
    "holonomic { a*exp(-x^2) + b*tanh(y) = c; } assume { a > 0; b > 0; c > a + b; }",
    "holonomic { a*tanh(x) = c; } assume { a > 0; c >= a; }",
    "holonomic { a*cosh(x) + b*sin(y) = c; } assume { a > 0; b > 0; c + b < a; }",
    "holonomic { a*atan(x) = c; } assume { a > 0; c > 2*a; }",
    "holonomic { a*sin(x) + b*y^2 + c = 0; } assume { a > 0; b > 0; c > a; }",
    "holonomic { a*cosh(y)*sin(x) + c*cosh(y) = -1; } assume { a > 0; c > a; }",
    "holonomic { a*cos(x) + b*cos(y) = c; a*sin(x) + b*sin(y) = 0; } assume { a > 0; b > 0; c > 0; a > b + c; }",
    "holonomic { a*cos(x) - b*cos(y) + c*cos(z) = 1; a*sin(x) - b*sin(y) + c*sin(z) = 0; } \
     assume { a > 0; b > 0; c > 0; b > a + c + 1; }",
    "constraints { der(x)^2 + a*sin(y) + c = 0; } assume { a > 0; c > a; }",
    "constraints { der(x)^2 + der(y)^2 = a*sin(x)*cos(y) - c; } assume { a > 0; c > a; }",
    "constraints { der(x)^2 + a*sin(x) + b*cos(x) + c = 0; } assume { c > 0; c^2 > a^2 + b^2; }",
    "holonomic { z = 1; } constraints { der(x)^2 + der(y)^2 + z = 0; }",
];

/// Constraints that hold at some.
const SOMEWHERE: [&str; 18] = [
    "holonomic { sin(x)+cos(y) = 1; }",
    "constraints { der(x)^2+der(y)^2 = 1; der(x)+der(y) = 1; }",
    "holonomic { x^2 + y^2 = a; } assume { a > 0; }",
    "holonomic { a*sin(x) + b*cos(y) = c; } assume { a > 0; b > 0; c > a + b/2; }",
    "holonomic { a*sin(x) + b*cos(y) = c; } assume { a > 0; b > 0; c >= a + b; }",
    "holonomic { a*sin(x) - b*cos(y) = c; } assume { a > 0; b < 0; c > a + b; }",
    "holonomic { a*sin(x) + b*cos(y) = c; } assume { a > 0; c > a + b; }",
    "holonomic { a*sin(x) + b*cos(x) = c; } assume { c > 0; c^2 > a^2 + b^2/2; }",
    "holonomic { a*sin(x) + b*cos(y) = c; } assume { c > 0; c^2 > a^2 + b^2; }",
    "holonomic { (a - b)*sin(x) = c; } assume { b > a; c > a - b; }",
    "holonomic { (a + b*cos(x))*sin(y) = c; } assume { a > 0; b > 0; c > a; }",
    "holonomic { a*exp(-x^2) + b*tanh(y) = c; } assume { a > 0; b > 0; c > a; }",
    "holonomic { a*cosh(x) + b*sin(y) = c; } assume { a > 0; b > 0; c < a; }",
    "holonomic { a*atan(x) = c; } assume { a > 0; c > 3/2*a; }",
    "holonomic { a*sin(x) + b*y^2 + c = 0; } assume { a > 0; b > 0; c > 0; }",
    "holonomic { a*cos(x) + b*cos(y) = c; a*sin(x) + b*sin(y) = 0; } assume { a > 0; b > 0; c > 0; a > b; c > b; }",
    "constraints { der(x)^2 + a*sin(y) + c = 0; } assume { a > 0; c > 0; }",
    "constraints { der(x)^2 + der(y)^2 = a*sin(x)*cos(y) - c; } assume { a > 0; c > 0; }",
];

const CIRCLE: &str = "base { c, s } on { c^2+s^2 = 1; } basis { w } anchor { der(c) = -s*w; der(s) = c*w; }";
const ROD: &str = "base { x, y } holonomic { x^2+y^2 = 1; } lagrangian { (der(x)^2+der(y)^2)/2 }";

/// Functions on an embedded circle, and on positions that a constraint leaves, without a real value there.
const UNDEFINED_THERE: [(&str, &str); 9] = [
    (CIRCLE, "lagrangian { w^2 - ln(c + s - 3/2) }"),
    (CIRCLE, "lagrangian { w^2 } forces { w: sqrt(c - 2); }"),
    (CIRCLE, "lagrangian { w^2 } outputs { q = 1/(c^2 + s^2 - 1); }"),
    (CIRCLE, "lagrangian { w^2 - sqrt(c*s - 1) }"),
    (ROD, "forces { x: sqrt(x*y - 1); }"),
    (ROD, "forces { x: ln(x + y - 2); }"),
    (ROD, "forces { x: 1/(x^2 + y^2 - 1); }"),
    (ROD, "outputs { q = ln(x^2 + y^2 - 1); }"),
    (ROD, "outputs { q = acos(x + 3); }"),
];

/// The same with one somewhere.
const DEFINED_THERE: [(&str, &str); 5] = [
    (CIRCLE, "lagrangian { w^2 - ln(c + s - 1.4) }"),
    (CIRCLE, "lagrangian { w^2 } forces { w: sqrt(c - 0.9); }"),
    (ROD, "forces { x: sqrt(x*y - 0.4); }"),
    (ROD, "outputs { q = ln(x^2 + y^2) + 1/sqrt(x^2 + y^2); }"),
    (ROD, "outputs { q = acos(x + 1); }"),
];

/// Identities of c and s that hold at no real point.
const NO_BASE: [&str; 3] = ["c^2+s^2 = -1;", "c^4+s^4 = c*s - 1;", "c^2+s^2 = 2*c - 2;"];

fn found(attribute: &str) -> Vec<String> {
    let fields = if attribute.contains("base { c,") { "" } else { "a: f64, b: f64, c: f64, m: f64" };
    let source = format!("#[nonholonomic({attribute})] struct S {{ {fields} }}");
    let [declaration] = declarations(&source).try_into().expect("one declaration");
    errors(&declaration.expanded())
}

/// Whether declarations are refused with words about real values, or accepted; names those that are not.
fn assert_judged(list: impl IntoIterator<Item = String>, refused: bool) {
    const WORDS: [&str; 9] = [
        "no real value",
        "real values on no open set",
        "defined nowhere",
        "contradict",
        "exclude",
        "holds nowhere",
        "no real",
        "no points that satisfy",
        "where those hold",
    ];
    let wrong: Vec<String> = list
        .into_iter()
        .filter_map(|attribute| {
            let errors = found(&attribute);
            let says_so = errors.iter().any(|error| WORDS.iter().any(|word| error.contains(word)));
            (says_so != refused || errors.is_empty() == refused).then(|| format!("{attribute}: {errors:?}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn potential((function, assumed): (&str, &str)) -> String {
    let assumed = if assumed.is_empty() { String::new() } else { format!("assume {{ {assumed} }}") };
    format!("base {{ x, y }} lagrangian {{ (der(x)^2 + der(y)^2)/2 - {function} }} {assumed}")
}

fn with(list: &[&str]) -> Vec<String> {
    list.iter().map(|function| potential((function, ""))).collect()
}

fn moving(list: &[&str]) -> Vec<String> {
    let lagrangian = "lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 }";
    list.iter().map(|constraints| format!("base {{ x, y, z }} {lagrangian} {constraints}")).collect()
}

#[test]
fn functions_without_a_real_value_are_refused() {
    assert_judged(with(&UNDEFINED), true);
    assert_judged(UNDEFINED_AS_ASSUMED.into_iter().map(potential), true);
}

#[test]
fn functions_with_real_values_are_accepted() {
    assert_judged(with(&DEFINED), false);
    assert_judged(DEFINED_AS_ASSUMED.into_iter().map(potential), false);
}

#[test]
fn assumptions_are_satisfied_or_contradictory() {
    let assumed = |list: &[&'static str]| list.iter().map(|a| potential(("x", *a))).collect::<Vec<_>>();
    assert_judged(assumed(&CONTRADICTORY), true);
    assert_judged(assumed(&CONSISTENT), false);
}

#[test]
fn constraints_and_identities_have_real_points_or_are_refused() {
    assert_judged(moving(&NOWHERE), true);
    assert_judged(moving(&SOMEWHERE), false);
    let identity =
        |on: &&str| format!("base {{ c, s }} on {{ {on} }} lagrangian {{ (der(c)^2 + der(s)^2)/2 }}");
    assert_judged(NO_BASE.iter().map(identity), true);
}

#[test]
fn what_has_values_at_single_points_is_said_to() {
    for (function, words) in [
        ("sqrt(2*x*y - x^2 - y^2)", "real values on no open set"),
        ("asin(x^2 + 1)", "real values on no open set"),
        ("ln(-x^2)", "no real value anywhere"),
        ("sqrt(-x^2 - 1)", "no real value anywhere"),
    ] {
        let errors = found(&potential((function, "")));
        // nothing more is said of what has no values
        assert!(errors.len() == 1 && errors[0].contains(words), "{function}: {errors:?}");
    }
}

#[test]
fn nothing_is_said_to_follow_from_a_contradiction() {
    let errors = found(&potential(("x", "a > 0; b > 0; a + b < 2*sqrt(a*b);")));
    assert!(errors.len() == 1 && errors[0].contains("is contradictory"), "{errors:?}");
}

#[test]
fn an_arc_of_one_asks_for_nothing() {
    let attribute = potential(("acos(cos(x)^2 + sin(x)^2)*y", ""));
    let source = format!("#[nonholonomic({attribute})] struct S {{ a: f64 }}");
    let [declaration] = declarations(&source).try_into().expect("one declaration");
    let report = declaration.system().expect("it is well-posed").report;
    assert!(!report.contains("have a value only where"), "{report}");
}

#[test]
fn functions_are_asked_where_positions_may_be() {
    let there =
        |list: &[(&str, &str)]| list.iter().map(|(on, what)| format!("{on} {what}")).collect::<Vec<_>>();
    assert_judged(there(&UNDEFINED_THERE), true);
    assert_judged(there(&DEFINED_THERE), false);
}

/// Roots of even powers are powers where these are even: they have a value where what they are made of is 0, too.
#[test]
fn even_roots_of_even_powers_have_a_value_everywhere() {
    let potential = "k*sqrt((a*x - y)^4) + ((x*y)^6)^(1/3) + sqrt(2*x^4*y^8)";
    let text = format!(
        "#[nonholonomic(base {{ x, y }} lagrangian {{ (der(x)^2 + der(y)^2)/2 - {potential} }})]\nstruct Flat {{ k: f64, a: f64 }}"
    );
    let report = declarations(&text)[0].system().unwrap_or_else(|errors| panic!("{errors:?}")).report;
    assert!(!report.contains("only where"), "{report}");
}

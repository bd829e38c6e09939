//! Names: what is known where, what is declared twice, what was meant.

use super::{messages, resolved};

fn of(attribute: &str) -> Vec<String> {
    messages(attribute, "struct S { m: f64, J: [f64; 2], #[nh(skip)] tag: u8 }")
}

const DECLARE: &str = "parameters are fields of the struct; other names are declared in `base`, `basis`, `inputs` or \
                       `auxiliary`, or by a `let`";

#[test]
fn unknown_names() {
    for (attribute, message) in [
        ("base { theta } lagrangian { thteta }", "unknown name `thteta`\nhelp: did you mean `theta`?"),
        ("base { x } lagrangian { M * x }", "unknown name `M`\nhelp: did you mean `m`?"),
        ("base { x } lagrangian { PI }", "unknown name `PI`\nhelp: did you mean `pi`?"),
        ("base { x } lagrangian { time }", "unknown name `time`\nhelp: the time is `t`"),
        (
            "base { R[2][2] } on { transpose(R) * R = identity; } lagrangian { R[0][0] }",
            "unknown name `identity`\nhelp: the function of this name is called as `identity(3)`",
        ),
        (
            "base { theta } basis { w } anchor { der(theta) = w; } lagrangian { theta_dot^2 }",
            "unknown name `theta_dot`\nhelp: the rate of `theta` is written `der(theta)`",
        ),
        (
            "base { theta } lagrangian { theta_ddot }",
            "unknown name `theta_ddot`\nhelp: accelerations are what is derived; they cannot be used",
        ),
        ("base { x } lagrangian { quux }", &format!("unknown name `quux`\nhelp: {DECLARE}")),
        (
            "base { x } lagrangian { tag }",
            "unknown name `tag`\nthe field `tag` is marked `#[nh(skip)]`\nhelp: take the mark away to make it a parameter",
        ),
        (
            "base { x } lagrangian { let b = a1; let a1 = x; b }",
            "unknown name `a1`\n`a1` is a `let` of `lagrangian`, where it stays, from its line on\nhelp: put that `let` \
             between the sections, where all of them know it",
        ),
        (
            "base { x } lagrangian { x } outputs { speed = x; twice = 2 * speed; }",
            "unknown name `speed`\n`speed` is an output, and outputs are not used in expressions\nhelp: name the \
             value with a `let`, and use that",
        ),
        (
            "base { xi } lagrangian { der(xj) }",
            "there is no base coordinate `xj`\nhelp: base coordinates are declared in `base { x, y }`",
        ),
        (
            "base { theta } lagrangian { der(tehta) }",
            "there is no base coordinate `tehta`\nhelp: did you mean `theta`?",
        ),
    ] {
        assert_eq!(of(attribute), [message], "{attribute}");
    }
}

/// What is not declared is one mistake, in whatever places it stands.
#[test]
fn a_missing_name_is_one_error() {
    for (attribute, message) in [
        (
            "let p = [x, z]; let q = [z, x]; base { x } lagrangian { kinetic(m, p) + kinetic(m, q) } forces { x: z * der(z); z: 1; }",
            format!("unknown name `z`\n`z` stands in 4 more places\nhelp: {DECLARE}"),
        ),
        (
            "base { x } lagrangian { sum(i in 0..2: J[i] * centre) } outputs { a = der(centre); }",
            format!("unknown name `centre`\n`centre` stands in one more place\nhelp: {DECLARE}"),
        ),
        (
            "let center = x; base { x } lagrangian { m * x } outputs { a = der(centre); b = centre; }",
            "there is no base coordinate `centre`\n`centre` stands in one more place\nhelp: did you mean `center`?"
                .to_owned(),
        ),
        (
            "base { x } basis { v, w } anchor { der(x) = v; } brackets { [v, c] = w; [w, c] = v; } lagrangian { m * (v^2 + w^2 + c^2) }",
            "there is no section `c`\n`c` stands in 2 more places\nhelp: sections are declared in `basis { omega, v1 }` \
             or by `velocities`"
                .to_owned(),
        ),
        (
            "base { x } lagrangian { m * der(x)^2 - k * x } track { k } linearization { keep: k; }",
            format!("unknown name `k`\n`k` stands in 2 more places\nhelp: {DECLARE}"),
        ),
    ] {
        assert_eq!(of(attribute), [message], "{attribute}");
    }
    let called = of("base { x } lagrangian { m * der(x)^2 - h(x) } outputs { a = h(x); b = der(h(x)); }");
    assert!(
        called.len() == 1 && called[0].starts_with("unknown function `h`\n`h` stands in 2 more places\n"),
        "{called:?}"
    );
    let two = of("base { x } lagrangian { a1 + b1 + a1 + b1 }");
    assert_eq!(two.len(), 2, "{two:?}");
}

/// A section that has no place for something is one mistake, on both sides of an equation and in all of its lines.
#[test]
fn what_has_no_place_is_one_error() {
    let told = of(
        "base { x, y } lagrangian { m * (der(x)^2 + der(y)^2) } holonomic { der(x) = der(y); m * der(y) = 1; }",
    );
    assert!(
        told.len() == 1
            && told[0]
                .starts_with("`der(…)` cannot be used in `holonomic`\n`der(…)` stands in 2 more places\n"),
        "{told:?}"
    );
    // an input elsewhere is another
    let two =
        of("base { x, y } inputs { u } lagrangian { u * der(x)^2 - u * y } constraints { der(x) = u; }");
    assert_eq!(two.len(), 2, "{two:?}");
}

#[test]
fn what_has_no_derivative() {
    for (inside, what, way_out) in [
        ("m", "a parameter, whose derivative is 0", "leave the term out"),
        ("x_dot", "a velocity", "accelerations are what is derived; they cannot be used"),
        ("t", "the time, whose derivative is 1", "write `1`"),
        ("pi", "a constant", "leave the term out"),
        ("u", "an input", "inputs have no known rates; an auxiliary state has: `auxiliary { der(z) = …; }`"),
    ] {
        assert_eq!(
            of(&format!("base {{ x }} inputs {{ u }} lagrangian {{ der({inside}) }}")),
            [format!("`der` takes a base coordinate, and `{inside}` is {what}\nhelp: {way_out}")]
        );
    }
}

#[test]
fn every_name_is_declared_once() {
    let twice = |name: &str, first: &str| {
        format!(
            "`{name}` is declared twice\nit is {first} already\nhelp: choose another name: every name has one \
             meaning in the whole declaration"
        )
    };
    let parameter = "a parameter (a field of the struct)";
    for (attribute, name, first) in [
        ("base { x, x } lagrangian { x }", "x", "a base coordinate"),
        ("base { m } lagrangian { m }", "m", parameter),
        ("base { x } basis { x } anchor { der(x) = 0; } lagrangian { 1 }", "x", "a base coordinate"),
        ("base { x } inputs { x } lagrangian { x }", "x", "a base coordinate"),
        ("basis { w } inputs { w } lagrangian { w }", "w", "a quasi-velocity"),
        ("base { x } lagrangian { let m = 1; m * x }", "m", parameter),
        ("base { x } lagrangian { let a = 1; let a = 2; a * x }", "a", "an abbreviation (a `let`)"),
        ("base { x } lagrangian { sum(m in 0..2: J[m]) * x }", "m", parameter),
        ("base { x } lagrangian { sum(i in 0..2, i in 0..2: J[i]) * x }", "i", "a loop variable"),
        ("base { x } velocities { m = der(x); } lagrangian { x }", "m", parameter),
        (
            "base { x } lagrangian { x } inputs { x_dot }",
            "x_dot",
            "the name of a coordinate's velocity in generated code",
        ),
        (
            "base { x } lagrangian { x } constraints { for x in 0..1 { der(x) = 0; } }",
            "x",
            "a base coordinate",
        ),
    ] {
        assert_eq!(of(attribute), [twice(name, first)], "{attribute}");
    }
    assert_eq!(
        of("base { x, x_dot } lagrangian { x }"),
        ["`x_dot` is declared twice\nwithout a `basis`, the velocity of `x` is called `x_dot` in generated \
          code\nhelp: choose another name"]
    );
    // a `let` ends with its section
    assert!(of("base { x } lagrangian { let e = x; e } forces { let e = 2; x: e; }").is_empty());
}

#[test]
fn reserved_names() {
    for (name, meaning) in
        [("t", "the time"), ("pi", "the number π"), ("sin", "a function"), ("dot", "a function")]
    {
        let expected = [format!("`{name}` is reserved\nit is {meaning}\nhelp: choose another name")];
        assert_eq!(of(&format!("base {{ x, {name} }} lagrangian {{ x }}")), expected);
        assert_eq!(of(&format!("base {{ x }} lagrangian {{ x }} outputs {{ {name} = x; }}")), expected);
        assert_eq!(of(&format!("base {{ x }} lagrangian {{ let {name} = x; x }}")), expected);
    }
}

#[test]
fn sections_use_what_they_may() {
    let frame = "base { x } basis { w } anchor { der(x) = w; } lagrangian { w^2 } inputs { u }";
    for (section, what) in [
        ("brackets { [w, w] = t; }", "`t` cannot be used in `brackets`"),
        ("brackets { [w, w] = der(x); }", "`der(…)` cannot be used in `brackets`"),
        ("constraints { w = u; }", "the input `u` cannot be used in `constraints`"),
        ("constraints { w = abs(x); }", "`abs` cannot be used in `constraints`"),
        ("on { w = 0; }", "the quasi-velocity `w` cannot be used in `on`"),
        ("on { t = x; }", "`t` cannot be used in `on`"),
    ] {
        let found = of(&format!("{frame} {section}"));
        assert_eq!(found.len(), 1, "{section}: {found:?}");
        assert_eq!(found[0].lines().next(), Some(what), "{section}");
    }
    for (attribute, what) in [
        (
            "base { x } basis { w } anchor { der(x) = t * w; } lagrangian { 1 }",
            "`t` cannot be used in `anchor`",
        ),
        (
            "base { x } basis { w } anchor { der(x) = der(x); } lagrangian { 1 }",
            "`der(…)` cannot be used in `anchor`",
        ),
        (
            "base { x } velocities { w = der(x) * w; } lagrangian { 1 }",
            "the quasi-velocity `w` cannot be used in `velocities`",
        ),
        ("base { x } velocities { w = t * der(x); } lagrangian { 1 }", "`t` cannot be used in `velocities`"),
        ("base { x } inputs { u } lagrangian { u * x }", "the input `u` cannot be used in `lagrangian`"),
    ] {
        let found = of(attribute);
        assert_eq!(found.len(), 1, "{attribute}: {found:?}");
        assert_eq!(found[0].lines().next(), Some(what), "{attribute}");
    }
    assert!(
        of(&format!("{frame} forces {{ w: abs(u) * sign(w) + t; }} outputs {{ p = min(u, der(x)); }}"))
            .is_empty()
    );
}

#[test]
fn one_mistake_does_not_hide_another() {
    let found = of("base { x, q[2] } lagrangian { let e = aaa + 1; e + e + bbb * ccc }
         constraints { for i in 0..2 { der(q[i]) = ddd; der(q[i + 1]) = x; } }
         forces { nowhere: eee; x: fff; x: 1; } outputs { o = ggg; } independent { hhh }");
    let first: Vec<_> = found.iter().filter_map(|message| message.lines().next()).collect();
    assert_eq!(
        first,
        [
            "unknown name `aaa`",
            "unknown name `bbb`",
            "unknown name `ccc`",
            "unknown name `ddd`",
            "the index 2 is out of range",
            "a force along the unknown direction `nowhere`",
            "unknown name `eee`",
            "unknown name `fff`",
            "unknown name `ggg`",
            "there is no section `hhh`",
        ]
    );
}

#[test]
fn errors_point_at_their_tokens() {
    let text = "base { x } lagrangian { sum(i in 0..3: der(x) * (1 + oops)) } independent { der(x), zz }";
    let errors = resolved(text, "struct S;").map(|_| ()).expect_err("errors");
    let places: Vec<_> = errors
        .iter()
        .map(|error| &text[error.extent.first.start().column..error.extent.last.end().column])
        .collect();
    assert_eq!(places, ["oops", "zz"]);
}

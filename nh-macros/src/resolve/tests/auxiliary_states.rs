//! Auxiliary states: what they are, and what is wrong with them.

use super::{messages, model};

const STRUCT: &str = "struct S { m: f64 }";

#[test]
fn left_sides_declare_names_that_all_sections_know() {
    let found = model(
        "base { x } lagrangian { m * der(x)^2 } forces { x: s[1] - lag + der(lag) }
         constraints { der(x) = lag; } inputs { u }
         auxiliary { let k = 2; for i in 0..2 { der(s[i]) = k * lag - i; } der(lag) = u - s[0]; }",
        STRUCT,
    );
    let names: Vec<&str> = found.auxiliary.iter().map(|state| state.name.as_str()).collect();
    assert_eq!(names, ["s[0]", "s[1]", "lag"]);
    let value = |k: usize| found.graph.text_within(found.auxiliary[k].value, 100);
    assert_eq!([value(0), value(1), value(2)].join(" | "), "2*lag | 2*lag - 1 | u - s[0]");
    let in_force = found.graph.symbols_in(&[found.forces[0].value]);
    assert!(in_force.contains(&found.auxiliary[2].rate) && in_force.contains(&found.auxiliary[2].symbol));
}

#[test]
fn where_they_have_no_place_a_way_out_is_shown() {
    let top = "base { x } inputs { u } auxiliary { der(lag) = u - lag; }";
    let cases = [
        (
            "lagrangian { m * der(x)^2 + lag }",
            "the auxiliary state `lag` cannot be used in `lagrangian`\nit has no inertia: it acts through `forces` \
             and through coefficients of `constraints`\nhelp: make it a base coordinate whose velocity is commanded: \
             `base { lag } auxiliary { der(rate) = …; } constraints { der(lag) = rate; }`",
        ),
        (
            "lagrangian { m * der(x)^2 } constraints { der(x) = der(lag); }",
            "the rate of an auxiliary state `der(lag)` cannot be used in `constraints`\nan input may be in it, and \
             what stands here is differentiated\nhelp: where no input is in it, write its right-hand side; a rate \
             that an input commands is a state of its own: `auxiliary { der(rate) = command; }`",
        ),
        (
            "lagrangian { m * der(x)^2 } constraints { der(x) = u; }",
            "the input `u` cannot be used in `constraints`\na constraint holds at all times, and an input may jump\n\
             help: command its rate: `auxiliary { der(rate) = u; } constraints { der(delta) = rate; }`, or let it act \
             through `forces`",
        ),
        (
            "lagrangian { m * der(x)^2 } assume { lag > 0; }",
            "the auxiliary state `lag` cannot be used in `assume`\nfacts and levels are about parameters\nhelp: write \
             parameters and numbers",
        ),
        (
            "lagrangian { m * der(x)^2 } forces { lag: 1 }",
            "`lag` is an auxiliary state, not a direction\nhelp: a force acts along a section of the basis or along a \
             base coordinate",
        ),
    ];
    for (rest, text) in cases {
        assert_eq!(messages(&format!("{top} {rest}"), STRUCT), [text], "{rest}");
    }
}

#[test]
fn lines_that_declare_nothing_are_errors() {
    let cases = [
        (
            "lag = 1;",
            "expected `der(…)`, found `lag`\nhelp: an auxiliary state is declared by its rate: `der(current) = …;`",
        ),
        (
            "der(m) = 1;",
            "`m` is declared twice\nit is a parameter (a field of the struct) already\nhelp: choose another name: \
             every name has one meaning in the whole declaration",
        ),
        (
            "der(lag) = [1, 2];",
            "the two sides have different shapes\non the left is a number, on the right a vector of 2 entries\nhelp: \
             the left side says how many there are: `der(lag[i in 0..3]) = …;`",
        ),
        (
            "der(lag[1]) = x;",
            "`lag[0]` is not defined\nother entries of `lag` are, and indices count from 0\nhelp: add `der(lag[0]) = …;`",
        ),
        (
            "der(lag[2]) = -lag;",
            "`lag[0][0]` is not defined\nother entries of `lag` are, and indices count from 0\nhelp: write \
             `der(lag[0..2]) = …;` for a vector: `lag[2]` is one entry",
        ),
        (
            "der(lag[2]) = [x, 1];",
            "`lag[0][0]` is not defined\nother entries of `lag` are, and indices count from 0\nhelp: write \
             `der(lag[0..2]) = …;` for a vector: `lag[2]` is one entry",
        ),
    ];
    for (line, text) in cases {
        let found =
            messages(&format!("base {{ x }} lagrangian {{ m * der(x)^2 }} auxiliary {{ {line} }}"), STRUCT);
        assert_eq!(found, [text], "{line}");
    }
}

//! Units: what is inferred, and what contradicts what, in words.

use nonholonomic_core::units::{Quantity, Unit};

use super::{messages, model, resolved};

const WAY_OUT: &str =
    "help: a factor is missing, is too much or has a wrong power, or `units` gives a name a wrong unit";

/// The units of a declaration as `name: unit`.
fn units(attribute: &str, item: &str) -> Vec<String> {
    let text = |Quantity { name, unit, .. }: Quantity| match unit {
        Unit::Known(unit) => format!("{name}: {unit}"),
        Unit::Free => format!("{name}: ?"),
    };
    model(attribute, item).units.into_iter().map(text).collect()
}

#[test]
fn units_follow_from_each_other() {
    let found = units(
        "base { x, q }
         lagrangian { m / 2 * der(x)^2 + J / 2 * der(q)^2 - k / 2 * x^2 }
         constraints { rolling: der(x) = r * der(q); }
         inputs { torque }
         forces { q: torque - self.friction(c * der(q)); }
         outputs { speed = r * der(q); }
         units { x = m; q = rad; m = kg; }",
        "struct S { m: f64, J: f64, k: f64, r: f64, c: f64, unseen: f64 }",
    );
    let expected = [
        "x: m",
        "q: rad",
        "x_dot: m s⁻¹",
        "q_dot: s⁻¹",
        "torque: J",
        "m: kg",
        "J: kg m²",
        "k: N m⁻¹",
        "r: m",
        "c: ?",
        "unseen: ?",
        "speed: m s⁻¹",
        "rolling: N",
    ];
    assert_eq!(found, expected);
}

/// `units` gives a name that two things have to the coordinate; what the other is made of says its unit.
#[test]
fn outputs_and_claims_may_have_the_name_of_a_coordinate() {
    let attribute = "base { x, y }
         lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
         outputs { x = y^2; area = x * y; y = free * y; }
         units { x = m; m = kg; g = m/s^2; }";
    let item = "struct S { m: f64, g: f64, free: f64 }";
    let found = units(attribute, item);
    let expected = [
        "x: m",
        "y: m",
        "x_dot: m s⁻¹",
        "y_dot: m s⁻¹",
        "m: kg",
        "g: m s⁻²",
        "free: ?",
        "output x: m²",
        "area: m²",
        "output y: ?",
    ];
    assert_eq!(found, expected);
    let (_, layout) = resolved(attribute, item).expect("declared well");
    let outputs = layout.outputs;
    let said: Vec<&[String]> = outputs.iter().map(|family| family.units.as_slice()).collect();
    assert_eq!(said, [&["m²".to_owned()][..], &["m²".to_owned()][..], &[]]);
}

#[test]
fn sections_have_the_units_of_what_they_generate() {
    let found = units(
        "base { x, y, th }
         basis { v, side, omega }
         anchor {
             der(x) = v * cos(th) - side * sin(th); der(y) = v * sin(th) + side * cos(th); der(th) = omega;
         }
         frame { turn = e * omega + v; across = side; ahead = v; }
         lagrangian { m / 2 * (v^2 + side^2) + J / 2 * omega^2 }
         symmetries { spin: omega; }
         units { x, y = m; m = kg; }",
        "struct S { m: f64, J: f64, e: f64 }",
    );
    // e turns a rate into a speed: e omega + v is a section, so e is that of omega over that of v
    assert!(found.contains(&"e: m⁻¹".to_owned()), "{found:?}");
    assert!(found.contains(&"turn: m s⁻¹".to_owned()), "{found:?}");
    assert!(found.contains(&"spin: J s".to_owned()), "{found:?}");
}

#[test]
fn impulses_have_the_units_of_their_rows() {
    let declared = |touch: &str| {
        format!(
            "base {{ x, y, phi }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 }}
             impacts {{ touch: y >= r, der(x) + r * der(phi) = 0; grip: der(phi) = 0; }}
             units {{ x, y, r = m; phi = rad; m = kg; touch = {touch}; grip = N m s; }}"
        )
    };
    let item = "struct S { m: f64, J: f64, r: f64 }";
    let found = units(&declared("N s"), item);
    for said in ["touch[0]: N s", "touch[1]: N s", "grip: N m s"] {
        assert!(found.contains(&said.to_owned()), "{found:?}");
    }
    let wrong = messages(&declared("N"), item);
    assert!(wrong.len() == 1 && wrong[0].starts_with("the units do not fit: "), "{wrong:#?}");
}

#[test]
fn a_model_may_have_no_units() {
    let found = units(
        "base { x, q } lagrangian { (der(x)^2 + der(q)^2) / 2 } units { x, q, t, lagrangian = 1; }",
        "struct S;",
    );
    assert_eq!(found, ["x: 1", "q: 1", "x_dot: 1", "q_dot: 1"]);
}

#[test]
fn shared_lines_and_bodies_are_seen() {
    let declared = |radius: &str| {
        format!(
            "base {{ x, y, th, roll }}
             let p = [x, y, {radius}];
             let R = rot_z(th) * rot_y(roll);
             let h(u) = k * u;
             lagrangian {{ kinetic(m, I, p, R) - m * g * p[2] - h(x)^2 / 2 }}
             constraints {{ rolling: velocity_at(p, R, [x, y, 0])[0..2] = 0; }}
             units {{ x, y, r = m; th, roll = rad; m = kg; g = m/s^2; }}"
        )
    };
    let item = "struct S { m: f64, I: [f64; 3], g: f64, r: f64, k: f64 }";
    let found = units(&declared("r"), item);
    assert!(found.contains(&"I[2]: kg m²".to_owned()), "{found:?}");
    assert!(found.contains(&"k: kg^(1/2) s⁻¹".to_owned()), "{found:?}");
    let wrong = messages(&declared("r^2"), item);
    assert!(wrong.len() <= 3 && wrong[0].starts_with("the units do not fit: "), "{wrong:#?}");
}

#[test]
fn contradictions_are_said() {
    let item = "struct S { m: f64, g: f64, k: f64 }";
    for (attribute, expected) in [
        (
            "base { x } lagrangian { m / 2 * der(x)^2 - m * g * x - k * x }
             units { x = m; m = kg; g = m/s^2; k = N/m; }",
            vec![format!(
                "the units do not fit: `m/2*der(x)^2` is J, `k*x` is N\n`k*x` is added to `m/2*der(x)^2`; `m` is kg, \
                 `k` is N m⁻¹, `x` is m\n{WAY_OUT}"
            )],
        ),
        (
            "base { x } lagrangian { m / 2 * der(x)^2 - k / 2 * (x - 1)^2 } units { x = m; m = kg; }",
            vec![format!(
                "the units do not fit: `x` is m, `1` is a pure number\n`1` is added to `x`\n{WAY_OUT}"
            )],
        ),
        (
            "base { x } lagrangian { m / 2 * der(x)^2 - k * sin(x) } units { x = m; m = kg; }",
            vec![format!(
                "the units do not fit: the argument of a function is a pure number, `x` is m\n\
                 `x` is the argument of a function\n{WAY_OUT}"
            )],
        ),
        (
            "base { x } lagrangian { m / 2 * der(x)^2 - m * g * x } impacts { floor: x >= 0 with restitution k; }
             units { x = m; m = kg; k = m; }",
            vec![format!(
                "the units do not fit: a coefficient of restitution is a pure number, `k` is m\n\
                 `k` is a coefficient of restitution\n{WAY_OUT}"
            )],
        ),
        (
            "base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * x } forces { y: -k * y; }
             units { x, y = m; m = kg; }",
            vec![
                "the units contradict each other: `k` would be N m⁻¹ here, N elsewhere\n\
                 here `-k*y` is the force along `y`\n\
                 in `lagrangian` `k*x` is added to `m/2*(der(x)^2 + der(y)^2)`\n\
                 help: give the unit of `k` in `units` to see which of these is wrong"
                    .to_owned(),
                "`k` would be N here\n`k*x` is added to `m/2*(der(x)^2 + der(y)^2)`".to_owned(),
            ],
        ),
        (
            "base { x } lagrangian { m / 2 * der(x)^2 } forces { x: self.f(t) - self.f(x); }
             units { x = m; m = kg; }",
            vec![
                "the units contradict each other: argument 1 of `self.f` would be m here, s elsewhere\n\
                 here `x` is argument 1 of `self.f`\n\
                 in `forces` `t` is argument 1 of `self.f`\n\
                 help: in all calls of a method an argument has one unit, and so has the value: correct one of them, \
                 or call another method"
                    .to_owned(),
                "argument 1 of `self.f` would be s here\n`t` is argument 1 of `self.f`".to_owned(),
            ],
        ),
        (
            "base { x } lagrangian { m / 2 * der(x)^2 } units { x = m; x_dot = m/s^2; }",
            vec![
                "the units do not fit: `x_dot` is m s⁻¹, and m s⁻² in `units`\n\
                 the units of `t`, `x`, `x_dot` belong together\n\
                 help: leave one of them out: it follows from the others"
                    .to_owned(),
            ],
        ),
    ] {
        assert_eq!(messages(attribute, item), expected, "{attribute}");
    }
}

/// A sum with a wrong term has the unit of none: what `units` says of its name is compared when it is right.
#[test]
fn a_wrong_term_is_told_once() {
    let item = "struct S { m: f64, k: f64, l: f64 }";
    let of = |sections: &str, unit: &str| {
        let attribute = format!(
            "base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - k / 2 * x^2 }} {sections}
             units {{ x = m; y = m; m = kg; k = N/m; l = m; it = {unit}; }}"
        );
        messages(&attribute, item)
    };
    for (sections, unit) in [
        ("outputs { it = m * der(x) + k * x; }", "N"),
        ("outputs { it = [m * der(x) + k * x, k * x]; }", "N"),
        ("conserved { it = k / 2 * y + k / 2 * x^2; }", "N"),
        ("constraints { it: der(x) + y = l * der(y); }", "N s"),
        ("holonomic { it: x + y * l = l; }", "N/m"),
        ("symmetries { it: y * der(y) + der(x) + der(y); }", "J s"),
    ] {
        let found = of(sections, unit);
        assert_eq!(found.len(), 1, "{sections}: {found:?}");
        assert!(!found[0].contains("`units`\n"), "{sections}: {found:?}");
    }
    let found = of("outputs { it = k * x; }", "J");
    assert_eq!(
        found,
        [format!("the units do not fit: `it` is N, and J in `units`\n`k` is N m⁻¹, `x` is m\n{WAY_OUT}")]
    );
}

/// As many lines as can be meant to be right are looked at; with more of them each contradiction is told by itself.
#[test]
fn many_wrong_lines_are_told_without_a_search() {
    let errors = |count: usize| {
        let all = |text: &dyn Fn(usize) -> String| (0..count).map(text).collect::<Vec<_>>();
        let (names, lines) = (all(&|k| format!("q{k}")), all(&|k| format!("q{k} = m;")));
        let terms = all(&|k| format!("J[{k}] / 2 * der(q{k})^2 - k[{k}] * cos(q{k}) - h[{k}] * sin(q{k})"));
        let machine = format!("base {{ {} }} lagrangian {{ {} }}", names.join(", "), terms.join(" + "));
        let item = format!("struct S {{ J: [f64; {count}], k: [f64; {count}], h: [f64; {count}] }}");
        let found = messages(&format!("{machine} units {{ {} }}", lines.join(" ")), &item);
        found.iter().filter(|error| error.contains("is the argument of a function")).count()
    };
    assert_eq!(errors(64), 64);
    assert_eq!(errors(65), 130);
}

#[test]
fn symmetric_matrices_have_units_as_a_whole_and_by_rows() {
    let item = "struct S { #[nh(symmetric)] I: [[f64; 2]; 2] }";
    let of = |lines: &str| {
        let machine = "base { q[2] } lagrangian { dot(der(q), I * der(q)) / 2 }";
        messages(&format!("{machine} units {{ {lines} }}"), item)
    };
    assert_eq!(of("I = kg m^2;"), Vec::<String>::new());
    assert_eq!(of("I[0], I[1] = kg m^2;"), Vec::<String>::new());
    assert_eq!(of("I[0][0] = kg m^2; I[0][1] = kg m; I[1][1] = kg;"), Vec::<String>::new());
    let twice = "the unit of `I[0][1]` is given twice\nhelp: keep one of them";
    assert_eq!(of("I[0][1] = kg m; I[1][0] = kg m;"), [twice]);
    let disagree = "one of these units does not fit: that of `I[0][0]`, `I[0][1]` is kg m² in `units`, and kg by all the \
                    rest; that of `I[0][1]`, `I[1][1]` is kg in `units`, and kg m² by all the rest\n\
                    in `lagrangian` `q_dot[1]*I[1][1]` is added to `q_dot[0]*I[0][1]`\n\
                    help: correct it, or leave it out: it follows from the rest; or correct each of these terms";
    assert_eq!(of("I[0] = kg m^2; I[1] = kg;"), [disagree]);
    let found = units(
        "base { q[2] } lagrangian { dot(der(q), I * der(q)) / 2 } units { I = N m s^2; q = rad; }",
        item,
    );
    assert!(found.contains(&"I[1][0]: N m s²".to_owned()), "{found:?}");
    let found = units(
        "base { q[2] } lagrangian { dot(der(q), I * der(q)) / 2 } units { q[0] = m; q[1] = rad; }",
        item,
    );
    assert!(found.contains(&"I[0][1]: kg m".to_owned()), "{found:?}");
    assert!(found.contains(&"I[1][0]: kg m".to_owned()), "{found:?}");
}

/// A line of `units` that contradicts several terms is one error; a contradiction beside it is another.
#[test]
fn a_wrong_line_is_one_error() {
    let of = |lines: &str| {
        let machine = "base { x, th } lagrangian { m / 2 * der(x)^2 + J / 2 * der(th)^2 - k * (1 - cos(th)) }
            inputs { left, right } forces { x: (left + right) / r - d * sin(th); th: (right - left) * b / r; }
            outputs { s = sin(th) + c; }";
        let item = "struct S { m: f64, J: f64, k: f64, r: f64, b: f64, c: f64, d: f64 }";
        messages(&format!("{machine} units {{ m = kg; {lines} }}"), item)
    };
    assert_eq!(of("x, b, r = m; th = rad; left, right = N m;"), Vec::<String>::new());
    let turns = "in `lagrangian` `th` is the argument of a function\n\
                 in `forces` `th` is the argument of a function\n\
                 in `forces` `(right - left)*b/r` is the force along `th`\n\
                 in `outputs` `th` is the argument of a function\n\
                 help: correct it, or leave it out: it follows from the rest; or correct each of these terms";
    let wrong = format!(
        "the unit of `th` does not fit: it is m in `units`, and a pure number by all the rest\n{turns}"
    );
    assert_eq!(of("x, b, r, th = m; left, right = N m;"), std::slice::from_ref(&wrong));
    let other = format!(
        "the units do not fit: `sin(th)` is a pure number, `c` is s\n`c` is added to `sin(th)`\n{WAY_OUT}"
    );
    assert_eq!(of("x, b, r, th = m; left, right = N m; c = s;"), [wrong, other]);
}

#[test]
fn units_that_are_none_are_refused() {
    let of = |line: &str| {
        let attribute = format!("base {{ x }} lagrangian {{ m / 2 * der(x)^2 }} units {{ {line} }}");
        let found = messages(&attribute, "struct S { m: f64 }");
        found.first().map(|message| message.lines().next().unwrap_or_default().to_owned())
    };
    for (line, expected) in [
        ("x = mm;", "`mm` is a multiple: 1e-3 m"),
        ("m = g;", "`g` is a multiple: 1e-3 kg"),
        ("x = meter;", "unknown unit `meter`"),
        ("z = m;", "unknown name `z`"),
        ("x = m; x = m;", "the unit of `x` is given twice"),
        ("x = 10 m;", "the number `10` in a unit"),
        ("m = kg/m/s;", "a unit has one `/`, in front of its last factor"),
        ("x = m^200;", "this exponent is too large"),
        ("der(x) = m/s;", "the unit of a rate is not declared: it follows"),
    ] {
        assert_eq!(of(line).as_deref(), Some(expected), "{line}");
    }
    assert_eq!(of("m = kg^(2/2) rad; x = m*rad/(kg kg^-1);"), None);
}

#[test]
fn fields_say_their_units() {
    let (_, layout) = resolved(
        "base { q[2] } lagrangian { m / 2 * dot(der(q), der(q)) } units { q = m; m = kg; }",
        "struct S { m: f64 }",
    )
    .expect("in order");
    assert_eq!(layout.coordinates[0].units, ["m", "m"]);
    assert_eq!(layout.velocities[0].units, ["m s⁻¹", "m s⁻¹"]);
    assert!(layout.idle.is_empty());
}

#[test]
fn parameters_in_no_expression_are_known() {
    let (resolved, layout) = resolved(
        "base { x } let h(u) = a * u; lagrangian { m / 2 * der(x)^2 - h(x) } assume { b > 0; } units { k = kg; }",
        "struct S { m: f64, a: f64, b: f64, k: f64, G: [f64; 3] }",
    )
    .expect("in order");
    assert_eq!(resolved.model.idle, ["G", "k"]);
    assert!(layout.idle.contains("k"));
}

#[test]
fn inputs_in_no_expression_are_known() {
    let model = model(
        "base { x } inputs { u, v[2], w, s } lagrangian { m / 2 * der(x)^2 } forces { x: u + v[1]; } outputs { it = w; }",
        "struct S { m: f64 }",
    );
    assert_eq!(model.idle_inputs, ["s"]);
}

/// One error was made in what has the name: `units` says nothing of it, and goes on.
#[test]
fn names_in_error_are_not_unknown() {
    let of = |line: &str, units: &str| {
        let attribute = format!(
            "base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) }}
             constraints {{ for i in 0..1 {{ roll: der(x) = der(y) + i * {line}; }} }}
             outputs {{ power[0..2] = [m, {line}]; }} conserved {{ spin = {line}; }} units {{ {units} }}"
        );
        let found = messages(&attribute, "struct S { m: f64 }");
        found.iter().map(|message| message.lines().next().unwrap_or_default().to_owned()).collect::<Vec<_>>()
    };
    let unknown = "unknown name `mm`";
    assert_eq!(of("mm", "power = W; roll = N; spin = 1;"), [unknown]);
    assert_eq!(of("mm", "power = W; pwoer = W;"), [unknown, "unknown name `pwoer`"]);
    assert_eq!(of("m", "power[2] = W;"), ["`power` has no such entry"]);
}

/// A rate of a family is written once, and what is wrong with it is told once.
#[test]
fn a_line_of_a_family_is_told_once() {
    let found = messages(
        "base { x } lagrangian { m / 2 * der(x)^2 } auxiliary { der(s[i in 0..3]) = x - s[i]; } units { s = kg; x = m; }",
        "struct S { m: f64 }",
    );
    assert_eq!(found.len(), 1, "{found:#?}");
    let found = messages(
        "base { x, y } velocities { v[i in 0..2] = der(x) + (1 - 2 * i) * der(y); }
         lagrangian { m / 2 * dot(v, v) } units { x, y = m; v = kg; }",
        "struct S { m: f64 }",
    );
    assert_eq!(found.len(), 1, "{found:#?}");
}

#[test]
fn units_without_a_space_are_understood() {
    for (written, meant) in [("Nm", "N m"), ("m2", "m^2"), ("kgm", "kg m")] {
        let attribute = format!("base {{ x }} lagrangian {{ m * der(x)^2 }} units {{ m = {written}; }}");
        let [found] = &messages(&attribute, "struct S { m: f64 }")[..] else {
            panic!("one error: {written}")
        };
        assert!(found.ends_with(&format!("help: write `{meant}`")), "{found}");
    }
}

/// Whether a body turns about an axis or not, its moment about that has the unit of one.
#[test]
fn bodies_have_moments_of_inertia() {
    let item = "struct S { m: f64, I: [f64; 3], J: f64 }";
    let upright = "base { x, yaw } lagrangian { kinetic(m, I, [x, 0, 0], rot_z(yaw)) }";
    let found = units(&format!("{upright} units {{ x = m; m = kg; }}"), item);
    for entry in ["I[0]: kg m²", "I[1]: kg m²", "I[2]: kg m²"] {
        assert!(found.contains(&entry.to_owned()), "{found:?}");
    }
    let refused = |machine: &str, text: &str| {
        let found = messages(&format!("{machine} units {{ x = m; m = kg; I = kg m^2; }}"), item);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains(text), "{found:?}");
    };
    let wrong = "base { x, yaw } lagrangian { kinetic(m, [m, I[1], I[2]], [x, 0, 0], rot_z(yaw)) }";
    refused(wrong, "`m` is a moment of inertia");
    // a length in the place of the angle
    refused("base { x, y } lagrangian { kinetic(m, J, [x, y], x) }", "`x` is m");
}

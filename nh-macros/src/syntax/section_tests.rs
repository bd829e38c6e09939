//! Tests of sections and their lines: what is read, every error text, recovery.

use super::ast::{Brackets, Formulation, Item, Relation, Subscript, Velocity};
use super::testing::{declaration, messages, shown, underlined};
use super::vocabulary::SECTIONS;

const SLEIGH: &str = "
    base   { theta, x, /// across
             y }
    basis  { omega, v1, v2, }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta)
    }
    brackets { [omega, v1] = v2; [omega, v2] = -v1; }
    lagrangian  { let I = J + m * (a^2 + b^2); I / 2 * omega^2 + m / 2 * (v1^2 + v2^2) }
    constraints { /// the knife
                  knife: v2 = 0; }
    impacts     { wall: x >= 0, v1 = 0 with restitution c; }
    forces      { omega: torque - c * omega; }
    inputs      { torque, u[2] }
    outputs     { speed = sqrt(v1^2 + v2^2); }
    independent { omega, der(x), w[0] }
    linearization { keep: omega, der(x), w[0]; }
    formulation { adapted }
    names       { state = RobotState; input = Controls; }
    crate       { ::renamed::nonholonomic }
    almost;
";

/// The messages of one section beside what every declaration needs.
fn of(section: &str) -> Vec<String> {
    let base = if section.starts_with("base") { "" } else { "base { x }" };
    let basis =
        if section.starts_with("basis") || section.starts_with("velocities") { "" } else { "basis { w }" };
    let lagrangian = if section.starts_with("lagrangian") { "" } else { "lagrangian { w^2 }" };
    messages(&format!("{base} {basis} {lagrangian} {section}"), "struct S;")
}

fn one<T>(item: &Item<T>) -> &T {
    match item {
        Item::One(one) => one,
        Item::Let(_) | Item::For(_) => panic!("a statement"),
    }
}

#[test]
fn a_whole_declaration_is_read() {
    let s = declaration(SLEIGH, "struct Sleigh { m: f64 }").expect("a declaration").sections;
    let base = s.base.expect("base");
    assert_eq!(base.keyword.text, "base");
    assert_eq!(base.body.iter().map(|d| d.name.text.as_str()).collect::<Vec<_>>(), ["theta", "x", "y"]);
    assert_eq!(base.body[2].docs.to_string(), "# [doc = \" across\"]");
    assert_eq!(s.basis.expect("basis").body.len(), 3);
    let anchor = s.anchor.expect("anchor").body;
    assert_eq!(one(&anchor[1]).coordinate.name.text, "x");
    assert_eq!(shown(&one(&anchor[2]).value), "((v1 * sin(theta)) + (v2 * cos(theta)))");
    let Brackets::Table(brackets) = &s.brackets[0].body else { panic!("a table") };
    assert_eq!(one(&brackets[1]).second.name.text, "v2");
    let lagrangian = s.lagrangian.expect("lagrangian").body;
    assert_eq!(lagrangian.lets[0].name.text, "I");
    assert!(shown(&lagrangian.value).starts_with("((I / 2 * (omega^2))"));
    let constraints = s.constraints.expect("constraints").body;
    assert_eq!(one(&constraints[0]).label.as_ref().expect("a label").text, "knife");
    assert_eq!(one(&constraints[0]).docs.to_string(), "# [doc = \" the knife\"]");
    let wall = s.impacts.expect("impacts").body;
    let wall = one(&wall[0]);
    assert_eq!(wall.rows.iter().map(|row| row.is_unilateral).collect::<Vec<_>>(), [true, false]);
    assert_eq!(wall.restitution.as_ref().map(shown).as_deref(), Some("c"));
    assert_eq!(one(&s.forces.expect("forces").body[0]).along.name.text, "omega");
    assert_eq!(s.inputs.expect("inputs").body[1].lengths, [2]);
    assert_eq!(one(&s.outputs.expect("outputs").body[0]).name.text, "speed");
    assert_eq!(s.linearization.expect("linearization").body.map(|kept| kept.len()), Some(3));
    let independent = s.independent.expect("independent").body;
    assert!(matches!(&independent[1], Velocity::Der(place, _) if place.name.text == "x"));
    assert!(matches!(&independent[2], Velocity::Named(place) if place.indices.len() == 1));
    assert_eq!(s.formulation.expect("formulation").body, Formulation::Adapted);
    assert_eq!(s.names.expect("names").body[1].name.text, "Controls");
    assert_eq!(s.runtime.expect("crate").body.to_string(), ":: renamed :: nonholonomic");
    assert!(s.almost.is_some());
}

#[test]
fn families_and_blocks_are_read() {
    let text = "
        base { theta[4], R[3][3] }
        velocities { w[i in 0..3] = der(theta[i]); w[3] = der(theta[3]); }
        lagrangian { let k[i in 0..4, j in 0..i] = i * j; let q[i in 0..2][j in 0..2] = 1; sum(i in 0..4: k[i][0]) }
        constraints { let a = 1; for i in 0..3 { let b = a; for j in i..3, k in 0..2 { w[i] = w[j]; } row: w[i] = 0 } w[0] = 0 }
        brackets so(3) { w1, w2, w3 }
        brackets heisenberg { q[0], p, z }
    ";
    let s = declaration(text, "struct S;").expect("a declaration").sections;
    assert_eq!(s.base.expect("base").body[1].lengths, [3, 3]);
    let velocities = s.velocities.expect("velocities").body;
    assert!(matches!(one(&velocities[0]).subscripts[0], Subscript::Each(_)));
    assert!(matches!(one(&velocities[1]).subscripts[0], Subscript::Entry(_)));
    let lets = s.lagrangian.expect("lagrangian").body.lets;
    assert_eq!((lets[0].binders.len(), lets[1].binders.len()), (2, 2));
    let constraints = s.constraints.expect("constraints").body;
    assert_eq!(constraints.len(), 3);
    let Item::For(outer) = &constraints[1] else { panic!("a block") };
    assert_eq!(outer.items.len(), 3);
    assert!(
        matches!(&outer.items[1], Item::For(inner) if inner.binders.len() == 2 && inner.items.len() == 1)
    );
    let Brackets::Known(so) = &s.brackets[0].body else { panic!("a known algebra") };
    assert_eq!((so.algebra.text.as_str(), so.order, so.sections.len()), ("so", Some(3), 3));
    let Brackets::Known(heisenberg) = &s.brackets[1].body else { panic!("a known algebra") };
    assert_eq!(heisenberg.order, None);
}

#[test]
fn comparisons_are_read() {
    for (text, relation) in [
        ("m > 0", Relation::Greater),
        ("m >= 0", Relation::GreaterOrEqual),
        ("m < 0", Relation::Less),
        ("m <= 0", Relation::LessOrEqual),
        ("m != 0", Relation::NotEqual),
    ] {
        let mut stream = super::stream::Stream::new(
            text.parse().expect("tokens"),
            crate::report::Extent::at(proc_macro2::Span::call_site()),
        );
        assert_eq!(stream.comparison().expect("a comparison").relation, relation);
    }
}

#[test]
fn every_section_has_its_place() {
    for keyword in SECTIONS {
        let found = messages(&format!("{keyword} {{ 5 = }}"), "struct S;");
        assert!(!found.is_empty(), "nothing was said about {keyword}");
        assert!(!found[0].starts_with("unknown section"), "{found:?}");
    }
}

#[test]
fn errors_in_lines_are_explained() {
    let line = "a line of the anchor reads `der(x) = …;`, with a base coordinate `x`";
    let pair = "a bracket reads `[a, b] = …;`, with two sections of the basis";
    let force = "a force reads `name: …;`, with a section or a base coordinate";
    let assumption = "an assumption reads `m > 0;`, with one of `< <= > >= !=`";
    let methods = "derivatives of a method read `motor: [self.motor_d1, self.motor_d2];`";
    for (section, message) in [
        ("anchor { x = w; }", format!("expected `der(…)`, found `x`\nhelp: {line}")),
        ("anchor { der x = w; }", "expected a base coordinate in parentheses, found `x`".to_owned()),
        ("anchor { der(x): w; }", format!("expected `=`, found `:`\nhelp: {line}")),
        ("anchor { der(x) == w; }", "`==` is not part of an equation\nhelp: write a single `=`".to_owned()),
        ("brackets { w = v; }", format!("expected a pair of sections, found `w`\nhelp: {pair}")),
        (
            "brackets { so(3) }",
            "expected a pair of sections, found `so`\nhelp: a known algebra stands before the braces, its sections \
             between them: `brackets so(3) { w }`"
                .to_owned(),
        ),
        ("brackets { [w] = v; }", format!("expected `,` and a second section after `w`\nhelp: {pair}")),
        ("brackets { [w, 2] = v; }", format!("expected a section, found `2`\nhelp: {pair}")),
        ("forces { w = 2; }", format!("expected `:`, found `=`\nhelp: {force}")),
        (
            "forces { der(x): 2; }",
            "a force along `der(…)`\nhelp: a force along a base coordinate is written `x: …;`".to_owned(),
        ),
        (
            "forces { w: 1, x: 2 }",
            "expected `;`, found `,`\nhelp: lines end with `;`: write it in place of the comma".to_owned(),
        ),
        (
            "constraints { w }",
            "expected `=` after `w`\nhelp: this is an equation: `left = right`, where the right may be `0`"
                .to_owned(),
        ),
        (
            "constraints { w = 0 v = 0 }",
            "an operator or a `;` is missing between `0` and `v`\nhelp: a product is written `0 * v`".to_owned(),
        ),
        ("constraints { a = b = c }", "expected `;`, found `=`".to_owned()),
        (
            "impacts { floor: y >= 0 restitution e; }",
            "`with` is missing before `restitution`\nhelp: an impact reads `floor: h >= 0 with restitution e;` or \
             `blade: u = 0, w = 0;`"
                .to_owned(),
        ),
        ("outputs { speed: 3 }", "expected `=`, found `:`\nhelp: a definition reads `name = …;`".to_owned()),
        ("outputs { R[0][1][2] = 3 }", "a third index\nhelp: families have one or two indices".to_owned()),
        ("symmetries { w }", "expected `:` after `w`\nhelp: a symmetry reads `label: …;`".to_owned()),
        ("assume { m }", format!("expected a comparison after `m`\nhelp: {assumption}")),
        (
            "assume { M[0][1] = M[1][0] }",
            format!(
                "an assumption is not an equation\n{assumption}\nhelp: declare equal numbers once, and use that name \
                 twice: a symmetric matrix from six"
            ),
        ),
        (
            "assume { 0 < a < b }",
            "a chain of comparisons\nhelp: write one comparison per line: `0 < a; a < b;`".to_owned(),
        ),
        (
            "names { sate = A; }",
            "there is no generated type `sate`\ntypes that can be renamed: `state`, `velocity`, `input`, \
             `multipliers`, `outputs`, `reactions`, `residual`, `momenta`, `phase`, `quadratures`, `gyroscopic`, `power`, `coordinate`, `variable`, `impulses`\nhelp: did you mean `state`?"
                .to_owned(),
        ),
        (
            "names { everything = A; }",
            "there is no generated type `everything`\nhelp: types that can be renamed: `state`, `velocity`, \
             `input`, `multipliers`, `outputs`, `reactions`, `residual`, `momenta`, `phase`, `quadratures`, `gyroscopic`, `power`, `coordinate`, `variable`, `impulses`"
                .to_owned(),
        ),
        ("derivative { motor = 2 }", format!("expected `:`, found `=`\nhelp: {methods}")),
        ("derivative { motor: 2 }", format!("expected a list of methods in brackets, found `2`\nhelp: {methods}")),
        ("derivative { motor: [d1] }", format!("expected `self.` and a method, found `d1`\nhelp: {methods}")),
        ("derivative { motor: [self.a self.b] }", format!("expected `,` or `]`, found `self`\nhelp: {methods}")),
        ("formulation { reduced }", "unknown formulation `reduced`\nhelp: write `adapted` or `projected`".to_owned()),
        ("formulation { }", "expected a formulation, found nothing\nhelp: write `adapted` or `projected`".to_owned()),
        ("formulation { adapted, projected }", "expected `}`, found `,`\nhelp: there is one formulation".to_owned()),
        (
            "crate { 2 }",
            "expected the path of the runtime crate\nfound `2`\nhelp: write `crate { ::my_name_for_nonholonomic }`"
                .to_owned(),
        ),
    ] {
        assert_eq!(of(section), [message], "{section}");
    }
}

#[test]
fn errors_in_lists_are_explained() {
    for (section, message) in [
        ("inputs { u; v }", "names in a list are not separated by `;`\nhelp: write commas"),
        ("inputs { u v }", "a comma is missing before this name"),
        ("inputs { u = 2 }", "expected `,` or the end of the list, found `=`"),
        (
            "distribution { u + v }",
            "the sections that span D are listed by their names\nhelp: name the combination: `frame { s = …; } \
             distribution { s }`",
        ),
        (
            "distribution { 2 * der(x), v }",
            "the sections that span D are listed by their names\nhelp: name the combination: `frame { s = …; } \
             distribution { s }`",
        ),
        (
            "inputs { u: f64 }",
            "names in a list have no type\nhelp: write the name alone: every number is of the scalar type of the \
             struct",
        ),
        ("inputs { u,, v }", "a comma with nothing before it in this list"),
        ("inputs { u[] }", "expected the number of entries, an integer, found nothing"),
        ("inputs { u[n] }", "expected the number of entries, an integer, found `n`"),
        ("inputs { u[2.5] }", "expected the number of entries, an integer\n`2.5` is none, or too large"),
        ("inputs { u[2 3] }", "expected `]`, found `3`"),
        ("inputs { u[0] }", "this has no entries\nhelp: leave it out"),
        ("inputs { u[70][70] }", "this has more than 4096 entries"),
        ("inputs { u[1][1][1] }", "a third index\nhelp: families have one or two indices"),
        (
            "inputs { #[serde(skip)] u }",
            "attributes have no place in a declaration\nhelp: only doc comments may stand before a name",
        ),
        (
            "inputs { #[doc = edge \"torque\"] u }",
            "this is no documentation\nhelp: write `#[doc = \"…\"]`, or `///`",
        ),
        ("inputs { #[doc = +] u }", "this is no documentation\nhelp: write `#[doc = \"…\"]`, or `///`"),
        (
            "inputs { type }",
            "expected a name, found `type`, a word that Rust keeps for itself\nhelp: choose another name, or \
             write `r#type`",
        ),
        (
            "inputs { self }",
            "expected a name, found `self`, a word that Rust keeps for itself\nhelp: choose another name",
        ),
        ("independent { 2 }", "expected the name of a velocity, found `2`"),
    ] {
        assert_eq!(of(section), [message], "{section}");
    }
}

#[test]
fn errors_in_lets_and_blocks_are_explained() {
    for (section, message) in [
        (
            "lagrangian { }",
            "there is no expression in `lagrangian`\nhelp: write kinetic minus potential energy: \
          `lagrangian { m / 2 * v^2 - m * g * z }`",
        ),
        (
            "lagrangian { a; b }",
            "a second expression\nhelp: the Lagrangian is one expression; name parts of it with `let`",
        ),
        (
            "lagrangian { a; let b = 1 }",
            "a `let` behind the Lagrangian itself\nhelp: move it before the expression",
        ),
        (
            "lagrangian { let mut a = 1; a }",
            "a `let` names a value, which never changes\nhelp: leave out `mut`",
        ),
        ("lagrangian { let a: f64 = 1; a }", "a `let` has no type\nhelp: write `let name = …;`"),
        (
            "lagrangian { let a = 1, b = 2; a - b }",
            "expected `;`, found `,`\nhelp: lines end with `;`, and a second `let` is a line of its own",
        ),
        (
            "lagrangian { let a = (x) a - 1 }",
            "an operator or a `;` is missing between `(x)` and `a`\nhelp: a product is written `(x) * a`",
        ),
        ("lagrangian { let a; a }", "expected `=` after `a`\nhelp: an abbreviation reads `let name = …;`"),
        (
            "lagrangian { let a[0] = 1; a }",
            "expected a range: `[i in 0..4]`\nhelp: an indexed `let` defines all entries in one line",
        ),
        (
            "lagrangian { let a[i in 0..1, j in 0..1, k in 0..1] = 1; a }",
            "a third index\nhelp: a `let` has one or two indices",
        ),
        (
            "constraints { for i { w = 0 } }",
            "expected `in` and a range, found braces\nhelp: a range reads `i in 0..4`",
        ),
        ("constraints { for i in 0..3; w = 0 }", "expected the items of the `for` in braces after `3`"),
        (
            "anchor { der(x[i in 0..2]) = w[i]; }",
            "a range in the index of a name that is declared elsewhere\nhelp: write `[i]`, with `for i in 0..2 { … }` \
             around the line or `sum(i in 0..2: …)` around a term",
        ),
        (
            "forces { x[i in 0..2]: w[i]; }",
            "a range in the index of a name that is declared elsewhere\nhelp: write `[i]`, with `for i in 0..2 { … }` \
             around the line or `sum(i in 0..2: …)` around a term",
        ),
        (
            "lagrangian { w[i in 0..2]^2 }",
            "a range in the index of a name that is declared elsewhere\nhelp: write `[i]`, with `for i in 0..2 { … }` \
             around the line or `sum(i in 0..2: …)` around a term",
        ),
        (
            "constraints { for i in 0..2 { roll[i]: w[i] = 0; } }",
            "a label has no index\nhelp: write `roll: …`: inside of `for` it gives an array `roll`",
        ),
        (
            "holonomic { rod[i in 0..2]: x[i] = 0; }",
            "a label has no index\nhelp: write `for i in 0..2 { rod: … }`, which gives an array `rod`",
        ),
        (
            "symmetries { turn[i in 0..2]: w[i]; }",
            "a label has no index\nhelp: write `for i in 0..2 { turn: … }`, which gives an array `turn`",
        ),
        (
            "impacts { stop[i in 0..2]: x[i] >= 0; }",
            "a label has no index\nhelp: write `for i in 0..2 { stop: … }`, which gives an array `stop`",
        ),
        (
            "lagrangian { for i in 0..3 { x } }",
            "`for` has no place in an expression\nhelp: a sum is written `sum(i in 0..4: …)`; `for` goes around whole items",
        ),
    ] {
        assert_eq!(of(section), [message], "{section}");
    }
    let deep = format!("constraints {{ {} w = 0 {} }}", "for i in 0..1 {".repeat(5000), "}".repeat(5000));
    assert_eq!(
        of(&deep),
        ["`for` blocks are nested more than 8 deep\nhelp: one `for` takes several variables: \
          `for i in 0..3, j in 0..3 { … }`"]
    );
}

#[test]
fn errors_between_sections_are_explained() {
    let known = "known algebras: `so(n)`, `se(2)`, `se(3)`, `sl(2)`, `heisenberg(n)`";
    for (section, message) in [
        ("constraint { w = 0; }", "unknown section `constraint`\nhelp: did you mean `constraints`?".to_owned()),
        ("potential { w }", format!("unknown section `potential`\nhelp: sections: {}", SECTIONS.join(", "))),
        (
            "let c = cos(x)",
            "a `;` is missing behind this `let`\nhelp: between the sections every `let` ends with `;`".to_owned(),
        ),
        ("let h() = 1;", "a function without arguments\nhelp: leave the parentheses out: `let name = …;`".to_owned()),
        (
            "let e(q)[i in 0..2] = q;",
            "an index behind the arguments of a function\nhelp: let its value be a vector: `let e(q) = [cos(q), \
             sin(q)];`"
                .to_owned(),
        ),
        (
            "outputs { let h(u) = u; y = h(1); }",
            "the function `h` stands inside a section\nhelp: put its `let` between the sections, where all of them \
             know it"
                .to_owned(),
        ),
        (
            "for i in 0..2 { brackets so(3) { w[i] } }",
            "a `for` around sections\nhelp: it goes around the items inside of one: `brackets { for i in 0..3 { … } }`; \
             blocks such as `brackets so(3) { … }` are written one by one"
                .to_owned(),
        ),
        ("inputs { a } inputs { b }", "a second `inputs`\n`inputs` was declared above already\nhelp: move its content into the first one".to_owned()),
        ("inputs { a }, outputs { }", "sections are not separated by commas\nhelp: leave it out".to_owned()),
        ("inputs(a)", "expected `{`, found parentheses\nhelp: write `inputs { … }`".to_owned()),
        ("inputs", "expected `{` after `inputs`\nhelp: write `inputs { … }`".to_owned()),
        ("= inputs { a }", "expected a section, found `=`\nhelp: a section reads `base { x, y }`".to_owned()),
        ("almost { }", "expected `;`, found braces\nhelp: `almost;` has no content".to_owned()),
        ("/// doc\n inputs { a }", "a doc comment before a section documents nothing\nhelp: write `//`, or put it before a declared name".to_owned()),
        ("brackets so3 { w }", format!("unknown algebra `so3`\n{known}\nhelp: write `so(3)`")),
        ("brackets heisenburg { w }", format!("unknown algebra `heisenburg`\n{known}\nhelp: did you mean `heisenberg`?")),
        ("brackets virasoro { w }", format!("unknown algebra `virasoro`\n{known}\nhelp: write its table: `brackets {{ [a, b] = c; }}`")),
        ("brackets so(n) { w }", "expected the number of the algebra, an integer, found `n`".to_owned()),
    ] {
        assert_eq!(of(section), [message], "{section}");
    }
}

#[test]
fn one_mistake_does_not_hide_another() {
    let found = underlined(
        "base { x, 2, y }\n\
         anchor { x = 1; der(y) = w ** 2; der(z) = ; }\n\
         lagrangain { x }\n\
         constraints { for i in 0..3 { w[i] == 0; 2x = 0 } v = }\n\
         inputs (u)\n\
         forces { w: sin x; }",
    );
    let found: Vec<_> = found.iter().map(|(at, what)| (at.as_str(), what.as_str())).collect();
    assert_eq!(
        found,
        [
            ("2", "expected a name, found `2`"),
            ("x", "expected `der(…)`, found `x`"),
            ("**", "`**` is not an operator"),
            ("=", "expected an expression after `=`"),
            ("lagrangain", "unknown section `lagrangain`"),
            ("==", "`==` is not part of an equation"),
            ("2x", "`2x` is a single number to Rust"),
            ("=", "expected an expression after `=`"),
            ("(u)", "expected `{`, found parentheses"),
            ("sin", "`sin` is a function and needs its parentheses"),
        ]
    );
}

#[test]
fn errors_in_struct_and_sections_come_together() {
    assert_eq!(messages("bass { x }", "struct S { m: u8 }").len(), 2);
    assert_eq!(messages("base { x } lagrangian { x. } lagrangian { y y }", "enum E {}").len(), 4);
}

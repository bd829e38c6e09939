//! The sections of a declaration: what they become, and every error text.

use nonholonomic_core::id::{Id, SectionId};
use nonholonomic_core::model::{ForceDirection, Formulation, Kinematics};

use super::{STRUCT, assert_errors, evaluated, model, of, of_name, resolved};

#[test]
fn tangent_bundle() {
    let (resolved, layout) =
        resolved("base { x, /// angles\n th[2] } lagrangian { der(x)^2 }", STRUCT).expect("a declaration");
    let model = resolved.model;
    let names: Vec<_> = model.sections.iter().map(|section| section.name.as_str()).collect();
    assert_eq!(names, ["x_dot", "th_dot[0]", "th_dot[1]"]);
    for (coordinate, section) in model.coordinates.iter().zip(&model.sections) {
        assert_eq!(coordinate.rate, section.symbol);
    }
    assert!(matches!(model.kinematics, Kinematics::Tangent));
    assert_eq!(layout.coordinates[1].docs.to_string(), "# [doc = \" angles\"]");
    let fields: Vec<_> = layout.velocities.iter().map(|family| family.ident.to_string()).collect();
    assert_eq!(fields, ["x_dot", "th_dot"]);
    assert_eq!(layout.velocities[1].lengths, [2]);
    assert_eq!(
        model.parameters.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(),
        ["m", "G[0]", "G[1]", "G[2]"]
    );
}

#[test]
fn anchors() {
    let model = model(
        "base { g[3], x } basis { w[3], v } anchor { der(g) = cross(g, w); der(x) = v; } lagrangian { v^2 }",
        STRUCT,
    );
    let Kinematics::Anchor(lines) = &model.kinematics else { panic!("an anchor") };
    assert_eq!(lines.len(), 4);
    let n = of_name;
    let expected = n("g[1]") * n("w[2]") - n("g[2]") * n("w[1]");
    assert!((evaluated(&model, lines[0].rate) - expected).abs() < 1e-12);
    let missing =
        of("base { x, g[3], h[9] } basis { w } anchor { der(x) = w; der(g[1]) = w; } lagrangian { w }");
    assert_eq!(
        missing,
        [
            "the anchor has no line for `g[0]`, `g[2]`\nthe kinematic equations give the rate of every base \
             coordinate\nhelp: add `der(g[0]) = …;`, or `der(g[0]) = 0;` if it never changes",
            "the anchor has no line for `h[0]`, `h[1]`, `h[2]`, `h[3]` and 5 more\nthe kinematic equations give \
             the rate of every base coordinate\nhelp: add `der(h[0]) = …;`, or `der(h[0]) = 0;` if it never changes",
        ]
    );
    assert_errors(&[
        (
            "base { x } basis { w } anchor { der(x) = w; der(x) = 2 * w; } lagrangian { w }",
            "`der(x)` is given twice\nhelp: keep one of the lines",
        ),
        (
            "base { g[3] } basis { w } anchor { der(g) = w; } lagrangian { w }",
            "the two sides have different shapes\non the left is a vector of 3 entries, on the right a number",
        ),
        (
            "base { x } basis { w } lagrangian { w }",
            "`base` and `basis` without an `anchor`\nthe kinematic equations give the rate of every base \
             coordinate\nhelp: add `anchor { der(x) = …; }`",
        ),
        (
            "base { xa } basis { w } anchor { der(xaa) = w; } lagrangian { w }",
            "there is no base coordinate `xaa`\nhelp: did you mean `xa`?",
        ),
    ]);
}

#[test]
fn coframes() {
    for velocities in [
        "w[0] = der(x); w[1] = m * der(y);",
        "w[1] = m * der(y); w[0] = der(x);",
        "let k = m; w = [der(x), k * der(y)];",
        "let d = [der(x), m * der(y)]; w[i in 0..2] = d[i];",
        "let d = [der(x), m * der(y)]; for i in 0..2 { w[i] = d[i]; }",
    ] {
        let (resolved, layout) = resolved(
            &format!("base {{ x, y }} velocities {{ {velocities} }} lagrangian {{ dot(w, w) }}"),
            STRUCT,
        )
        .expect(velocities);
        assert_eq!(layout.velocities[0].lengths, [2]);
        let model = resolved.model;
        let Kinematics::Coframe(rows) = &model.kinematics else { panic!("a coframe") };
        assert!((evaluated(&model, rows[1].value) - of_name("m") * of_name("der(y)")).abs() < 1e-12);
        assert!((evaluated(&model, rows[0].value) - of_name("der(x)")).abs() < 1e-12);
    }
    assert_errors(&[
        (
            "base { x, y } velocities { w = der(x); } lagrangian { w^2 }",
            "the coframe is not square: 1 quasi-velocity for 2 base coordinates\nhelp: define one quasi-velocity \
             for each base coordinate, or use `basis` and `anchor`",
        ),
        (
            "base { x, y } velocities { w = der(x); w = der(y); } lagrangian { w^2 }",
            "`w` is defined twice\nhelp: keep one of the definitions",
        ),
        (
            "base { x, y } velocities { w[0] = der(x); w[2] = der(y); } lagrangian { w[0]^2 }",
            "`w[1]` is not defined\nother entries of `w` are, and indices count from 0\nhelp: add `w[1] = …;`",
        ),
        (
            "base { x, y } velocities { w[2] = [der(x), der(y)]; } lagrangian { w[0]^2 }",
            "`w[0][0]` is not defined\nother entries of `w` are, and indices count from 0\nhelp: write `w = …;` for a \
             vector: `w[2]` is one entry",
        ),
        (
            "base { x, y } velocities { w[0] = der(x); w = der(y); } lagrangian { w[0]^2 }",
            "`w` has different numbers of indices\nhelp: define all of its entries in the same way",
        ),
        (
            "base { x } velocities { w[0 - 1] = der(x); } lagrangian { w[0]^2 }",
            "the index -1 is out of range\nhelp: indices count from 0, and there are at most 4096 entries",
        ),
        (
            "base { x } velocities { v = oops; } lagrangian { v * v }",
            "unknown name `oops`\nhelp: parameters are fields of the struct; other names are declared in `base`, `basis`, `inputs` or `auxiliary`, or by a `let`",
        ),
    ]);
}

#[test]
fn brackets() {
    let table =
        model("basis { a, b, c } brackets { [a, b] = 2 * c; [c, a] = 0; } lagrangian { a }", "struct S;");
    assert!(table.brackets_declared);
    assert_eq!(table.brackets.len(), 2);
    assert!((evaluated(&table, table.brackets[0].value) - 2.0 * of_name("c")).abs() < 1e-12);
    let family = model(
        "basis { w[3], v } brackets so(3) { w } brackets { [w[0], v] = v; } lagrangian { v }",
        "struct S;",
    );
    assert_eq!(family.brackets.len(), 4);
    assert_eq!(family.brackets[0].known, Some("so(3)"));
    assert_eq!(family.brackets[0].right, SectionId::from_index(1));
    assert!((evaluated(&family, family.brackets[0].value) - of_name("w[2]")).abs() < 1e-12);
    assert_eq!(
        model("basis { p, q, z } brackets heisenberg { p, q, z } lagrangian { p }", "struct S;")
            .brackets
            .len(),
        1
    );
    assert_errors(&[
        (
            "basis { w[4] } brackets so(3) { w } lagrangian { 1 }",
            "`so(3)` takes 3 sections, and 4 are listed\nhelp: list them in the order w1, w2, w3 with [w1, w2] = w3 \
             and cyclic",
        ),
        (
            "basis { w } brackets se(2) { w } lagrangian { 1 }",
            "`se(2)` takes 3 sections, and 1 is listed\nhelp: list them in the order omega, v1, v2 with [omega, \
             v1] = v2 and [omega, v2] = -v1",
        ),
        (
            "basis { w[3] } brackets so(3) { w[0], w[1], w[1] } lagrangian { 1 }",
            "the section `w[1]` is listed twice",
        ),
        (
            "basis { w[3] } brackets se(4) { w } lagrangian { 1 }",
            "`se(4)` is not a known algebra\nhelp: known are so(n) for n from 3 to 32, se(2), se(3), sl(2) and heisenberg(n)",
        ),
        (
            "basis { omega, v } brackets { [omgea, v] = v; } lagrangian { 1 }",
            "there is no section `omgea`\nhelp: did you mean `omega`?",
        ),
        (
            "basis { w[2] } brackets { [w, w[0]] = w[1]; } lagrangian { 1 }",
            "`w` is a family of sections\nhelp: name one of them, as in `w[0]`; `for` goes over all",
        ),
        (
            "basis { w, v } brackets { [w, m] = v; } lagrangian { 1 }",
            "`m` is a parameter, not a section\nhelp: name one of the quasi-velocities",
        ),
    ]);
}

#[test]
fn constraints() {
    let model = model(
        "base { x, y, z } lagrangian { 1 }
         constraints { roll: der(x) = m * der(y); der(y) = x * der(y); -der(z) = 0; z_dot = 0; der(z) * 2 = 0; }",
        STRUCT,
    );
    let solved: Vec<_> = model.constraints.iter().map(|c| c.solved_for).collect();
    let symbol = |k: usize| Some(model.sections[SectionId::from_index(k)].symbol);
    assert_eq!(solved, [symbol(0), None, None, symbol(2), None]);
    let first = model.constraints.iter().next().expect("one");
    assert_eq!(first.label.as_deref(), Some("roll"));
    let expected = of_name("x_dot") - of_name("m") * of_name("y_dot");
    assert!((evaluated(&model, first.residual) - expected).abs() < 1e-12);
}

#[test]
fn vector_constraints_and_loops() {
    let model = model(
        "base { g[3] } basis { w[3], v[3] } anchor { der(g) = cross(g, w); } lagrangian { 1 }
         constraints { roll: v = m * cross(w, g); for i in 0..2 { pair: w[i] = v[i]; } cross(w, v) = 0; }",
        STRUCT,
    );
    let labels: Vec<_> = model.constraints.iter().map(|c| c.label.clone().unwrap_or_default()).collect();
    assert_eq!(labels, ["roll[0]", "roll[1]", "roll[2]", "pair[0]", "pair[1]", "", "", ""]);
    // what a vector equation stands solved for is not read off
    let solved: Vec<_> = model.constraints.iter().map(|c| c.solved_for).collect();
    let of = |k: usize| Some(model.sections[SectionId::from_index(k)].symbol);
    assert_eq!(solved, [None, None, None, of(0), of(1), None, None, None]);
    assert_errors(&[
        (
            "base { x, y } lagrangian { 1 } constraints { a: der(x) = 0; a: der(y) = 0; }",
            "the label `a` is given twice\nhelp: choose another label",
        ),
        (
            "base { q[3] } lagrangian { 1 } constraints { der(q) = m; }",
            "the two sides have different shapes\non the left is a vector of 3 entries, on the right a number",
        ),
    ]);
}

/// `der(x)` on the left is the quasi-velocity that the anchor puts for it.
#[test]
fn a_rate_that_is_a_quasi_velocity_is_solved_for() {
    let model = model(
        "base { x, y } basis { u, v } anchor { der(x) = u; der(y) = u + v; } lagrangian { 1 }
         constraints { der(x) = m * v; der(x) = der(y); u = der(y); der(y) = 0; }",
        STRUCT,
    );
    let u = model.sections[SectionId::from_index(0)].symbol;
    let solved: Vec<_> = model.constraints.iter().map(|c| c.solved_for).collect();
    let rate = model.coordinates.iter().nth(1).map(|c| c.rate);
    assert_eq!(solved, [Some(u), None, None, rate]);
}

#[test]
fn forces() {
    let tangent = model("base { x, q[2] } lagrangian { 1 } forces { x: m; q: [1, 2]; } inputs { u }", STRUCT);
    let directions: Vec<_> = tangent.forces.iter().map(|force| force.direction).collect();
    let sections: Vec<_> = tangent.sections.iter().map(|s| ForceDirection::Section(s.symbol)).collect();
    assert_eq!(directions, sections);
    let anchored = model(
        "base { x } basis { w } anchor { der(x) = w; } lagrangian { 1 } forces { x: m; w: 2; }",
        STRUCT,
    );
    assert!(matches!(anchored.forces[0].direction, ForceDirection::Coordinate(_)));
    assert_errors(&[
        (
            "base { theta } lagrangian { 1 } forces { tehta: m; }",
            "a force along the unknown direction `tehta`\nhelp: did you mean `theta`?",
        ),
        (
            "base { x } lagrangian { 1 } forces { m: m; }",
            "`m` is a parameter, not a direction\nhelp: a force acts along a section of the basis or along a base \
             coordinate",
        ),
        (
            "base { x } lagrangian { 1 } forces { x: m; x_dot: 1; }",
            "the force along `x_dot` is given twice\nhelp: write one line with the sum",
        ),
        (
            "base { q[3] } lagrangian { 1 } forces { q: m; }",
            "the two sides have different shapes\non the left is a vector of 3 entries, on the right a number",
        ),
    ]);
}

/// The larger side is the right one of `<=`; what is said of sides is said of them as they are written.
#[test]
fn sides_of_impacts() {
    assert_errors(&[
        (
            "base { q[3] } lagrangian { 1 } impacts { wall: q <= m; }",
            "the two sides have different shapes\non the left is a vector of 3 entries, on the right a number",
        ),
        (
            "base { q[3] } lagrangian { 1 } impacts { wall: q >= m; }",
            "the two sides have different shapes\non the left is a vector of 3 entries, on the right a number",
        ),
    ]);
}

#[test]
fn outputs() {
    let (resolved, layout) = resolved(
        "base { q[2] } lagrangian { 1 } outputs { speed = m; p = G; s[i in 0..2] = der(q[i]); o[0] = q; o[1] = 2 * q; }",
        STRUCT,
    )
    .expect("a declaration");
    let names: Vec<_> = resolved.model.outputs.iter().map(|output| output.name.as_str()).collect();
    assert_eq!(
        names,
        ["speed", "p[0]", "p[1]", "p[2]", "s[0]", "s[1]", "o[0][0]", "o[0][1]", "o[1][0]", "o[1][1]"]
    );
    let lengths: Vec<_> = layout.outputs.iter().map(|family| family.lengths.clone()).collect();
    assert_eq!(lengths, [vec![], vec![3], vec![2], vec![2, 2]]);
    assert_errors(&[
        (
            "base { x } lagrangian { 1 } outputs { a = x; a = 2; }",
            "`a` is defined twice\nhelp: keep one of the definitions",
        ),
        (
            "base { x } lagrangian { 1 } outputs { for i in 0..0 { a[i] = x; } }",
            "`a` has no entries\nhelp: leave it out",
        ),
    ]);
}

#[test]
fn choices() {
    let (resolved, layout) = resolved(
        "base { x, q[2] } lagrangian { 1 } independent { der(q), x_dot } formulation { projected }
         names { state = Where; } crate { ::other }",
        STRUCT,
    )
    .expect("a declaration");
    let model = &resolved.model;
    let place = |symbol| model.sections.iter().position(|section| section.symbol == symbol).expect("known");
    let kept: Vec<_> =
        model.independent.as_ref().expect("a list").iter().map(|(symbol, _)| place(*symbol)).collect();
    assert_eq!(kept, [1, 2, 0]);
    assert!(matches!(resolved.model.formulation, Some((Formulation::Projected, _))));
    assert_eq!(layout.types.state.to_string(), "Where");
    assert_eq!(layout.types.velocity.to_string(), "SVelocity");
    assert_eq!(layout.runtime.to_string(), ":: other");
    assert_errors(&[
        (
            "base { x } lagrangian { 1 } independent { x }",
            "`x` is a base coordinate, not a velocity\nhelp: write `der(x)`",
        ),
        ("base { x } lagrangian { 1 } independent { der(x), x_dot }", "the velocity `x_dot` is named twice"),
        (
            "base { x } basis { w } anchor { der(x) = w; } lagrangian { 1 } independent { der(x) }",
            "`der(x)` is not one of the quasi-velocities\nthe declaration has its own quasi-velocities, and the \
             state keeps some of them\nhelp: name them as they are declared",
        ),
        (
            "base { x } lagrangian { 1 } names { state = A; state = B; }",
            "the type `state` is renamed twice\nhelp: keep one of the names",
        ),
        (
            "base { x } lagrangian { 1 } names { state = S; }",
            "two types are called `S`\nthe struct and the types generated for it need names of their own\nhelp: \
             choose another name",
        ),
    ]);
}

#[test]
fn facts() {
    let model = model(
        "base { R[3][3], x } basis { v } anchor { der(R) = 0 * v * R; der(x) = v; } lagrangian { v^2 }
         on { for i in 0..3, j in 0..i { dot(R[i], R[j]) = 0; } dot(R[0], R[0]) = 1; }
         conserved { energy = m * v^2; p[0] = v; }
         assume { m > 0; G >= 1; G[0] != m; }",
        STRUCT,
    );
    assert_eq!(model.identities.len(), 4);
    let r = |i: usize, j: usize| of_name(&format!("R[{i}][{j}]"));
    let product = (0..3).map(|k| r(1, k) * r(0, k)).sum::<f64>();
    assert!((evaluated(&model, model.identities[0].value) - product).abs() < 1e-12);
    assert_eq!(model.claims.iter().map(|claim| claim.name.as_str()).collect::<Vec<_>>(), ["energy", "p[0]"]);
    let facts: Vec<_> = model.assumptions.iter().map(|fact| fact.text.as_str()).collect();
    assert_eq!(facts, ["m > 0", "G[0] >= 1", "G[1] >= 1", "G[2] >= 1", "G[0] != m"]);
    assert_errors(&[(
        "base { x, y[2] } lagrangian { 1 } assume { y > G; }",
        "the two sides have different shapes\non the left is a vector of 2 entries, on the right a vector of 3 \
         entries",
    )]);
    assert_errors(&[(
        "base { R[3][3] } lagrangian { 1 } on { transpose(R) * R = 1; }",
        "the two sides have different shapes\non the left is a matrix of 3 × 3 entries, on the right a number\nhelp: the \
         matrix with ones on its diagonal is `identity(3)`; only the literal `0` has any shape",
    )]);
}

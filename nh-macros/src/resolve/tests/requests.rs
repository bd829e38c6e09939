//! What is asked for: requests, methods of the user's with their derivatives, tracked variables.

use nonholonomic_core::model::{Request, TrackedItem};

use super::{STRUCT, assert_errors, evaluated, model, of, of_name};

#[test]
fn requests() {
    let constrained = "base { x } lagrangian { 1 } constraints { der(x) = 0; }";
    let model = model(&format!("{constrained} emit {{ reactions, multipliers }}"), STRUCT);
    let asked: Vec<_> = model.requests.iter().map(|(request, _)| *request).collect();
    assert_eq!(asked, [Request::Reactions, Request::Multipliers]);
    let all = Request::WORDS.map(|(known, _)| format!("`{known}`")).join(", ");
    let known = format!("what can be asked for: {all}");
    let mistyped = format!("`multiplier` cannot be emitted\n{known}\nhelp: did you mean `multipliers`?");
    assert_errors(&[
        ("base { x } lagrangian { 1 } emit { multiplier }", mistyped.as_str()),
        (
            "base { x } lagrangian { 1 } emit { everything }",
            &format!("`everything` cannot be emitted\nhelp: {known}"),
        ),
        (
            "base { x } lagrangian { 1 } emit { energy }",
            "`energy` is generated without being asked for\nhelp: leave it out",
        ),
        (&format!("{constrained} emit {{ reactions, reactions }}"), "`reactions` is asked for twice"),
        (
            "base { x } lagrangian { 1 } emit { reactions }",
            "there are no reactions without constraints\nhelp: state them in `constraints { … }`, or leave this out",
        ),
    ]);
}

#[test]
fn methods() {
    let model = model(
        "base { x } inputs { u } lagrangian { der(x)^2 }
         forces { x: self.motor(der(x), 2 * u) + self.motor(der(x), u + u) - self.drag(); }
         outputs { heat = self.motor(0, u); }",
        STRUCT,
    );
    let calls: Vec<_> = model.calls.iter().map(|call| model.graph.symbols()[call.symbol].as_str()).collect();
    assert_eq!(calls, ["self.motor(x_dot, 2*u)", "self.drag()", "self.motor(0, u)"]);
    let force = evaluated(&model, model.forces[0].value);
    assert!((force - (2.0 * of_name(calls[0]) - of_name(calls[1]))).abs() < 1e-12);
    assert_eq!(model.calls[0].method, "motor");
    let found = of("base { q[2] } lagrangian { 1 } forces { q[0]: self.motor(q); }");
    assert!(found[0].starts_with("expected a number, this is a vector of 2 entries"), "{found:?}");
}

#[test]
fn derivatives_of_methods() {
    let text = "base { x } inputs { u } lagrangian { der(x)^2 } forces { x: self.motor(der(x), u); }";
    let declared = format!("{text} derivative {{ motor: [self.by_speed, self.by_input]; }}");
    let model = model(&declared, STRUCT);
    let names = ["by_speed", "by_input"].map(str::to_owned).to_vec();
    assert_eq!(model.calls[0].derivatives, Some(names));
    let with = |section: &str| of(&format!("{text} derivative {{ {section} }}"));
    assert_eq!(
        with("motor: [self.a];"),
        [
            "`self.motor` is called with 2 arguments, and 1 derivative is given\nthere is one derivative for each \
          argument, in their order\nhelp: write `motor: [self.motor_d1, self.motor_d2];`"
        ]
    );
    assert_eq!(
        with("moter: [self.a, self.b];"),
        ["`self.moter` is not called anywhere\nhelp: did you mean `motor`?"]
    );
    assert_eq!(
        with("motor: [self.a, self.b]; motor: [self.a, self.b];"),
        ["the derivatives of `self.motor` are given twice\nhelp: keep one of the lines"]
    );
}

#[test]
fn tracked_variables_and_outputs() {
    let text = "base { x, y[2] } lagrangian { 1 } outputs { a[i in 0..2] = y[i]; b = x; }";
    let tracked = model(&format!("{text} track {{ x, der(y[1]), y, a[1], b }}"), STRUCT).tracked.unwrap();
    let outputs: Vec<_> = tracked
        .iter()
        .filter(|(item, _)| matches!(item, TrackedItem::Output(_)))
        .map(|(item, _)| *item)
        .collect();
    assert_eq!(tracked.len(), 6);
    assert_eq!(outputs, [TrackedItem::Output(1), TrackedItem::Output(2)]);
    let with = |section: &str| of(&format!("{text} track {{ {section} }}"));
    assert_eq!(
        with("m"),
        [
            "`m` is neither a state variable nor an output\nhelp: `track` names coordinates, velocities and outputs"
        ]
    );
    assert_eq!(with("x, x"), ["this is tracked already"]);
    let nothing = "help: name the state variables and outputs that are needed, or leave the section out";
    assert_eq!(with(""), [format!("nothing is tracked\n{nothing}")]);
    let spanned = of(&format!("{text} distribution {{ }}"));
    let nothing = "help: name the sections that span D, or leave `distribution` out";
    assert_eq!(spanned, [format!("no section spans the distribution: nothing can move\n{nothing}")]);
}

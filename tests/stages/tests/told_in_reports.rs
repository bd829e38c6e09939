//! What reports tell of names, groups, gaps and functions.

use nh_stages::declarations;

const FIELDS: &str = "m: f64, a: f64";

fn report(sections: &str, fields: &str) -> String {
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ {fields} }}");
    declarations(&text)[0].system().unwrap_or_else(|errors| panic!("{errors:?}")).report
}

/// A section of the frame takes the place of a declared one, and velocities along the others change with it.
#[test]
fn reports_say_which_velocities_keep_their_name_and_have_another_value() {
    let declared =
        "base { x, y } basis { u, v } anchor { der(x) = u; der(y) = v; } lagrangian { m/2*(u^2 + v^2) }";
    let told = |frame: &str| {
        let report = report(&format!("{declared} frame {{ {frame} }}"), FIELDS);
        let lines = report.lines().filter(|line| line.contains("in the basis of the frame"));
        lines.map(|line| line.trim().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(
        told("h = u + a*v;"),
        ["`v` is the velocity along v in the basis of the frame: that in the declared basis is v + a*h"]
    );
    assert!(told("h = 2*u;").is_empty());
    assert!(told("h = u + a*v; k = v - a*u;").is_empty());
    let rates = report(
        "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) } frame { roll = x_dot + a*y_dot; }",
        FIELDS,
    );
    assert!(rates.contains("`y_dot` is the velocity along y_dot in the basis of the frame"), "{rates}");
    assert!(rates.contains("is y_dot + a*roll"), "{rates}");
}

/// What `track` leaves out takes the outputs along that need it.
#[test]
fn reports_say_which_outputs_are_left_out() {
    let declared =
        "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) } outputs { place = [x, y]; far = x; }";
    let told = report(&format!("{declared} track {{ der(x), y }}"), FIELDS);
    for output in ["the output `place[0]`, which depends on x", "the output `far`, which depends on x"] {
        assert!(told.contains(output), "{told}");
    }
}

/// What constraints say of velocities may be the rate of positions.
#[test]
fn integrable_constraints_are_pointed_to_holonomic() {
    let is_told = |sections: &str| report(sections, FIELDS).contains("written in `holonomic`");
    let space = "base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2) }";
    assert!(is_told(&format!("{space} constraints {{ x*der(x) + y*der(y) = 0; }}")));
    assert!(is_told(&format!("{space} constraints {{ der(y) = a*der(x); }}")));
    assert!(is_told(&format!("{space} holonomic {{ z = a; }} constraints {{ x*der(x) + y*der(y) = 0; }}")));
    assert!(!is_told(&format!("{space} constraints {{ der(z) = x*der(y); }}")));
    assert!(!is_told(&format!("{space} holonomic {{ x^2 + y^2 = a^2; }}")));
    assert!(!is_told(&format!("{space} distribution {{ der(x), der(y) }}")));
    // no angles are there for a body that turns about one axis
    let body = "basis { p, q, r } brackets so(3) { p, q, r } lagrangian { m/2*(p^2 + 2*q^2 + a*r^2) }";
    assert!(!is_told(&format!("{body} constraints {{ p = 0; q = 0; }}")));
    let sphere = "base { g[3] } on { dot(g, g) = 1; } basis { w[3] } brackets so(3) { w } anchor { der(g) = cross(g, w); } \
        lagrangian { dot(w, w) }";
    assert!(!is_told(&format!("{sphere} constraints {{ w[0] = 0; w[1] = 0; }}")));
    assert!(is_told(&format!("{sphere} constraints {{ der(g[2]) = 0; }}")));
    let carried = "base { x, y, p } basis { u, v, w } anchor { der(x) = u; der(y) = v; der(p) = 0; } \
        lagrangian { m*(u^2 + v^2 + p^2*w^2) }";
    assert!(!is_told(&format!("{carried} constraints {{ w = 0; }}")));
    assert!(is_told(&format!("{carried} constraints {{ u = a*v; }}")));
    // an auxiliary state stands in no position constraint
    let commanded = format!("{space} auxiliary {{ der(rate) = a; }} constraints {{ der(x) = rate; }}");
    assert!(!is_told(&commanded));
}

/// A function behind `up to` is what the Lagrangian changes by.
#[test]
fn lagrangians_that_change_by_a_rate_are_not_called_invariant() {
    let report = report(
        "base { x, z } lagrangian { m/2*(der(x)^2 + der(z)^2) } \
         symmetries { boost: t*der(x) up to m*x; shift: der(z) up to 0; }",
        FIELDS,
    );
    let line = |name: &str| report.lines().find(|line| line.trim().starts_with(name)).map(str::to_owned);
    let boost = line("boost:").expect("a line of its own");
    assert!(boost.contains("L is invariant up to the rate of the function in the momentum"), "{boost}");
    assert_eq!(
        line("shift:").as_deref(),
        Some("  shift: z_dot; a symmetry: L is invariant; der(m*z_dot) = 0")
    );
}

/// A motor on what constraints hold moves nothing.
#[test]
fn forces_that_do_not_act_on_the_motion_are_told() {
    let told = |sections: &str| {
        let report = report(sections, FIELDS);
        let lines = report.lines().filter(|line| line.contains("does not act on the motion"));
        lines.map(|line| line.trim().to_owned()).collect::<Vec<_>>()
    };
    let held =
        |along: &str| format!("the force along {along} does not act on the motion: D leads nowhere along it");
    let skate = "base { x, y, th } basis { v, w, side }
        anchor { der(x) = v*cos(th) - side*sin(th); der(y) = v*sin(th) + side*cos(th); der(th) = w; }
        lagrangian { m/2*(v^2 + side^2) + a/2*w^2 } inputs { u }";
    assert_eq!(
        told(&format!("{skate} constraints {{ side = 0; }} forces {{ side: u; v: u; w: -w; x: u; }}")),
        [held("side")]
    );
    assert_eq!(
        told(&format!("{skate} constraints {{ side = a*w; }} forces {{ side: u; v: u; }}")),
        Vec::<String>::new()
    );
    // along what is moved, and not moved freely
    let belt = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) } constraints { der(y) = a; } forces { y: -m; x: m; }";
    assert_eq!(told(belt), [held("y_dot")]);
    assert_eq!(told(&format!("{belt} formulation {{ projected }}")), [held("y_dot")]);
    let framed = "base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + a/2*der(th)^2 }
        frame { h = cos(th)*x_dot + sin(th)*y_dot; s = cos(th)*y_dot - sin(th)*x_dot; c = th_dot; }";
    assert_eq!(
        told(&format!("{framed} distribution {{ h, c }} forces {{ s: m; h: m; c: a; }}")),
        [held("s")]
    );
    assert_eq!(told(&format!("{framed} forces {{ s: m; h: m; }}")), Vec::<String>::new());
}

#[test]
fn the_group_is_named_where_it_is_not_all_that_is_cyclic() {
    let disk = "base { x, y, phi, psi } \
                lagrangian { (der(x)^2 + der(y)^2 + der(psi)^2 + der(phi)^2)/2 + E * cos(phi) } \
                constraints { der(x) = R * cos(phi) * der(psi); der(y) = R * sin(phi) * der(psi); }";
    let cyclic = report(disk, "E: f64, R: f64");
    assert!(cyclic.contains("; the group: translations along the cyclic coordinates"), "{cyclic}");
    let plane = report(&format!("{disk} symmetries {{ east: der(x); north: der(y); }}"), "E: f64, R: f64");
    assert!(plane.contains("a Chaplygin system"), "{plane}");
    assert!(plane.contains("; the group: translations along x, y\n"), "{plane}");
}

#[test]
fn a_gap_changes_at_its_rate() {
    let report = report(
        "base { h } lagrangian { der(h)^2/2 - h } impacts { floor: h >= 0; ceiling: h <= a; }",
        "a: f64",
    );
    assert!(report.contains("floor: h >= 0, changing at the rate h_dot"), "{report}");
    // the larger side less the other
    assert!(report.contains("ceiling: a - h >= 0, changing at the rate -h_dot"), "{report}");
    assert!(!report.contains("closing at the rate h_dot"), "{report}");
}

/// Functions whose arguments are equal, as the mean of equal places is, are one, and ask for values of all that is declared.
#[test]
fn functions_have_short_arguments() {
    let told = |potential: &str, fields: &str, further: &str| {
        let lagrangian = format!("base {{ x, y }} lagrangian {{ (der(x)^2 + der(y)^2) / 2 + {potential} }}");
        report(&format!("{lagrangian} {further}"), fields)
    };
    let mean = told("k * cos((m * x + n * x) / (m + n))", "m: f64, n: f64, k: f64", "emit { jacobian }");
    assert!(mean.contains("der(x_dot) = -k*sin(x)\n"), "{mean}");
    let shares = told("sin(x^2 / (x + y) + x*y / (x + y))", "", "");
    assert!(shares.contains("der(x_dot) = cos(x)\n"), "{shares}");
    assert!(shares.contains("the equations have a value only where x + y != 0"), "{shares}");
    let squares = told("x * exp(y * (sin(y)^2 + cos(y)^2))", "", "");
    assert!(squares.contains("der(x_dot) = exp(y)\n"), "{squares}");
}

/// Rates of auxiliary states have values or have none like forces.
#[test]
fn rates_of_auxiliary_states_say_where_they_have_a_value() {
    let told = |rate: &str| {
        let sections = "base { x } lagrangian { m/2*der(x)^2 } forces { x: -z; }";
        report(&format!("{sections} auxiliary {{ der(z) = {rate}; }}"), FIELDS)
    };
    let power = told("m*der(x) - a*z^(3/2)");
    assert!(power.contains("the equations have a value only where z >= 0\n"), "{power}");
    let slip = told("a*atan(z/der(x))");
    assert!(slip.contains("the equations have a value only where x_dot != 0\n"), "{slip}");
    let smooth = told("m*der(x) - a*z/sqrt(1 + z^2)");
    assert!(!smooth.contains("have a value only where"), "{smooth}");
}

/// What cancels in an output is not stored for its sake.
#[test]
fn the_speed_of_a_point_does_not_keep_the_heading() {
    let tracked = |output: &str| {
        let sections = "base { x, y, yaw } basis { u, s, w }
            anchor { der(x) = u*cos(yaw) - s*sin(yaw); der(y) = u*sin(yaw) + s*cos(yaw); der(yaw) = w; }
            let p = [x, y];
            lagrangian { m/2*(u^2 + s^2) + a/2*w^2 + m*a*w*s } constraints { blade: s = 0; }";
        let report = report(&format!("{sections} outputs {{ speed = {output}; }} track {{ speed }}"), FIELDS);
        let lines: Vec<&str> = report.lines().skip_while(|line| *line != "Tracked variables").collect();
        lines[1].trim().to_owned()
    };
    for output in ["norm(der(p))", "dot(der(p), der(p))", "cos(yaw)*der(x) + sin(yaw)*der(y)"] {
        assert_eq!(tracked(output), "u, w", "{output}");
    }
    assert_eq!(tracked("der(x)"), "yaw, u, w");
}

/// Where nothing can be, no rank drops and no velocities break down.
#[test]
fn places_that_cannot_be_are_not_told() {
    let told = |sections: &str| {
        let report = report(sections, "m: f64, R: f64, W: f64, l: f64, r: f64");
        let lines =
            report.lines().filter(|line| line.contains("dependent where") || line.contains("break down"));
        lines.map(|line| line.trim().to_owned()).collect::<Vec<_>>()
    };
    let hoop = "base { x, y, z } lagrangian { m*(der(x)^2 + der(y)^2 + der(z)^2) } assume { R > 0; }
        holonomic { ball: x^2 + y^2 + z^2 = R^2; plane:";
    assert_eq!(told(&format!("{hoop} x*sin(W) - y*cos(W) = 0; }}")), [""; 0]);
    assert_eq!(told(&format!("{hoop} x*sin(W*t) - y*cos(W*t) = 0; }}")), [""; 0]);
    let [edge] = told(&format!("{hoop} x^2 + y^2 = R*x; }}")).try_into().expect("Viviani's curve");
    assert!(edge.contains("they are dependent where y = 0 and z = 0"), "{edge}");
    let crank = "base { a, s } lagrangian { m*(der(a)^2 + der(s)^2) } independent { der(a) }
        holonomic { rod: (s - r*cos(a))^2 + (r*sin(a))^2 = l^2; }";
    assert_eq!(told(&format!("{crank} assume {{ r > 0; l > r; }}")), [""; 0]);
    let [short] = told(&format!("{crank} assume {{ l > 0; l < r; }}")).try_into().expect("dead centres");
    assert!(short.contains("they break down where s - r*cos(a) = 0"), "{short}");
}

/// A slip that is no error is seen: an input that acts nowhere, and a kinetic energy of the wrong sign.
#[test]
fn what_may_be_a_slip_is_told() {
    let told = |sections: &str| report(&format!("base {{ x, y }} {sections}"), FIELDS);
    let wrong = told(
        "lagrangian { a*x - m/2*der(x)^2 - a/2*der(y)^2 } inputs { push, pull[2] } forces { x: pull[0]; } assume { m > 0; }",
    );
    assert!(wrong.contains("Unused inputs\n  push stands in no expression\n"), "{wrong}");
    assert!(
        wrong.contains(
            "  negative everywhere: (x_dot, x_dot); L is the kinetic energy less the potential energy\n"
        ),
        "{wrong}"
    );
    let right = told(
        "lagrangian { m/2*der(x)^2 + a/2*der(y)^2 - x } inputs { push } forces { x: push; } assume { m > 0; }",
    );
    assert!(!right.contains("Unused inputs") && !right.contains("negative everywhere"), "{right}");
}

/// The drag of a velocity in a plane has a value and slopes at rest; what has no slope, and what power series divide by,
/// is told.
#[test]
fn roots_are_told_where_derivatives_are_asked_for() {
    let told = |forces: &str, emit: &str| {
        let plane = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) }";
        let report = report(&format!("{plane} forces {{ {forces} }} {emit}"), FIELDS);
        let lines = report.lines().filter_map(|line| line.split_once("may have no value unless "));
        lines.map(|(_, condition)| condition.to_owned()).collect::<Vec<_>>()
    };
    let drag = "x: -a*sqrt(der(x)^2 + der(y)^2)*der(x);";
    for emit in ["emit { jacobian }", "emit { adjoint_product }", ""] {
        assert!(told(drag, emit).is_empty(), "{emit}");
    }
    let rest = ["x_dot^2 + y_dot^2 > 0"];
    for forces in [
        "x: -a*sqrt(der(x)^2 + der(y)^2);",
        "x: -a*sqrt(der(x)^2 + der(y)^2)*(der(x) + x);",
        "x: -a*sqrt(der(x)^2 + der(y)^2)*der(x); y: a*sqrt(der(x)^2 + der(y)^2);",
    ] {
        assert_eq!(told(forces, "emit { jacobian }"), rest, "{forces}");
    }
    for emit in ["emit { taylor }", "emit { jacobian, taylor }"] {
        assert_eq!(told(drag, emit), rest, "{emit}");
    }
    // it ends where the root does
    assert_eq!(told("x: sqrt(x)*x;", "emit { jacobian }"), [""; 0]);
    assert_eq!(told("x: sqrt(x)*y;", "emit { jacobian }"), ["x > 0"]);
    assert_eq!(told("x: sqrt(x^2 + a*y^2)*y;", "emit { jacobian }"), ["x^2 + a*y^2 > 0"]);
    assert!(told("x: -a*sqrt(der(x)^2 + 1)*der(x);", "emit { jacobian }").is_empty());
    // its value is enough for the derivative to have one
    assert!(told("x: a/sqrt(x^2 + y^2);", "emit { jacobian }").is_empty());
    assert_eq!(told("x: asin(y);", "emit { jacobian }"), ["|y| < 1"]);
}

/// What no chart of the constraint manifold reaches may be a part of it: where x = y = 0, u v - z w may be anything, and
/// where charts divide by x and y it is 0.
#[test]
fn places_on_parts_that_no_chart_reaches_are_told() {
    let report = report(
        "base { x, y, u, v, w, z, q } lagrangian { m*(der(x)^2 + der(y)^2 + der(u)^2 + der(v)^2 + der(w)^2 + der(z)^2) \
         + m*(u*v - z*w + 1)^2*der(q)^2 } holonomic { first: x*u = y*z; second: y*v = x*w; } assume { m > 0; }",
        FIELDS,
    );
    assert!(report.contains("the equations are singular where u*v - z*w + 1 = 0"), "{report}");
}

/// Where forces with roots have slopes at rest, so have the programs of all Jacobians, whatever form the equations have;
/// those for which that is not proved are told.
#[test]
fn jacobians_go_on_where_forces_do() {
    let plane = "base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 }";
    let air = "x: -c*norm([der(x), der(y)])*der(x); y: -c*norm([der(x), der(y)])*der(y);";
    let turn = "th: -d*sqrt(der(th)^2)*der(th);";
    let blade = "constraints { der(y)*cos(th) = der(x)*sin(th) + l*der(th); }";
    let arm =
        "base { a, b } let p = l*[cos(a) + cos(a + b), sin(a) + sin(a + b)]; let q = l*[cos(a), sin(a)];
        lagrangian { m/2*dot(der(p), der(p)) + m/2*dot(der(q), der(q)) + m*l*p[1] }";
    let tip = "a: -c*norm(der(p))*dot(der(p), diff(p, a)); b: -c*norm(der(p))*dot(der(p), diff(p, b));";
    let body = "basis { v[3], w[3] } brackets se(3) { v, w } lagrangian { m/2*dot(v, v) + J/2*(w[0]^2 + w[1]^2 + 2*w[2]^2) }";
    let fluid = "v: -c*norm(v)*v; w: -d*norm(w)*w;";
    let sleigh = "base { x, y, th } basis { u, v, w } anchor { der(x) = u*cos(th) - v*sin(th); \
        der(y) = u*sin(th) + v*cos(th); der(th) = w; } lagrangian { m/2*(u^2 + v^2) + J/2*w^2 } constraints { v = l*w; }";
    let water = "u: -c*sqrt(u^2 + (v + l*w)^2)*u; w: -c*l*sqrt(u^2 + (v + l*w)^2)*(v + l*w);";
    let machines = [
        format!("{plane} forces {{ {air} {turn} }}"),
        format!("{plane} {blade} forces {{ {air} {turn} }}"),
        format!("{plane} {blade} independent {{ der(x), der(y) }} forces {{ {air} {turn} }}"),
        format!("{body} forces {{ {fluid} }}"),
        format!("{sleigh} forces {{ {water} }}"),
        format!("{plane} auxiliary {{ der(heat) = c*norm([der(x), der(y)])^3 - heat; }} forces {{ {air} }}"),
    ];
    let told = |machine: &str, level: &str| {
        let products =
            if level == "balanced" { ", sparse_jacobian, jacobian_product, adjoint_product" } else { "" };
        let text = format!(
            "#[nonholonomic({machine} assume {{ m > 0; J > 0; l > 0; }} accuracy {{ {level} }} emit {{ jacobian{products} }})] \
             struct Machine {{ m: f64, J: f64, l: f64, c: f64, d: f64 }}"
        );
        let declaration = &declarations(&text)[0];
        let system = declaration.system().unwrap_or_else(|errors| panic!("{errors:?} {machine}"));
        assert!(system.derivatives_go_on, "{} {machine}", system.report);
        let emitted = declaration.expanded().to_string();
        let told =
            emitted.split_once("Derivatives that may have no value where a root in the forces vanishes\\n  ");
        told.map_or(String::new(), |(_, told)| told.split("\\n").next().unwrap_or(told).to_owned())
    };
    for level in ["fast", "balanced", "careful"] {
        for machine in &machines {
            assert_eq!(told(machine, level), "", "{level}: {machine}");
        }
    }
    // what the equations divide by themselves has no limit, whatever holds of other roots
    let both = "x: a*x*y/sqrt(x^2 + y^2) - a*sqrt(der(x)^2 + der(y)^2)*der(x);";
    let text = format!(
        "#[nonholonomic(base {{ x, y }} lagrangian {{ der(x)^2 + der(y)^2 }} forces {{ {both} }} emit {{ jacobian }})] \
         struct Machine {{ a: f64 }}"
    );
    let system = declarations(&text)[0].system().expect("it is right");
    assert!(
        !system.derivatives_go_on && system.report.contains("unless x_dot^2 + y_dot^2 > 0"),
        "{}",
        system.report
    );
    // multiplied out, the derivative of the root no longer shows that it vanishes with it
    assert_eq!(
        told(&format!("{arm} forces {{ {tip} }}"), "balanced"),
        "linearized, jacobian, sparse_jacobian, sparse_linearized"
    );
}

//! What reports say is true in every frame and at every point, or says where it is.

use nh_stages::declarations;

/// The report of a declaration, given by the sections of the attribute and the fields.
fn report(sections: &str, fields: &str) -> String {
    let source = format!("#[nonholonomic({sections})] struct S {{ {fields} }}");
    let found = declarations(&source);
    match found[0].system() {
        Ok(system) => system.report,
        Err(errors) => panic!("{sections}\n{}", errors.join("\n")),
    }
}

/// Each declaration with what its report has to say, and what it must not.
fn check(cases: &[(&str, &str, &[&str], &[&str])]) {
    for (sections, fields, said, unsaid) in cases {
        let report = report(sections, fields);
        for line in *said {
            assert!(report.contains(line), "{sections}\nmissing: {line}\n{report}");
        }
        for line in *unsaid {
            assert!(!report.contains(line), "{sections}\nuntrue: {line}\n{report}");
        }
    }
}

/// so(3) acting on the sphere: its sections are those of another frame in the second declaration.
#[test]
fn the_kind_of_algebroid_does_not_depend_on_the_frame() {
    let top = "base { g[3] } on { dot(g, g) = 1; } basis { w[3] } anchor { der(g) = cross(g, w); }
        brackets so(3) { w } lagrangian { (w[0]^2 + w[1]^2 + 2 * w[2]^2) / 2 - g[2] }";
    let turned = format!("{top} frame {{ a = (2 + g[0]) * w[0]; }}");
    let kind = "algebroid: a transitive action Lie algebroid with isotropy of rank 1, rank 3 over a base of \
                dimension 2, embedded in 3 coordinates";
    check(&[(top, "", &[kind], &[]), (&turned, "", &[kind], &[])]);
}

/// A basis in which the rank would drop at the origin, which is not on the sphere; and a speed that is not 0.
#[test]
fn no_rank_is_said_to_drop_where_nothing_is() {
    check(&[
        (
            "base { g[3] } on { dot(g, g) = 1; } basis { a, b, c } anchor { der(g) = cross(g, [a + b, b, c]); }
             brackets { [a, b] = c; [a, c] = a - b; [b, c] = 2 * a - b; } lagrangian { (a^2 + b^2 + c^2) / 2 }",
            "",
            &["a transitive action Lie algebroid with isotropy of rank 1, rank 3"],
            &["but not where"],
        ),
        (
            "base { x, y } lagrangian { (der(x)^2 + der(y)^2) / 2 } assume { c > 0; }
             constraints { der(x)^2 + 2 * der(y)^2 - der(x) * der(y) = c^2; }",
            "c: f64",
            &["1, nonlinear in the velocities"],
            &["dependent where"],
        ),
        (
            "base { x, y, z } holonomic { x^2 + y^2 = 1; } constraints { x * der(z) = 2 * der(x) - y * der(z); }
             lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 }",
            "",
            &[],
            &["where y = 0 and x = 0", "where x = 0 and y = 0"],
        ),
    ]);
}

/// With a drift it is the bracket with the drift that leaves D: D itself, along x and th, is closed. So is D at every
/// instant where its rows have coefficients of the time alone.
#[test]
fn what_is_not_closed_is_named() {
    let lagrangian = "base { x, y, th } lagrangian { (der(x)^2 + der(y)^2 + der(th)^2) / 2 }";
    let declared = |constraint: &str| format!("{lagrangian} constraints {{ {constraint}; }}");
    check(&[
        (
            &declared("der(y) = v * sin(th)"),
            "v: f64",
            &["D with the drift is not closed under the bracket (nonholonomic)"],
            &["; D is not closed"],
        ),
        (
            &declared("der(y) = v * sin(t) * der(x)"),
            "v: f64",
            &["; D, as it changes with the time, is not closed under the bracket (nonholonomic)"],
            &["; D is not closed"],
        ),
        (&declared("der(y) = th * der(x)"), "", &["; D is not closed under the bracket (nonholonomic)"], &[]),
    ]);
}

#[test]
fn an_anchor_that_drops_rank_says_where() {
    check(&[
        (
            "base { x } basis { a, b } anchor { der(x) = x * a; } brackets { } lagrangian { (a^2 + b^2) / 2 }",
            "",
            &["a transitive action Lie algebroid with isotropy of rank 1, but not where x = 0"],
            &["Atiyah"],
        ),
        (
            "base { x } basis { w[3] } anchor { der(x) = 0 * w[0]; } brackets so(3) { w }
             lagrangian { dot(w, w) / 2 - x }",
            "",
            &["a bundle of Lie algebras: the anchor is 0"],
            &["action"],
        ),
        (
            "base { a[3] } basis { w[3] } anchor { der(a) = cross(a, w); } brackets so(3) { w }
             lagrangian { dot(w, w) / 2 - a[2] }",
            "",
            &["orbits of dimension 2, but not where"],
            &["transitive"],
        ),
        (
            // a wrong sign in the frame of a body on the plane
            "base { x, y, theta } basis { u, v, omega }
             anchor { der(theta) = omega; der(x) = v * cos(theta) - u * sin(theta); der(y) = v * sin(theta) - u * cos(theta); }
             lagrangian { (u^2 + v^2 + omega^2) / 2 }",
            "",
            &["the tangent bundle TM in an anholonomic frame, which is singular where cos(theta)^2 - sin(theta)^2 = 0"],
            &[],
        ),
        (
            "base { x, y, theta } basis { u, v, omega }
             anchor { der(theta) = omega; der(x) = v * cos(theta) - u * sin(theta); der(y) = v * sin(theta) + u * cos(theta); }
             lagrangian { (u^2 + v^2 + omega^2) / 2 }",
            "",
            &["the tangent bundle TM in an anholonomic frame, rank 3"],
            &["singular", "but not where"],
        ),
    ]);
}

#[test]
fn constraints_say_where_they_are_dependent_in_every_formulation() {
    let plane = "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 }";
    check(&[
        (
            &format!("{plane} constraints {{ x * der(x) + y * der(y) = 0; }}"),
            "",
            &["formulation: projected", "they are dependent where x = 0 and y = 0"],
            &[],
        ),
        (
            &format!(
                "{plane} constraints {{ x * der(x) + y * der(y) = 0; }} independent {{ der(x), der(z) }}"
            ),
            "",
            &["formulation: adapted", "they are dependent where x = 0 and y = 0"],
            &[],
        ),
        (
            &format!("{plane} constraints {{ der(x)^2 + der(y)^2 = der(z)^2; }}"),
            "",
            &["they are dependent where x_dot = 0 and y_dot = 0 and z_dot = 0"],
            &[],
        ),
        (
            &format!("{plane} constraints {{ der(x)^2 + der(y)^2 = 1 + der(z)^2; }}"),
            "",
            &["constraints: 1, nonlinear in the velocities"],
            &["they are dependent"],
        ),
        (
            // two branches: der(x) = 0 and der(y) = 0
            &format!("{plane} constraints {{ der(x) * der(y) = 0; }}"),
            "",
            &["they are dependent where y_dot = 0 and x_dot = 0"],
            &[],
        ),
        (
            &format!("{plane} constraints {{ der(x) = y * der(z); }}"),
            "",
            &["constraints: 1, linear"],
            &["they are dependent"],
        ),
    ]);
}

#[test]
fn a_pivot_of_parameters_is_named_where_the_choice_is() {
    check(&[(
        "basis { w[3] } brackets so(3) { w } lagrangian { dot(w, w) / 2 } constraints { dot(Ga, w) = 0; }",
        "Ga: [f64; 3]",
        &["`w[2]` can be eliminated where Ga[2] != 0, which `validate` checks", "Ga[2] != 0\n"],
        &["wherever the constraints are independent"],
    )]);
}

/// Velocities that could be named, where the state keeps all of them unasked; where they do, and what for.
#[test]
fn velocities_to_name_are_suggested_where_all_are_kept() {
    let skate = "base { x, y, theta } lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
        constraints { sin(theta) * der(x) = cos(theta) * der(y); }";
    let hoop = "base { x, y, z } lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
        holonomic { plane: sin(W * t) * x = cos(W * t) * y; hoop: x^2 + y^2 + z^2 = r^2; }";
    let wire =
        "base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y } holonomic { y = a * x^2; }";
    let trailer = "base { x, y, theta, phi }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 + I / 2 * der(phi)^2 }
        constraints {
            sin(theta) * der(x) = cos(theta) * der(y);
            d * der(phi) + cos(phi) * der(y) = sin(phi) * der(x);
        }";
    let one = "with 1 acceleration to solve for in place of";
    check(&[
        (
            skate,
            "m: f64, J: f64",
            &[
                "`independent { der(x), der(theta) }` would keep 2 velocities in the state, with 2 accelerations to solve \
               for in place of 3 accelerations and 1 multiplier; it is valid where cos(theta) != 0\n",
            ],
            &["it is valid everywhere"],
        ),
        (
            &format!("{skate} track {{ x, der(y) }}"),
            "m: f64, J: f64",
            &["`independent { der(y), der(theta) }` would keep"],
            &[],
        ),
        (&format!("{skate} formulation {{ projected }}"), "m: f64, J: f64", &[], &["would keep"]),
        (&format!("{skate} independent {{ der(x), der(theta) }}"), "m: f64, J: f64", &[], &["would keep"]),
        // x or y would break down at times that no motion avoids
        (
            hoop,
            "m: f64, g: f64, W: f64, r: f64",
            &["`independent { der(z) }` would keep 1 velocity", one],
            &[],
        ),
        (
            wire,
            "m: f64, g: f64, a: f64",
            &[
                "`independent { der(x) }` would keep 1 velocity",
                "2 accelerations and 1 multiplier; it is valid everywhere\n",
            ],
            &[],
        ),
        (
            trailer,
            "m: f64, J: f64, I: f64, d: f64",
            &[
                "`independent { der(x), der(theta) }`",
                "it is valid where cos(theta) != 0, for parameters with d != 0\n",
            ],
            &[],
        ),
        // nothing is known of where a pivot would have to be other than 0
        (
            "base { a, b } holonomic { sin(a) + b^5 * sin(b) + b = 0; } lagrangian { (der(a)^2 + der(b)^2) / 2 }",
            "",
            &["no points were found where"],
            &["would keep"],
        ),
    ]);
}

#[test]
fn powers_of_velocities_say_where_they_break_down() {
    check(&[
        (
            "basis { omega } lagrangian { J / 2 * omega^2.5 }",
            "J: f64",
            &["the mass matrix is singular where omega = 0", "only where omega >= 0"],
            &[],
        ),
        ("basis { omega } lagrangian { J / 2 * omega^1.5 }", "J: f64", &["only where omega > 0"], &[]),
        ("base { x } lagrangian { 1 - sqrt(1 - der(x)^2) }", "", &["only where -x_dot^2 + 1 > 0"], &[]),
        ("base { x } lagrangian { der(x)^2 / 2 - asin(x) }", "", &["only where |x| < 1"], &["|x| <= 1"]),
        ("base { x } lagrangian { der(x)^2 / 2 + der(x)^4 }", "", &[], &["singular", "only where"]),
    ]);
}

#[test]
fn a_mass_matrix_that_may_be_singular_says_for_whom() {
    let snake =
        "base { x, y } lagrangian { (2 + a * cos(x)) * der(x)^2 + der(y)^2 + sin(y) * der(x) * der(y) }";
    check(&[
        (snake, "a: f64", &["for some parameters the mass matrix is singular where"], &[]),
        // positive definite for every machine, though no single term says so
        (
            "base { x, q } lagrangian { m / 2 * (der(x)^2 + 2 * l * cos(q) * der(x) * der(q) + l^2 * der(q)^2) + J / 2 * der(q)^2 }",
            "m: f64, l: f64, J: f64",
            &[],
            &["singular"],
        ),
    ]);
}

#[test]
fn names_of_the_report_are_not_those_of_the_user() {
    let report = report(
        "base { h, p_x, lambda_1, x } lagrangian { m / 2 * (der(h)^2 + der(p_x)^2 + der(lambda_1)^2 + der(x)^2) - h }
         constraints { sin(h) * der(p_x) = cos(h) * der(lambda_1); }",
        "m: f64",
    );
    assert!(report.contains("*lambda_1_"), "{report}");
    let report = self::report(
        "base { h, x } lagrangian { m / 2 * (der(h)^2 + p_x_dot * der(x)^2) - h } emit { hamiltonian }",
        "m: f64, p_x_dot: f64",
    );
    assert!(report.contains("\n  h_ = ") && report.contains("\n  p_x_dot_ = "), "{report}");
}

#[test]
fn assumptions_that_were_not_decided_are_said_to_be() {
    let particle = "base { x } lagrangian { (a^2 + b^2 + 1) / 2 * der(x)^2 }";
    let doubt = "whether the assumptions can hold together was not decided";
    let with = |assumptions: &str| format!("{particle} assume {{ {assumptions} }}");
    check(&[
        (&with("sin(a) > 0.9999999999; cos(b) > 0.9999999999;"), "a: f64, b: f64", &[doubt], &[]),
        (&with("a > 1; b > 1; a * b < 4;"), "a: f64, b: f64", &[], &[doubt]),
        (&with("a >= 1; a <= 1; b != 0;"), "a: f64, b: f64", &[], &[doubt]),
        (&with("a > 1000; b < -1e-3;"), "a: f64, b: f64", &[], &[doubt]),
        (particle, "a: f64, b: f64", &[], &[doubt]),
    ]);
}

#[test]
fn equations_that_nothing_is_known_to_satisfy_are_said_to_be() {
    let particle = |rest: &str| {
        format!("base {{ x, y, z }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }} {rest}")
    };
    let doubt = "was not decided: none were found, and no contradiction";
    let of_velocities = format!(
        "whether real positions and velocities satisfy the constraints, for parameters as they \
                                 are assumed, {doubt}"
    );
    let of_positions = format!("whether real positions satisfy the position constraints {doubt}");
    let speed = |bound: &str| {
        particle(&format!(
            "constraints {{ der(x)^2 + der(y)^2 = 2 * e / m; }} assume {{ e > 0; m > 0; {bound} }}"
        ))
    };
    let near = particle("holonomic { a: sin(x) * y + sin(y) * x + 0.01 = exp(-x^2 - y^2) * 0.01; }");
    let far = particle("holonomic { a: x^6 + y^6 + 11 / 10 = 3 * x^2 * y^2; }");
    let along = "constraints { der(x)^2 + der(y)^2 = 2 * e / m; b: der(x) = d; } assume { e > 0; m > 0; ";
    check(&[
        (
            &particle(&format!("{along} d > sqrt(2 * e / m); }}")),
            "m: f64, e: f64, d: f64",
            &[&of_velocities],
            &[],
        ),
        (&particle(&format!("{along} d > 0; }}")), "m: f64, e: f64, d: f64", &[], &[doubt]),
        (&speed(""), "m: f64, e: f64", &[], &[doubt]),
        (&near, "m: f64", &[], &[doubt]),
        (&far, "m: f64", &[&of_positions], &[]),
    ]);
}

/// What holds everywhere is no condition, whatever it is written like.
#[test]
fn conditions_that_always_hold_are_not_said() {
    let fields = "m: f64";
    let machine = |rest: &str| format!("base {{ x, y }} lagrangian {{ m/2*(der(x)^2 + der(y)^2) - {rest} }}");
    let only: &[&str] = &["have a value only where"];
    for always in [
        "x*ln(cosh(x)^2 - sinh(x)^2)",
        "ln((1 + tanh(x))/(1 - tanh(x)))",
        "ln(sqrt(1 + x^2) - x)",
        "1/(sqrt(1 + x^2) - x)",
        "asin(tanh(x))",
        "sqrt(x^2 - x*y + y^2 + 1)",
    ] {
        check(&[(&machine(always), fields, &[], only)]);
    }
    for somewhere in ["asin(x)", "sqrt(y - 1)", "ln(1 - x^2)", "1/(exp(x) - 2)", "ln(tanh(x))"] {
        check(&[(&machine(somewhere), fields, only, &[])]);
    }
    for mass in ["tanh(x) + 1", "sqrt(1 + x^2) - x", "exp(x) - x", "2 - sin(x) - cos(x)"] {
        let machine = format!("base {{ x, y }} lagrangian {{ m/2*({mass})*(der(x)^2 + der(y)^2) }}");
        check(&[(&machine, fields, &[], &["singular where"])]);
    }
    for mass in ["tanh(x) + 1/2", "sqrt(1 + x^2) - 2*x", "exp(x) - 3*x", "1 - sin(x) - cos(x)"] {
        let machine = format!("base {{ x, y }} lagrangian {{ m/2*({mass})*(der(x)^2 + der(y)^2) }}");
        check(&[(&machine, fields, &["mass matrix is singular where"], &[])]);
    }
}

#[test]
fn angles_say_where_they_are_none() {
    let particle =
        |of: &str| format!("base {{ x, y }} lagrangian {{ m / 2 * (der(x)^2 + der(y)^2) - k * {of} }}");
    let nowhere = "the equations have a value only where not both y = 0 and x = 0";
    check(&[
        (&particle("atan2(y, x)^2"), "m: f64, k: f64", &[nowhere], &[]),
        (&particle("atan2(sin(y), cos(y))^2 * x"), "m: f64, k: f64", &[], &["only where"]),
        (&particle("atan2(y, 1 + x^2)"), "m: f64, k: f64", &[], &["only where"]),
    ]);
}

/// A splitting whose quantities would fill pages is classified, and its quantities are left out in so many words.
#[test]
fn quantities_of_a_splitting_are_shown_as_long_as_they_are_short() {
    let too_long = "Splitting of D\n  not shown: the quantities of this splitting are too long";
    let (_, arm) =
        nh_stages::arms().into_iter().find(|(name, _)| name == "arm on a skate, 2 links").expect("an arm");
    let long = arm.system().expect("regular").report;
    assert!(long.contains(too_long) && long.contains("Lagrange–d'Alembert–Poincaré"), "{long}");
    let (_, snakeboard) =
        nh_stages::record().into_iter().find(|(name, _)| name == "snakeboard").expect("a board");
    let short = snakeboard.system().expect("regular").report;
    assert!(short.contains("horizontal lift") && !short.contains(too_long), "{short}");
}

/// No zeros are told of what has none, and no choice of velocities is passed over for them.
#[test]
fn no_zeros_are_told_of_what_has_none() {
    let space = "base { x, y, z } lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }";
    let adapted = "can be eliminated wherever the constraints are independent";
    for (constraints, said, unsaid) in [
        ("constraints { (x^2 - 4 * x + 5) * der(z) = x * der(y); }", adapted, "dependent where"),
        (
            "constraints { (x^4 - x + 5) * der(z) = x * der(y); der(x) = y * der(z); }",
            adapted,
            "dependent where",
        ),
        (
            "constraints { (x - sin(x) - 8) * der(z) = x * der(y); }",
            "divides by x - sin(x) - 8",
            "dependent where",
        ),
        ("holonomic { sin(x) + cos(y) = 1 / 2; }", "D is closed", "dependent where"),
        (
            "holonomic { sin(x) + cos(y) = 2 * a; } assume { a > 0; a < 1 / 2; }",
            "D is closed",
            "dependent where",
        ),
        ("holonomic { sin(x) + cos(y) = 2 * a; }", "dependent where cos(x) = 0 and sin(y) = 0", "undecided"),
    ] {
        let sections = format!("{space} {constraints}");
        check(&[(&sections, "m: f64, a: f64", &[said], &[unsaid])]);
    }
    check(&[(
        "base { x, y } velocities { u = (x^2 - 2 * x + 2) * der(x); v = x * (exp(x) - x) * der(y); }
         lagrangian { (u^2 + v^2) / 2 }",
        "",
        &["a chart only where x != 0"],
        &["2*x + 2 != 0", "exp(x) - x != 0"],
    )]);
}

/// A translation that leaves the rates of position constraints as they are, and not the positions, is none of the machine.
#[test]
fn what_position_constraints_tie_is_not_cyclic() {
    check(&[
        (
            "base { x, y, theta } holonomic { pin: [x, y] - l * [sin(theta), -cos(theta)] = 0; }
             lagrangian { kinetic(m, J, [x, y], theta) - m * g * y }",
            "m: f64, J: f64, l: f64, g: f64",
            &["position constraints: 2"],
            &["cyclic", "translations along"],
        ),
        (
            "base { sun, carrier, ring, planet, z } holonomic {
                 outer: rs * sun + rp * planet = (rs + rp) * carrier;
                 inner: (rs + 2 * rp) * ring - rp * planet = (rs + rp) * carrier;
             }
             lagrangian { J / 2 * (der(sun)^2 + der(carrier)^2 + der(ring)^2 + der(planet)^2 + der(z)^2) }",
            "J: f64, rs: f64, rp: f64",
            &["cyclic coordinates, each left to a quadrature: z; horizontal symmetries: z"],
            &["quadrature: sun", "momentum equations of rank 2"],
        ),
    ]);
}

/// Where accelerations and multipliers are not determined though the constraints are independent there; and nowhere else.
#[test]
fn projected_equations_say_where_they_are_singular() {
    let on_circle = |lagrangian: &str, curve: &str| {
        format!("base {{ x, y }} lagrangian {{ {lagrangian} }} holonomic {{ {curve}; }}")
    };
    let weighted = on_circle("(x^2*der(x)^2 + der(y)^2)/2", "x^2 + y^2 = 1");
    let far = on_circle("((x - 2)^2*der(x)^2 + der(y)^2)/2", "x^2 + y^2 = 1");
    let null = on_circle("(der(x)^2 - der(y)^2)/2", "x^2 + y^2 = 1");
    let spacelike = on_circle("(der(x)^2 - der(y)^2)/2", "x^2 - y^2 = 1");
    let usual = on_circle("m*(der(x)^2 + der(y)^2)/2", "x^2 + y^2 = 1");
    let blade = "base { x, y, th } lagrangian { (x*der(x)^2 + x*der(y)^2 + der(th)^2)/2 }
        constraints { cos(th)*der(y) = sin(th)*der(x); }";
    let crane = "base { x, y, z } lagrangian { (trolley + bridge*cos(x) + hoist*cos(y))/2*der(x)^2 + hoist*sin(y)*der(y)*der(z)
        + (trolley*sin(x) + bridge*sin(y) + hoist*cos(x)*sin(y))*der(x)*der(y) + (trolley + bridge*sin(x)*cos(z))/2*der(z)^2
        + (trolley + bridge*cos(2*x) + hoist*sin(3*y))/2*der(y)^2 + (bridge*sin(z) + hoist*cos(y))*der(x)*der(z) }";
    let too_long = "the mass matrix is singular in some states; the condition is too long to be shown\n";
    check(&[
        (crane, "trolley: f64, bridge: f64, hoist: f64", &[too_long], &["determinant"]),
        (&weighted, "", &["the equations are singular where x = 0\n"], &[]),
        (&null, "", &["the equations are singular where 4*y^2 - 4*x^2 = 0\n"], &[]),
        (blade, "", &["the equations are singular where x = 0\n"], &[]),
        (&far, "", &[], &["singular"]),
        (&spacelike, "", &[], &["singular"]),
        (&usual, "m: f64", &[], &["singular"]),
    ]);
}

//! A few systems as resolved models, built by hand.

pub(crate) use crate::builder::{Builder, origin};
use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::id::ExprId;
use nonholonomic_core::model::{ConstraintDecl, FrameDecl, Model};

/// The Chaplygin sleigh with its position; CLMM section 6.1.
pub(crate) fn sleigh() -> Model {
    let mut b = Builder::new(&["m", "J", "a", "b"], &["theta", "x", "y"], &["omega", "v1", "v2"]);
    b.anchor(&[
        &[(1, 1, "omega")],
        &[(1, 1, "v1*cos(theta)"), (-1, 1, "v2*sin(theta)")],
        &[(1, 1, "v1*sin(theta)"), (1, 1, "v2*cos(theta)")],
    ]);
    b.lagrangian(&[
        (1, 2, "J*omega*omega"),
        (1, 2, "m*a*a*omega*omega"),
        (1, 2, "m*b*b*omega*omega"),
        (1, 2, "m*v1*v1"),
        (1, 2, "m*v2*v2"),
        (-1, 1, "m*b*omega*v1"),
        (1, 1, "m*a*omega*v2"),
    ]);
    b.constraint(&[(1, 1, "v2")]);
    b.model
}

/// The same on TQ in the coordinates of the plane: no pivot is valid everywhere.
pub(crate) fn sleigh_on_the_plane() -> Model {
    let mut b = Builder::new(&["m", "J", "a", "b"], &["theta", "x", "y"], &[]);
    b.lagrangian(&[
        (1, 2, "J*theta_dot*theta_dot"),
        (1, 2, "m*a*a*theta_dot*theta_dot"),
        (1, 2, "m*b*b*theta_dot*theta_dot"),
        (1, 2, "m*x_dot*x_dot"),
        (1, 2, "m*y_dot*y_dot"),
        (-1, 1, "m*b*theta_dot*x_dot*cos(theta)"),
        (-1, 1, "m*b*theta_dot*y_dot*sin(theta)"),
        (1, 1, "m*a*theta_dot*y_dot*cos(theta)"),
        (-1, 1, "m*a*theta_dot*x_dot*sin(theta)"),
    ]);
    b.constraint(&[(1, 1, "y_dot*cos(theta)"), (-1, 1, "x_dot*sin(theta)")]);
    b.model
}

/// A car that is driven and steered at its front wheels.
pub(crate) fn car() -> Model {
    let velocities = ["v", "side", "omega", "turn"];
    let mut b = Builder::new(&["m", "J", "Js", "a", "L"], &["x", "y", "th", "delta"], &velocities);
    b.anchor(&[
        &[(1, 1, "v*cos(th)"), (-1, 1, "side*sin(th)")],
        &[(1, 1, "v*sin(th)"), (1, 1, "side*cos(th)")],
        &[(1, 1, "omega")],
        &[(1, 1, "turn")],
    ]);
    b.lagrangian(&[
        (1, 2, "m*v*v"),
        (1, 2, "m*side*side"),
        (1, 1, "m*a*side*omega"),
        (1, 2, "m*a*a*omega*omega"),
        (1, 2, "J*omega*omega"),
        (1, 2, "Js*omega*omega"),
        (1, 1, "Js*omega*turn"),
        (1, 2, "Js*turn*turn"),
    ]);
    b.constraint(&[(1, 1, "side")]);
    b.constraint(&[(1, 1, "side*cos(delta)"), (1, 1, "L*omega*cos(delta)"), (-1, 1, "v*sin(delta)")]);
    let mut model = b.model;
    let kept = [0, 3].map(|index| model.sections[nonholonomic_core::id::Id::from_index(index)].symbol);
    model.independent = Some(kept.map(|symbol| (symbol, origin())).to_vec());
    model
}

/// The two-wheeled robot on TQ; CLMM section 6.4.
pub(crate) fn robot() -> Model {
    let parameters = ["m0", "m1", "l", "J", "J2", "c", "R"];
    let mut b = Builder::new(&parameters, &["x", "y", "theta", "psi1", "psi2"], &[]);
    b.lagrangian(&[
        (1, 2, "m1*x_dot*x_dot"),
        (1, 2, "m1*y_dot*y_dot"),
        (1, 1, "m0*l*theta_dot*y_dot*cos(theta)"),
        (-1, 1, "m0*l*theta_dot*x_dot*sin(theta)"),
        (1, 2, "J*theta_dot*theta_dot"),
        (1, 2, "J2*psi1_dot*psi1_dot"),
        (1, 2, "J2*psi2_dot*psi2_dot"),
    ]);
    b.constraint(&[(1, 1, "x_dot*sin(theta)"), (-1, 1, "y_dot*cos(theta)")]);
    for (sign, wheel) in [(1, "R*psi1_dot"), (-1, "R*psi2_dot")] {
        b.constraint(&[
            (1, 1, "x_dot*cos(theta)"),
            (1, 1, "y_dot*sin(theta)"),
            (sign, 1, "c*theta_dot"),
            (1, 1, wheel),
        ]);
    }
    b.model
}

/// The Veselova system without potential, on the action algebroid; CLMM section 6.2.
pub(crate) fn veselova() -> Model {
    let mut b = Builder::new(&["I1", "I2", "I3"], &["g1", "g2", "g3"], &["w1", "w2", "w3"]);
    b.anchor(&[
        &[(1, 1, "g2*w3"), (-1, 1, "g3*w2")],
        &[(1, 1, "g3*w1"), (-1, 1, "g1*w3")],
        &[(1, 1, "g1*w2"), (-1, 1, "g2*w1")],
    ]);
    b.bracket(0, 1, &[(1, 1, "w3")]);
    b.bracket(1, 2, &[(1, 1, "w1")]);
    b.bracket(2, 0, &[(1, 1, "w2")]);
    b.lagrangian(&[(1, 2, "I1*w1*w1"), (1, 2, "I2*w2*w2"), (1, 2, "I3*w3*w3")]);
    b.constraint(&[(1, 1, "g1*w1"), (1, 1, "g2*w2"), (1, 1, "g3*w3")]);
    b.model
}

/// A ball on a table that rotates with angular velocity Omega, on TR² × so(3); CLMM section 7.4.
/// `k2` is the square of the radius of gyration; the angular velocity is spatial.
pub(crate) fn ball_on_rotating_table() -> Model {
    let mut b = Builder::new(&["r", "k2", "Omega"], &["x", "y"], &["dx", "dy", "w1", "w2", "w3"]);
    b.anchor(&[&[(1, 1, "dx")], &[(1, 1, "dy")]]);
    b.bracket(2, 3, &[(-1, 1, "w3")]);
    b.bracket(3, 4, &[(-1, 1, "w1")]);
    b.bracket(4, 2, &[(-1, 1, "w2")]);
    b.lagrangian(&[
        (1, 2, "dx*dx"),
        (1, 2, "dy*dy"),
        (1, 2, "k2*w1*w1"),
        (1, 2, "k2*w2*w2"),
        (1, 2, "k2*w3*w3"),
    ]);
    b.constraint(&[(1, 1, "dx"), (-1, 1, "r*w2"), (1, 1, "Omega*y")]);
    b.constraint(&[(1, 1, "dy"), (1, 1, "r*w1"), (-1, 1, "Omega*x")]);
    b.model
}

/// A particle in the plane that slides along a direction of slope t: ẏ = t ẋ.
pub(crate) fn steered_blade() -> Model {
    let mut b = Builder::new(&["m"], &["x", "y"], &[]);
    b.lagrangian(&[(1, 2, "m*x_dot*x_dot"), (1, 2, "m*y_dot*y_dot")]);
    b.constraint(&[(1, 1, "y_dot"), (-1, 1, "x_dot*t")]);
    b.model
}

/// The snakeboard on its Atiyah algebroid: by its two constraints, or by the sections that span D.
pub(crate) fn snakeboard(spanned: bool) -> Model {
    let sections = ["xi1", "xi2", "xi3", "dpsi", "dphi"];
    let mut b = Builder::new(&["m", "l", "J0", "J1"], &["psi", "phi"], &sections);
    b.anchor(&[&[(1, 1, "dpsi")], &[(1, 1, "dphi")]]);
    // body-frame translations xi1, xi2 and rotation xi3: [xi3, xi1] = xi2, [xi3, xi2] = −xi1
    b.bracket(2, 0, &[(1, 1, "xi2")]);
    b.bracket(2, 1, &[(-1, 1, "xi1")]);
    b.lagrangian(&[
        (1, 2, "m*xi1*xi1"),
        (1, 2, "m*xi2*xi2"),
        (1, 2, "m*l*l*xi3*xi3"),
        (1, 2, "J0*dpsi*dpsi"),
        (1, 1, "J0*dpsi*xi3"),
        (1, 1, "J1*dphi*dphi"),
    ]);
    if spanned {
        // s = −l cosφ ξ₁ + sinφ ξ₃
        let value = b.sum(&[(-1, 1, "l*cos(phi)*xi1"), (1, 1, "sin(phi)*xi3")]);
        let symbol = b.model.graph.new_symbol("s");
        b.model.frame.push(FrameDecl { name: "s".into(), symbol, value, origin: origin() });
        let symbols = [symbol, b.symbol("dpsi"), b.symbol("dphi")];
        b.model.distribution = Some(symbols.map(|symbol| (symbol, origin())).to_vec());
    } else {
        b.constraint(&[(-1, 1, "sin(phi)*xi1"), (1, 1, "cos(phi)*xi2"), (-1, 1, "l*cos(phi)*xi3")]);
        b.constraint(&[(1, 1, "sin(phi)*xi1"), (1, 1, "cos(phi)*xi2"), (1, 1, "l*cos(phi)*xi3")]);
    }
    b.model
}

/// A charged particle in the field of a connection A = b y dx on the plane: on TQ/S¹ with the
/// coordinate sections d1, d2 and the vertical xi, or in the frame h1 = d1 − A xi, h2 = d2.
pub(crate) fn charged_particle(horizontal: bool) -> Model {
    let mut b = Builder::new(&["m", "b"], &["x", "y"], &["d1", "d2", "xi"]);
    b.anchor(&[&[(1, 1, "d1")], &[(1, 1, "d2")]]);
    b.model.brackets_declared = true;
    if horizontal {
        let value = b.sum(&[(1, 1, "d1"), (-1, 1, "b*y*xi")]);
        let symbol = b.model.graph.new_symbol("h1");
        b.model.frame.push(FrameDecl { name: "h1".into(), symbol, value, origin: origin() });
        b.lagrangian(&[(1, 2, "m*h1*h1"), (1, 2, "m*d2*d2"), (1, 2, "xi*xi")]);
    } else {
        // the vertical velocity is xi + b y d1
        b.lagrangian(&[
            (1, 2, "m*d1*d1"),
            (1, 2, "m*d2*d2"),
            (1, 2, "xi*xi"),
            (1, 1, "xi*b*y*d1"),
            (1, 2, "b*b*y*y*d1*d1"),
        ]);
    }
    b.model
}

/// Two points of unit mass in a vertical plane with parallel velocities; gravity on the second.
pub(crate) fn parallel_velocities() -> Model {
    let mut b = Builder::new(&["g"], &["x1", "y1", "x2", "y2"], &[]);
    let squares = ["x1_dot*x1_dot", "y1_dot*y1_dot", "x2_dot*x2_dot", "y2_dot*y2_dot"];
    let mut terms: Vec<(i64, i64, &str)> = squares.iter().map(|square| (1, 2, *square)).collect();
    terms.push((-1, 1, "g*y2"));
    b.lagrangian(&terms);
    b.constraint(&[(1, 1, "x1_dot*y2_dot"), (-1, 1, "x2_dot*y1_dot")]);
    b.model
}

/// A point of unit mass in a vertical plane whose speed is kept at c.
pub(crate) fn constant_speed() -> Model {
    let mut b = Builder::new(&["c", "g"], &["x", "y"], &[]);
    b.lagrangian(&[(1, 2, "x_dot*x_dot"), (1, 2, "y_dot*y_dot"), (-1, 1, "g*y")]);
    b.constraint(&[(1, 1, "x_dot*x_dot"), (1, 1, "y_dot*y_dot"), (-1, 1, "c*c")]);
    b.model
}

/// A form of the velocities that depends on the time: L = (ẋ + t ẏ)²/2 + ẏ²/2.
pub(crate) fn time_dependent_form() -> Model {
    let mut b = Builder::new(&[], &["x", "y"], &[]);
    let form = b.sum(&[(1, 1, "x_dot"), (1, 1, "t*y_dot")]);
    let rest = b.sum(&[(1, 2, "y_dot*y_dot")]);
    let graph = &mut b.model.graph;
    let square = graph.square(form);
    b.model.lagrangian.value =
        graph.linear_combination(&[(Rational::new(1, 2), square), (Rational::ONE, rest)]);
    b.model
}

/// A tractor, by the velocities in its frame, with two trailers; their angles are measured against
/// the tractor (`absolute`: all turn with the plane) or against the one before.
///
/// The first trailer hangs at h behind the axle and carries its load at c before its wheels; the second
/// hangs at its wheels. With a drift, the wheels of the second slip sideways at a constant rate.
pub(crate) fn trailers(relative: bool, drift: bool) -> Model {
    let parameters = ["m", "J", "h", "c", "d", "s"];
    let mut b = Builder::new(&parameters, &["th", "p", "q"], &["w", "v1", "v2", "dp", "dq"]);
    b.anchor(&[&[(1, 1, "w")], &[(1, 1, "dp")], &[(1, 1, "dq")]]);
    b.bracket(0, 1, &[(1, 1, "v2")]);
    b.bracket(0, 2, &[(-1, 1, "v1")]);
    let words: Vec<ExprId> = ["w", "v1", "v2", "dp", "dq", "p", "q", "h", "c", "d", "m", "J", "s"]
        .into_iter()
        .map(|name| b.term(Rational::ONE, name))
        .collect();
    let [w, v1, v2, dp, dq, p, q, h, c, d, m, inertia, slip] = words[..] else { unreachable!() };
    let g = &mut b.model.graph;
    // the trailers' angles against the tractor, and their angular velocities
    let second = if relative { g.formula(p + q) } else { q };
    let turning = if relative { g.formula(dp + dq) } else { dq };
    let (w1, w2) = (g.formula(w + dp), g.formula(w + turning));
    // points at a distance behind: u − i l e^{ia} w
    let behind = |g: &mut Graph, [x, y]: [ExprId; 2], l: ExprId, angle: ExprId, w: ExprId| {
        let (sin, cos) = (g.sin(angle), g.cos(angle));
        let (dx, dy) = (
            g.product(&[l, sin, w].map(|f| (f, Rational::ONE))),
            g.product(&[l, cos, w].map(|f| (f, Rational::ONE))),
        );
        [g.formula(x + dx), g.formula(y - dy)]
    };
    let zero = g.zero();
    let hitch = behind(g, [v1, v2], h, zero, w);
    let first_wheels = behind(g, hitch, d, p, w1);
    let before = g.formula(d - c);
    let load = behind(g, hitch, before, p, w1);
    let wheels = behind(g, first_wheels, d, second, w2);
    let mut terms = Vec::new();
    for [x, y] in [[v1, v2], load, wheels] {
        for u in [x, y] {
            let square = g.square(u);
            terms.push(g.formula(m * square));
        }
    }
    for u in [w, w1, w2] {
        let square = g.square(u);
        terms.push(g.formula(inertia * square));
    }
    let sum = g.sum(&terms);
    b.model.lagrangian.value = g.scale(Rational::new(1, 2), sum);
    let across = |g: &mut Graph, [x, y]: [ExprId; 2], angle: ExprId| {
        let (sin, cos) = (g.sin(angle), g.cos(angle));
        let (sx, cy) = (g.formula(sin * x), g.formula(cos * y));
        g.formula(cy - sx)
    };
    let mut last = across(g, wheels, second);
    if drift {
        last = g.formula(last - slip);
    }
    for residual in [v2, across(g, first_wheels, p), last] {
        b.model.constraints.push(ConstraintDecl {
            label: None,
            residual,
            solved_for: None,
            is_entry: false,
            origin: origin(),
        });
    }
    b.model
}

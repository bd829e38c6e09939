//! What the report calls systems that are in no list: each was classified by hand.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]
#![allow(dead_code, reason = "the reports are looked at")]

use nonholonomic::prelude::*;

/// Declares a system; what is tested is its report.
macro_rules! system {
    ($name:ident { $($fields:tt)* } $($declaration:tt)*) => {
        #[nonholonomic($($declaration)*)]
        #[derive(Clone, Copy, Debug)]
        struct $name { $($fields)* }
    };
}

// D is integrable: z = x y + constant.
system! { Leaves { m: f64 }
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - z }
    constraints { der(z) = y * der(x) + x * der(y); }
}

// Affine and integrable: z = x + t + constant.
system! { Drift { m: f64 }
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints { der(z) = der(x) + 1; }
}

// A frame of commuting fields, and a parameter that nothing depends on.
system! { Commuting { m: f64, k: f64 }
    base { x, y }
    basis { a, b }
    anchor { der(x) = exp(x) * a; der(y) = b; }
    lagrangian { m / 2 * (a^2 + b^2) }
}

// A top by the vertical in the body: so(3) acts on the sphere.
system! { Top { A: f64, C: f64 }
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { (A * (w[0]^2 + w[1]^2) + C * w[2]^2) / 2 - g[2] }
}

// The same by points of a circle: a moving frame of its tangent bundle.
system! { Circle { m: f64 }
    base { c, s }
    on { c^2 + s^2 = 1; }
    basis { w }
    anchor { der(c) = -s * w; der(s) = c * w; }
    lagrangian { m / 2 * w^2 - c }
}

// A rigid body in an ideal fluid.
system! { Kirchhoff { I: [f64; 3], M: [f64; 3] }
    basis { w[3], u[3] }
    brackets se(3) { w, u }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2 + M[i] * u[i]^2) / 2 }
}

// Suslov's body with a mass that slides along it: r̈ and two momentum equations.
system! { Arm { I: [f64; 3], m: f64 }
    base { r }
    basis { v, w[3] }
    anchor { der(r) = v; }
    brackets so(3) { w }
    lagrangian { (I[0] + m * r^2) / 2 * w[0]^2 + I[1] / 2 * w[1]^2 + (I[2] + m * r^2) / 2 * w[2]^2 + m / 2 * v^2 - r^2 }
    constraints { w[2] = 0; }
}

// D lies in the isotropy: the point does not move.
system! { Pinned { m: f64 }
    base { x }
    basis { v, w[3] }
    anchor { der(x) = v; }
    brackets so(3) { w }
    lagrangian { m / 2 * v^2 + (w[0]^2 + 2 * w[1]^2 + 3 * w[2]^2) / 2 }
    constraints { v = 0; w[0] = 0; }
}

// The constraint is on the base, so that D and the isotropy do not span.
system! { Half { m: f64 }
    base { x, y }
    basis { u, v, p, q }
    anchor { der(x) = u; der(y) = v; }
    brackets { [p, q] = q; }
    lagrangian { m / 2 * (u^2 + v^2) + p^2 / 2 + q^2 / 2 }
    constraints { u = y * v; }
}

// Two links on wheels and a flywheel, on the plane: the translations and the flywheel are cyclic.
system! { Links { m: f64, J: f64 }
    base { x, y, th, p1, p2 }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * (der(th)^2 + der(p1)^2 + der(p2)^2) - cos(p1) * m }
    constraints {
        der(x) * sin(th) = der(y) * cos(th);
        der(x) * sin(th + p1) - der(y) * cos(th + p1) = der(th) + der(p1);
    }
}

// A direction that turns: D of each time is a line, which is integrable, D in time and space is not.
system! { Turning { m: f64, W: f64 }
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { cos(W * t) * der(y) = sin(W * t) * der(x); }
}

// An advected vector that not every group element moves: the anchor is not onto.
system! { Advected { A: f64 }
    base { a[3], r }
    basis { w[3], v }
    anchor { der(a) = cross(a, w); der(r) = v; }
    brackets so(3) { w }
    lagrangian { (w[0]^2 + A * w[1]^2 + w[2]^2 + v^2) / 2 - dot(a, a) * r }
    constraints { w[2] = r * v; }
}

// A roller racer: with its handlebar straight it rolls without steering. D has no basis valid everywhere.
system! { Racer { m: f64, J: f64, l: f64, d: f64 }
    base { x, y, th, ph }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * (der(th)^2 + (der(th) + der(ph))^2) }
    constraints {
        cos(th) * der(y) = sin(th) * der(x);
        cos(th + ph) * der(y) + (l * cos(ph) + d) * der(th) + d * der(ph) = sin(th + ph) * der(x);
    }
}

/// A car: straight ahead it has no motion that turns it.
#[nonholonomic(
    base { x, y, theta, delta }
    basis { v, w, r, ds }
    anchor {
        der(x) = v * cos(theta) - w * sin(theta);
        der(y) = v * sin(theta) + w * cos(theta);
        der(theta) = r;
        der(delta) = ds;
    }
    lagrangian { m / 2 * (v^2 + w^2) + J / 2 * r^2 + K / 2 * ds^2 }
    constraints { w = 0; r = v * tan(delta); }
)]
#[derive(Clone, Copy, Debug)]
#[allow(dead_code, non_snake_case, reason = "only its report is read")]
struct Car {
    m: f64,
    J: f64,
    K: f64,
}

#[test]
fn reports() {
    for (report, lines) in [
        (
            Leaves::REPORT,
            ["TM in its coordinate frame, rank 3 over a base of dimension 3\n", "(holonomic)\n"],
        ),
        (
            Drift::REPORT,
            ["constraints: 1, affine in the velocities; D is closed", "the momentum of y, m*y_dot"],
        ),
        (Commuting::REPORT, ["TM in a holonomic frame: all brackets vanish, rank 2", "constraints: none\n"]),
        (
            Top::REPORT,
            [
                "a transitive action Lie algebroid with isotropy of rank 1, rank 3 over a base of dimension 2",
                ", embedded in 3 coordinates\n",
            ],
        ),
        (
            Circle::REPORT,
            ["the tangent bundle TM in a holonomic frame", "dimension 1, embedded in 2 coordinates\n"],
        ),
        (
            Kirchhoff::REPORT,
            ["a Lie algebra, rank 6 over a base of dimension 0\n", "equations: Euler–Poincaré\n"],
        ),
        (
            Arm::REPORT,
            [
                "a transitive action Lie algebroid with isotropy of rank 3",
                "Lagrange–d'Alembert–Poincaré: S = D ∩ V, V = ker ρ, has rank 2; D + V = E",
            ],
        ),
        (Pinned::REPORT, ["momentum equations of rank 2 alone: D lies in V = ker ρ\n", "(nonholonomic)"]),
        (Half::REPORT, ["has rank 2; D + V is not E (no dimension assumption)\n", "(holonomic)\n"]),
        (
            Links::REPORT,
            [
                "has rank 1 (more where sin(p1) = 0); D + V = E (the dimension assumption); the group: translations",
                "horizontal symmetries: p2\n",
            ],
        ),
        (
            Car::REPORT,
            [
                "of a Chaplygin system: the anchor maps D one to one onto the rates of theta, delta where sin(delta) != 0",
                "the equations have a value only where cos(delta) != 0\n",
            ],
        ),
        (
            Racer::REPORT,
            [
                "formulation: projected",
                "of a Chaplygin system: the anchor maps D one to one onto the rates of th, ph where sin(ph) != 0;",
            ],
        ),
        (
            Turning::REPORT,
            [
                "; D, as it changes with the time, is not closed under the bracket (nonholonomic)\n",
                "the energy (CLMM Theorems 3.4",
            ],
        ),
        (
            Advected::REPORT,
            [
                "an action Lie algebroid with orbits of dimension 3, but not where a[2] = 0 and a[1] = 0 and a[0] = 0, rank 4",
                "(nonholonomic)",
            ],
        ),
    ] {
        for line in lines {
            assert!(report.contains(line), "{line}\n{report}");
        }
    }
    assert!(Commuting::REPORT.contains("Unused parameters\n  k stands in no expression"));
    assert!(!Leaves::REPORT.contains("Unused parameters"));
    // what is false of them
    for (report, words) in [
        (Leaves::REPORT, "nonholonomic"),
        (Advected::REPORT, "equations: "),
        (Turning::REPORT, "horizontal symmetries"),
        (Links::REPORT, "Chaplygin"),
    ] {
        let classification = report.split("\n\n").nth(1).unwrap_or_default();
        let symmetries = report.split("\nSymmetries\n").nth(1).unwrap_or_default();
        assert!(!classification.contains(words) && !symmetries.contains(words), "{words}\n{report}");
    }
}

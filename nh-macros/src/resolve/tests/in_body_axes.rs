//! Bodies in space in their own axes, mathematics (42) and (43): on random trees of joints both forms are admitted, and
//! say what another form says; every step of them that is changed is noticed.

use std::fmt::Write;

use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::choose::Fate;
use nonholonomic_core::compile::compile_with;
use nonholonomic_core::forms::{Form, Registry, Setting};
use nonholonomic_core::mechanics::{Definition, OtherAxes, Procedure, ReducedEquations};

use super::proved::Dice;
use super::{derivative_of, fates, model};

const BODIES: &str =
    "struct S { m: [f64; 6], J: [[f64; 3]; 6], K: [[f64; 3]; 3], l: [f64; 6], s: [f64; 6], g: f64 }";

const NAMES: [&str; 2] = ["joint by joint", "by composite bodies"];

fn form(name: &str) -> &'static dyn Form {
    let registry = Registry::standard();
    registry.forms().iter().copied().find(|form| form.name() == name).expect("a form of the registry")
}

/// A tree of bodies in space: on the ground, on a skate, or afloat; about axes of every kind, along rails, with points.
fn tree_in_space(seed: u64, bodies: usize) -> String {
    let mut dice = Dice::of(seed);
    let ground = dice.below(3);
    let (mut base, mut lets, mut energy) = (String::new(), String::new(), "0".to_owned());
    let (root, place) = match ground {
        0 => (None, "[0, 0, l[5]]"),
        1 => {
            base.push_str("x, y, yaw, ");
            let _ = write!(lets, "let P = rot_z(yaw); ");
            let _ = write!(energy, " + kinetic(m[5], [0, 0, J[5][2]], [x, y, 0] + P * [l[4], 0, 0], P)");
            (Some("P"), "[x, y, l[5]]")
        }
        _ => {
            base.push_str("p[3], yaw, pitch, roll, ");
            let _ = write!(lets, "let P = rot_z(yaw) * rot_y(pitch) * rot_x(roll); ");
            let _ = write!(energy, " + kinetic(m[5], J[5], p, P) - m[5] * g * p[2]");
            (Some("P"), "p + P * [l[5], 0, 0]")
        }
    };
    for k in 0..bodies {
        let parent = dice.below(k.max(1));
        let (attitude, joint) = if k == 0 {
            (root.map(ToOwned::to_owned), format!("({place})"))
        } else {
            let slide = if dice.below(4) == 0 { format!(" + d{k}") } else { String::new() };
            if !slide.is_empty() {
                let _ = write!(base, "d{k}, ");
            }
            let arm = [format!("[0, 0, l[{parent}]{slide}]"), format!("[l[{parent}], s[1]{slide}, 0]")];
            (Some(format!("R{parent}")), format!("(o{parent} + R{parent} * {})", arm[dice.below(2)]))
        };
        let turn = match dice.below(6) {
            0 => format!("rot_x(q{k})"),
            1 => format!("rot_y(q{k})"),
            2 => format!("rot_z(q{k})"),
            3 => format!("rot([3/5, 0, -4/5], q{k})"),
            4 => format!("rot_x(s[{k}]) * rot_z(q{k})"),
            _ => format!("rot_y(pi/2) * rot([0, -1, 0], q{k})"),
        };
        let _ = write!(base, "q{k}, ");
        let attitude = attitude.map_or(String::new(), |carrier| format!("{carrier} * "));
        let _ = write!(lets, "let R{k} = {attitude}{turn}; let o{k} = {joint}; ");
        let _ = write!(lets, "let c{k} = o{k} + R{k} * [l[{}], 0, s[{k}]]; ", dice.below(5));
        let inertia = if dice.below(3) == 0 { "K".to_owned() } else { format!("J[{k}]") };
        let body = if k + 1 == bodies && dice.below(3) == 0 {
            format!("kinetic(m[{k}], c{k})")
        } else {
            format!("kinetic(m[{k}], {inertia}, c{k}, R{k})")
        };
        let _ = write!(energy, " + {body} - m[{k}] * g * c{k}[2]");
    }
    let _ = write!(energy, " + J[0][0] / 2 * der(q0)^2 - s[0] / 2 * (q1 - q0)^2");
    let base = base.trim_end_matches(", ");
    if ground != 1 {
        return format!(
            "base {{ {base} }} {lets} lagrangian {{ {energy} }} inputs {{ u }} forces {{ q1: u; }}"
        );
    }
    let joints: Vec<&str> = base.split(", ").skip(3).collect();
    let rates: Vec<String> = joints.iter().map(|joint| format!("w_{joint}")).collect();
    let anchor: Vec<String> = joints.iter().map(|joint| format!("der({joint}) = w_{joint};")).collect();
    format!(
        "base {{ {base} }} basis {{ v, side, omega, {} }} anchor {{ der(x) = v * cos(yaw) - side * sin(yaw); \
         der(y) = v * sin(yaw) + side * cos(yaw); der(yaw) = omega; {} }} {lets} lagrangian {{ {energy} }} \
         constraints {{ side = 0; }} inputs {{ u }} forces {{ w_q1: u; }}",
        rates.join(", "),
        anchor.join(" ")
    )
}

/// Whether a form exists: then it is admitted, and says what the chain does.
fn agrees(declared: &str, bodies: &str, name: &str) -> bool {
    let plain = compile_with(model(declared, bodies), &Registry::of(vec![form("along the chain")]));
    let plain = plain.unwrap_or_else(|errors| panic!("{declared}: {errors:?}"));
    let alone = compile_with(model(declared, bodies), &Registry::of(vec![form(name)])).expect("regular");
    let Some((_, fate)) = fates(&alone).into_iter().find(|(known, _)| *known == name) else { return false };
    assert!(!matches!(fate, Fate::NotAdmitted(_)), "{declared}\n{}", alone.ledger);
    for (one, other) in derivative_of(&plain).into_iter().zip(derivative_of(&alone)) {
        assert!((one - other).abs() <= 1e-8 * one.abs().max(1.0), "{declared}: {one}, {other}");
    }
    true
}

#[test]
fn trees_of_joints_move_as_the_mass_matrix_says() {
    let mut competed = [0; 2];
    for seed in 0..12 {
        let bodies = 3 + usize::from(seed % 3 == 0);
        let declared = tree_in_space(seed, bodies);
        for (name, competed) in NAMES.into_iter().zip(&mut competed) {
            *competed += usize::from(agrees(&declared, BODIES, name));
        }
    }
    assert!(competed.iter().all(|competed| *competed >= 10), "{competed:?} of 12");
}

/// A link whose attitude is that of the column turned by an angle of its own, and whose place depends on that of
/// an upper arm beside it.
#[test]
fn angles_counted_from_what_carries_an_upper_arm_move_the_lower_one() {
    let bodies = "struct S { m: [f64; 3], J: [[f64; 3]; 2], l: [f64; 3], I: f64, g: f64 }";
    for angle in ["q2", "q1 + q2"] {
        let declared = format!(
            "base {{ arm, q1, q2 }} let A = rot_z(arm); let R = A * rot_x(q1);
             let elbow = A * [l[0], 0, 0] + R * [0, 0, l[1]]; let T = A * rot_x({angle}); let c = elbow + T * [0, 0, l[2]];
             lagrangian {{ I / 2 * der(arm)^2 + kinetic(m[0], J[0], elbow, R) + kinetic(m[1], J[1], c, T) - g * (m[0] * elbow[2] + m[1] * c[2]) }}"
        );
        assert!(agrees(&declared, bodies, "by composite bodies"), "{declared}");
    }
}

/// Angles about axes in every order, also where the velocities are no chart where the angles are 0.
#[test]
fn attitudes_by_three_angles_of_every_kind() {
    let axes = ["x", "y", "z"];
    let orders = (0..27).map(|k| [k / 9, k / 3 % 3, k % 3]);
    let orders: Vec<_> = orders.filter(|[first, second, third]| first != second && second != third).collect();
    assert_eq!(orders.len(), 12);
    for [first, second, third] in orders.into_iter().map(|order| order.map(|axis| axes[axis])) {
        let declared = format!(
            "base {{ p[3], e[3], a }} let R = rot_{first}(e[2]) * rot_{second}(e[1]) * rot_{third}(e[0]);
             velocities {{ w = body_rate(R); v = der(p); h = der(a); }}
             let A = R * rot_y(a); let c = p + R * [l[0], 0, 0] + A * [l[1], 0, l[2]];
             lagrangian {{ kinetic(m[0], J[0], p, R) + kinetic(m[1], J[1], c, A) }}"
        );
        assert!(agrees(&declared, BODIES, "by composite bodies"), "{declared}");
    }
}

/// A form with one of its steps changed.
struct Planted {
    of: &'static str,
    step: usize,
    slip: fn(&mut Graph, &mut Definition),
}

impl Form for Planted {
    fn name(&self) -> &'static str {
        "planted"
    }
    fn condition(&self) -> &'static str {
        "in tests"
    }
    fn formulas(&self) -> &'static str {
        "none"
    }
    fn rank(&self) -> u8 {
        u8::MAX
    }
    fn derive(&self, _: &mut Graph, _: &Setting) -> Option<ReducedEquations> {
        None
    }
    fn solve(&self, graph: &mut Graph, setting: &Setting) -> Option<(Procedure, Vec<OtherAxes>)> {
        let (mut procedure, axes) = form(self.of).solve(graph, setting)?;
        (self.slip)(graph, procedure.definitions.get_mut(self.step)?);
        Some((procedure, axes))
    }
}

fn value(definition: &mut Definition) -> &mut nonholonomic_core::id::ExprId {
    match definition {
        Definition::Value { value, .. } => value,
        _ => panic!("values alone are defined"),
    }
}

#[test]
fn every_step_that_is_changed_is_noticed() {
    changes_are_noticed(
        "base { q[4] }
        let A = rot_z(q[0]); let B = A * rot_y(q[1]); let C = B * rot_x(q[2]); let D = C * rot_y(q[3]);
        let b = [0, 0, l[0]] + B * [0, s[0], l[1]]; let c = b + C * [l[2], 0, s[1]]; let d = c + D * [0, 0, l[3]];
        lagrangian {
            kinetic(m[0], J[0], [0, 0, l[0]], A) + kinetic(m[1], J[1], b, B) + kinetic(m[2], K, c, C)
            + kinetic(m[3], J[3], d, D) - g * (m[1] * b[2] + m[2] * c[2] + m[3] * d[2])
        } inputs { u } forces { q[1]: u; }",
    );
}

/// On a body that turns freely, and moves along the axes of space.
#[test]
fn every_step_behind_a_free_attitude_that_is_changed_is_noticed() {
    changes_are_noticed(
        "base { p[3], q[4], a } on { dot(q, q) = 1; } basis { w[3], v[3], h }
        anchor {
            der(q) = [
                -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2, (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2,
                (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2, (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2
            ];
            der(p) = v; der(a) = h;
        }
        let R = [
            [1 - 2 * (q[2]^2 + q[3]^2), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])],
            [2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1]^2 + q[3]^2), 2 * (q[2] * q[3] - q[0] * q[1])],
            [2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1]^2 + q[2]^2)]
        ];
        let A = R * rot_y(a); let c = p + R * [l[0], s[0], l[1]] + A * [l[2], 0, s[1]];
        lagrangian { kinetic(m[0], J[0], p, R) + kinetic(m[1], K, c, A) - g * (m[0] * p[2] + m[1] * c[2]) }
        inputs { u } forces { h: u; }",
    );
}

fn changes_are_noticed(declared: &str) {
    let slips: [fn(&mut Graph, &mut Definition); 2] = [
        |graph, definition| {
            let value = value(definition);
            *value = graph.formula(-*value);
        },
        |graph, definition| {
            let value = value(definition);
            *value = graph.scale(Rational::ONE + Rational::new(1, 1_000_000_000), *value);
        },
    ];
    let plain = compile_with(model(declared, BODIES), &Registry::of(vec![form("along the chain")]));
    let plain = plain.expect("regular");
    for (slip, of) in slips.into_iter().zip(NAMES) {
        let mut steps = 0;
        for step in (0..).step_by(17) {
            let planted: &'static Planted = Box::leak(Box::new(Planted { of, step, slip }));
            let system =
                compile_with(model(declared, BODIES), &Registry::of(vec![planted])).expect("regular");
            let Some((_, fate)) = fates(&system).into_iter().find(|(name, _)| *name == "planted") else {
                break;
            };
            if matches!(fate, Fate::NotAdmitted(_)) {
                steps += 1;
                continue;
            }
            // a turn of what is round, or where a sum alone is used
            for (one, other) in derivative_of(&plain).into_iter().zip(derivative_of(&system)) {
                assert!((one - other).abs() <= 1e-12 * one.abs().max(1.0), "{of}, {step}: {one}, {other}");
            }
        }
        assert!(steps >= 5, "{steps} steps");
    }
}

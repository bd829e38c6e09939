//! What is emitted is proved, and known where it is called.

use std::fmt::Write;

use nonholonomic_core::choose::Fate;
use nonholonomic_core::compile::compile;
use nonholonomic_core::system::System;

use super::{catalogue, model};

/// At every decision something is chosen, and proved to 80 bits.
fn assert_proved(system: &System) {
    let name = &system.model.name;
    assert!(system.ledger.at("derivative").is_some(), "{name}: {}", system.ledger);
    for decision in &system.ledger.decisions {
        match decision.chosen().map(|chosen| &chosen.fate) {
            Some(Fate::Chosen(proof)) => assert!(proof.bits >= 80.0, "{name}: {}", system.ledger),
            _ => panic!("{name}: {}", system.ledger),
        }
    }
}

#[test]
fn every_reference_system_is_proved() {
    for (attribute, item) in catalogue::all() {
        let system = compile(catalogue::resolved(attribute, item).model).expect("derived");
        assert_proved(&system);
        // no form of a reference system is wrong, or asks for more than the declaration
        let refused = system.ledger.decisions.iter().flat_map(|decision| &decision.contenders);
        let refused: Vec<_> =
            refused.filter(|contender| matches!(contender.fate, Fate::NotAdmitted(_))).collect();
        assert!(refused.is_empty(), "{}: {}", system.model.name, system.ledger);
    }
}

/// A wheel and a trailer in coordinates: the velocity of the wheel's axis contains der(th), which cancels.
const TRAILER: &str = "
    base { x, y, th, q }
    lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*(der(th)^2 + der(q)^2) }
    constraints {
        wheel: cos(th)*(der(y) - c*sin(th)*der(th)) = sin(th)*(der(x) - c*cos(th)*der(th));
        trailer: cos(q)*der(y) - sin(q)*der(x) + l*cos(q - th)*der(th) = d*der(q);
    }";

/// Velocities in constraints with coefficients that cancel, in sums, products and functions of angles.
const CANCELLING: [(&str, &str); 4] = [
    (TRAILER, "struct S { m: f64, J: f64, c: f64, l: f64, d: f64 }"),
    (
        "base { x, y, z, w } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2 + der(w)^2)/2 }
         constraints { one: der(x) = (z + der(y))*w - w*der(y); two: der(y) = x*der(z); }",
        "struct S;",
    ),
    (
        "base { x, y, z, w } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2 + der(w)^2)/2 }
         constraints {
             one: der(x) = y*der(w) + (sin(z)^2 + cos(z)^2 - 1)*der(y);
             two: der(y) = x*der(w) + (cos(2*z) - 2*cos(z)^2 + 1)*der(x);
         }",
        "struct S;",
    ),
    (
        "base { a, b, c, d, e, f, g }
         lagrangian { (der(a)^2 + der(b)^2 + der(c)^2 + der(d)^2 + der(e)^2 + der(f)^2 + der(g)^2)/2 }
         constraints {
             der(a) = g*(der(g) + b*der(b)) - g*b*der(b);
             der(b) = f*(der(g) + c*der(c)) - f*c*der(c);
             der(c) = sin(a)*(der(g) + der(d)) - sin(a)*der(d);
             der(d) = a*(der(f) + der(e)) - a*der(e);
             der(e) = b*der(f) + c*der(g);
         }",
        "struct S;",
    ),
];

#[test]
fn nothing_is_emitted_that_is_not_known() {
    let of_trailer = [
        "",
        "independent { der(y), der(q) }",
        "independent { der(x), der(th) }",
        "formulation { projected }",
    ];
    let trailers = of_trailer.map(|choice| (format!("{TRAILER} {choice}"), CANCELLING[0].1));
    let others = CANCELLING[1..].iter().map(|(attribute, item)| ((*attribute).to_owned(), *item));
    for (attribute, item) in trailers.into_iter().chain(others) {
        let emitted =
            format!("{attribute} outputs {{ }} emit {{ jacobian, multipliers, reactions, gibbs_appell }}")
                .replace("outputs { }", "");
        let text =
            crate::expand::nonholonomic(emitted.parse().expect("tokens"), item.parse().expect("tokens"))
                .to_string();
        assert!(!text.contains("is not known here"), "{attribute}");
        if let Some(at) = text.find("compile_error") {
            panic!("{attribute}: {}", &text[at..text.len().min(at + 300)]);
        }
        assert_proved(&compile(model(&emitted, item)).expect("it was emitted"));
    }
}

/// Numbers that a seed determines.
pub(super) struct Dice(u64);

impl Dice {
    pub(super) fn of(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9) + 1)
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap_or(0) % n
    }
}

/// A tree of two to four bodies in the plane, some on wheels.
fn planar_machine(seed: u64) -> String {
    let mut dice = Dice::of(seed);
    let bodies = 2 + dice.below(3);
    planar_tree(&mut dice, bodies, bodies)
}

/// A tree of bodies in the plane, hinged to each other, the first and perhaps others on wheels, if there are any, in
/// coordinates.
pub(super) fn planar_tree(dice: &mut Dice, bodies: usize, most_wheels: usize) -> String {
    let mut base = "x, y".to_owned();
    // the velocity of the reference point of each body, by components, and its angular velocity
    let mut points: Vec<([String; 2], String)> = Vec::new();
    let (mut energy, mut angles) = ("0".to_owned(), Vec::new());
    let mut wheels = 0;
    for k in 0..bodies {
        let _ = write!(base, ", q{k}");
        let relative = k > 0 && dice.below(2) == 0;
        let parent = dice.below(k.max(1));
        let (place, turning) = if k == 0 {
            (["der(x)".to_owned(), "der(y)".to_owned()], "der(q0)".to_owned())
        } else {
            let ([u, v], spin) = &points[parent];
            let (a, length) = (&angles[parent], format!("l[{}]", dice.below(4)));
            let sign = if dice.below(2) == 0 { "+" } else { "-" };
            let other = if sign == "+" { "-" } else { "+" };
            let place = [
                format!("({u} {other} {length}*sin({a})*{spin})"),
                format!("({v} {sign} {length}*cos({a})*{spin})"),
            ];
            let turning = if relative { format!("({spin} + der(q{k}))") } else { format!("der(q{k})") };
            (place, turning)
        };
        let a = if relative { format!("{} + q{k}", angles[parent]) } else { format!("q{k}") };
        let [u, v] = &place;
        let ahead = format!("c[{}]", dice.below(4));
        let _ = write!(
            energy,
            " + m[{k}]/2*(({u} - {ahead}*sin({a})*{turning})^2 + ({v} + {ahead}*cos({a})*{turning})^2) + J[{k}]/2*{turning}^2"
        );
        points.push((place, turning));
        angles.push(a);
    }
    let mut rows = String::new();
    for (k, ([u, v], turning)) in points.iter().enumerate() {
        if wheels < most_wheels && (k == 0 || dice.below(3) > 0) {
            let a = &angles[k];
            let back =
                if dice.below(2) == 0 { format!(" - l[{}]*{turning}", dice.below(4)) } else { String::new() };
            let _ = writeln!(rows, "wheel{k}: cos({a})*{v} - sin({a})*{u}{back} = 0;");
            wheels += 1;
        }
    }
    let constraints = if rows.is_empty() { rows } else { format!("constraints {{ {rows} }}") };
    format!("base {{ {base} }} lagrangian {{ {energy} }} {constraints}")
}

const BODIES: &str = "struct S { m: [f64; 5], J: [f64; 5], l: [f64; 4], c: [f64; 4] }";

#[test]
fn planar_machines_are_proved() {
    // at the last one the velocities that move points on wheels together have to be found
    for seed in [0, 1, 2, 3, 4, 5, 30] {
        let declared = planar_machine(seed);
        match compile(model(&declared, BODIES)) {
            Ok(system) => {
                assert_proved(&system);
                let refused = system.ledger.decisions.iter().flat_map(|decision| &decision.contenders);
                let refused: Vec<_> =
                    refused.filter(|contender| matches!(contender.fate, Fate::NotAdmitted(_))).collect();
                assert!(refused.is_empty(), "{seed}: {declared}\n{}", system.ledger);
            }
            Err(violations) => panic!("{seed}: {declared}\n{violations:?}"),
        }
    }
}

//! Wrong functions beside the motion, each one step away from the right one, are refused.

use std::cell::RefCell;
use std::collections::BTreeSet;

use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::compile::compile_with;
use nonholonomic_core::forms::Registry;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::Model;

use super::model;

/// Declarations that ask for everything between them, on D and on E, over coordinates and an embedded base.
const DECLARED: [(&str, &str); 9] = [
    (
        "base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 - m*g*x*sin(al) }
         constraints { blade: der(x)*sin(th) = der(y)*cos(th); } inputs { u } forces { th: u; }
         formulation { projected } outputs { ahead = x*der(y); fast = y*der(x)^2; }
         emit { jacobian, parameter_jacobian, output_jacobian, bracket, connection, power, divergence, multipliers }",
        "struct S { m: f64, J: f64, g: f64, al: f64 }",
    ),
    (
        "base { x, y, th, q } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 + I/2*der(q)^2 - k*cos(th) }
         constraints { rolls: der(x) = R*cos(th)*der(q); side: der(y) = R*sin(th)*der(q); }
         symmetries { along: R*cos(th)*der(x) + R*sin(th)*der(y) + der(q); }
         outputs { spin = J*der(th); ahead = x*der(q); }
         emit { hamiltonian, bracket, discrete_gradient, connection, divergence, volume, output_jacobian, jacobian }",
        "struct S { m: f64, J: f64, I: f64, R: f64, k: f64 }",
    ),
    (
        "base { x, y, th, q } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 + I/2*der(q)^2 - cos(th + q) }
         constraints { rolls: der(x) = R*cos(th)*der(q); side: der(y) = R*sin(th)*der(q); }
         emit { gyroscopic, power, reactions }",
        "struct S { m: f64, J: f64, I: f64, R: f64 }",
    ),
    (
        "base { x, y, z, s } lagrangian { (der(x)^2 + der(y)^2 + (1 + x^2)*der(z)^2 + der(s)^2)/2 - x^2 }
         constraints { der(z) = y*der(x) + sin(x)*der(s); } emit { splitting }",
        "struct S;",
    ),
    (
        "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 - (x^2 + y^2)/2 }
         constraints { der(z) = y*der(x); } conserved { energy = (der(x)^2 + der(y)^2 + der(z)^2 + x^2 + y^2)/2; }
         formulation { projected } emit { leapfrog, invariants, discrete_gradient }",
        "struct S;",
    ),
    (
        "base { g[3] } on { g[0]^2 + g[1]^2 + g[2]^2 = 1; } basis { w[3] }
         anchor {
             der(g[0]) = g[1]*w[2] - g[2]*w[1]; der(g[1]) = g[2]*w[0] - g[0]*w[2]; der(g[2]) = g[0]*w[1] - g[1]*w[0];
         }
         brackets so(3) { w } lagrangian { A/2*w[0]^2 + B/2*w[1]^2 + C/2*w[2]^2 - c*g[2] }
         constraints { suslov: w[2] = e*w[0]; } outputs { height = g[2]; spin = A*w[0]; }
         emit { divergence, bracket, hamiltonian }",
        "struct S { A: f64, B: f64, C: f64, c: f64, e: f64 }",
    ),
    (
        "basis { w[3] } brackets so(3) { w } lagrangian { A/2*w[0]^2 + B/2*w[1]^2 + C/2*w[2]^2 }
         constraints { suslov: w[2] = e*w[0]; } emit { euler_poincare_suslov }",
        "struct S { A: f64, B: f64, C: f64, e: f64 }",
    ),
    (
        "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 } constraints { der(z) = a*der(x) + b; }
         holonomic { rod: x^2 + y^2 = l^2; } inputs { u } forces { y: u; } emit { power, multipliers }",
        "struct S { a: f64, b: f64, l: f64 }",
    ),
    (
        "base { x, y } lagrangian { (der(x)^2 + der(y)^2)/2 } hamilton_jacobi { der(x): 2; der(y): a; } emit { hamiltonian }",
        "struct S { a: f64 }",
    ),
];

/// What is done to one output of one function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slip {
    /// Nothing: which functions there are.
    Seen,
    Sign,
    /// A share of 1e-9 is missing; of what is 0 there is so much.
    Small,
    /// It is multiplied and divided by a parameter.
    Divisor,
}

thread_local! {
    static PLANTED: RefCell<(Slip, String, usize)> = const { RefCell::new((Slip::Seen, String::new(), 0)) };
    static SEEN: RefCell<Vec<(String, usize)>> = const { RefCell::new(Vec::new()) };
}

fn spoil(graph: &mut Graph, name: &str, procedure: &mut Procedure) {
    let (slip, wanted, index) = PLANTED.with_borrow(Clone::clone);
    if slip == Slip::Seen {
        SEEN.with_borrow_mut(|seen| seen.push((name.to_owned(), procedure.outputs.len())));
        return;
    }
    if name != wanted {
        return;
    }
    let output = procedure.outputs[index];
    let small = Rational::new(1, 1_000_000_000);
    let is_zero = graph.zero_test(output).is_zero();
    let find = |graph: &mut Graph, wanted: &str| {
        let found = graph.symbols().iter_ids().find(|(_, name)| *name == wanted).map(|(id, _)| id);
        graph.symbol(found.expect("declared"))
    };
    procedure.outputs[index] = match slip {
        // a multiple of a density is one
        Slip::Small | Slip::Sign if name == "volume_density" => {
            let (small, angle) = (graph.number(small), find(graph, "th"));
            graph.formula(output + small * angle)
        }
        Slip::Small | Slip::Sign if is_zero => {
            let small = graph.number(small);
            graph.formula(output + small)
        }
        Slip::Sign => graph.scale(Rational::MINUS_ONE, output),
        Slip::Small => graph.scale(Rational::ONE - small, output),
        Slip::Divisor => {
            // ((f + x) a)/a − x
            let (a, x) = (find(graph, "a"), find(graph, "x"));
            let product = graph.formula((output + x) * a);
            let name = procedure.define(graph, "product", product);
            graph.formula(name / a - x)
        }
        Slip::Seen => output,
    };
}

/// What is said of a declaration with a slip.
fn planted(model: &Model, slip: Slip, name: &str, index: usize) -> Result<(), Vec<String>> {
    PLANTED.set((slip, name.to_owned(), index));
    let outcome = compile_with(model.clone(), &Registry::standard().finishing(spoil));
    PLANTED.set((Slip::Seen, String::new(), 0));
    let text = |violation: &nonholonomic_core::violation::Violation| {
        format!("{}: {}", violation.what, violation.evidence)
    };
    outcome.map(drop).map_err(|violations| violations.iter().map(text).collect())
}

/// The name under which a function is proved.
fn site(name: &str) -> &str {
    match name {
        "legendre" | "inverse" | "equations" | "bracket_of_momenta" | "drift_of_momenta" => "hamiltonian",
        "energy_gradient" | "sharp" => "discrete_gradient",
        "bracket_with_energy" | "drift_of_outputs" => "bracket",
        "vertical_sections"
        | "horizontal_lifts"
        | "locked_inertia"
        | "connection_coefficients"
        | "curvature"
        | "vertical_momenta"
        | "vertical_velocities"
        | "horizontal_force" => "splitting",
        other => other,
    }
}

#[test]
fn a_sign_and_a_term_of_1e_9_in_every_function() {
    let mut tried: BTreeSet<String> = BTreeSet::new();
    for (attribute, item) in DECLARED {
        let model = model(attribute, item);
        SEEN.take();
        assert_eq!(planted(&model, Slip::Seen, "", 0), Ok(()), "{attribute}");
        for (name, outputs) in SEEN.take() {
            for (slip, index) in [(Slip::Sign, 0), (Slip::Small, outputs - 1)] {
                let found = planted(&model, slip, &name, index).expect_err(&format!("{name}: {slip:?}"));
                let expected = format!(
                    "`{}` was not derived as what its definition says: compared in exact numbers with the declared \
                     equations and the motion: it is not what its definition says",
                    site(&name)
                );
                assert!(found.contains(&expected), "{name}, {slip:?}: {found:?}");
            }
            tried.insert(name);
        }
    }
    let all: Vec<&str> = tried.iter().map(String::as_str).collect();
    assert_eq!(all.len(), 42, "{all:?}");
}

#[test]
fn a_divisor_that_is_a_parameter_that_may_be_zero() {
    let declared = |assumed: &str| {
        let attribute = format!(
            "base {{ x, y, z }} lagrangian {{ (der(x)^2 + der(y)^2 + der(z)^2)/2 - a*x^2*y }}
             constraints {{ der(z) = y*der(x); }} {assumed} outputs {{ ahead = a*x*der(y); }}
             emit {{ jacobian, parameter_jacobian, output_jacobian, divergence }}"
        );
        model(&attribute, "struct S { a: f64 }")
    };
    let model = declared("");
    let names =
        ["energy", "velocity", "outputs", "jacobian", "parameter_jacobian", "output_jacobian", "divergence"];
    for name in names {
        let found = planted(&model, Slip::Divisor, name, 0).expect_err(name);
        let expected = format!(
            "`{name}` was not derived as what its definition says: compared in exact numbers with the declared \
             equations and the motion: it has no value where `a` is 0, and the motion has one"
        );
        assert!(found.contains(&expected), "{name}: {found:?}");
        assert_eq!(planted(&declared("assume { a > 0; }"), Slip::Divisor, name, 0), Ok(()), "{name}");
    }
}

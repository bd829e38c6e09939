//! Wrong functions beside the motion, each one step away from the right one, are refused.

use std::cell::RefCell;
use std::collections::BTreeSet;

use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::compile::compile_with;
use nonholonomic_core::forms::Registry;
use nonholonomic_core::functions::TABLE;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::Model;
use nonholonomic_core::system::System;

use super::model;

/// Declarations that ask for everything between them, on D and on E, over coordinates and an embedded base.
const DECLARED: [(&str, &str); 13] = [
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
         holonomic { rod: x^2 + y^2 = l^2; } inputs { u } forces { y: u; }
         emit { power, multipliers, symmetric_projection, jacobian, return_jacobian }",
        "struct S { a: f64, b: f64, l: f64 }",
    ),
    (
        "base { x, z, y } lagrangian { (der(x)^2 + a*der(y)^2 + der(z)^2)/2 - b*y } constraints { der(z) = y*der(x); }
         holonomic { rod: x^2 + y^2 = l^2; } independent { der(x) } emit { discrete_gradient }",
        "struct S { a: f64, b: f64, l: f64 }",
    ),
    (
        "base { x, y } lagrangian { ((1 + x^2)*der(x)^2 + a*der(y)^2 + x*der(y))/2 - b*y } holonomic { rod: x^2 + y^2 = l^2; }
         emit { rattle }",
        "struct S { a: f64, b: f64, l: f64 }",
    ),
    (
        "base { x, y } lagrangian { (der(x)^2 + der(y)^2)/2 } hamilton_jacobi { der(x): 2; der(y): a; } emit { hamiltonian }",
        "struct S { a: f64 }",
    ),
    (
        "base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 + m*a*der(x)*der(th)*cos(th) }
         constraints { cart: der(y) = x*der(x) + b; }
         impacts { wall: x + l*sin(th) >= 0, x - l*sin(th) >= 0 with restitution e; }",
        "struct S { m: f64, J: f64, a: f64, b: f64, l: f64, e: f64 }",
    ),
    (
        "base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 }
         holonomic { rod: x^2 + y^2 = l^2; } impacts { stop: x >= t, der(th) = x*der(x) + b with restitution e; }",
        "struct S { m: f64, J: f64, b: f64, l: f64, e: f64 }",
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
    /// It is multiplied and divided by something.
    Divisor(Divisor),
}

/// What may be 0 where the motion is regular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Divisor {
    /// a
    Parameter,
    /// a − b
    Difference,
    /// a² − b c
    Cone,
    /// a² − 2 a b + b², which does not change its sign
    Square,
    /// x − a
    State,
    /// x² + y² + c, which no positive c makes 0
    Positive,
    /// x¹⁵ − a, of a degree that is not looked for
    Long,
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
        Slip::Divisor(divisor) => {
            // ((f + x) d)/d − x
            let [a, b, c, x, y] = ["a", "b", "c", "x", "y"].map(|name| find(graph, name));
            let divisor = match divisor {
                Divisor::Parameter => a,
                Divisor::Difference => graph.formula(a - b),
                Divisor::Cone => graph.formula(a.square() - b * c),
                Divisor::Square => {
                    let twice = graph.scale(Rational::from(2), a);
                    graph.formula(a.square() + b.square() - twice * b)
                }
                Divisor::State => graph.formula(x - a),
                Divisor::Positive => graph.formula(x.square() + y.square() + c),
                Divisor::Long => {
                    let power = graph.pow(x, Rational::from(15));
                    graph.formula(power - a)
                }
            };
            let product = graph.formula((output + x) * divisor);
            let name = procedure.define(graph, "product", product);
            graph.formula(name / divisor - x)
        }
        Slip::Seen => output,
    };
}

/// What is said of a declaration with a slip.
fn planted(model: &Model, slip: Slip, name: &str, index: usize) -> Result<(), Vec<String>> {
    compiled(model, slip, name, index).map(drop)
}

/// What becomes of a declaration with a slip.
fn compiled(model: &Model, slip: Slip, name: &str, index: usize) -> Result<System, Vec<String>> {
    PLANTED.set((slip, name.to_owned(), index));
    let outcome = compile_with(model.clone(), &Registry::standard().finishing(spoil));
    PLANTED.set((Slip::Seen, String::new(), 0));
    let text = |violation: &nonholonomic_core::violation::Violation| {
        format!("{}: {}", violation.what, violation.evidence)
    };
    outcome.map_err(|violations| violations.iter().map(text).collect())
}

/// The name under which a function is proved.
fn site(name: &str) -> &str {
    match name {
        "legendre" | "inverse" | "equations" | "bracket_of_momenta" | "drift_of_momenta" => "hamiltonian",
        "velocity_return" => "position_return",
        "energy_gradient" | "sharp" => "discrete_gradient",
        "lagrangian_slopes" => "rattle",
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
    assert_eq!(all.len(), 49, "{all:?}");
    let left_out = TABLE.iter().map(|signature| signature.name).filter(|name| !all.contains(name));
    assert_eq!(left_out.collect::<Vec<_>>(), OTHERWISE, "nothing is planted in these");
}

/// The functions that are proved with the motion, or made of its rates after the proofs.
const OTHERWISE: [&str; 4] = ["multipliers", "reactions", "gibbs_appell", "quadratures"];

/// Divisors with what makes them harmless, and the text of what is 0.
const DIVISORS: [(Divisor, &str, &str); 5] = [
    (Divisor::Parameter, "a > 0;", "a"),
    (Divisor::Difference, "a > b;", "a - b"),
    (Divisor::Cone, "a^2 - b*c > 0;", "b*c - a^2"),
    (Divisor::Square, "a > b;", "a^2 + b^2 - 2*a*b"),
    (Divisor::State, "", "a - x"),
];

/// Declarations with the parameters a, b, c and coordinates x, y, between which every function that divisors are
/// planted in is asked for.
const WITH_PARAMETERS: [(&str, &str, &[&str]); 5] = [
    (
        "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 - (a + b*c)*x^2*y }
         constraints { der(z) = y*der(x); }",
        "outputs { ahead = a*x*der(y); fast = y*der(x)^2; } symmetries { up: der(x) + y*der(z); } inputs { u } forces { y: u; }
         emit { jacobian, parameter_jacobian, output_jacobian, divergence, power, connection }",
        &[
            "energy", "velocity", "outputs", "momenta", "momentum_rates", "jacobian", "parameter_jacobian",
            "output_jacobian", "divergence", "power", "christoffel", "connection",
        ],
    ),
    (
        "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 - (a + b*c)*x^2*y }
         constraints { der(z) = y*der(x); }",
        "outputs { ahead = a*x*der(y); fast = y*der(x)^2; } conserved { h = (der(x)^2 + der(y)^2 + der(z)^2)/2 + (a + b*c)*x^2*y; }
         emit { hamiltonian, bracket, discrete_gradient, volume, gyroscopic, splitting, invariants }",
        &[
            "legendre", "inverse", "hamiltonian", "equations", "bracket_of_momenta", "drift_of_momenta",
            "energy_gradient", "sharp", "bracket", "bracket_with_energy", "drift_of_outputs", "volume_density",
            "gyroscopic", "horizontal_lifts", "curvature", "horizontal_force", "invariant_gradients",
        ],
    ),
    (
        "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 - (a + b*c)*x^2*y }
         constraints { der(z) = y*der(x); } formulation { projected }",
        "emit { power, multipliers, leapfrog }",
        &["constraint_residual", "projection", "power", "leapfrog"],
    ),
    (
        "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + der(z)^2)/2 - (a + b*c)*z }
         holonomic { rod: x^2 + y^2 = 4; }",
        "emit { power, multipliers, rattle }",
        &["position_return", "power", "lagrangian_slopes", "rattle"],
    ),
    (
        "base { x, y, z } lagrangian { ((1 + y^2)*der(x)^2 + der(y)^2 + (a + b*c)*der(z)^2)/2 }",
        "hamilton_jacobi { der(x): 0; der(y): a - b; der(z): 1 + c; } emit { hamiltonian }",
        &["hamilton_jacobi"],
    ),
];

#[test]
fn a_divisor_that_may_be_zero_where_the_motion_is_regular() {
    let (mut tried, mut wrong): (BTreeSet<&str>, Vec<String>) = Default::default();
    for (moving, asked, names) in WITH_PARAMETERS {
        let declared = |assumed: &str| {
            let assumed = if assumed.is_empty() { String::new() } else { format!("assume {{ {assumed} }}") };
            model(&format!("{moving} {assumed} {asked}"), "struct S { a: f64, b: f64, c: f64 }")
        };
        let (free, positive) = (declared(""), declared("c > 0;"));
        SEEN.take();
        assert_eq!(planted(&free, Slip::Seen, "", 0), Ok(()), "{asked}");
        let seen = SEEN.take();
        for name in names {
            assert!(seen.iter().any(|(found, _)| found == name), "{name}: {seen:?}");
            for (divisor, assumed, text) in DIVISORS {
                // what a density is multiplied by is another one's
                if *name == "volume_density" && divisor == Divisor::State {
                    continue;
                }
                let found = planted(&free, Slip::Divisor(divisor), name, 0).err().unwrap_or_default();
                let expected = format!(
                    "`{}` was not derived as what its definition says: compared in exact numbers with the declared \
                     equations and the motion: it has no value where `{text}` is 0, and the motion has one",
                    site(name)
                );
                if !found.contains(&expected) {
                    wrong.push(format!("{name}, {divisor:?}: {found:?}"));
                }
                if !assumed.is_empty()
                    && let Err(found) = planted(&declared(assumed), Slip::Divisor(divisor), name, 0)
                {
                    wrong.push(format!("{name}, {divisor:?}, {assumed}: {found:?}"));
                }
            }
            if let Err(found) = planted(&positive, Slip::Divisor(Divisor::Positive), name, 0) {
                wrong.push(format!("{name}, positive: {found:?}"));
            }
            tried.insert(name);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(tried.len(), 36, "{tried:?}");
}

/// A divisor of a degree that is not looked for is named in the ledger, under the function that has it.
#[test]
fn a_divisor_that_was_not_decided_is_named() {
    let mut unnamed: Vec<String> = Vec::new();
    for (moving, asked, names) in WITH_PARAMETERS {
        let model = model(&format!("{moving} {asked}"), "struct S { a: f64, b: f64, c: f64 }");
        let doubts = |system: &System, name: &str| -> Vec<String> {
            let decision = system.ledger.at(site(name));
            decision.map_or_else(Vec::new, |decision| decision.limits.clone())
        };
        let right = compiled(&model, Slip::Seen, "", 0).expect("regular");
        for name in names.iter().filter(|name| **name != "volume_density") {
            let system = compiled(&model, Slip::Divisor(Divisor::Long), name, 0).expect("not refuted");
            let said = doubts(&system, name);
            let is_named = |doubt: &String| {
                doubt.starts_with("whether it adds a condition was not decided: where ")
                    && doubt.contains("x^15")
            };
            if !said.iter().any(is_named) || doubts(&right, name).iter().any(is_named) {
                unnamed.push(format!("{name}: {said:?}"));
            }
        }
    }
    assert!(unnamed.is_empty(), "{}", unnamed.join("\n"));
}

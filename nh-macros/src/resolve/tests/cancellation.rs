//! Terms that cancel identically are not in emitted derivatives where the expanded form is no dearer: where
//! one velocity, input or parameter is a million times the others, such a term leaves no digits of the value.

use nonholonomic_core::algebra::Bounded;
use nonholonomic_core::compile::compile;
use nonholonomic_core::id::{ExprId, Id, SymbolId};
use nonholonomic_core::program::{Cost, Program, interpret_in, schedule};
use nonholonomic_core::system::System;

use super::catalogue;
use super::model;

/// How much larger an error may be than that of the expanded form: more than operations add up to.
const MORE: f64 = 1e3;

/// A heavy body in a fluid with a keel: its momenta `I ω + m h v` are in the equations of several velocities.
const KEEL: &str = "base { gamma[3] } on { dot(gamma, gamma) = 1; } basis { w[3], v[3] }
    anchor { der(gamma) = cross(gamma, w); }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian {
        sum(i in 0..3: I[i]*w[i]^2 + M[i]*v[i]^2)/2 + m*dot(v, cross(w, [0, 0, h])) - m*g*h*gamma[2]
    }
    constraints { v[1] = 0 } inputs { thrust, tau[3] }
    forces { v[0]: thrust; for i in 0..3 { w[i]: tau[i]; } }";
/// A sleigh on a moving belt, on the plane.
const BELT: &str = "base { x, y, theta }
    lagrangian {
        m/2*((der(x) - a*sin(theta)*der(theta))^2 + (der(y) + a*cos(theta)*der(theta))^2) + J/2*der(theta)^2
    }
    constraints { -(der(x) - u)*sin(theta) + der(y)*cos(theta) = 0 }
    forces { theta: -c*der(theta) }
    formulation { projected }";
/// A falling particle whose speed is kept: only the part of its weight along the velocity acts.
const KEPT: &str = "base { x, y } lagrangian { m/2*(der(x)^2 + der(y)^2) - m*g*y }
    constraints { der(x)^2 + der(y)^2 = c^2 }";

/// A number between 1/2 and 2 that the symbol determines, of either sign for what is no parameter.
fn ordinary(symbol: SymbolId, parameters: &[SymbolId]) -> f64 {
    let unit = f64::from(u32::try_from(symbol.index() * 2_654_435_761 % 65_536).expect("16 bits")) / 65_536.0;
    let size = 2_f64.powf(2.0 * unit - 1.0);
    if parameters.contains(&symbol) || symbol.index().is_multiple_of(2) { size } else { -size }
}

/// Where outputs lose digits against their expanded forms, though these take no more work: that output alone
/// expanded, or all of them.
fn losses(mut system: System) -> Vec<String> {
    let graph = &mut system.model.graph;
    let written_out = system.derivative.written_out(graph);
    let expanded = graph.simplify_all(&written_out);
    let program = |outputs: Vec<ExprId>| schedule(graph, &system.derivative.with_outputs(outputs));
    let work = |program: &Program| Cost::of(program).weighted();
    let (emitted, all) = (program(system.derivative.outputs.clone()), program(expanded.clone()));
    let is_dearer = |output: usize| {
        let mut one = system.derivative.outputs.clone();
        one[output] = expanded[output];
        work(&all) > work(&emitted) && work(&program(one)) > work(&emitted)
    };
    let parameters: Vec<SymbolId> =
        system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let is_scaled =
        |symbol: &SymbolId| *symbol != system.model.time && !system.state_coordinates.contains(symbol);
    let mut found = Vec::new();
    for large in graph.symbols_in(&written_out).into_iter().filter(is_scaled) {
        let at = |symbol: SymbolId| ordinary(symbol, &parameters) * if symbol == large { 1e6 } else { 1.0 };
        let run = |program: &Program| -> Vec<Bounded> {
            interpret_in(program, |symbol| Bounded { value: at(symbol), error: 0.0 })
        };
        for (output, (value, reference)) in run(&emitted).iter().zip(run(&all)).enumerate() {
            let error = reference.error.max(f64::EPSILON * reference.value.abs());
            if value.error > MORE * error && !is_dearer(output) {
                let name = &graph.symbols()[large];
                found.push(format!("{}: output {output} where {name} is large", system.model.name));
            }
        }
    }
    found
}

fn compiled(attribute: &str, item: &str) -> System {
    compile(model(attribute, item)).expect("derived")
}

#[test]
fn what_cancels_identically_is_not_computed() {
    let keel = compiled(KEEL, "struct Keel { I: [f64; 3], M: [f64; 3], m: f64, h: f64, g: f64 }");
    let belt = compiled(BELT, "struct Belt { m: f64, J: f64, a: f64, c: f64, u: f64 }");
    let kept = compiled(KEPT, "struct Kept { m: f64, g: f64, c: f64 }");
    let found: Vec<String> = [keel, belt, kept].into_iter().flat_map(losses).collect();
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn nor_in_any_reference_system() {
    for (attribute, item) in catalogue::all() {
        let system = compile(catalogue::resolved(attribute, item).model).expect("derived");
        assert_eq!(losses(system), Vec::<String>::new());
    }
}

//! Tests of this stage: the meaning of expressions, evaluated, and every error text.

mod almost;
mod along_free_directions;
mod auxiliary_states;
mod cancellation;
mod catalogue;
mod ceilings;
mod constants;
mod cross_checks;
mod free_bodies;
mod from_the_tips;
mod fuzz;
mod hostile_sizes;
mod in_body_axes;
mod irrational;
mod machine_errors;
mod machine_words;
mod meaning;
mod name_errors;
mod on_levels;
mod planted;
mod planted_functions;
mod proved;
mod requests;
mod section_errors;
mod unit_errors;

use nonholonomic_core::choose::Fate;
use nonholonomic_core::id::{ExprId, Id, SymbolId};
use nonholonomic_core::model::Model;
use nonholonomic_core::program::{interpret, schedule};
use nonholonomic_core::system::System;

use super::{Resolved, resolve};
use crate::emit::Layout;
use crate::report::Diagnostic;
use crate::syntax::testing::declaration;

/// The resolved declaration with its layout, or the errors of this stage.
fn resolved(attribute: &str, item: &str) -> Result<(Resolved, Layout), Vec<Diagnostic>> {
    let declaration = declaration(attribute, item)?;
    let mut layout = Layout::of_struct(&declaration.structure, attribute.parse().expect("tokens"));
    match resolve(&declaration, &mut layout) {
        Ok(resolved) => Ok((resolved, layout)),
        Err(unresolved) => Err(unresolved.errors),
    }
}

/// The model of a declaration in order.
fn model(attribute: &str, item: &str) -> Model {
    match resolved(attribute, item) {
        Ok((resolved, _)) => resolved.model,
        Err(errors) => panic!("{}", errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")),
    }
}

/// The texts of the errors.
fn messages(attribute: &str, item: &str) -> Vec<String> {
    match resolved(attribute, item) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.iter().map(ToString::to_string).collect(),
    }
}

/// The struct of the tests of sections and of requests.
const STRUCT: &str = "struct S { m: f64, G: [f64; 3] }";

/// The texts of the errors of a declaration with [`STRUCT`].
fn of(attribute: &str) -> Vec<String> {
    messages(attribute, STRUCT)
}

fn assert_errors(cases: &[(&str, &str)]) {
    for (attribute, message) in cases {
        assert_eq!(of(attribute), [*message], "{attribute}");
    }
}

/// The value of an expression where every symbol has the value [`of_name`] of its name.
fn evaluated(model: &Model, expression: ExprId) -> f64 {
    model.graph.evaluate(&[expression], |symbol| of_name(&model.graph.symbols()[symbol]))[0].value
}

/// A value for every name: not the same for any two of a declaration, and never 0.
fn of_name(name: &str) -> f64 {
    let hash = name.bytes().fold(17_u32, |hash, byte| hash.wrapping_mul(31).wrapping_add(u32::from(byte)));
    1.0 + f64::from(hash % 1009) / 1009.0
}

/// The derivative at a point.
fn derivative_of(system: &System) -> Vec<f64> {
    let program = schedule(&system.model.graph, &system.derivative);
    // a quaternion has length 1
    let unit = [("q[0]", 0.5), ("q[1]", -0.1), ("q[2]", 0.7), ("q[3]", 0.5)];
    let is_embedded = !system.model.identities.is_empty();
    interpret(&program, |symbol: SymbolId| {
        let name = &system.model.graph.symbols()[symbol];
        match unit.iter().find(|(known, _)| is_embedded && known == name) {
            Some((_, value)) => *value,
            None => 0.3 + 0.17 * f64::from(u32::try_from(symbol.index() % 11).expect("small")),
        }
    })
}

/// What became of the forms of the derivative that competed.
fn fates(system: &System) -> Vec<(&'static str, Fate)> {
    let decision = system.ledger.at("derivative").expect("a derivative");
    decision.contenders.iter().map(|contender| (contender.form, contender.fate.clone())).collect()
}

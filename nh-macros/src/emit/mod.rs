//! Stage 8, emit: a verified system and its names to tokens.
//!
//! After this point there are items that name everything by absolute paths, allocate nothing and
//! cannot panic. One file per kind of item; `program.rs` turns straight-line programs into
//! statements for all of them.

mod almost_poisson;
mod angle_cache;
mod assembly;
mod c;
mod c_names;
mod callback;
mod collisions;
mod discrete;
mod editor;
mod embedding;
mod energy;
mod functions;
mod hamiltonian;
mod held;
mod impact_methods;
mod inclusion;
mod infix;
mod inherent_method;
mod intermediate_names;
mod invariants;
mod jacobian;
mod labels;
mod latex;
mod layout;
mod line_breaks;
mod linearization;
mod lint;
mod literal;
mod map_functions;
mod motion;
mod near_return;
mod observed;
mod place;
mod positions;
mod power;
mod prepared;
mod program;
mod projection;
mod reconstruction;
mod record;
mod reduced_declaration;
mod report_text;
mod results;
#[cfg(test)]
mod samples;
mod setting;
mod slopes_of_return;
mod sparse_jacobian;
mod state;
mod stubs;
mod symbols;
mod taylor;
#[cfg(test)]
mod tests;
mod validate;
mod variational;
mod vector_products;

use nonholonomic_core::functions::{ENERGY, VELOCITY};
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::system::System;
use nonholonomic_core::violation::Violation;
use proc_macro2::TokenStream;

use setting::Context;
use symbols::Scope;

pub(crate) use callback::alias;
pub(crate) use collisions::collision;
pub(crate) use inclusion::inclusion;
pub(crate) use layout::{Family, Layout, TypeNames};
pub(crate) use map_functions::{morphism, morphism_stub};
pub(crate) use power::directions_of_forces;
pub(crate) use reduced_declaration::{Written, can_be_written, quotient};
pub(crate) use stubs::stubs;

/// The struct and everything that its declaration gives it.
///
/// # Errors
/// A program that is not proved to compute what was derived.
pub(crate) fn emit(system: &System, layout: &Layout) -> Result<TokenStream, Vec<Violation>> {
    let model = &system.model;
    let in_state = &system.state();
    let basis: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
    let outputs: Vec<String> = model.outputs.iter().map(|output| output.name.clone()).collect();
    let context = &Context::new(layout, in_state, &basis).observing(&outputs);
    let scope = &Scope::new(context, model, in_state);
    let derivative = context.lowering.program(model, &system.derivative);
    let part = functions::emit(context, scope, system)
        .with(taylor::emit(context, scope, system, &derivative))
        .with(embedding::emit(context, scope, system))
        .with(projection::emit(context, system))
        .with(assembly::emit(context, scope, system))
        .with(jacobian::emit(context, scope, system))
        .with(sparse_jacobian::emit(context, scope, system))
        .with(vector_products::emit(context, system))
        .with(linearization::emit(context, system, &derivative))
        .with(impact_methods::emit(context, scope, system))
        .with(prepared::emit(context, system, &derivative))
        .with(angle_cache::emit(context, scope, system, &derivative))
        .with(hamiltonian::emit(context, scope, system))
        .with(almost_poisson::emit(context, scope, system))
        .with(held::emit(context, scope, system))
        .with(discrete::emit(context, system))
        .with(variational::emit(context, scope, system))
        .with(invariants::emit(context, scope, system));
    let mut programs = vec![("derivative", &derivative)];
    programs.extend(part.programs.iter().map(|(name, program)| (*name, program)));
    let mut methods = report_text::constant(context, system, &programs);
    methods.extend(c::constant(context, scope, system, &programs));
    methods.extend(latex::constant(context, system));
    methods.extend(motion::method(context, scope, &derivative));
    let mut items = report_text::item(context, &system.equations);
    items.extend(records(context, system.functions.get(&VELOCITY).is_some()));
    items.extend(state::emit(context));
    let mut check_state = embedding::check_state(context, scope, system);
    check_state.extend(positions::hooks(context, system));
    items.extend(motion::implementation(context, &motion::inlining(&derivative), &check_state));
    items.extend(system.functions.get(&ENERGY).map(|_| energy::implementation(context)));
    if let Some(outputs) = &context.outputs {
        items.extend(observed::implementation(context, outputs));
    }
    methods.extend(part.methods);
    items.extend(part.items);
    methods.extend(validate::method(context, scope, system));
    // the ledger tells of all programs
    methods.extend(report_text::derivation(context, system));
    items.extend(context.inherent(&methods));
    items.extend(editor::emit(context, system.functions.get(&VELOCITY).is_some()));
    items.extend(callback::emit(context));
    let violations: Vec<Violation> = context
        .lowering
        .violation(model.origin)
        .into_iter()
        .chain(literal::beyond_range(context, model.origin))
        .collect();
    if violations.is_empty() { Ok(items) } else { Err(violations) }
}

/// The generated structs; that of all velocities only with the method that returns it.
fn records(context: &Context, has_velocity: bool) -> TokenStream {
    let velocity = has_velocity.then_some(&context.velocity);
    let optional = [&context.input, &context.outputs].map(Option::as_ref);
    let records = [Some(&context.state), velocity].into_iter().chain(optional).flatten();
    records.map(|record| record.emit(context)).collect()
}

//! Stage 8, emit: a verified system and its names to tokens.
//!
//! After this point there are items that name everything by absolute paths, allocate nothing and
//! cannot panic. One file per kind of item; `program.rs` turns straight-line programs into
//! statements for all of them.

mod callback;
mod constraint;
mod context;
mod dynamics;
mod embedding;
mod energy;
mod expression;
mod function;
mod jacobian;
mod layout;
mod lint;
mod names;
mod number;
mod observed;
mod program;
mod projection;
mod record;
mod report;
#[cfg(test)]
mod samples;
mod scope;
mod state;
mod stubs;
#[cfg(test)]
mod tests;
mod validate;
mod velocity;

use nh_core::id::SymbolId;
use nh_core::system::System;
use proc_macro2::TokenStream;

use context::Context;
use function::program;
use scope::Scope;

pub(crate) use layout::{Family, Layout, TypeNames};
pub(crate) use stubs::stubs;

/// The struct and everything that its declaration gives it.
pub(crate) fn emit(system: &System, layout: &Layout) -> TokenStream {
    let model = &system.model;
    let kept = &system.state_velocities;
    let basis: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
    let context = &Context::new(layout, kept, &basis);
    let scope = &Scope::new(context, model, kept);
    let derivative = program(model, &system.derivative);
    let energy_program = program(model, &system.energy);
    let velocities = program(model, &system.velocity);
    let observables = program(model, &system.observables);
    let mut programs =
        vec![("derivative", &derivative), ("energy", &energy_program), ("velocity", &velocities)];
    if context.outputs.is_some() {
        programs.push(("outputs", &observables));
    }
    let part = constraint::emit(context, scope, system)
        .with(embedding::emit(context, scope, system))
        .with(projection::emit(context, system))
        .with(jacobian::emit(context, scope, system));
    programs.extend(part.programs.iter().map(|(name, program)| (*name, program)));
    let mut methods = report::constant(context, system, &programs);
    methods.extend(dynamics::method(context, scope, &derivative));
    methods.extend(energy::method(context, scope, &energy_program));
    methods.extend(velocity::method(context, scope, &velocities));
    let mut items = report::item(context, &system.equations);
    items.extend(records(context));
    items.extend(state::emit(context));
    let check_state = embedding::check_state(context, scope, system);
    items.extend(dynamics::implementation(context, &check_state));
    items.extend(energy::implementation(context));
    if let Some(outputs) = &context.outputs {
        methods.extend(observed::method(context, outputs, scope, &observables));
        items.extend(observed::implementation(context, outputs));
    }
    methods.extend(part.methods);
    items.extend(part.items);
    methods.extend(validate::method(context, scope, system));
    items.extend(context.inherent(&methods));
    items.extend(callback::emit(context));
    items
}

/// The generated structs.
fn records(context: &Context) -> TokenStream {
    let optional = [&context.input, &context.outputs].into_iter().flatten();
    let records = [&context.state, &context.velocity].into_iter().chain(optional);
    records.map(|record| record.emit(context)).collect()
}

//! The Hamiltonian side: momenta, the Legendre transformation, h and Hamilton's equations.

use std::collections::BTreeSet;

use nonholonomic_core::mechanics::{HamiltonianSide, Procedure};
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::functions::matrix;
use super::inherent_method::{Part, Signature};
use super::layout::{local, plain};
use super::program::body;
use super::record::Record;
use super::setting::Context;
use super::state;
use super::symbols::{Argument, Scope};

/// The struct of coordinates and momenta.
fn phase(context: &Context, velocities: usize) -> Record {
    let layout = context.layout;
    let name = layout.name.to_string();
    let mut fields = Vec::new();
    let mut left = context.state.len().saturating_sub(velocities);
    let mut taken = BTreeSet::new();
    for field in &context.state.fields {
        let own = plain(&field.ident);
        if left > 0 {
            left = left.saturating_sub(field.len());
            taken.insert(own.clone());
            fields.push(field.described(&format!(" The coordinate `{own}`.")));
            continue;
        }
        let mut ident = format!("p_{own}");
        while !taken.insert(ident.clone()) {
            ident.push('_');
        }
        let what = if field.is_family() { "momenta" } else { "momentum" };
        fields.push(field.renamed(
            format_ident!("{ident}", span = field.ident.span()),
            &format!(" The {what} along `{own}`: ∂L/∂v on the constraint distribution."),
        ));
    }
    Record {
        name: layout.types.phase.clone(),
        doc: format!("The state of [`{name}`] on the Hamiltonian side: base coordinates, then momenta."),
        fields,
    }
}

/// The struct and the methods, if they are asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(side) = &system.phase_space.hamiltonian else { return Part::default() };
    let record = &phase(context, system.state_velocities.len());
    let argument = local("phase");
    let symbols: Vec<_> = system.state_coordinates.iter().chain(&side.momenta).copied().collect();
    let of_phase = Scope::new(context, &system.model, &system.state()).with_places(
        Argument::Phase,
        &symbols,
        record.places(&argument),
    );
    let n = system.state_coordinates.len();
    let mut part = Part { items: record.emit(context), ..Part::default() };
    part.items.extend(state::of(context, record));
    let mut add = |signature: Signature,
                   scope: &Scope,
                   procedure: &Procedure,
                   shape: &dyn Fn(&[TokenStream]) -> TokenStream,
                   kept: bool| {
        let program = context.lowering.program(&system.model, procedure);
        let body = body(context, scope, &program);
        let mut used = body.used.clone();
        if kept && n > 0 {
            used.insert(signature.argument.0);
        }
        let (statements, result) = (&body.statements, shape(&body.outputs));
        part.methods.extend(signature.with_body(context, &used, &quote!(#statements #result)));
        part.programs.push((signature.name, program));
    };
    let [legendre, inverse, energy, equations, drift, bracket] = signatures(context, record);
    let of_state = context.state.places(&context.locals.state);
    let of_record = record.places(&argument);
    let HamiltonianSide { legendre: forth, inverse: back, .. } = side;
    add(
        legendre,
        scope,
        forth,
        &|momenta| record.construct(&quote_name(record), &[&of_state[..n], momenta].concat()),
        true,
    );
    add(
        inverse,
        &of_phase,
        back,
        &|velocities| context.state.construct(&context.state_name(), &[&of_record[..n], velocities].concat()),
        true,
    );
    add(energy, &of_phase, &side.hamiltonian, &|outputs| outputs.iter().cloned().collect(), false);
    add(
        equations,
        &of_phase,
        &side.equations,
        &|outputs| record.construct(&quote_name(record), outputs),
        false,
    );
    add(drift, &of_phase, &side.drift, &|outputs| record.construct(&quote_name(record), outputs), false);
    add(
        bracket,
        &of_phase,
        &side.bracket,
        &|outputs| matrix(context, record.len(), record.len(), outputs),
        false,
    );
    part
}

/// The same with zeros.
pub(super) fn stub(context: &Context, velocities: usize) -> Part {
    let record = &phase(context, velocities);
    let mut part = Part { items: record.emit(context), ..Part::default() };
    part.items.extend(state::of(context, record));
    let default = quote!(::core::default::Default::default());
    for signature in signatures(context, record) {
        part.methods.extend(signature.with_body(context, &BTreeSet::new(), &default));
    }
    part
}

fn quote_name(record: &Record) -> TokenStream {
    let name = &record.name;
    quote!(#name)
}

fn signatures(context: &Context, record: &Record) -> [Signature; 6] {
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let (state, phase) = (context.type_of(&context.state), context.type_of(record));
    let size = Literal::usize_unsuffixed(record.len());
    let of_state = || (Argument::State, state.clone());
    let of_phase = || (Argument::Phase, phase.clone());
    let equations = signature(
        context,
        "hamilton",
        &[" Hamilton's equations: the time derivative of coordinates and momenta."],
        of_phase(),
        phase.clone(),
    );
    let drift = signature(
        context,
        "drift",
        &[
            " R_L, what Hamilton's equations add to the bracket with the energy: zero where the constraints are",
            " homogeneous, nothing depends on the time, and no force acts.",
        ],
        of_phase(),
        phase.clone(),
    );
    [
        signature(
            context,
            "legendre",
            &[" The Legendre transformation: the momenta of a state."],
            of_state(),
            phase.clone(),
        ),
        signature(
            context,
            "inverse_legendre",
            &[" The state that has these momenta."],
            of_phase(),
            state.clone(),
        ),
        signature(
            context,
            "hamiltonian",
            &[" The energy as a function of coordinates and momenta."],
            of_phase(),
            scalar.clone(),
        ),
        Signature { takes_input: true, ..equations },
        Signature { takes_input: true, ..drift },
        signature(
            context,
            "poisson",
            &[
                " The almost-Poisson structure: entry (i, j) is the nonholonomic bracket of components i and j",
                " of coordinates and momenta.",
            ],
            of_phase(),
            quote!(#runtime::nalgebra::SMatrix<#scalar, #size, #size>),
        ),
    ]
}

/// The method with the arguments `t` and a value of another type than the state.
fn signature(
    context: &Context,
    name: &'static str,
    doc: &'static [&'static str],
    argument: (Argument, TokenStream),
    returns: TokenStream,
) -> Signature {
    let ident = match argument.0 {
        Argument::Phase => local("phase"),
        _ => context.locals.state.clone(),
    };
    Signature { name, doc, argument: (argument.0, ident, argument.1), takes_input: false, returns }
}

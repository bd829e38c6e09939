//! The nonholonomic connection and the momentum equation.

use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::expression::element;
use super::function::{Head, Part, program};
use super::program::body;
use super::scope::Scope;

/// One of the functions, an array.
struct Entry<'a> {
    name: &'static str,
    doc: &'static [&'static str],
    takes_input: bool,
    /// The lengths, the outermost first.
    lengths: Vec<usize>,
    procedure: Option<&'a Procedure>,
}

/// The inherent methods, if they are asked for; none for what is empty.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let mut part = Part::default();
    for entry in entries(system) {
        let Some(procedure) = entry.procedure.filter(|procedure| !procedure.outputs.is_empty()) else {
            continue;
        };
        let program = program(&system.model, procedure);
        let body = body(context, scope, &program);
        let (statements, result) = (&body.statements, array(&entry.lengths, &body.outputs));
        let scalar = &context.scalar;
        let returns = entry.lengths.iter().rev().fold(quote!(#scalar), |inner, length| {
            let length = Literal::usize_unsuffixed(*length);
            quote!([#inner; #length])
        });
        let Entry { name, doc, takes_input, .. } = entry;
        let head = Head { name, doc, takes_input, returns };
        part.methods.extend(head.with_body(context, &body.used, &quote!(#statements #result)));
        part.programs.push((name, program));
    }
    part
}

/// The functions with their shapes.
fn entries(system: &System) -> Vec<Entry<'_>> {
    let Some(found) = &system.phase_space.splitting else { return Vec::new() };
    let (n, h, s) = (system.model.sections.len(), found.coordinates.len(), found.momenta.outputs.len());
    let entry = |name, lengths: &[usize], procedure, doc| Entry {
        name,
        doc,
        takes_input: false,
        lengths: lengths.to_vec(),
        procedure,
    };
    vec![
        entry(
            "vertical_sections",
            &[s, n],
            Some(&found.vertical),
            &[
                " Sections S_ρ that span S = D ∩ V, the vertical part of the constraint distribution, by their",
                " components along the basis.",
            ],
        ),
        entry(
            "horizontal_lifts",
            &[h, n],
            Some(&found.lifts),
            &[
                " The horizontal lifts h_κ of the nonholonomic connection: sections of the constraint distribution",
                " over the unit rates of the coordinates that the report names, orthogonal to S in the kinetic metric.",
            ],
        ),
        entry(
            "locked_inertia",
            &[s, s],
            found.inertia.as_ref(),
            &[" The locked inertia: the kinetic metric on the sections S_ρ."],
        ),
        entry(
            "connection_coefficients",
            &[h, s, n],
            Some(&found.coefficients),
            &[
                " The coefficients Υ of the connection: entry `[κ][ρ]` is the bracket [h_κ, S_ρ] along the basis.",
            ],
        ),
        entry(
            "curvature",
            &[h, h, n],
            Some(&found.curvature),
            &[" The curvature K: entry `[κ][λ]` is the bracket [h_κ, h_λ] along the basis."],
        ),
        entry(
            "vertical_momenta",
            &[s],
            Some(&found.momenta),
            &[" The nonholonomic momentum map: the momenta P_ρ along the sections S_ρ."],
        ),
        Entry {
            takes_input: true,
            ..entry(
                "vertical_momentum_rates",
                &[s],
                Some(&found.rates),
                &[
                    " The right sides of the momentum equations: the rates of the momenta P_ρ along the motion.",
                ],
            )
        },
        entry(
            "vertical_velocities",
            &[s],
            Some(&found.velocities),
            &[" The components v^ρ of the velocity along the sections S_ρ."],
        ),
        entry(
            "horizontal_force",
            &[h],
            Some(&found.force),
            &[
                " The force on the right of the horizontal equations, by curvature and connection:",
                " −p([h_κ, h_λ]) ẋ^λ − p([h_κ, S_ρ]) v^ρ.",
            ],
        ),
    ]
}

/// Nested arrays of the entries.
fn array(lengths: &[usize], entries: &[TokenStream]) -> TokenStream {
    let mut level: Vec<TokenStream> = entries.iter().map(element).collect();
    for length in lengths.iter().rev() {
        level = level.chunks((*length).max(1)).map(|chunk| quote!([#(#chunk),*])).collect();
    }
    level.into_iter().collect()
}

//! Brackets, volume, connections and the almost-Poisson form.

use std::collections::BTreeSet;

use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::Request;
use nonholonomic_core::phase_space::AlmostPoisson;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::context::Context;
use super::expression::element;
use super::function::{Head, Part, Signature, program};
use super::layout::local;
use super::program::body;
use super::scope::{Argument, Scope};

/// What is derived about phase space apart from momenta.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let found = &system.phase_space;
    let mut part = Part::default();
    let mut add =
        |head: Option<Head>, procedure: &Option<Procedure>, shape: &dyn Fn(&[TokenStream]) -> TokenStream| {
            let (Some(head), Some(procedure)) = (head, procedure) else { return };
            let program = program(&system.model, procedure);
            let mut body = body(context, scope, &program);
            if head.name == "hamilton_jacobi" && !system.state_coordinates.is_empty() {
                // the coordinates are handed through
                body.used.insert(Argument::State);
            }
            let (statements, result) = (&body.statements, shape(&body.outputs));
            part.methods.extend(head.with_body(context, &body.used, &quote!(#statements #result)));
            part.programs.push((head.name, program));
        };
    let observables = context.outputs.as_ref().map_or(0, super::record::Record::len);
    add(bracket(context), &found.bracket, &|outputs| square(context, observables, outputs));
    let [with_energy, drift] = parts_of_rates(context);
    let parts = |values: &[TokenStream]| {
        let record = context.outputs.as_ref();
        record
            .map_or_else(TokenStream::new, |record| record.construct(&record.name.to_token_stream(), values))
    };
    add(with_energy, &found.bracket_with_energy, &parts);
    add(drift, &found.drift_of_outputs, &parts);
    add(Some(divergence(context)), &found.divergence, &|outputs| outputs.iter().cloned().collect());
    add(Some(density(context)), &found.density, &|outputs| outputs.iter().cloned().collect());
    let (velocities, sections) = (system.state_velocities.len(), context.velocity.len());
    add(Some(connection(context, velocities)), &found.connection, &|outputs| cube(velocities, outputs));
    add(Some(christoffel(context, sections)), &found.christoffel, &|outputs| cube(sections, outputs));
    let kept = context.state.places(&context.locals.state);
    let coordinates = kept.len().saturating_sub(velocities);
    add(Some(hamilton_jacobi(context)), &found.hamilton_jacobi, &|outputs| {
        let components = [&kept[..coordinates], outputs].concat();
        context.state.construct(&context.state_name(), &components)
    });
    match &found.almost_poisson {
        Some(form) => part.with(almost_poisson(context, scope, system, form)),
        None => part,
    }
}

/// The same items with zeros.
pub(super) fn stub(context: &Context, requests: &[Request], claims_section: bool, velocities: usize) -> Part {
    let mut part = Part::default();
    let default = quote!(::core::default::Default::default());
    let mut add = |asked: bool, head: Option<Head>| {
        if let Some(head) = head.filter(|_| asked) {
            part.methods.extend(head.with_body(context, &BTreeSet::new(), &default));
        }
    };
    let asked = |request| requests.contains(&request);
    let [with_energy, drift] = parts_of_rates(context);
    for head in [bracket(context), with_energy, drift] {
        add(asked(Request::Bracket), head);
    }
    add(asked(Request::Divergence), Some(divergence(context)));
    add(asked(Request::Volume), Some(density(context)));
    add(asked(Request::Connection), Some(connection(context, velocities)));
    add(asked(Request::Connection), Some(christoffel(context, context.velocity.len())));
    add(claims_section, Some(hamilton_jacobi(context)));
    if asked(Request::DiscreteGradient) {
        let zeros = quote!(::core::default::Default::default());
        let drop = |names: TokenStream| quote!(_ = (self, #names); #zeros);
        let (t, state, covector) = (&context.locals.t, &context.locals.state, local("covector"));
        let gradient = drop(quote!(#t, #state));
        let sharp = drop(quote!(#t, #state, #covector));
        part.items.extend(implementation(context, &gradient, &sharp));
    }
    part
}

fn bracket(context: &Context) -> Option<Head> {
    let outputs = context.outputs.as_ref()?;
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let count = Literal::usize_unsuffixed(outputs.len());
    Some(Head {
        name: "bracket",
        doc: &[
            " The nonholonomic brackets of the outputs: entry (i, j) is {output i, output j}, the outputs in",
            " the order of their declaration.",
        ],
        takes_input: true,
        returns: quote!(#runtime::nalgebra::SMatrix<#scalar, #count, #count>),
    })
}

/// The bracket with the energy, and the rest of the rate.
fn parts_of_rates(context: &Context) -> [Option<Head>; 2] {
    let head = |name, doc| {
        let returns = context.type_of(context.outputs.as_ref()?);
        Some(Head { name, doc, takes_input: true, returns })
    };
    [
        head(
            "bracket_with_energy",
            &[
                " The nonholonomic brackets of the outputs with the energy: their rates along the motion, but for",
                " `drift_of_outputs`.",
            ],
        ),
        head(
            "drift_of_outputs",
            &[
                " R_L, what the rates of the outputs have beyond their brackets with the energy: zero where the",
                " constraints are homogeneous, nothing depends on the time, and no force acts.",
            ],
        ),
    ]
}

fn divergence(context: &Context) -> Head {
    Head {
        name: "divergence",
        doc: &[
            " The divergence of the vector field of the motion in the coordinates of the state.",
            "",
            " Where base coordinates are embedded it is that of the motion on the embedded base.",
        ],
        takes_input: true,
        returns: context.scalar.clone(),
    }
}

fn density(context: &Context) -> Head {
    Head {
        name: "volume_density",
        doc: &[
            " The density, in the coordinates of the state, of a volume that the motion keeps.",
            "",
            " Where the state satisfies identities or constraints it is relative to their differentials.",
        ],
        takes_input: false,
        returns: context.scalar.clone(),
    }
}

fn connection(context: &Context, velocities: usize) -> Head {
    Head {
        name: "connection",
        doc: &[
            " The symbols of the constrained connection: entry `[a][b][c]` is the component along c of the",
            " derivative of section b along section a. Without potential and forces, the rate of velocity c",
            " is minus the sum of `[a][b][c]` times the velocities a and b.",
        ],
        takes_input: false,
        returns: cube_type(context, velocities),
    }
}

fn christoffel(context: &Context, sections: usize) -> Head {
    Head {
        name: "christoffel",
        doc: &[
            " The Christoffel symbols of the kinetic metric, without constraints: entry `[a][b][c]` is the",
            " component along c of the derivative of section b along section a.",
        ],
        takes_input: false,
        returns: cube_type(context, sections),
    }
}

fn hamilton_jacobi(context: &Context) -> Head {
    Head {
        name: "hamilton_jacobi",
        doc: &[
            " The state over the same point of the base whose momenta are the declared solution of the",
            " Hamilton–Jacobi equation: the motion from there keeps them so.",
        ],
        takes_input: false,
        returns: context.type_of(&context.state),
    }
}

fn cube_type(context: &Context, size: usize) -> TokenStream {
    let (scalar, size) = (&context.scalar, Literal::usize_unsuffixed(size));
    quote!([[[#scalar; #size]; #size]; #size])
}

fn cube(size: usize, entries: &[TokenStream]) -> TokenStream {
    let rows: Vec<TokenStream> = entries
        .chunks(size.max(1))
        .map(|row| {
            let row = row.iter().map(element);
            quote!([#(#row),*])
        })
        .collect();
    let planes = rows.chunks(size.max(1)).map(|plane| quote!([#(#plane),*]));
    quote!([#(#planes),*])
}

/// An `SMatrix` from its entries, row by row.
pub(super) fn square(context: &Context, size: usize, entries: &[TokenStream]) -> TokenStream {
    let (runtime, scalar) = (&context.runtime, &context.scalar);
    let columns = (0..size).map(|column| {
        let column = entries.iter().skip(column).step_by(size).map(element);
        quote!([#(#column),*])
    });
    let columns = quote!([#(#columns),*]);
    let size = Literal::usize_unsuffixed(size);
    quote! {
        <#runtime::nalgebra::SMatrix<#scalar, #size, #size> as
            ::core::convert::From<[[#scalar; #size]; #size]>>::from(#columns)
    }
}

/// `impl AlmostPoisson for Sleigh`.
fn almost_poisson(context: &Context, scope: &Scope, system: &System, form: &AlmostPoisson) -> Part {
    let covector = local("covector");
    let of_gradient = program(&system.model, &form.gradient);
    let of_sharp = program(&system.model, &form.sharp);
    let with_covector = Scope::new(context, &system.model, &system.state()).with_array(
        Argument::Covector,
        &covector,
        &form.covector,
    );
    let [gradient, sharp] = [(&of_gradient, false), (&of_sharp, true)].map(|(program, takes_covector)| {
        let body = body(context, if takes_covector { &with_covector } else { scope }, program);
        let outputs = body.outputs.iter().map(element);
        let statements = &body.statements;
        let arguments = [Argument::This, Argument::Time, Argument::State];
        let mut drops = super::function::drops_of(context, &arguments, &body.used);
        if takes_covector && !body.used.contains(&Argument::Covector) {
            drops.extend(quote!(_ = #covector;));
        }
        quote!(#drops #statements [#(#outputs),*])
    });
    let items = implementation(context, &gradient, &sharp);
    Part {
        items,
        methods: TokenStream::new(),
        programs: vec![("energy_gradient", of_gradient), ("almost_poisson", of_sharp)],
    }
}

fn implementation(context: &Context, gradient: &TokenStream, sharp: &TokenStream) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let (covector, n) = (local("covector"), Literal::usize_unsuffixed(context.state.len()));
    let body = quote! {
        #[inline]
        fn energy_gradient(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #n] { #gradient }
        #[inline]
        fn almost_poisson(
            &self, #t: #scalar, #state: &#state_type, #covector: &[#scalar; #n]
        ) -> [#scalar; #n] {
            #sharp
        }
    };
    context.implement(&quote!(#runtime::AlmostPoisson), &body)
}

/// The method with the arguments `t` and a value of another type than the state.
pub(super) fn signature(
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

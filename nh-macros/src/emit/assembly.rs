//! Assembling a machine from a rough start: `assemble`, `assemble_holding`, and the coordinates that can be held.

use nonholonomic_core::id::SymbolId;
use nonholonomic_core::system::{Assembly, Linearized, PositionReturn, System};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::Part;
use super::layout::local;
use super::program::body;
use super::record::Field;
use super::results::residual_names;
use super::setting::{Context, coordinate_fields};
use super::symbols::{Argument, Scope};

/// The methods and the enum of the coordinates; nothing without position constraints.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(positions) = &system.positions else { return Part::default() };
    let loops = loops(context, system, positions);
    let methods = methods(
        context,
        &by_loops(context, scope, system, positions),
        &holding(context, scope, system, positions),
        &loops,
    );
    let has_variables = system.linearization.is_some();
    Part { methods, items: coordinates(context, &system.state_coordinates, has_variables), ..Part::default() }
}

/// The same with nothing to do.
pub(super) fn stub(context: &Context, in_state: &[SymbolId], has_variables: bool) -> Part {
    let guess = local("guess");
    let same = quote!(::core::result::Result::Ok(*#guess));
    let held = local("held");
    let t = &context.locals.t;
    let methods = methods(
        context,
        &quote!(_ = (self, #t); #same),
        &quote!(_ = (self, #t, #held); #same),
        &TokenStream::new(),
    );
    Part { methods, items: coordinates(context, in_state, has_variables), ..Part::default() }
}

/// The enum of the coordinates in the state; where that of all variables of the state is generated they are among them, first.
fn coordinates(context: &Context, in_state: &[SymbolId], has_variables: bool) -> TokenStream {
    if has_variables {
        return TokenStream::new();
    }
    let Context { layout, .. } = context;
    let doc = format!(" The base coordinates of [`{}`], by their names in the declaration.", layout.name);
    let fields = coordinate_fields(layout, in_state, "coordinate");
    by_name(context, &layout.types.coordinate, &doc, fields.iter().map(|field| ("coordinate", field)))
}

/// An enum with a variant for each component of some fields, documented as what it is.
pub(super) fn by_name<'a>(
    context: &Context,
    name: &Ident,
    doc: &str,
    fields: impl Iterator<Item = (&'static str, &'a Field)>,
) -> TokenStream {
    let Context { visibility, lints, .. } = context;
    let variants = fields.flat_map(|(what, field)| {
        let is_family = field.is_family();
        let span = field.ident.span().resolved_at(Span::call_site());
        let ident = field.ident.clone();
        let names: Vec<String> = field.names().to_vec();
        names.into_iter().map(move |component| {
            let text = component.replace("][", "_").replace('[', "_").replace(']', "");
            let ident = if is_family { Ident::new(&text, span) } else { ident.clone() };
            let doc = format!(" The {what} `{component}`.");
            quote!(#[doc = #doc] #ident)
        })
    });
    quote! {
        #lints
        #[doc = #doc]
        #[allow(non_camel_case_types, dead_code)]
        #[derive(
            ::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq,
            ::core::cmp::Eq, ::core::hash::Hash
        )]
        #visibility enum #name { #(#variants),* }
    }
}

/// The value that says what the equations are called, and what they depend on.
fn loops(context: &Context, system: &System, positions: &PositionReturn) -> TokenStream {
    let runtime = &context.runtime;
    let Assembly { identities, independent, positions: equations, .. } = &positions.assembly;
    let residuals = residual_names(system);
    let texts = system.embedding.as_ref().map_or(&[][..], |embedding| &embedding.texts);
    let of_positions = &residuals[..positions.count.min(residuals.len())];
    let (first, followers) = of_positions.split_at(system.model.positions.len().min(of_positions.len()));
    let of_base = identities.iter().filter_map(|index| texts.get(*index));
    let names = first.iter().chain(of_base).chain(followers);
    let independent = Literal::usize_unsuffixed(*independent);
    let graph = &system.model.graph;
    let values = &equations.procedure.outputs;
    let occurring = graph.symbols_in(&values[..equations.rows.min(values.len())]);
    let depends = equations.by.iter().map(|symbol| occurring.contains(symbol));
    quote! {
        #runtime::Loops {
            names: [#(#names),*],
            independent: #independent,
            depends: [#(#depends),*],
        }
    }
}

/// `|state| ([…], [[…], …])`: functions with their derivatives at a state.
fn linearized(context: &Context, scope: &Scope, system: &System, what: &Linearized) -> TokenStream {
    let (state, state_type) = (&context.locals.state, context.type_of(&context.state));
    let body = body(context, scope, &context.lowering.program(&system.model, &what.procedure));
    let (values, slopes) = body.outputs.split_at(what.rows.min(body.outputs.len()));
    let values = values.iter().map(element);
    let width = what.by.len();
    let rows = (0..what.rows).map(|row| {
        let entries = slopes.iter().skip(row * width).take(width).map(element);
        quote!([#(#entries),*])
    });
    let argument = if body.used.contains(&Argument::State) { quote!(#state) } else { quote!(_) };
    let statements = &body.statements;
    quote!(|#argument: &#state_type| { #statements ([#(#values),*], [#(#rows),*]) })
}

/// What does the rest, and what says where it failed.
fn rest(context: &Context) -> TokenStream {
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let runtime = &context.runtime;
    quote! {
        |#state: &mut #state_type| Self::project(self, #t, #state),
        |#state: &#state_type| #runtime::Dynamics::worst_constraint(self, #t, #state),
    }
}

/// The body of `assemble`.
fn by_loops(context: &Context, scope: &Scope, system: &System, positions: &PositionReturn) -> TokenStream {
    let (runtime, guess) = (&context.runtime, local("guess"));
    let (state, state_type) = (&context.locals.state, context.type_of(&context.state));
    let equations = linearized(context, scope, system, &positions.assembly.positions);
    let step = body(context, scope, &context.lowering.program(&system.model, &positions.step));
    let (statements, outputs) = (&step.statements, step.outputs.iter().map(element));
    let argument = if step.used.contains(&Argument::State) { quote!(#state) } else { quote!(_) };
    let settle = if system.embedding.is_some() {
        quote!(|#state: &mut #state_type| Self::normalize(self, #state))
    } else {
        quote!(|_: &mut #state_type| ::core::result::Result::Ok(()))
    };
    let (rest, loops) = (rest(context), local("loops"));
    quote! {
        #runtime::assemble(
            #guess, &#loops, #equations, |#argument: &#state_type| { #statements [#(#outputs),*] }, #settle, #rest
        )
    }
}

/// The body of `assemble_holding`.
fn holding(context: &Context, scope: &Scope, system: &System, positions: &PositionReturn) -> TokenStream {
    let (runtime, guess, held) = (&context.runtime, local("guess"), local("held"));
    let equations = linearized(context, scope, system, &positions.assembly.positions);
    let motion = linearized(context, scope, system, &positions.assembly.velocities);
    let names = residual_names(system);
    let names = names.iter().skip(positions.count);
    let count = Literal::usize_unsuffixed(system.state_coordinates.len());
    let (coordinate, place, fixed) = (local("coordinate"), local("place"), local("fixed"));
    let (rest, loops) = (rest(context), local("loops"));
    quote! {
        let mut #fixed = [false; #count];
        for #coordinate in #held {
            if let ::core::option::Option::Some(#place) = #fixed.get_mut(*#coordinate as ::core::primitive::usize) {
                *#place = true;
            }
        }
        #runtime::assemble_holding(#guess, &#fixed, &#loops, #equations, (&[#(#names),*], #motion), #rest)
    }
}

/// The two inherent methods with these bodies.
fn methods(
    context: &Context,
    nothing_held: &TokenStream,
    holding: &TokenStream,
    loops: &TokenStream,
) -> TokenStream {
    let Context { runtime, visibility, scalar, layout, .. } = context;
    let (t, state_type) = (&context.locals.t, context.type_of(&context.state));
    let (guess, held, name) = (local("guess"), local("held"), local("loops"));
    let coordinate = &layout.types.coordinate;
    let bound = context.parameter().map(|parameter| quote!(where #parameter: #runtime::Real));
    let loops = (!loops.is_empty()).then(|| quote!(let #name = #loops;));
    quote! {
        /// Moves a rough guess to where the position constraints hold, and its velocities to the constraints there.
        ///
        /// The steps are those of `project`, halved until the residuals fall, so that the guess may be far away.
        ///
        /// # Errors
        /// If nothing near the guess satisfies the constraints, or they are dependent where the search comes to: the
        /// constraint with the largest residual, by name.
        #visibility fn assemble(
            &self, #t: #scalar, #guess: &#state_type
        ) -> ::core::result::Result<#state_type, #runtime::AssemblyError> #bound { #loops #nothing_held }

        /// Finds the coordinates that are not held, and the velocities. Only coordinates can be held.
        ///
        /// The coordinates in `held` keep their values exactly. Of those that the position constraints depend on there
        /// have to be as many as these leave free; the others follow, on the branch of the guess. Where as many are held
        /// as velocities are free, they keep their rates, too, and the velocities follow from these; else the velocities
        /// are moved least, in the kinetic energy.
        ///
        /// # Errors
        /// If too few or too many are held, nothing satisfies the constraints, or only on another branch than that of
        /// the guess: by name and with what is left.
        #visibility fn assemble_holding(
            &self, #t: #scalar, #guess: &#state_type, #held: &[#coordinate]
        ) -> ::core::result::Result<#state_type, #runtime::AssemblyError> #bound { #loops #holding }
    }
}

//! The way back to the constraint manifold.

use nh_core::id::SymbolId;
use nh_core::system::{Projection, System};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::constraint;
use super::context::Context;
use super::function::program;
use super::layout::local;
use super::program::body;
use super::scope::{Argument, Scope};

/// The inherent method `project`, and `impl Constrained for Sleigh`; nothing where every state
/// satisfies the constraints.
pub(super) fn emit(context: &Context, system: &System) -> (TokenStream, TokenStream) {
    let (Some(projection), Some(residual)) = (&system.projection, constraint::residual(context, system))
    else {
        return (TokenStream::new(), TokenStream::new());
    };
    let count = residual.len();
    (method(context, system, projection), implementation(context, count))
}

/// The inherent method.
fn method(context: &Context, system: &System, projection: &Projection) -> TokenStream {
    let Context { runtime, visibility, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let (start, present) = (local("start"), local("present"));
    let scope = Scope::new(context, &system.model, &system.state_velocities)
        .with_array(Argument::Start, &start, &projection.start)
        .with_array(Argument::Present, &present, &system.state_velocities);
    let step = body(context, &scope, &program(&system.model, &projection.step));
    let name = |argument: Argument, ident: &Ident| {
        if step.used.contains(&argument) { quote!(#ident) } else { quote!(_) }
    };
    let (start_name, present_name) = (name(Argument::Start, &start), name(Argument::Present, &present));
    let (statements, outputs) = (&step.statements, &step.outputs);
    let places = context.state.places(state);
    let (coordinates, velocities) =
        places.split_at(places.len().saturating_sub(system.state_velocities.len()));
    let moved = moved(context, coordinates, &present, &system.state_velocities);
    quote! {
        /// Moves the velocities to the nearest ones that satisfy the constraints, where distance is
        /// measured by the kinetic energy.
        ///
        /// # Errors
        /// If the constraints are not met, because the state is too far from them or they are
        /// dependent there; the state is then as it was.
        #visibility fn project(
            &self, #t: #scalar, #state: &mut #state_type
        ) -> ::core::result::Result<(), #runtime::ProjectionError> {
            [#(#velocities),*] = #runtime::project(
                [#(#velocities),*],
                |#start_name, #present_name| { #statements [#(#outputs),*] },
                |#present| ::core::convert::From::from(Self::constraint_residual(self, #t, &#moved)),
            )?;
            ::core::result::Result::Ok(())
        }
    }
}

/// The state with other velocities.
fn moved(
    context: &Context,
    coordinates: &[TokenStream],
    present: &Ident,
    velocities: &[SymbolId],
) -> TokenStream {
    let mut components = coordinates.to_vec();
    components.extend((0..velocities.len()).map(|index| {
        let index = Literal::usize_unsuffixed(index);
        quote!(#present[#index])
    }));
    let name = &context.state.name;
    context.state.construct(&quote!(#name), &components)
}

/// `impl Constrained for Sleigh`.
fn implementation(context: &Context, count: usize) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let count = Literal::usize_unsuffixed(count);
    let body = quote! {
        type Constraints = #runtime::D<#count>;
        #[inline]
        fn constraint_residual(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #count] {
            ::core::convert::From::from(Self::constraint_residual(self, #t, #state))
        }
        #[inline]
        fn project(
            &self, #t: #scalar, #state: &mut #state_type
        ) -> ::core::result::Result<(), #runtime::ProjectionError> {
            Self::project(self, #t, #state)
        }
    };
    context.implement(&quote!(#runtime::Constrained), &body)
}

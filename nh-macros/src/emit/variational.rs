//! What a step of the variational method is made of.

use nonholonomic_core::program::Program;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Part, drops_of};
use super::layout::local;
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `impl DiscreteLagrangian for Linkage`, if it is asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(form) = &system.phase_space.variational else { return Part::default() };
    let given = local("given");
    let with_given = Scope::new(context, &system.model, &system.state()).with_array(
        Argument::Covector,
        &given,
        &form.given,
    );
    let lower = |procedure| context.lowering.program(&system.model, procedure);
    let (slopes, residual, change) = (lower(&form.slopes), lower(&form.residual), lower(&form.change));
    let mut drops = TokenStream::new();
    if !body(context, &with_given, &change).used.contains(&Argument::Covector) {
        drops.extend(quote!(_ = #given;));
    }
    let change_body = filled(context, &with_given, &change);
    let items = implementation(
        context,
        &filled(context, scope, &slopes),
        &filled(context, scope, &residual),
        &quote!(#drops #change_body),
    );
    let programs =
        vec![("lagrangian_slopes", slopes), ("position_constraints", residual), ("constrained", change)];
    Part { items, methods: TokenStream::new(), programs }
}

/// The same with zeros.
pub(super) fn stub(context: &Context) -> Part {
    let (state, given) = (&context.locals.state, local("given"));
    let zeros = quote!(::core::default::Default::default());
    let nothing = quote!(_ = (self, #state); #zeros);
    let items = implementation(context, &nothing, &nothing, &quote!(_ = (self, #state, #given); #zeros));
    Part { items, ..Part::default() }
}

/// The outputs of a program in front of zeros, as many as the state has components.
fn filled(context: &Context, scope: &Scope, program: &Program) -> TokenStream {
    let body = body(context, scope, program);
    let drops = drops_of(context, &[Argument::This, Argument::State], &body.used);
    let (runtime, scalar, statements) = (&context.runtime, &context.scalar, &body.statements);
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let rest = (body.outputs.len()..context.state.len()).map(|_| zero.clone());
    let outputs = body.outputs.iter().map(element).chain(rest);
    quote!(#drops #statements [#(#outputs),*])
}

fn implementation(
    context: &Context,
    slopes: &TokenStream,
    residual: &TokenStream,
    change: &TokenStream,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (state, state_type, given) = (&context.locals.state, context.type_of(&context.state), local("given"));
    let n = Literal::usize_unsuffixed(context.state.len());
    let body = quote! {
        #[inline]
        fn lagrangian_slopes(&self, #state: &#state_type) -> [#scalar; #n] { #slopes }
        #[inline]
        fn position_constraints(&self, #state: &#state_type) -> [#scalar; #n] { #residual }
        #[inline]
        fn constrained(&self, #state: &#state_type, #given: &[#scalar; #n]) -> [#scalar; #n] { #change }
    };
    context.implement(&quote!(#runtime::DiscreteLagrangian), &body)
}

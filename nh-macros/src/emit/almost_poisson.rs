//! The almost-Poisson form for methods that keep the energy.

use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::Part;
use super::layout::local;
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `impl AlmostPoisson for Sleigh`, if it is asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(form) = &system.phase_space.almost_poisson else { return Part::default() };
    let covector = local("covector");
    let of_gradient = context.lowering.program(&system.model, &form.gradient);
    let of_sharp = context.lowering.program(&system.model, &form.sharp);
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
        let mut drops = super::inherent_method::drops_of(context, &arguments, &body.used);
        if takes_covector && !body.used.contains(&Argument::Covector) {
            drops.extend(quote!(_ = #covector;));
        }
        quote!(#drops #statements [#(#outputs),*])
    });
    let items = implementation(context, &gradient, &sharp, system.phase_space.held.is_some());
    Part {
        items,
        methods: TokenStream::new(),
        programs: vec![("energy_gradient", of_gradient), ("almost_poisson", of_sharp)],
    }
}

/// The same with zeros.
pub(super) fn stub(context: &Context, holds: bool) -> Part {
    let zeros = quote!(::core::default::Default::default());
    let drop = |names: TokenStream| quote!(_ = (self, #names); #zeros);
    let (t, state, covector) = (&context.locals.t, &context.locals.state, local("covector"));
    let gradient = drop(quote!(#t, #state));
    let sharp = drop(quote!(#t, #state, #covector));
    Part { items: implementation(context, &gradient, &sharp, holds), ..Part::default() }
}

fn implementation(
    context: &Context,
    gradient: &TokenStream,
    sharp: &TokenStream,
    holds: bool,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let (covector, n) = (local("covector"), Literal::usize_unsuffixed(context.state.len()));
    let held = holds.then(|| {
        quote! {
            const HOLDS: ::core::primitive::bool = true;
            #[inline]
            fn held_equations(&self, #t: #scalar, #state: &#state_type) -> #runtime::Held<#state_type> {
                #runtime::Holding::held(self, #t, #state)
            }
            #[inline]
            fn residuals(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #n] {
                #runtime::Holding::equations(self, #t, #state)
            }
        }
    });
    let body = quote! {
        #[inline]
        fn energy_gradient(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #n] { #gradient }
        #[inline]
        fn almost_poisson(
            &self, #t: #scalar, #state: &#state_type, #covector: &[#scalar; #n]
        ) -> [#scalar; #n] {
            #sharp
        }
        #held
    };
    context.implement(&quote!(#runtime::AlmostPoisson), &body)
}

//! Discrete Lagrange–d'Alembert equations, and invariants with their gradients, for the methods that
//! take them.

use nonholonomic_core::model::Request;
use nonholonomic_core::phase_space::StepForm;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Part, drops_of};
use super::layout::local;
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The traits `Leapfrog` and `EulerPoincareSuslov`, as far as they are asked for.
pub(super) fn emit(context: &Context, system: &System) -> Part {
    let found = &system.phase_space;
    let mut part = Part::default();
    for (kind, form) in
        [(Kind::Leapfrog, &found.leapfrog), (Kind::EulerPoincareSuslov, &found.euler_poincare_suslov)]
    {
        let Some(StepForm { length, map }) = form else { continue };
        let name = local("length");
        let scope = Scope::new(context, &system.model, &system.state()).with_places(
            Argument::Length,
            &[*length],
            vec![quote!(#name)],
        );
        let program = context.lowering.program(&system.model, map);
        let body = body(context, &scope, &program);
        let mut drops = drops_of(context, &[Argument::This, Argument::State], &body.used);
        if !body.used.contains(&Argument::Length) {
            drops.extend(quote!(_ = #name;));
        }
        let statements = &body.statements;
        let result = match kind {
            Kind::Leapfrog => {
                let places = context.state.places(&context.locals.state);
                let kept = places.len().saturating_sub(body.outputs.len());
                let components = [&places[..kept], body.outputs.as_slice()].concat();
                context.state.construct(&context.state_name(), &components)
            }
            Kind::EulerPoincareSuslov => {
                let outputs = body.outputs.iter().map(element);
                quote!([#(#outputs),*])
            }
        };
        part.items.extend(kind.implementation(context, &quote!(#drops #statements #result)));
        part.programs.push((kind.function(), program));
    }
    part
}

/// The same items with nothing in them.
pub(super) fn stub(context: &Context, requests: &[Request]) -> Part {
    let mut part = Part::default();
    let kinds =
        [(Request::Leapfrog, Kind::Leapfrog), (Request::EulerPoincareSuslov, Kind::EulerPoincareSuslov)];
    for (_, kind) in kinds.into_iter().filter(|(request, _)| requests.contains(request)) {
        let (state, length) = (&context.locals.state, local("length"));
        let nothing = quote!(_ = (self, #state, #length); ::core::default::Default::default());
        part.items.extend(kind.implementation(context, &nothing));
    }
    part
}

#[derive(Clone, Copy)]
enum Kind {
    Leapfrog,
    EulerPoincareSuslov,
}

impl Kind {
    fn function(self) -> &'static str {
        match self {
            Self::Leapfrog => "kick",
            Self::EulerPoincareSuslov => "discrete_momentum",
        }
    }

    fn implementation(self, context: &Context, body: &TokenStream) -> TokenStream {
        let Context { runtime, scalar, .. } = context;
        let (state, state_type) = (&context.locals.state, context.type_of(&context.state));
        let (length, n) = (local("length"), Literal::usize_unsuffixed(context.state.len()));
        match self {
            Self::Leapfrog => {
                let method = quote! {
                    #[inline]
                    fn kick(&self, #state: &#state_type, #length: #scalar) -> #state_type { #body }
                };
                context.implement(&quote!(#runtime::Leapfrog), &method)
            }
            Self::EulerPoincareSuslov => {
                let method = quote! {
                    #[inline]
                    fn discrete_momentum(&self, #state: &#state_type, #length: #scalar) -> [#scalar; #n] {
                        #body
                    }
                };
                context.implement(&quote!(#runtime::EulerPoincareSuslov), &method)
            }
        }
    }
}

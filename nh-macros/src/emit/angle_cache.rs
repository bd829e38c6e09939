//! The derivative with sines and cosines from angles at hand.

use std::collections::BTreeSet;

use nonholonomic_core::model::Request;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::inherent_method::{Part, drops};
use super::layout::local;
use super::motion::inlining;
use super::program::body_near_angles;
use super::setting::{Context, copy_of_parameters};
use super::symbols::Scope;

/// `AngleCachedSleigh` and `with_angle_cache`, if they are asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System, derivative: &Program) -> Part {
    if !system.model.requests.iter().any(|(asked, _)| *asked == Request::AngleCache) {
        return Part::default();
    }
    let angles = local("angles");
    let (body, count) = body_near_angles(context, scope, derivative, &angles);
    let name = &context.state.name;
    let result = context.state.construct(&quote!(#name), &body.outputs);
    let (statements, drops) = (&body.statements, drops(context, &body.used, true));
    let unused = (count == 0).then(|| quote!(_ = #angles;));
    items(context, count, &inlining(derivative), &quote!(#drops #unused #statements #result))
}

/// The same items with zeros.
pub(super) fn stub(context: &Context) -> Part {
    let angles = local("angles");
    let drops = drops(context, &BTreeSet::new(), true);
    items(context, 0, &quote!(#[inline]), &quote!(#drops _ = #angles; ::core::default::Default::default()))
}

/// The name of the type, `impl AngleCache`, and the method that makes one.
fn items(context: &Context, count: usize, inlining: &TokenStream, derivative: &TokenStream) -> Part {
    let Context { runtime, scalar, visibility, layout, lints, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let name = &layout.name;
    let cached = format_ident!("AngleCached{name}");
    let (_, ty_generics, _) = context.generics.split_for_impl();
    let parameters = context.parameters_of_alias();
    let (length, angles) = (Literal::usize_unsuffixed(count), local("angles"));
    let doc = format!(" [`{name}`] with the sines and cosines of its angles at hand.");
    // angles are compared: lanes have no order
    let is_real = context.parameter().map(|parameter| quote!(where #parameter: #runtime::Real));
    let copy = copy_of_parameters(context);
    let methods = quote! {
        /// The same system, which takes sines and cosines from those of angles nearby.
        #[must_use]
        #[inline]
        #visibility fn with_angle_cache(&self) -> #runtime::AngleCached<Self> #is_real {
            #runtime::AngleCached::new(#copy)
        }
    };
    let implementation = context.implement_for_reals(
        &quote!(#runtime::AngleCache),
        &quote! {
            type Angles = [#runtime::Angle<#scalar>; #length];
            #[inline]
            fn angles_at_zero() -> Self::Angles {
                [#runtime::Angle::zero(); #length]
            }
            #inlining
            fn derivative_near(
                &self, #angles: &mut Self::Angles, #t: #scalar, #state: &#state_type, #input: &#input_type
            ) -> #state_type {
                #derivative
            }
        },
    );
    let items = quote! {
        #[doc = #doc]
        #lints
        #visibility type #cached #parameters = #runtime::AngleCached<#name #ty_generics>;
        #implementation
    };
    Part { methods, items, programs: Vec::new() }
}

//! What is emitted beside errors, so that nothing but the errors shows: the same items, without
//! the derived equations.

use std::collections::BTreeSet;

use nh_core::id::SymbolId;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::Head;
use super::layout::Layout;
use super::{callback, dynamics, energy, observed, report, state, validate, velocity};

/// The struct with the items that its declaration would have given it, as far as it is understood.
/// `kept` is the best guess of the velocities in the state.
pub(crate) fn stubs(layout: &Layout, kept: &[SymbolId]) -> TokenStream {
    let declared: usize = layout.velocities.iter().map(|family| family.entries().len()).sum();
    let declared = layout.velocity_symbols.get(..declared).unwrap_or_default();
    let context = &Context::new(layout, kept, declared);
    let runtime = &context.runtime;
    let scalar = &context.scalar;
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let default = quote!(::core::default::Default::default());
    let stub = |head: Head, value: &TokenStream| head.with_body(context, &BTreeSet::new(), value);
    let mut methods = report::with_text(context, "");
    methods.extend(stub(dynamics::head(context), &default));
    methods.extend(stub(energy::head(context), &zero));
    methods.extend(stub(velocity::head(context), &default));
    methods.extend(validate::with_body(context, &TokenStream::new()));
    let mut items = report::item(context, &[]);
    items.extend(super::records(context));
    items.extend(state::emit(context));
    items.extend(dynamics::implementation(context, &TokenStream::new()));
    items.extend(energy::implementation(context));
    if let Some(outputs) = &context.outputs {
        methods.extend(stub(observed::head(context, outputs), &default));
        items.extend(observed::implementation(context, outputs));
    }
    items.extend(context.inherent(&methods));
    items.extend(callback::emit(context));
    items
}

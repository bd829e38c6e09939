//! The rates of coordinates that Routh reduction leaves to quadratures.

use nh_core::system::System;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::context::{Context, coordinate_fields};
use super::function::{Head, Part, program};
use super::program::body;
use super::record::Record;
use super::scope::Scope;

/// The inherent method `quadratures` with its struct, if coordinates have left the state.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(quadratures) = &system.quadratures else { return Part::default() };
    let layout = context.layout;
    let record = Record {
        name: layout.types.quadratures.clone(),
        doc: format!("The rates of the coordinates that are not in the state of [`{}`].", layout.name),
        fields: coordinate_fields(layout, &quadratures.coordinates),
    };
    let program = program(&system.model, &quadratures.rates);
    let body = body(context, scope, &program);
    let result = record.construct(&record.name.to_token_stream(), &body.outputs);
    let statements = &body.statements;
    let head = Head {
        name: "quadratures",
        doc: &[" The rates of the coordinates that are not in the state: quadratures give these back."],
        takes_input: false,
        returns: context.type_of(&record),
    };
    let methods: TokenStream = head.with_body(context, &body.used, &quote!(#statements #result));
    Part { methods, items: record.emit(context), programs: vec![("quadratures", program)] }
}

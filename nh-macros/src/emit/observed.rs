//! The declared observables.

use nonholonomic_core::program::Program;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::Head;
use super::program::body;
use super::record::Record;
use super::scope::Scope;

/// The head of `outputs`.
pub(super) fn head(context: &Context, outputs: &Record) -> Head {
    Head {
        name: "outputs",
        doc: &[" The observables at a state."],
        takes_input: true,
        returns: context.type_of(outputs),
    }
}

/// The inherent method `outputs`.
pub(super) fn method(context: &Context, outputs: &Record, scope: &Scope, program: &Program) -> TokenStream {
    let body = body(context, scope, program);
    let name = &outputs.name;
    let result = outputs.construct(&quote!(#name), &body.outputs);
    let statements = &body.statements;
    head(context, outputs).with_body(context, &body.used, &quote!(#statements #result))
}

/// `impl Observed for Sleigh`.
pub(super) fn implementation(context: &Context, outputs: &Record) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let outputs = context.type_of(outputs);
    let body = quote! {
        type Outputs = #outputs;
        #[inline]
        fn outputs(&self, #t: #scalar, #state: &#state_type, #input: &#input_type) -> #outputs {
            Self::outputs(self, #t, #state, #input)
        }
    };
    context.implement(&quote!(#runtime::Observed), &body)
}

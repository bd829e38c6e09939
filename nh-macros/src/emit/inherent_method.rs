//! The inherent methods that programs become.

use std::collections::BTreeSet;

use nonholonomic_core::program::Program;
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream};
use quote::quote;

use super::setting::Context;
use super::symbols::Argument;

/// The head of a method of time, state, and perhaps input.
pub(super) struct Head {
    pub(super) name: &'static str,
    /// Its documentation, a line each.
    pub(super) doc: &'static [&'static str],
    pub(super) takes_input: bool,
    pub(super) returns: TokenStream,
}

impl Head {
    /// The method; arguments that are not in `used` are dropped first.
    pub(super) fn with_body(
        &self,
        context: &Context,
        used: &BTreeSet<Argument>,
        body: &TokenStream,
    ) -> TokenStream {
        self.with_inlining(context, used, body, &quote!(#[inline]))
    }

    /// The same with a hint of its own, or an order, to be put in line.
    pub(super) fn with_inlining(
        &self,
        context: &Context,
        used: &BTreeSet<Argument>,
        body: &TokenStream,
        inlining: &TokenStream,
    ) -> TokenStream {
        let argument = (Argument::State, context.locals.state.clone(), context.type_of(&context.state));
        let Self { name, doc, takes_input, ref returns } = *self;
        let signature = Signature { name, doc, argument, takes_input, returns: returns.clone() };
        signature.with_inlining(context, used, body, inlining)
    }
}

/// The head of a method of time, one more argument, and perhaps input.
pub(super) struct Signature {
    pub(super) name: &'static str,
    /// Its documentation, a line each.
    pub(super) doc: &'static [&'static str],
    /// What it takes, by reference.
    pub(super) argument: (Argument, Ident, TokenStream),
    pub(super) takes_input: bool,
    pub(super) returns: TokenStream,
}

impl Signature {
    /// The method; arguments that are not in `used` are dropped first.
    pub(super) fn with_body(
        &self,
        context: &Context,
        used: &BTreeSet<Argument>,
        body: &TokenStream,
    ) -> TokenStream {
        self.with_inlining(context, used, body, &quote!(#[inline]))
    }

    fn with_inlining(
        &self,
        context: &Context,
        used: &BTreeSet<Argument>,
        body: &TokenStream,
        inlining: &TokenStream,
    ) -> TokenStream {
        let Context { visibility, scalar, .. } = context;
        let (t, input) = (&context.locals.t, &context.locals.input);
        let input_type = context.input_type();
        let input_parameter = self.takes_input.then(|| quote!(, #input: &#input_type));
        let Self { doc, returns, argument: (argument, ident, of_type), .. } = self;
        let mut drops = drops_of(context, &[Argument::This, Argument::Time], used);
        if !used.contains(argument) {
            drops.extend(quote!(_ = #ident;));
        }
        if self.takes_input {
            drops.extend(drops_of(context, &[Argument::Input], used));
        }
        let name = Ident::new(self.name, Span::call_site());
        let block = block(drops, body);
        quote! {
            #(#[doc = #doc])*
            #[must_use]
            #inlining
            #visibility fn #name(&self, #t: #scalar, #ident: &#of_type #input_parameter) -> #returns #block
        }
    }
}

/// Statements in braces. A group takes tokens as they are, where quoting them copies each.
fn block(mut first: TokenStream, rest: &TokenStream) -> Group {
    if first.is_empty() {
        return Group::new(Delimiter::Brace, rest.clone());
    }
    first.extend(rest.clone());
    Group::new(Delimiter::Brace, first)
}

/// `_ = t;` for those of some arguments that are not in `used`.
pub(super) fn drops_of(context: &Context, arguments: &[Argument], used: &BTreeSet<Argument>) -> TokenStream {
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let unused = arguments.iter().filter(|argument| !used.contains(argument));
    unused
        .map(|argument| match argument {
            Argument::This => quote!(_ = self;),
            Argument::Time => quote!(_ = #t;),
            Argument::State => quote!(_ = #state;),
            Argument::Input => quote!(_ = #input;),
            _ => TokenStream::new(),
        })
        .collect()
}

/// `_ = state;` for every parameter that is not in `used`.
pub(super) fn drops(context: &Context, used: &BTreeSet<Argument>, takes_input: bool) -> TokenStream {
    let arguments = [Argument::This, Argument::Time, Argument::State, Argument::Input];
    drops_of(context, if takes_input { &arguments } else { &arguments[..3] }, used)
}

/// What one emitter contributes.
#[derive(Default)]
pub(super) struct Part {
    /// Inherent methods.
    pub(super) methods: TokenStream,
    /// Items beside the struct.
    pub(super) items: TokenStream,
    /// What the methods compute, by their names: for the report.
    pub(super) programs: Vec<(&'static str, Program)>,
}

impl Part {
    /// The contributions of both.
    pub(super) fn with(mut self, other: Self) -> Self {
        self.methods.extend(other.methods);
        self.items.extend(other.items);
        self.programs.extend(other.programs);
        self
    }
}

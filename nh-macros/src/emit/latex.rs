//! `emit { latex }`: the declaration and what was derived, in the notation of papers.

use nonholonomic_core::report::latex::document;
use nonholonomic_core::system::System;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use syn::LitStr;

use super::layout::plain;
use super::report_text::{is_doc, split_attributes};
use super::setting::Context;

/// `const LATEX`, if it is asked for.
pub(super) fn constant(context: &Context, system: &System) -> TokenStream {
    let Some(sections) = &system.latex else { return TokenStream::new() };
    let title = plain(&context.layout.name);
    with_text(context, &document(&title, &documentation(context.layout.item.clone()), sections))
}

/// `const LATEX` with this text.
pub(super) fn with_text(context: &Context, text: &str) -> TokenStream {
    let visibility = &context.visibility;
    quote! {
        /// The declaration and what was derived from it, in TeX. Written to a file it compiles by itself, with
        /// pdflatex and amsmath; in another document that loads amsmath, `\\input` puts its text there.
        #visibility const LATEX: &'static ::core::primitive::str = #text;
    }
}

/// What the user says about the struct, line by line.
fn documentation(item: TokenStream) -> String {
    let (attributes, _) = split_attributes(item);
    let mut lines = String::new();
    for attribute in attributes.iter().filter(|token| is_doc(token)) {
        let TokenTree::Group(group) = attribute else { continue };
        let text = group.stream().into_iter().find_map(|token| match token {
            TokenTree::Literal(literal) => syn::parse_str::<LitStr>(&literal.to_string()).ok(),
            _ => None,
        });
        lines.extend(text.map(|text| text.value() + "\n"));
    }
    lines
}

//! `REPORT`, and the equations in the documentation of the struct.

use nonholonomic_core::model::Request;
use nonholonomic_core::program::{Cost, Program};
use nonholonomic_core::system::System;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::quote;

use super::line_breaks::broken;
use super::lint::allow_for;
use super::setting::Context;

/// `const REPORT`, with the operation counts of the named programs.
pub(super) fn constant(context: &Context, system: &System, programs: &[(&str, &Program)]) -> TokenStream {
    let mut text = system.report.trim_end().to_owned();
    let open = context.lowering.divided_by_roots();
    if system.derivatives_go_on && !open.is_empty() {
        text.push_str("\n\nDerivatives that may have no value where a root in the forces vanishes\n  ");
        text.push_str(&open.join(", "));
    }
    text.push_str("\n\nOperations per evaluation:\n");
    for (name, program) in programs {
        let cost = Cost::of(program);
        text.extend(["  ", name, ": ", &cost.to_string(), "\n"]);
    }
    with_text(context, text.trim_start())
}

/// `const REPORT` with this text.
pub(super) fn with_text(context: &Context, text: &str) -> TokenStream {
    let visibility = &context.visibility;
    quote! {
        /// What was derived from the declaration, as text.
        #visibility const REPORT: &'static ::core::primitive::str = #text;
    }
}

/// `const DERIVATION`, if it is asked for.
pub(super) fn derivation(context: &Context, system: &System) -> TokenStream {
    let is_asked = system.model.requests.iter().any(|(request, _)| *request == Request::Explain);
    if is_asked {
        derivation_with(context, &(system.ledger.to_string() + &context.lowering.text()))
    } else {
        TokenStream::new()
    }
}

/// `const DERIVATION` with this text.
pub(super) fn derivation_with(context: &Context, text: &str) -> TokenStream {
    let visibility = &context.visibility;
    quote! {
        /// How the forms of the emitted functions were chosen: what competed, its cost and its rounding errors, how
        /// the winner was proved, and why the others lost.
        #visibility const DERIVATION: &'static ::core::primitive::str = #text;
    }
}

/// The struct: after the user's documentation, its equations.
pub(super) fn item(context: &Context, equations: &[String]) -> TokenStream {
    let (attributes, rest) = split_attributes(context.layout.item.clone());
    let mut lines = Vec::new();
    if !equations.is_empty() {
        // a blank line behind the user's documentation
        if attributes.iter().any(is_doc) {
            lines.push(String::new());
        }
        lines.extend([" # Equations of motion", "", " ```text"].map(str::to_owned));
        let parts = equations.iter().flat_map(|line| broken(line));
        lines.extend(parts.map(|line| format!(" {line}").trim_end().to_owned()));
        lines.push(" ```".to_owned());
    }
    let allow = allow_for(context.layout.parameters.iter().map(|family| &family.ident));
    let (attributes, rest) = (attributes.into_iter(), rest.into_iter());
    // what the user writes comes later and prevails: an expectation of theirs is met
    quote!(#allow #(#attributes)* #(#[doc = #lines])* #(#rest)*)
}

/// The tokens of the attributes of an item, and the others.
pub(super) fn split_attributes(item: TokenStream) -> (Vec<TokenTree>, Vec<TokenTree>) {
    let mut tokens: Vec<TokenTree> = item.into_iter().collect();
    let mut end = 0;
    while let [TokenTree::Punct(pound), TokenTree::Group(group), ..] = &tokens[end..] {
        if pound.as_char() != '#' || group.delimiter() != Delimiter::Bracket {
            break;
        }
        end += 2;
    }
    let rest = tokens.split_off(end);
    (tokens, rest)
}

/// Whether this is the bracket of a doc attribute.
pub(super) fn is_doc(token: &TokenTree) -> bool {
    let TokenTree::Group(group) = token else { return false };
    matches!(group.stream().into_iter().next(), Some(TokenTree::Ident(ident)) if ident == "doc")
}

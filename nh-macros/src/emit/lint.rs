//! The lints that a user's names and attributes would trigger in generated code.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::quote;
use syn::{Attribute, Meta};

use super::layout::plain;
use super::setting::respan;

/// Whether the compiler accepts a name for a field or a variable.
pub(super) fn is_snake_case(name: &str) -> bool {
    let trimmed = name.trim_matches('_');
    !trimmed.contains("__") && !trimmed.chars().any(char::is_uppercase)
}

/// The attribute that a struct with fields of such names needs, if any: capitals are the field's custom,
/// and a parameter or a velocity is used whatever its first character.
pub(super) fn allow_for<'a>(idents: impl Iterator<Item = &'a Ident>) -> TokenStream {
    let names: Vec<String> = idents.map(plain).collect();
    let mut lints = Vec::new();
    if names.iter().any(|name| !is_snake_case(name)) {
        lints.push(quote!(non_snake_case));
    }
    if names.iter().any(|name| name.starts_with('_')) {
        lints.push(quote!(clippy::pub_underscore_fields));
    }
    if lints.is_empty() { TokenStream::new() } else { quote!(#[allow(#(#lints),*)]) }
}

/// The attributes of all items that name a struct with such attributes, on itself or on its fields.
///
/// What the user allows or expects there holds for what is generated from it as well, and what is
/// deprecated may be named by that. Nothing else is allowed.
pub(super) fn inherited(attributes: &[Attribute]) -> TokenStream {
    let mut seen = BTreeSet::new();
    let metas = attributes.iter().filter_map(|attribute| of_meta(&attribute.meta));
    let metas = metas.filter(|meta| seen.insert(meta.to_string()));
    metas.map(|meta| respan(quote!(#[#meta]))).collect()
}

/// What one attribute means for generated items.
fn of_meta(meta: &Meta) -> Option<TokenStream> {
    if meta.path().is_ident("deprecated") {
        return Some(quote!(allow(deprecated)));
    }
    let Meta::List(list) = meta else { return None };
    let tokens: Vec<TokenTree> = list.tokens.clone().into_iter().collect();
    let is_comma = |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ',');
    let mut parts = tokens.split(is_comma).map(|part| part.iter().cloned().collect::<TokenStream>());
    if list.path.is_ident("allow") {
        return Some(quote!(allow(#(#parts),*)));
    }
    if list.path.is_ident("expect") {
        // unused code that is allowed counts as a use of what it names, and the expectation would fail
        let is_about_use = |part: &TokenStream| ["dead_code", "unused"].contains(&part.to_string().as_str());
        let parts = parts.filter(|part| !is_about_use(part));
        return Some(quote!(allow(#(#parts),*)));
    }
    if !list.path.is_ident("cfg_attr") {
        return None;
    }
    let condition = parts.next()?;
    let metas: Vec<TokenStream> = parts.filter_map(|part| of_meta(&syn::parse2(part).ok()?)).collect();
    (!metas.is_empty()).then(|| quote!(cfg_attr(#condition, #(#metas),*)))
}

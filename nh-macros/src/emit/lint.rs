//! The lints that a user's names would trigger in generated code.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::layout::plain;

/// Whether the compiler accepts a name for a field or a variable.
pub(super) fn is_snake_case(name: &str) -> bool {
    let trimmed = name.trim_matches('_');
    !trimmed.contains("__") && !trimmed.chars().any(char::is_uppercase)
}

/// The attribute that fields with such names need, if any.
pub(super) fn allow_for<'a>(mut idents: impl Iterator<Item = &'a Ident>) -> TokenStream {
    if idents.any(|ident| !is_snake_case(&plain(ident))) {
        quote!(#[allow(non_snake_case)])
    } else {
        TokenStream::new()
    }
}

//! The hidden macro that hands a declaration on, so that another macro can read it by the path of
//! the struct: beside `Sleigh` stands `__nh_declaration_Sleigh`.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use super::layout::plain;
use super::setting::Context;

/// The macro and its alias.
///
/// A `macro_rules!` macro that is exported lives at the root of its crate, so its name has a hash;
/// the alias lives beside the struct, and is as visible as it is. The empty call keeps both from
/// being reported as unused.
pub(super) fn emit(context: &Context) -> TokenStream {
    let layout = context.layout;
    let name = plain(&layout.name);
    let (attribute, item) = (&layout.attribute, &layout.written);
    let is_public = matches!(layout.visibility, syn::Visibility::Public(_));
    // a public struct in the body of a function is no reason to warn
    let export = is_public.then(|| quote!(#[allow(non_local_definitions)] #[macro_export]));
    let visibility = &context.visibility;
    let hash = fingerprint(&format!("{name} {attribute} {item} {}", place()));
    let hidden = format_ident!("__nh_declaration_{name}_{hash:016x}", span = Span::call_site());
    let alias = alias(&name);
    quote! {
        #[doc(hidden)]
        #export
        macro_rules! #hidden {
            () => {};
            ($callback:path, { $($rest:tt)* }) => {
                $callback! { declaration { { #attribute } { #item } } $($rest)* }
            };
        }
        #[doc(hidden)]
        #visibility use #hidden as #alias;
        #alias! {}
    }
}

/// The name beside the struct.
pub(crate) fn alias(name: &str) -> Ident {
    format_ident!("__nh_declaration_{name}", span = Span::call_site())
}

/// Where the declaration stands, so that equal ones differ; nothing outside a compiler.
fn place() -> String {
    if proc_macro::is_available() {
        let span = proc_macro::Span::call_site();
        format!("{} {} {}", span.file(), span.line(), span.column())
    } else {
        String::new()
    }
}

/// The FNV-1a hash: the same everywhere and always.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

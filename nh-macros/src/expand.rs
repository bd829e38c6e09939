//! The stages in order, and what is emitted when one of them fails.

use proc_macro2::TokenStream;
use quote::quote;

use crate::report::{Diagnostic, compile_errors};
use crate::syntax;

/// The expansion of the attribute. On error: the errors, and the item as if it had no attribute.
pub(crate) fn nonholonomic(attribute: TokenStream, item: TokenStream) -> TokenStream {
    match stages(attribute, item.clone()) {
        Ok(tokens) => tokens,
        Err(errors) => {
            let errors = compile_errors(&errors);
            let item = syntax::without_own_attributes(item);
            quote!(#errors #item)
        }
    }
}

/// From tokens to tokens.
fn stages(attribute: TokenStream, item: TokenStream) -> Result<TokenStream, Vec<Diagnostic>> {
    let declaration = syntax::parse(attribute, item)?;
    Ok(declaration.structure.item)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(attribute: &str, item: &str) -> String {
        let tokens = nonholonomic(attribute.parse().unwrap(), item.parse().unwrap());
        prettyplease::unparse(&syn::parse2(tokens).unwrap())
    }

    #[test]
    fn the_item_is_emitted_without_our_attributes() {
        assert_eq!(
            expanded(
                "base { x } lagrangian { m / 2 * der(x)^2 }",
                "#[derive(Clone)] struct S { /// mass\n m: f64, #[nh(skip)] tag: u8 }"
            ),
            "#[derive(Clone)]\nstruct S {\n    /// mass\n    m: f64,\n    tag: u8,\n}\n"
        );
    }

    #[test]
    fn errors_come_with_the_item() {
        let text = expanded("base { x } lagrangian { 2x }", "struct S { #[nh(skip)] tag: u8 }");
        assert!(text.starts_with("::core::compile_error! {"), "{text}");
        assert!(text.ends_with("struct S {\n    tag: u8,\n}\n"), "{text}");
    }
}

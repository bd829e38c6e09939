//! The attribute macro `#[nonholonomic(…)]`: the declaration of a nonholonomic mechanical system
//! becomes verified code. Tokens come in and go out here; the mathematics is in `nh-core`.

mod emit;
mod expand;
mod report;
mod resolve;
mod suggest;
mod syntax;

/// Derives the equations of motion of the declared system for the annotated struct.
#[proc_macro_attribute]
pub fn nonholonomic(
    attribute: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    expand::nonholonomic(attribute.into(), item.into()).into()
}

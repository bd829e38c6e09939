//! Stage 1, parse: tokens to [`ast::SystemDecl`].
//!
//! After this point the grammar is right, names are unresolved, and every node has its extent.

#[allow(dead_code, reason = "the next stage reads it")]
pub(crate) mod ast;
mod check;
mod expr;
mod habits;
mod items;
pub(crate) mod limits;
mod lines;
mod names;
mod number;
mod render;
mod sections;
mod stream;
mod structure;
pub(crate) mod vocabulary;

#[cfg(test)]
mod expr_tests;
#[cfg(test)]
mod fuzz_tests;
#[cfg(test)]
mod section_tests;
#[cfg(test)]
mod structure_tests;
#[cfg(test)]
pub(crate) mod testing;

use proc_macro2::{Span, TokenStream};

pub(crate) use structure::without_own_attributes;

use crate::report::{Diagnostic, Errors, Extent};

/// Reads the attribute and its item.
pub(crate) fn parse(attribute: TokenStream, item: TokenStream) -> Result<ast::SystemDecl, Vec<Diagnostic>> {
    let mut errors = Errors::new();
    let structure = structure::structure(item, &mut errors);
    let around = structure.as_ref().map_or(Span::call_site(), |structure| structure.name.span());
    let sections = sections::sections(attribute, Extent::at(around), &mut errors);
    let structure = errors.finish(structure)?;
    // without a struct there was an error, and the fence is closed
    let Some(structure) = structure else { return Err(Vec::new()) };
    check::check(ast::SystemDecl { structure, sections })
}

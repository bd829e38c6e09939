//! Stage 1, parse: tokens to [`ast::SystemDecl`].
//!
//! After this point the grammar is right, names are unresolved, and every node has its extent.

#[allow(dead_code, reason = "the next stage reads it")]
pub(crate) mod ast;
mod check;
mod expr;
mod habits;
mod impact_lines;
mod items;
pub(crate) mod limits;
mod lines;
pub(crate) mod map_syntax;
mod names;
mod number;
pub(crate) mod quotient_syntax;
mod render;
mod sections;
mod stream;
mod structure;
mod too_large;
mod units;
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

pub(crate) use names::is_mark;
pub(crate) use structure::without_own_attributes;

use crate::report::{Diagnostic, Errors, Extent};

/// A declaration in error.
#[derive(Debug)]
pub(crate) struct Malformed {
    /// What is wrong.
    pub(crate) errors: Vec<Diagnostic>,
    /// What could be read, if the item is a struct: what stubs are made of.
    pub(crate) rest: Option<Box<ast::SystemDecl>>,
}

/// Reads the attribute and its item.
pub(crate) fn parse(attribute: TokenStream, item: TokenStream) -> Result<ast::SystemDecl, Malformed> {
    let mut errors = Errors::new();
    let structure = structure::structure(item, &mut errors);
    let around = structure.as_ref().map_or(Span::call_site(), |structure| structure.name.span());
    let sections = sections::sections(attribute, Extent::at(around), &mut errors);
    let declaration = structure.map(|structure| ast::SystemDecl { structure, sections });
    // without a struct there was an error, and the fence is closed
    let checked = errors.finish(()).and_then(|()| declaration.as_ref().map_or(Ok(()), check::check));
    match (checked, declaration) {
        (Ok(()), Some(declaration)) => Ok(declaration),
        (checked, rest) => {
            Err(Malformed { errors: checked.err().unwrap_or_default(), rest: rest.map(Box::new) })
        }
    }
}

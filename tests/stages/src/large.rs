//! Declarations of any size: honest ones, and such as nobody writes who means well. For each there is a size
//! at which a derivation that squares or multiplies out what it is given would not come to an end.

mod bundles;
mod chains;
mod expressions;
mod requests;
mod spatial_arms;

use crate::{Declaration, declarations};

/// A family of declarations that grow.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name in tables and tests.
    pub name: &'static str,
    /// The source text of the member of a size.
    pub source: fn(usize) -> String,
    /// Sizes from ordinary to absurd.
    pub sizes: &'static [usize],
}

impl Family {
    /// The declaration of a size.
    ///
    /// # Panics
    /// If the source text of the family is no declaration.
    #[must_use]
    pub fn member(&self, size: usize) -> Declaration {
        declarations(&(self.source)(size)).pop().expect("a declaration")
    }
}

/// Every family.
pub fn families() -> impl Iterator<Item = Family> {
    [expressions::FAMILIES, bundles::FAMILIES, chains::FAMILIES, spatial_arms::FAMILIES, requests::FAMILIES]
        .into_iter()
        .flatten()
        .copied()
}

/// A declaration with these sections and fields.
fn declared(sections: &str, fields: &str) -> String {
    format!("#[nonholonomic({sections})] pub struct Large {{ {fields} }}")
}

/// The texts of these numbers, one after the other.
fn joined(count: usize, text: impl Fn(usize) -> String) -> String {
    (0..count).map(text).collect()
}

/// The texts of these numbers with something between them.
fn separated(count: usize, separator: &str, text: impl Fn(usize) -> String) -> String {
    (0..count).map(text).collect::<Vec<_>>().join(separator)
}

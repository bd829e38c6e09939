//! The stages of the macro outside a compiler.
//!
//! A procedural macro exports nothing but macros, so its stages are compiled into this library: tests,
//! benchmarks and programs that watch a derivation run them on declarations as text. Tokens are those of
//! `proc-macro2`, whose spans know lines and columns.

extern crate proc_macro;

mod collected;
mod declarations;
mod judge;
mod large;
mod mutate;
mod record;
mod relations;
mod tokens;

#[path = "../../../nh-macros/src/derived_outline.rs"]
mod derived_outline;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/emit/mod.rs"]
mod emit;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/expand.rs"]
mod expand;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/morphism.rs"]
mod morphism;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/quotient.rs"]
mod quotient;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/report.rs"]
mod report;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/resolve/mod.rs"]
mod resolve;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/suggest.rs"]
mod suggest;
#[allow(dead_code, unused_imports, reason = "the back end is the macro's")]
#[path = "../../../nh-macros/src/syntax/mod.rs"]
mod syntax;

pub use collected::{collected, collected_relations};
pub use declarations::{Declaration, declarations};
pub use judge::{Defect, Verdict, judged, judged_relation};
pub use large::{Family, families};
pub use mutate::{Collection, Random, minimised, minimised_relation};
use nonholonomic_core::compile::compile_with;
use nonholonomic_core::forms::Registry;
use nonholonomic_core::model::Model;
use nonholonomic_core::system::System;
use proc_macro2::TokenStream;
use quote::quote;
pub use record::{arms, bicycle, record, references, whole_record};
pub use relations::{Relation, relations};
pub use tokens::{constant, errors, length};

use emit::Layout;
use syntax::Malformed;

impl Declaration {
    /// What the macro makes of it: the generated items, or errors and stubs.
    #[must_use]
    pub fn expanded(&self) -> TokenStream {
        expand::nonholonomic(self.attribute.clone(), self.item.clone())
    }

    /// What `quotient!` makes of this system and what is written between its braces.
    #[must_use]
    pub fn quotient(&self, written: &TokenStream) -> TokenStream {
        let full = self.handed_over();
        quotient::quotient(quote!(#full #written))
    }

    /// What `morphism!` makes of this system, another one, and what is written between its braces.
    #[must_use]
    pub fn morphism(&self, target: &Self, written: &TokenStream) -> TokenStream {
        let (source, target) = (self.handed_over(), target.handed_over());
        morphism::morphism(quote!(#target #source #written))
    }

    /// As the macro beside the struct hands it over.
    fn handed_over(&self) -> TokenStream {
        let (attribute, item) = (&self.attribute, &self.item);
        quote!(declaration { { #attribute } { #item } })
    }

    /// The declaration with its names resolved: what the engine reads.
    ///
    /// # Errors
    /// The messages of the errors.
    pub fn model(&self) -> Result<Model, Vec<String>> {
        self.resolved().map(|(resolved, _)| resolved.model)
    }

    /// The derived system.
    ///
    /// # Errors
    /// The messages of the errors.
    pub fn system(&self) -> Result<System, Vec<String>> {
        self.system_by(&Registry::standard())
    }

    /// The same with the forms of a registry.
    ///
    /// # Errors
    /// The messages of the errors.
    pub fn system_by(&self, registry: &Registry) -> Result<System, Vec<String>> {
        let (resolved, _) = self.resolved()?;
        let origins = resolved.origins;
        compile_with(resolved.model, registry).map_err(|violations| {
            violations.into_iter().map(|violation| origins.diagnostic(violation).to_string()).collect()
        })
    }

    fn resolved(&self) -> Result<(resolve::Resolved, Layout), Vec<String>> {
        let mut parsed = match syntax::parse(self.attribute.clone(), self.item.clone()) {
            Ok(parsed) => parsed,
            Err(Malformed { errors, .. }) => return Err(errors.iter().map(ToString::to_string).collect()),
        };
        let mut layout = Layout::of_struct(&parsed.structure, self.attribute.clone());
        match resolve::resolve(&parsed, &mut layout) {
            Ok(resolved) => Ok((resolved, layout)),
            Err(unresolved) => Err(resolve::told_of_lengths(&mut parsed, unresolved)
                .errors
                .iter()
                .map(ToString::to_string)
                .collect()),
        }
    }
}

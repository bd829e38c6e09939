//! What the macro must not do with any declaration, well-posed or not.

use crate::{Declaration, Relation, errors};
use nonholonomic_core::limits::{timed, within};
use proc_macro2::TokenStream;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Something that no declaration may lead to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Defect {
    /// The macro panics.
    Panic(String),
    /// What it emits is no list of items.
    Unreadable(String),
    /// An error that says nothing, or whose reason is left out.
    Empty(String),
    /// An error in words of the macro's own workings.
    Internal(String),
    /// More seconds of the processor than a step of work takes.
    Slow(String),
}

impl Defect {
    /// Whether another defect is of the same kind.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

/// What became of a declaration in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Code.
    Compiled,
    /// Errors.
    Refused,
    /// More work than it was given.
    TooLarge,
}

/// Expands a declaration with a limit on its work.
///
/// # Errors
/// The defect of the macro that it shows.
pub fn judged(declaration: &Declaration, work: u64) -> Result<Verdict, Defect> {
    expansion(work, || declaration.expanded())
}

/// The same for a map or a quotient.
///
/// # Errors
/// The defect of the macro that it shows.
pub fn judged_relation(relation: &Relation, work: u64) -> Result<Verdict, Defect> {
    expansion(work, || relation.expanded())
}

fn expansion(work: u64, expanded: impl Fn() -> TokenStream) -> Result<Verdict, Defect> {
    let expansion = AssertUnwindSafe(|| within(work, &expanded));
    let (expanded, seconds) = timed(|| catch_unwind(expansion));
    #[allow(clippy::cast_precision_loss, reason = "a limit needs no more digits")]
    if seconds > 20.0 + work as f64 * 1e-5 {
        return Err(Defect::Slow(format!("{seconds} s")));
    }
    let items = match expanded {
        Err(reason) => {
            let text = reason.downcast_ref::<String>().cloned();
            let text = text.or_else(|| reason.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            return Err(Defect::Panic(text.unwrap_or_default()));
        }
        Ok(Err(_)) => return Ok(Verdict::TooLarge),
        Ok(Ok(items)) => items,
    };
    let found = errors(&items);
    for message in &found {
        if message.lines().any(is_cut_off) || message.trim().is_empty() {
            return Err(Defect::Empty(message.clone()));
        }
        if ["not known here", "internal", "unwrap", "ExprId", "SymbolId", "defect of the derivation"]
            .iter()
            .any(|word| message.contains(word))
        {
            return Err(Defect::Internal(message.clone()));
        }
    }
    match syn::parse2::<syn::File>(items) {
        // a struct in error is handed on as it is written
        Err(error) if found.is_empty() => Err(Defect::Unreadable(error.to_string())),
        _ if found.is_empty() => Ok(Verdict::Compiled),
        _ => Ok(Verdict::Refused),
    }
}

/// A line that announces what does not come.
fn is_cut_off(line: &str) -> bool {
    let line = line.trim_end();
    line.is_empty()
        || line.ends_with(':')
        || line.ends_with("because")
        || line.ends_with(" =")
        || line.contains("``")
}

//! Expressions of generated code, with as few parentheses as they can be read with.

use proc_macro2::{TokenStream, TokenTree};
use quote::quote;

/// How tightly the outermost operator binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    Sum,
    Product,
    Negation,
    Atom,
}

/// An expression.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    /// Its tokens.
    pub(super) tokens: TokenStream,
    level: Level,
    /// The operations in it.
    pub(super) size: usize,
    /// Whether it is made of numbers, so that its type has to be said.
    pub(super) literal: bool,
}

impl Expression {
    /// A name, a place, a call.
    pub(super) fn atom(tokens: TokenStream, size: usize) -> Self {
        Self { tokens, level: Level::Atom, size, literal: false }
    }

    /// A literal without a suffix.
    pub(super) fn literal(tokens: TokenStream, negative: bool) -> Self {
        let level = if negative { Level::Negation } else { Level::Atom };
        Self { tokens, level, size: 0, literal: true }
    }

    fn binary(left: &Self, operator: &TokenStream, right: &Self, level: Level) -> Self {
        let (a, b) = (left.within(level), right.tightly_within(level));
        Self {
            tokens: quote!(#a #operator #b),
            level,
            size: left.size + right.size + 1,
            literal: left.literal && right.literal,
        }
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        Self::binary(self, &quote!(+), other, Level::Sum)
    }

    pub(super) fn sub(&self, other: &Self) -> Self {
        Self::binary(self, &quote!(-), other, Level::Sum)
    }

    pub(super) fn mul(&self, other: &Self) -> Self {
        Self::binary(self, &quote!(*), other, Level::Product)
    }

    pub(super) fn div(&self, other: &Self) -> Self {
        Self::binary(self, &quote!(/), other, Level::Product)
    }

    pub(super) fn neg(&self) -> Self {
        let inner = self.tightly_within(Level::Negation);
        Self { tokens: quote!(-#inner), level: Level::Negation, size: self.size + 1, literal: self.literal }
    }

    /// As a left operand.
    fn within(&self, level: Level) -> TokenStream {
        self.parenthesised(self.level < level)
    }

    /// As a right operand, or under a minus.
    fn tightly_within(&self, level: Level) -> TokenStream {
        self.parenthesised(self.level <= level)
    }

    fn parenthesised(&self, wrap: bool) -> TokenStream {
        let tokens = &self.tokens;
        if wrap { quote!((#tokens)) } else { tokens.clone() }
    }
}

/// An expression as an element of an array. Linters compare the lines of a difference there, to find
/// a comma that is missing, but generated tokens stand on no line: a difference is put in parentheses.
pub(super) fn element(tokens: &TokenStream) -> TokenStream {
    let mut operators = tokens.clone().into_iter().skip(1);
    let is_binary =
        operators.any(|token| matches!(token, TokenTree::Punct(punct) if "-*&".contains(punct.as_char())));
    if is_binary { quote!((#tokens)) } else { tokens.clone() }
}

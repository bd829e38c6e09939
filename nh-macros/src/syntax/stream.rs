//! A cursor over tokens: the ground that every parser of the language stands on.
//!
//! Invisible groups around a single token (a `macro_rules` fragment) are opened on the way in.

use proc_macro2::{Delimiter, Group, Ident, TokenStream, TokenTree};
use syn::ext::IdentExt;

use super::ast::Name;
use super::render::render;
use super::vocabulary::is_keyword;
use crate::report::{Diagnostic, Extent};

/// Tokens and a position in them.
#[derive(Debug)]
pub(crate) struct Stream {
    tokens: Vec<TokenTree>,
    at: usize,
    /// Where an error points if there is no token to point at: the enclosing group.
    around: Extent,
    /// How deeply the expression at hand is nested.
    pub(crate) depth: u32,
}

impl Stream {
    /// Over the content of something that stands at `around`.
    pub(crate) fn new(tokens: TokenStream, around: Extent) -> Self {
        Self::over(tokens.into_iter().map(open_invisible).collect(), around)
    }

    /// Over tokens that were part of another stream.
    pub(crate) fn over(tokens: Vec<TokenTree>, around: Extent) -> Self {
        Self { tokens, at: 0, around, depth: 0 }
    }

    /// Into a group.
    pub(crate) fn inside(group: &Group) -> Self {
        Self::new(group.stream(), Extent::at(group.span()))
    }

    /// Into a group within an expression.
    pub(crate) fn nested(&self, group: &Group) -> Self {
        Self { depth: self.depth, ..Self::inside(group) }
    }

    /// Everything, from the first token on.
    pub(crate) fn tokens(&self) -> &[TokenTree] {
        &self.tokens
    }

    /// What is not consumed yet.
    pub(crate) fn rest(&self) -> &[TokenTree] {
        &self.tokens[self.at..]
    }

    /// How many tokens are consumed.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// The next token.
    pub(crate) fn peek(&self) -> Option<&TokenTree> {
        self.tokens.get(self.at)
    }

    /// The token after `ahead` others.
    pub(crate) fn peek_at(&self, ahead: usize) -> Option<&TokenTree> {
        self.tokens.get(self.at + ahead)
    }

    /// The last token consumed.
    pub(crate) fn previous(&self) -> Option<&TokenTree> {
        self.at.checked_sub(1).and_then(|last| self.tokens.get(last))
    }

    /// Whether all is consumed.
    pub(crate) fn is_empty(&self) -> bool {
        self.at >= self.tokens.len()
    }

    /// Consumes a token.
    pub(crate) fn advance(&mut self) -> Option<TokenTree> {
        let token = self.tokens.get(self.at).cloned();
        self.at += usize::from(token.is_some());
        token
    }

    /// Whether the next tokens are these marks in a row.
    pub(crate) fn at_marks(&self, marks: &str) -> bool {
        marks
            .chars()
            .enumerate()
            .all(|(k, mark)| matches!(self.peek_at(k), Some(TokenTree::Punct(p)) if p.as_char() == mark))
    }

    /// Consumes these marks if they are next.
    pub(crate) fn eat(&mut self, marks: &str) -> bool {
        let found = self.at_marks(marks);
        if found {
            self.at += marks.chars().count();
        }
        found
    }

    /// Whether the next token is this word.
    pub(crate) fn at_word(&self, word: &str) -> bool {
        matches!(self.peek(), Some(TokenTree::Ident(ident)) if ident == word)
    }

    /// Whether this word is the first of all, consumed or not.
    pub(crate) fn begins_with(&self, word: &str) -> bool {
        matches!(self.tokens.first(), Some(TokenTree::Ident(ident)) if ident == word)
    }

    /// Consumes this word if it is next.
    pub(crate) fn eat_word(&mut self, word: &str) -> bool {
        let found = self.at_word(word);
        self.at += usize::from(found);
        found
    }

    /// Consumes a word if one is next, whatever it says.
    pub(crate) fn eat_ident(&mut self) -> Option<Ident> {
        let Some(TokenTree::Ident(ident)) = self.peek() else { return None };
        let ident = ident.clone();
        self.at += 1;
        Some(ident)
    }

    /// The next token if it is a group with this delimiter.
    pub(crate) fn peek_group(&self, delimiter: Delimiter) -> Option<&Group> {
        match self.peek() {
            Some(TokenTree::Group(group)) if group.delimiter() == delimiter => Some(group),
            _ => None,
        }
    }

    /// Consumes a group with this delimiter if it is next.
    pub(crate) fn eat_group(&mut self, delimiter: Delimiter) -> Option<Group> {
        let group = self.peek_group(delimiter)?.clone();
        self.at += 1;
        Some(group)
    }

    /// A name that Rust does not keep for itself. `role` says what it is the name of.
    pub(crate) fn name(&mut self, role: &str) -> Result<Name, Diagnostic> {
        let Some(TokenTree::Ident(ident)) = self.peek() else {
            return Err(self.expected(role));
        };
        let name = Name::new(ident.clone());
        name.check_word(role)?;
        self.at += 1;
        Ok(name)
    }

    /// Where the next token is, or else the last one, or else what is around.
    pub(crate) fn here(&self) -> Extent {
        self.peek().or(self.previous()).map_or(self.around, |token| Extent::at(token.span()))
    }

    /// From the token at position `start` to the last one consumed.
    pub(crate) fn since(&self, start: usize) -> Extent {
        Extent::of(self.consumed(start)).unwrap_or_else(|| self.here())
    }

    /// The tokens from position `start` to the last one consumed.
    pub(crate) fn consumed(&self, start: usize) -> &[TokenTree] {
        &self.tokens[start.min(self.at)..self.at]
    }

    /// The extent of all tokens.
    pub(crate) fn whole(&self) -> Extent {
        Extent::of(&self.tokens).unwrap_or(self.around)
    }

    /// Something else was expected here.
    pub(crate) fn expected(&self, wanted: &str) -> Diagnostic {
        let what = match (self.peek(), self.previous()) {
            (Some(TokenTree::Group(group)), _) => {
                let kind = match group.delimiter() {
                    Delimiter::Parenthesis => "parentheses",
                    Delimiter::Brace => "braces",
                    Delimiter::Bracket => "brackets",
                    Delimiter::None => "a fragment of several tokens",
                };
                format!("expected {wanted}, found {kind}")
            }
            (Some(token), _) => {
                format!("expected {wanted}, found `{}`", render(std::slice::from_ref(token)))
            }
            (None, Some(token)) => {
                format!("expected {wanted} after `{}`", render(std::slice::from_ref(token)))
            }
            (None, None) => format!("expected {wanted}, found nothing"),
        };
        Diagnostic::new(self.here(), what)
    }
}

impl Name {
    /// The name of an identifier.
    pub(crate) fn new(ident: Ident) -> Self {
        Self { text: ident.unraw().to_string(), ident }
    }

    /// Where it stands.
    pub(crate) fn extent(&self) -> Extent {
        Extent::at(self.ident.span())
    }

    /// Refuses words that Rust keeps for itself, and products written with a raised dot.
    pub(crate) fn check_word(&self, role: &str) -> Result<(), Diagnostic> {
        let word = self.ident.to_string();
        if is_keyword(&word) {
            let error = Diagnostic::new(
                self.extent(),
                format!("expected {role}, found `{word}`, a word that Rust keeps for itself"),
            )
            .about_word(&word);
            return Err(match word.as_str() {
                "_" | "self" | "Self" | "super" | "crate" | "$crate" => error.way_out("choose another name"),
                _ => error.way_out(format!("choose another name, or write `r#{word}`")),
            });
        }
        if word.contains('·') {
            let product = word.split('·').collect::<Vec<_>>().join(" * ");
            return Err(Diagnostic::new(
                self.extent(),
                format!("`{word}` is a single name to Rust, not a product"),
            )
            .way_out(format!("write `{}`", product.trim_matches([' ', '*']))));
        }
        Ok(())
    }
}

/// Opens invisible groups as long as they hold a single token.
fn open_invisible(mut token: TokenTree) -> TokenTree {
    while let TokenTree::Group(group) = &token {
        if group.delimiter() != Delimiter::None {
            break;
        }
        let mut content = group.stream().into_iter();
        let (Some(only), None) = (content.next(), content.next()) else { break };
        token = only;
    }
    token
}

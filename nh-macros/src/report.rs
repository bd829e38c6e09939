//! Diagnostics: what is wrong, the evidence, and a way out, at the tokens concerned.

use std::fmt;

use proc_macro2::{Delimiter, Group, Literal, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote_spanned};

/// Errors shown at most; whoever has more fixes these first.
const SHOWN: usize = 50;

/// A range of tokens: spans cannot be joined on stable, so the first and the last are kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// The span of the first token.
    pub(crate) first: Span,
    /// The span of the last token.
    pub(crate) last: Span,
}

impl Extent {
    /// The extent of a single token.
    pub(crate) fn at(span: Span) -> Self {
        Self { first: span, last: span }
    }

    /// From the start of this extent to the end of another.
    pub(crate) fn to(self, other: Self) -> Self {
        Self { first: self.first, last: other.last }
    }

    /// The extent of tokens, if there are any.
    pub(crate) fn of(tokens: &[TokenTree]) -> Option<Self> {
        let (first, last) = (tokens.first()?, tokens.last()?);
        Some(Self { first: first.span(), last: last.span() })
    }
}

/// One error.
#[derive(Clone, Debug)]
pub(crate) struct Diagnostic {
    /// Where it points.
    pub(crate) extent: Extent,
    /// Boxed: results that carry an error stay small, and so does the stack of the parser.
    message: Box<Message>,
}

/// What an error says.
#[derive(Clone, Debug)]
struct Message {
    what: String,
    evidence: Option<String>,
    way_out: Option<String>,
    /// A word that is told of once, however often it stands.
    word: Option<String>,
}

impl Diagnostic {
    /// Something is wrong here.
    pub(crate) fn new(extent: Extent, what: impl Into<String>) -> Self {
        let message = Message { what: what.into(), evidence: None, way_out: None, word: None };
        Self { extent, message: Box::new(message) }
    }

    /// Where it points and what it says, whichever entry of a family it is about.
    pub(crate) fn of_any_entry(&self) -> (String, String) {
        let Extent { first, last } = self.extent;
        let mut what = String::new();
        for (k, part) in self.message.what.split('[').enumerate() {
            let behind =
                part.split_once(']').filter(|(index, _)| k > 0 && index.chars().all(|c| c.is_ascii_digit()));
            let separator = if k > 0 && behind.is_none() { "[" } else { "" };
            what.extend([separator, behind.map_or(part, |(_, rest)| rest)]);
        }
        (format!("{first:?} {last:?}"), what)
    }

    /// And this shows it.
    pub(crate) fn evidence(mut self, evidence: impl Into<String>) -> Self {
        self.message.evidence = Some(evidence.into());
        self
    }

    /// And this shows it, before what does already.
    pub(crate) fn because(mut self, evidence: String) -> Self {
        let evidence = match self.message.evidence.take() {
            Some(more) => format!("{evidence}\n{more}"),
            None => evidence,
        };
        self.evidence(evidence)
    }

    /// And this is what to do.
    pub(crate) fn way_out(mut self, way_out: impl Into<String>) -> Self {
        self.message.way_out = Some(way_out.into());
        self
    }

    /// And it is about this word, wherever it stands.
    pub(crate) fn about_word(mut self, word: &str) -> Self {
        self.message.word = Some(word.to_owned());
        self
    }

    /// And this is what to do, unless something better was said already.
    pub(crate) fn or_way_out(self, way_out: impl Into<String>) -> Self {
        if self.message.way_out.is_some() { self } else { self.way_out(way_out) }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message.what)?;
        if let Some(evidence) = &self.message.evidence {
            write!(f, "\n{evidence}")?;
        }
        if let Some(way_out) = &self.message.way_out {
            write!(f, "\nhelp: {way_out}")?;
        }
        Ok(())
    }
}

impl From<syn::Error> for Diagnostic {
    fn from(error: syn::Error) -> Self {
        Self::new(Extent::at(error.span()), error.to_string())
    }
}

impl ToTokens for Diagnostic {
    /// A `compile_error!` that the compiler underlines from the first to the last token.
    fn to_tokens(&self, tokens: &mut TokenStream) {
        let mut message = Literal::string(&self.to_string());
        message.set_span(self.extent.last);
        let mut braces = Group::new(Delimiter::Brace, message.into_token_stream());
        braces.set_span(self.extent.last);
        tokens.extend(quote_spanned!(self.extent.first=> ::core::compile_error!));
        tokens.extend([TokenTree::Group(braces)]);
    }
}

/// The errors as items that stop the compilation.
pub(crate) fn compile_errors(errors: &[Diagnostic]) -> TokenStream {
    let mut tokens = TokenStream::new();
    for error in errors.iter().take(SHOWN) {
        error.to_tokens(&mut tokens);
    }
    if let (Some(last), true) = (errors.get(SHOWN), errors.len() > SHOWN) {
        let rest = errors.len() - SHOWN;
        Diagnostic::new(last.extent, format!("and {rest} more errors in this declaration"))
            .to_tokens(&mut tokens);
    }
    tokens
}

/// Collects the errors of one stage. Ends with [`Errors::finish`], which is the fence to the next
/// stage; dropping it unread is a bug.
#[derive(Debug, Default)]
pub(crate) struct Errors {
    collected: Vec<Diagnostic>,
    read: bool,
}

impl Errors {
    /// No errors yet.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Adds an error and goes on; one about a word that was told of is left out.
    pub(crate) fn push(&mut self, error: impl Into<Diagnostic>) {
        let error = error.into();
        let word = &error.message.word;
        if word.is_none() || !self.collected.iter().any(|known| known.message.word == *word) {
            self.collected.push(error);
        }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.collected.len()
    }

    /// Says more about an error, which is known by how many were there before it.
    pub(crate) fn because(&mut self, error: usize, evidence: String) {
        if let Some(known) = self.collected.get_mut(error) {
            *known = known.clone().because(evidence);
        }
    }

    /// The value, or its error is added.
    pub(crate) fn keep<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    /// The value if nothing went wrong in the whole stage, else all of its errors.
    pub(crate) fn finish<T>(mut self, value: T) -> Result<T, Vec<Diagnostic>> {
        self.read = true;
        if self.collected.is_empty() { Ok(value) } else { Err(std::mem::take(&mut self.collected)) }
    }
}

impl Drop for Errors {
    fn drop(&mut self) {
        debug_assert!(self.read || std::thread::panicking(), "errors were never read");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some(what: &str) -> Diagnostic {
        Diagnostic::new(Extent::at(Span::call_site()), what)
    }

    #[test]
    fn a_word_is_told_of_once() {
        let mut errors = Errors::new();
        for word in ["type", "type", "fn"] {
            errors.push(some("kept").about_word(word));
        }
        errors.push(some("other"));
        errors.push(some("other"));
        assert_eq!(errors.finish(()).unwrap_err().len(), 4);
    }

    #[test]
    fn errors_are_collected_and_fenced() {
        let mut errors = Errors::new();
        assert_eq!(errors.keep(Ok(3)), Some(3));
        assert_eq!(errors.keep::<i32>(Err(some("bad"))), None);
        errors.push(some("worse"));
        let found = errors.finish(()).unwrap_err();
        assert_eq!(found.iter().map(ToString::to_string).collect::<Vec<_>>(), ["bad", "worse"]);
        assert_eq!(Errors::new().finish(1).unwrap(), 1);
    }

    #[test]
    #[should_panic(expected = "never read")]
    fn unread_errors_are_a_bug() {
        drop(Errors::new());
    }

    #[test]
    fn a_diagnostic_is_a_compile_error() {
        let error = some("what").evidence("because").way_out("do this");
        assert_eq!(
            error.to_token_stream().to_string(),
            ":: core :: compile_error ! { \"what\\nbecause\\nhelp: do this\" }",
        );
    }

    #[test]
    fn long_lists_are_cut() {
        let many = vec![some("bad"); 60];
        let text = compile_errors(&many).to_string();
        assert_eq!(text.matches("compile_error").count(), 51);
        assert!(text.contains("and 10 more errors"));
    }
}

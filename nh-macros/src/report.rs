//! Diagnostics: what is wrong, the evidence, and a way out, at the tokens concerned.

use std::collections::BTreeSet;
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
    /// A name that stands for nothing, as others may.
    unknown: Option<String>,
    /// How many definitions are missing of names that then stand for nothing.
    lacking: usize,
}

impl Diagnostic {
    /// Something is wrong here.
    pub(crate) fn new(extent: Extent, what: impl Into<String>) -> Self {
        let message = Message {
            what: what.into(),
            evidence: None,
            way_out: None,
            word: None,
            unknown: None,
            lacking: 0,
        };
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

    /// And it is about a name that stands for nothing and is like no other.
    pub(crate) fn about_unknown(mut self, name: &str) -> Self {
        self.message.unknown = Some(name.to_owned());
        self
    }

    /// And it is that so many definitions are missing.
    pub(crate) fn lacking(mut self, definitions: usize) -> Self {
        self.message.lacking = definitions;
        self
    }

    /// And this shows it as well, after what does already.
    fn and_evidence(mut self, further: &str) -> Self {
        let evidence = self.message.evidence.take();
        self.evidence(
            evidence.map_or_else(|| further.to_owned(), |evidence| format!("{evidence}\n{further}")),
        )
    }

    /// What errors have in common that may be told as one.
    fn kind(&self) -> (bool, String) {
        match (&self.message.unknown, &self.message.way_out) {
            (Some(_), way_out) => (true, way_out.clone().unwrap_or_default()),
            (None, _) => (false, self.to_string()),
        }
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

/// Errors of which many are one mistake: what is said in three places or more is a habit, three names that stand for nothing
/// are a list that is missing, and names that definitions are missing of stand for nothing for that.
fn told_together(errors: &[Diagnostic]) -> Vec<Diagnostic> {
    const MANY: usize = 3;
    let names = |errors: &[&Diagnostic]| {
        let names = errors.iter().filter_map(|error| error.message.unknown.as_ref());
        names.map(|name| format!("`{name}`")).collect::<Vec<_>>()
    };
    let unknown: Vec<&Diagnostic> = errors.iter().filter(|error| error.message.unknown.is_some()).collect();
    let lacks = |error: &Diagnostic| error.message.lacking > 0 && unknown.len() <= error.message.lacking;
    let is_explained = !unknown.is_empty() && errors.iter().any(lacks);
    let kinds: Vec<(bool, String)> = errors.iter().map(Diagnostic::kind).collect();
    let mut told: BTreeSet<&(bool, String)> = BTreeSet::new();
    let mut together = Vec::new();
    for (error, kind) in errors.iter().zip(&kinds) {
        if error.message.unknown.is_some() && is_explained {
            continue;
        }
        if is_explained && lacks(error) {
            let names = names(&unknown);
            let stand = if names.len() == 1 { "stands" } else { "stand" };
            together.push(error.clone().and_evidence(&format!("{} {stand} for nothing", listed(&names))));
            continue;
        }
        let alike = errors.iter().zip(&kinds).filter(|(_, other)| *other == kind);
        let alike: Vec<&Diagnostic> = alike.map(|(error, _)| error).collect();
        if alike.len() < MANY {
            together.push(error.clone());
            continue;
        }
        if !told.insert(kind) {
            continue;
        }
        let mut one = error.clone();
        if one.message.unknown.is_some() {
            one.message.what = format!("unknown names {}", listed(&names(&alike)));
            let evidence: Vec<&str> =
                alike.iter().filter_map(|error| error.message.evidence.as_deref()).collect();
            one.message.evidence = (!evidence.is_empty()).then(|| evidence.join("\n"));
        } else {
            one = one.and_evidence(&format!("so it is in {} more places", alike.len() - 1));
        }
        together.push(one);
    }
    together
}

/// `a, b and c`.
pub(crate) fn listed(names: &[String]) -> String {
    match names {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        names => names.concat(),
    }
}

/// The errors as items that stop the compilation.
pub(crate) fn compile_errors(errors: &[Diagnostic]) -> TokenStream {
    let errors = told_together(errors);
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

    fn texts(errors: &[Diagnostic]) -> Vec<String> {
        told_together(errors).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_habit_is_told_once() {
        let twice = [some("bad"), some("worse"), some("bad")];
        assert_eq!(texts(&twice), ["bad", "worse", "bad"]);
        let often = [
            some("bad").evidence("so"),
            some("worse"),
            some("bad").evidence("so"),
            some("bad").evidence("so"),
        ];
        assert_eq!(texts(&often), ["bad\nso\nso it is in 2 more places", "worse"]);
    }

    #[test]
    fn names_that_stand_for_nothing_are_told_together() {
        let unknown =
            |name: &str| some(&format!("unknown name `{name}`")).about_unknown(name).way_out("declare");
        let few = [unknown("a"), some("bad"), unknown("b")];
        assert_eq!(
            texts(&few),
            ["unknown name `a`\nhelp: declare", "bad", "unknown name `b`\nhelp: declare"]
        );
        let many = [unknown("a"), some("bad"), unknown("b").evidence("twice"), unknown("c")];
        assert_eq!(texts(&many), ["unknown names `a`, `b` and `c`\ntwice\nhelp: declare", "bad"]);
        // a definition is missing of each
        let lacking = |count| some("too few").lacking(count);
        assert_eq!(
            texts(&[lacking(2), unknown("a"), unknown("b")]),
            ["too few\n`a` and `b` stand for nothing"]
        );
        assert_eq!(texts(&[unknown("a"), lacking(1)]), ["too few\n`a` stands for nothing"]);
        assert_eq!(texts(&[lacking(1), unknown("a"), unknown("b")]).len(), 3);
    }

    #[test]
    fn long_lists_are_cut() {
        let many: Vec<Diagnostic> = (0..60).map(|k| some(&format!("bad {k}"))).collect();
        let text = compile_errors(&many).to_string();
        assert_eq!(text.matches("compile_error").count(), 51);
        assert!(text.contains("and 10 more errors"));
    }
}

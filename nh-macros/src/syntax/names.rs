//! Names where they are declared and where lists and left-hand sides use them; ranges.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use super::ast::{Binder, Declared, Place, Velocity};
use super::limits;
use super::number::number;
use super::stream::Stream;
use crate::report::{Diagnostic, Errors, Extent};

/// The entries of `{ a, b, c }`: every wrong one is reported, the right ones are kept.
pub(crate) fn list<T>(
    body: &Group,
    errors: &mut Errors,
    entry: impl Fn(&mut Stream) -> Result<T, Diagnostic>,
) -> Vec<T> {
    let stream = Stream::inside(body);
    let mut found = Vec::new();
    let chunks: Vec<_> = stream.tokens().split(|token| is_mark(token, ',')).collect();
    let count = chunks.len();
    for (k, chunk) in chunks.into_iter().enumerate() {
        if chunk.is_empty() {
            if k + 1 < count {
                errors.push(Diagnostic::new(
                    Extent::at(body.span()),
                    "a comma with nothing before it in this list",
                ));
            }
            continue;
        }
        let mut chunk = Stream::over(chunk.to_vec(), stream.whole());
        match entry(&mut chunk) {
            Ok(value) => found.push(value),
            Err(error) => {
                errors.push(error);
                continue;
            }
        }
        let Err(error) = list_end(&chunk) else { continue };
        errors.push(error);
        // what follows a missing comma is probably an entry, and known to the rest of the program
        while !chunk.is_empty() {
            match entry(&mut chunk) {
                Ok(value) => found.push(value),
                Err(_) => _ = chunk.advance(),
            }
        }
    }
    found
}

/// Behind an entry of a list nothing but a comma may follow.
fn list_end(stream: &Stream) -> Result<(), Diagnostic> {
    match stream.peek() {
        None => Ok(()),
        Some(TokenTree::Punct(mark)) if mark.as_char() == ';' => {
            Err(Diagnostic::new(stream.here(), "names in a list are not separated by `;`")
                .way_out("write commas"))
        }
        Some(TokenTree::Punct(mark)) if mark.as_char() == ':' => {
            Err(Diagnostic::new(stream.here(), "names in a list have no type")
                .way_out("write the name alone: every number is of the scalar type of the struct"))
        }
        Some(TokenTree::Ident(_)) => {
            Err(Diagnostic::new(stream.here(), "a comma is missing before this name"))
        }
        Some(_) => Err(stream.expected("`,` or the end of the list")),
    }
}

/// Whether the token is this mark.
pub(crate) fn is_mark(token: &TokenTree, mark: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == mark)
}

impl Stream {
    /// Doc comments before a name or an item.
    pub(crate) fn docs(&mut self) -> Result<TokenStream, Diagnostic> {
        let start = self.position();
        while let (true, Some(TokenTree::Group(group))) = (self.at_marks("#"), self.peek_at(1)) {
            let inside: Vec<TokenTree> = group.stream().into_iter().collect();
            let is_text = match inside.as_slice() {
                [TokenTree::Ident(word), TokenTree::Punct(mark), _, ..] => {
                    word == "doc" && mark.as_char() == '='
                }
                _ => false,
            };
            let is_doc = group.delimiter() == Delimiter::Bracket && is_text;
            if !is_doc {
                let at = self.here().to(Extent::at(group.span()));
                return Err(Diagnostic::new(at, "attributes have no place in a declaration")
                    .way_out("only doc comments may stand before a name"));
            }
            // what is handed on has to be readable
            let text: TokenStream = inside[2..].iter().cloned().collect();
            let is_literal = matches!(&inside[2..], [TokenTree::Literal(_)]);
            if !is_literal && syn::parse2::<syn::Expr>(text).is_err() {
                let at = self.here().to(Extent::at(group.span()));
                return Err(Diagnostic::new(at, "this is no documentation")
                    .way_out("write `#[doc = \"…\"]`, or `///`"));
            }
            self.advance();
            self.advance();
        }
        Ok(self.consumed(start).iter().cloned().collect())
    }

    /// A declared name with its lengths: `x`, `theta[4]`, `R[3][3]`.
    pub(crate) fn declared(&mut self) -> Result<Declared, Diagnostic> {
        let docs = self.docs()?;
        let start = self.position();
        let name = self.name("a name")?;
        let mut lengths = Vec::new();
        while let Some(group) = self.eat_group(Delimiter::Bracket) {
            if lengths.len() == 2 {
                return Err(Diagnostic::new(Extent::at(group.span()), "a third index")
                    .way_out("families have one or two indices"));
            }
            let mut inner = Stream::inside(&group);
            let length = inner.integer("the number of entries")?;
            if !inner.is_empty() {
                return Err(inner.expected("`]`"));
            }
            lengths.push(length);
        }
        let extent = self.since(start);
        check_lengths(&lengths, extent)?;
        Ok(Declared { docs, name, lengths, symmetric: false, extent })
    }

    /// An integer literal.
    pub(crate) fn integer(&mut self, wanted: &str) -> Result<u32, Diagnostic> {
        let Some(TokenTree::Literal(literal)) = self.peek() else {
            return Err(self.expected(&format!("{wanted}, an integer")));
        };
        let extent = self.here();
        let value = number(&literal.to_string(), extent)?;
        let integer = match value.exponent {
            0 => value.digits.parse().ok(),
            _ => None,
        };
        let Some(integer) = integer else {
            return Err(Diagnostic::new(extent, format!("expected {wanted}, an integer"))
                .evidence(format!("`{}` is none, or too large", value.text)));
        };
        self.advance();
        Ok(integer)
    }

    /// A use of a name: `x`, `w[0]`, `R[i][j]`.
    pub(crate) fn place(&mut self, role: &str) -> Result<Place, Diagnostic> {
        let start = self.position();
        let name = self.name(role)?;
        let mut indices = Vec::new();
        self.indices(&mut indices)?;
        Ok(Place { name, indices, extent: self.since(start) })
    }

    /// A velocity: `v1`, `w[0]`, `der(x)`.
    pub(crate) fn velocity(&mut self) -> Result<Velocity, Diagnostic> {
        self.velocity_or("the name of a velocity")
    }

    fn velocity_or(&mut self, expected: &str) -> Result<Velocity, Diagnostic> {
        match self.der()? {
            Some((place, extent)) => Ok(Velocity::Der(place, extent)),
            None => Ok(Velocity::Named(self.place(expected)?)),
        }
    }

    /// A section that spans the constraint distribution, by its name: what is combined has a name in `frame`.
    pub(crate) fn spanning_section(&mut self) -> Result<Velocity, Diagnostic> {
        let start = self.position();
        let is_operator =
            |token: &TokenTree| ['+', '-', '*', '/', '^'].iter().any(|mark| is_mark(token, *mark));
        let combined = |stream: &mut Self| {
            while stream.advance().is_some() {}
            Diagnostic::new(stream.since(start), "the sections that span D are listed by their names")
                .way_out("name the combination: `frame { s = …; } distribution { s }`")
        };
        // a sign or a factor in front, as in `-v`, `2 * v` and `(a + b) * v`
        let begins = |token: &TokenTree| match token {
            TokenTree::Literal(_) => true,
            TokenTree::Group(group) => group.delimiter() == Delimiter::Parenthesis,
            token => is_operator(token),
        };
        if self.peek().is_some_and(begins) {
            return Err(combined(self));
        }
        let section = self.velocity_or("a section")?;
        if self.peek().is_some_and(is_operator) { Err(combined(self)) } else { Ok(section) }
    }

    /// `der(x)`, if that is next.
    pub(crate) fn der(&mut self) -> Result<Option<(Place, Extent)>, Diagnostic> {
        let start = self.position();
        if !self.eat_word("der") {
            return Ok(None);
        }
        let Some(group) = self.eat_group(Delimiter::Parenthesis) else {
            return Err(self.expected("a base coordinate in parentheses"));
        };
        let place = self.differentiated(&group)?;
        Ok(Some((place, self.since(start))))
    }

    /// `i in 0..4, j in 0..3`: up to whatever follows.
    pub(crate) fn binders(&mut self) -> Result<Vec<Binder>, Diagnostic> {
        let mut binders = vec![self.binder()?];
        while self.eat(",") {
            let is_range = match self.peek_at(1) {
                Some(TokenTree::Ident(word)) => word == "in",
                Some(token) => is_mark(token, '='),
                None => false,
            };
            if !is_range {
                return Err(self.expected("another range").way_out(
                    "a summand stands behind a `:`, as in `sum(i in 0..4: …)`; a range reads `j in 0..4`",
                ));
            }
            binders.push(self.binder()?);
        }
        Ok(binders)
    }

    /// `i in 0..4`
    pub(crate) fn binder(&mut self) -> Result<Binder, Diagnostic> {
        let way_out = "a range reads `i in 0..4`";
        let start = self.position();
        let name = self.name("a variable").map_err(|error| error.or_way_out(way_out))?;
        if !self.eat_word("in") {
            return Err(self.expected("`in` and a range").way_out(way_out));
        }
        let from = self.expression()?;
        if self.at_marks("..=") {
            let at = Extent::of(&self.rest()[..3]).unwrap_or(self.here());
            return Err(
                Diagnostic::new(at, "a range leaves out its end").way_out("write `0..4` for 0, 1, 2, 3")
            );
        }
        if !self.eat("..") {
            return Err(self.expected("`..` and the end of the range").way_out(way_out));
        }
        let to = self.expression()?;
        Ok(Binder { name, from, to, extent: self.since(start) })
    }
}

/// Families have entries, and not too many.
pub(crate) fn check_lengths(lengths: &[u32], extent: Extent) -> Result<(), Diagnostic> {
    if lengths.contains(&0) {
        return Err(Diagnostic::new(extent, "this has no entries").way_out("leave it out"));
    }
    let entries = lengths.iter().fold(1_u32, |entries, length| entries.saturating_mul(*length));
    if entries > limits::FAMILY {
        return Err(Diagnostic::new(extent, format!("this has more than {} entries", limits::FAMILY)));
    }
    Ok(())
}

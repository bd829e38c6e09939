//! Expressions: sums of products of signed powers.

use proc_macro2::{Delimiter, Group, TokenTree};

use super::ast::{Expr, ExprKind, Factor, Name, Place, Sign};
use super::habits;
use super::limits;
use super::number::number;
use super::render::render;
use super::stream::Stream;
use super::vocabulary::is_function;
use crate::report::{Diagnostic, Extent};

type Parsed = Result<Expr, Diagnostic>;

impl Stream {
    /// An expression that ends where the stream ends. `wanted` says what else might have followed.
    pub(crate) fn last_expression(&mut self, wanted: &str) -> Parsed {
        let value = self.expression()?;
        self.end(wanted)?;
        Ok(value)
    }

    /// Nothing more is left, or the error says what should have been here.
    pub(crate) fn end(&self, wanted: &str) -> Result<(), Diagnostic> {
        if self.is_empty() { Ok(()) } else { Err(habits::unexpected(self, wanted)) }
    }

    /// `term + term - term`
    pub(crate) fn expression(&mut self) -> Parsed {
        let start = self.position();
        let first = self.term()?;
        let mut terms = vec![(Sign::Plus, first)];
        loop {
            let sign = match self.peek() {
                Some(TokenTree::Punct(mark)) if mark.as_char() == '+' => Sign::Plus,
                Some(TokenTree::Punct(mark)) if mark.as_char() == '-' => Sign::Minus,
                _ => break,
            };
            habits::assignment(self)?;
            self.advance();
            terms.push((sign, self.term()?));
        }
        let extent = self.since(start);
        Ok(match terms.len() {
            1 => terms.swap_remove(0).1,
            _ => Expr { kind: ExprKind::Add(terms), extent },
        })
    }

    /// `factor * factor / factor`
    fn term(&mut self) -> Parsed {
        let start = self.position();
        let first = self.factor()?;
        let mut factors = vec![(Factor::Times, first)];
        loop {
            let kind = match self.peek() {
                Some(TokenTree::Punct(mark)) if mark.as_char() == '*' => Factor::Times,
                Some(TokenTree::Punct(mark)) if mark.as_char() == '/' => Factor::Over,
                _ => break,
            };
            habits::double_star(self)?;
            habits::assignment(self)?;
            self.advance();
            factors.push((kind, self.factor()?));
        }
        let extent = self.since(start);
        Ok(match factors.len() {
            1 => factors.swap_remove(0).1,
            _ => Expr { kind: ExprKind::Multiply(factors), extent },
        })
    }

    /// `-factor`, or a power. Every way deeper leads through here.
    fn factor(&mut self) -> Parsed {
        if self.depth >= limits::DEPTH {
            return Err(self.too_deep());
        }
        self.depth += 1;
        let start = self.position();
        let parsed = if self.eat("-") {
            self.factor()
                .map(|inner| Expr { kind: ExprKind::Negate(Box::new(inner)), extent: self.since(start) })
        } else {
            self.power()
        };
        self.depth -= 1;
        parsed
    }

    /// The expression is nested too deeply here.
    fn too_deep(&self) -> Diagnostic {
        let what = format!("this expression is nested more than {} levels deep", limits::DEPTH);
        Diagnostic::new(self.here(), what).way_out("name its inner parts with `let`")
    }

    /// `base ^ exponent`, the exponent a factor again: right-associative, and `2^-3` is fine.
    fn power(&mut self) -> Parsed {
        let start = self.position();
        let base = self.entry()?;
        if !self.at_marks("^") {
            return Ok(base);
        }
        habits::assignment(self)?;
        self.advance();
        let exponent = self.factor()?;
        Ok(Expr { kind: ExprKind::Power(Box::new(base), Box::new(exponent)), extent: self.since(start) })
    }

    /// A value, perhaps with indices: `A[i][j]`.
    fn entry(&mut self) -> Parsed {
        let start = self.position();
        let of = self.value()?;
        let mut indices = Vec::new();
        if !matches!(of.kind, ExprKind::Number(_)) {
            self.indices(&mut indices)?;
        }
        habits::method(self, start)?;
        Ok(if indices.is_empty() {
            of
        } else {
            Expr { kind: ExprKind::Index(Box::new(of), indices), extent: self.since(start) }
        })
    }

    /// `i`, or the part `0..2`.
    pub(crate) fn index_or_part(&mut self) -> Result<Expr, Diagnostic> {
        let start = self.position();
        let index = self.expression()?;
        if self.at_word("in") {
            return Err(self.loop_in_an_index(start));
        }
        if !self.at_marks("..") || self.at_marks("..=") {
            return Ok(index);
        }
        self.eat("..");
        let end = self.expression()?;
        let kind = ExprKind::Range(Box::new(index), Box::new(end));
        Ok(Expr { kind, extent: self.since(start) })
    }

    /// `x[i in 0..4]` where `x` is used, as on the left of a line of the anchor.
    fn loop_in_an_index(&mut self, start: usize) -> Diagnostic {
        let variable = render(self.consumed(start));
        while self.advance().is_some() {}
        let range = render(self.consumed(start));
        Diagnostic::new(self.since(start), "a range in the index of a name that is declared elsewhere").way_out(
            format!(
                "write `[{variable}]`, with `for {range} {{ … }}` around the line or `sum({range}: …)` around a term"
            ),
        )
    }

    /// `[i][j]`, at most two, and parts `[0..2]`.
    pub(crate) fn indices(&mut self, indices: &mut Vec<Expr>) -> Result<(), Diagnostic> {
        while let Some(group) = self.peek_group(Delimiter::Bracket).cloned() {
            let single = indices.iter().filter(|index| !matches!(index.kind, ExprKind::Range(..))).count();
            if single == 2 || indices.len() == limits::PARTS {
                return Err(Diagnostic::new(Extent::at(group.span()), "a third index")
                    .way_out("families and arrays have one or two indices"));
            }
            self.advance();
            let mut inner = self.nested(&group);
            let index = inner.index_or_part()?;
            if inner.at_marks(",") {
                return Err(Diagnostic::new(Extent::at(group.span()), "two indices in one bracket")
                    .way_out("write `A[i][j]`"));
            }
            inner.end("`]`")?;
            indices.push(index);
        }
        Ok(())
    }

    /// A number, a name, a call, a vector, or something in parentheses.
    fn value(&mut self) -> Parsed {
        match self.peek() {
            Some(TokenTree::Literal(_)) => self.literal(""),
            Some(TokenTree::Punct(_)) => {
                let number = matches!(self.peek_at(1), Some(TokenTree::Literal(_))) && self.eat(".");
                if number { self.literal(".") } else { Err(habits::no_value(self)) }
            }
            Some(TokenTree::Group(group)) => match group.delimiter() {
                Delimiter::Parenthesis | Delimiter::None => self.parenthesised(),
                Delimiter::Bracket => self.vector(),
                Delimiter::Brace => Err(habits::no_value(self)),
            },
            Some(TokenTree::Ident(_)) => self.word(),
            None => Err(habits::no_value(self)),
        }
    }

    /// `(a)`, or the fragment of a surrounding macro.
    fn parenthesised(&mut self) -> Parsed {
        let Some(TokenTree::Group(group)) = self.advance() else { return Err(self.expected("`(`")) };
        habits::empty_parentheses(&group)?;
        self.nested(&group).last_expression("`)`")
    }

    /// `[a, b, c]`
    fn vector(&mut self) -> Parsed {
        let start = self.position();
        let Some(TokenTree::Group(group)) = self.advance() else { return Err(self.expected("`[`")) };
        let parts = self.list(&group, "`]`")?;
        if parts.is_empty() {
            return Err(Diagnostic::new(Extent::at(group.span()), "an empty vector")
                .way_out("list its components: `[a, b, c]`"));
        }
        Ok(Expr { kind: ExprKind::Vector(parts), extent: self.since(start) })
    }

    /// A literal, behind a point perhaps, which is consumed already.
    fn literal(&mut self, point: &str) -> Parsed {
        let start = self.position() - point.len();
        let Some(TokenTree::Literal(literal)) = self.advance() else {
            return Err(self.expected("a number"));
        };
        let text = literal.to_string();
        let extent = self.since(start);
        let digits_only = !text.contains('.') && text.starts_with(|c: char| c.is_ascii_digit());
        if !(point.is_empty() || digits_only) {
            return Err(Diagnostic::new(extent, format!("`.{text}` is not a number")));
        }
        // only other macros make negative literals
        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest.to_owned()),
            None => (false, format!("{point}{text}")),
        };
        let value = Expr { kind: ExprKind::Number(number(&text, extent)?), extent };
        Ok(if negative { Expr { kind: ExprKind::Negate(Box::new(value)), extent } } else { value })
    }

    /// What begins with a word.
    fn word(&mut self) -> Parsed {
        if self.at_word("self") {
            return self.own_method();
        }
        let start = self.position();
        habits::foreign_word(self)?;
        let name = self.name("an expression")?;
        let Some(group) = self.eat_group(Delimiter::Parenthesis) else {
            return if is_function(&name.text) {
                Err(habits::bare_function(self, &name))
            } else {
                let extent = name.extent();
                Ok(Expr { kind: ExprKind::Name(name), extent })
            };
        };
        let kind = match name.text.as_str() {
            "der" => ExprKind::Der(Box::new(self.rate(&group)?)),
            "sum" => self.summed(&group)?,
            _ => ExprKind::Call(name, self.list(&group, "`,` or `)`")?),
        };
        Ok(Expr { kind, extent: self.since(start) })
    }

    /// What stands in `sum(…)`.
    fn summed(&self, group: &Group) -> Result<ExprKind, Diagnostic> {
        let mut inner = self.nested(group);
        let binders = inner.binders()?;
        if !inner.eat(":") {
            return Err(inner
                .expected("`:` and what is summed")
                .way_out("a sum reads `sum(i in 0..4: m[i] * v[i]^2)`"));
        }
        let body = inner.last_expression("`)`")?;
        Ok(ExprKind::Sum(binders, Box::new(body)))
    }

    /// `self.method(…)`
    fn own_method(&mut self) -> Parsed {
        let start = self.position();
        self.advance();
        if !self.eat(".") {
            return Err(Diagnostic::new(self.since(start), "`self` alone is no number")
                .way_out("write the name of a field, or call a method: `self.motor(omega)`"));
        }
        let name = self.name("the name of a method")?;
        let Some(group) = self.eat_group(Delimiter::Parenthesis) else {
            return Err(Diagnostic::new(self.since(start), "fields are written without `self`")
                .way_out(format!("write `{}`", name.text)));
        };
        let arguments = self.list(&group, "`,` or `)`")?;
        Ok(Expr { kind: ExprKind::Method(name, arguments), extent: self.since(start) })
    }

    /// What stands in `der(…)` in an expression.
    fn rate(&self, group: &Group) -> Parsed {
        let mut inner = self.nested(group);
        if inner.is_empty() {
            return Err(Diagnostic::new(Extent::at(group.span()), "`der` of nothing")
                .way_out("`der` takes a base coordinate or an expression of them: `der(x)`, `der(p - q)`"));
        }
        inner.last_expression("`)`")
    }

    /// The coordinate in `der(x)` on a left-hand side.
    pub(crate) fn differentiated(&self, group: &Group) -> Result<Place, Diagnostic> {
        let mut inner = self.nested(group);
        let way_out = "`der` takes the name of a base coordinate: `der(x)`, `der(theta[0])`; the \
                       chain rule is written out";
        let whole = Diagnostic::new(inner.whole(), "this is not a base coordinate").way_out(way_out);
        match inner.peek() {
            Some(TokenTree::Ident(ident)) if !is_function(&Name::new(ident.clone()).text) => {}
            _ => return Err(whole),
        }
        let place = inner.place("a base coordinate")?;
        if inner.is_empty() { Ok(place) } else { Err(whole) }
    }

    /// Expressions separated by commas.
    fn list(&self, group: &Group, wanted: &str) -> Result<Vec<Expr>, Diagnostic> {
        let mut inner = self.nested(group);
        let mut parts = Vec::new();
        while !inner.is_empty() {
            parts.push(inner.expression()?);
            if !inner.eat(",") {
                inner.end(wanted)?;
            }
        }
        Ok(parts)
    }
}

//! The lines of sections: equations, definitions, anchor lines, brackets, forces, comparisons.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use super::ast::{
    AnchorLine, BracketLine, Comparison, Definition, Equation, Expr, Force, MethodDerivative, Momentum, Name,
    Place, PositionLine, Relation, Renaming, Subscript, Symmetry,
};
use super::habits;
use super::items::END;
use super::names::is_mark;
use super::render::render;
use super::stream::Stream;
use super::vocabulary::TYPES;
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;

impl Stream {
    /// Consumes the `=` of an equation; `reads` shows how it should look.
    pub(crate) fn equals(&mut self, reads: &str) -> Result<(), Diagnostic> {
        if self.at_marks("=") && !self.at_marks("==") && !self.at_marks("=>") {
            self.advance();
            return Ok(());
        }
        Err(habits::unexpected(self, "`=`").or_way_out(reads))
    }

    /// Consumes the `:` behind a label or a direction.
    fn colon(&mut self, reads: &str) -> Result<(), Diagnostic> {
        if self.eat(":") {
            return Ok(());
        }
        Err(self.expected("`:`").way_out(reads))
    }

    /// `label: left = right`
    pub(crate) fn equation(&mut self) -> Result<Equation, Diagnostic> {
        self.equation_or_left().map_err(|(error, _)| error)
    }

    /// `label: left = right`, or `redundant`
    pub(crate) fn position_line(&mut self) -> Result<PositionLine, Diagnostic> {
        let extent = self.whole();
        if self.at_word("redundant") && self.tokens().len() == 1 {
            self.advance();
            return Ok(PositionLine::Redundant(extent));
        }
        self.equation().map(|equation| PositionLine::Equation(Box::new(equation)))
    }

    /// An equation, or the error with the left-hand side, if that could be read.
    pub(crate) fn equation_or_left(&mut self) -> Result<Equation, (Diagnostic, Option<Box<Expr>>)> {
        let none = |error| (error, None);
        let (docs, label) = self.label().map_err(none)?;
        let start = self.position();
        let left = self.expression().map_err(none)?;
        let right = self
            .equals("this is an equation: `left = right`, where the right may be `0`")
            .and_then(|()| self.last_expression(END));
        match right {
            Ok(right) => Ok(Equation { docs, label, left, right, extent: self.since(start) }),
            Err(error) => Err((error, Some(Box::new(left)))),
        }
    }

    /// Documentation and a label, where there are any.
    pub(super) fn label(&mut self) -> Result<(TokenStream, Option<Name>), Diagnostic> {
        let docs = self.docs()?;
        let is_label = matches!(self.peek(), Some(TokenTree::Ident(_)));
        let indices = (1..self.tokens().len()).take_while(|k| self.bracket_at(*k).is_some()).count();
        let behind = |k| self.peek_at(k).is_some_and(|token| is_mark(token, ':'));
        if !is_label || !behind(1 + indices) || behind(2 + indices) {
            return Ok((docs, None));
        }
        let label = self.name("a label")?;
        self.no_index(&label)?;
        self.eat(":");
        Ok((docs, Some(label)))
    }

    /// The brackets that are so far ahead.
    fn bracket_at(&self, ahead: usize) -> Option<&Group> {
        match self.peek_at(ahead) {
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket => Some(group),
            _ => None,
        }
    }

    /// Labels have no index: one inside `for` names an array by itself.
    fn no_index(&self, label: &Name) -> Result<(), Diagnostic> {
        let Some(group) = self.bracket_at(0) else { return Ok(()) };
        let inside: Vec<TokenTree> = group.stream().into_iter().collect();
        let label = &label.text;
        let way_out = match inside.get(1) {
            Some(TokenTree::Ident(word)) if word == "in" => {
                format!("write `for {} {{ {label}: … }}`, which gives an array `{label}`", render(&inside))
            }
            _ => format!("write `{label}: …`: inside of `for` it gives an array `{label}`"),
        };
        Err(Diagnostic::new(Extent::at(group.span()), "a label has no index").way_out(way_out))
    }

    /// `name = expr`, `name[0] = expr`, `name[i in 0..4] = expr`
    pub(crate) fn definition(&mut self) -> Result<Definition, Diagnostic> {
        let reads = "a definition reads `name = …;`";
        let is_separator = |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if matches!(mark.as_char(), '=' | ':'));
        if !self.tokens().iter().any(is_separator) {
            return Err(Diagnostic::new(self.whole(), "a name and a `=` are missing").way_out(reads));
        }
        let docs = self.docs()?;
        let start = self.position();
        let (name, subscripts) = self.defined()?;
        let extent = self.since(start);
        self.equals(reads)?;
        let value = self.last_expression(END)?;
        Ok(Definition { docs, name, subscripts, value, extent })
    }

    /// `der(name) = expr`, `der(name[i in 0..4]) = expr`
    pub(crate) fn auxiliary_line(&mut self) -> Result<Definition, Diagnostic> {
        let reads = "an auxiliary state is declared by its rate: `der(current) = …;`";
        let docs = self.docs()?;
        let start = self.position();
        if !self.eat_word("der") {
            return Err(self.expected("`der(…)`").way_out(reads));
        }
        let Some(group) = self.eat_group(Delimiter::Parenthesis) else {
            return Err(self.expected("a name in parentheses").way_out(reads));
        };
        let mut inner = Self::inside(&group);
        let (name, subscripts) = inner.defined().map_err(|error| error.or_way_out(reads))?;
        inner.end("`)`")?;
        let extent = self.since(start);
        self.equals(reads)?;
        let value = self.last_expression(END)?;
        Ok(Definition { docs, name, subscripts, value, extent })
    }

    /// The name that a line defines, with its indices.
    fn defined(&mut self) -> Result<(Name, Vec<Subscript>), Diagnostic> {
        let name = self.name("the name that is defined")?;
        let mut subscripts = Vec::new();
        while let Some(group) = self.eat_group(Delimiter::Bracket) {
            let mut inner = Self::inside(&group);
            if matches!(inner.peek_at(1), Some(TokenTree::Ident(word)) if word == "in") {
                subscripts.extend(inner.binders()?.into_iter().map(|each| Subscript::Each(Box::new(each))));
            } else {
                subscripts.push(Subscript::Entry(inner.index_or_part()?));
            }
            inner.end("`]`")?;
            if subscripts.len() > 2 {
                return Err(Diagnostic::new(Extent::at(group.span()), "a third index")
                    .way_out("families have one or two indices"));
            }
        }
        Ok((name, subscripts))
    }

    /// `der(x) = expr`
    pub(crate) fn anchor_line(&mut self) -> Result<AnchorLine, Diagnostic> {
        let reads = "a line of the anchor reads `der(x) = …;`, with a base coordinate `x`";
        self.docs()?;
        let Some((coordinate, extent)) = self.der()? else {
            return Err(self.expected("`der(…)`").way_out(reads));
        };
        self.equals(reads)?;
        let value = self.last_expression(END)?;
        Ok(AnchorLine { coordinate, value, extent })
    }

    /// `[a, b] = expr`
    pub(crate) fn bracket_line(&mut self) -> Result<BracketLine, Diagnostic> {
        let reads = "a bracket reads `[a, b] = …;`, with two sections of the basis";
        self.docs()?;
        let start = self.position();
        let Some(pair) = self.eat_group(Delimiter::Bracket) else {
            let is_algebra = matches!(self.peek_at(1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
            return Err(self.expected("a pair of sections").way_out(if is_algebra {
                "a known algebra stands before the braces, its sections between them: `brackets so(3) { w }`"
            } else {
                reads
            }));
        };
        let mut inner = Self::inside(&pair);
        let (first, second) = inner.pair().map_err(|error| error.or_way_out(reads))?;
        let extent = self.since(start);
        self.equals(reads)?;
        let value = self.last_expression(END)?;
        Ok(BracketLine { first, second, value, extent })
    }

    /// `a, b`
    fn pair(&mut self) -> Result<(Place, Place), Diagnostic> {
        let first = self.place("a section")?;
        if !self.eat(",") {
            return Err(self.expected("`,` and a second section"));
        }
        let second = self.place("a section")?;
        self.eat(",");
        self.end("`]`")?;
        Ok((first, second))
    }

    /// `name: expr`
    pub(crate) fn force(&mut self) -> Result<Force, Diagnostic> {
        let reads = "a force reads `name: …;`, with a section or a base coordinate";
        self.docs()?;
        if let Some((place, extent)) = self.der()? {
            return Err(Diagnostic::new(extent, "a force along `der(…)`")
                .way_out(format!("a force along a base coordinate is written `{}: …;`", place.name.text)));
        }
        let along = self.place("the direction of a force")?;
        self.colon(reads)?;
        let value = self.last_expression(END)?;
        Ok(Force { along, value })
    }

    /// `omega: expr`
    pub(crate) fn momentum(&mut self) -> Result<Momentum, Diagnostic> {
        self.docs()?;
        let along = self.velocity()?;
        self.colon("a momentum reads `omega: …;`, with one of the velocities of the state")?;
        let value = self.last_expression(END)?;
        Ok(Momentum { along, value })
    }

    /// `label: expr`
    pub(crate) fn symmetry(&mut self) -> Result<Symmetry, Diagnostic> {
        let docs = self.docs()?;
        let label = self.name("a label")?;
        self.no_index(&label)?;
        self.colon("a symmetry reads `label: …;`")?;
        let start = self.position();
        let value = self.expression()?;
        let gauge = if self.eat_word("up") {
            if !self.eat_word("to") {
                return Err(self.expected("`to`").way_out("a symmetry reads `label: … up to f;`"));
            }
            Some(self.expression()?)
        } else {
            None
        };
        let extent = self.since(start);
        self.end(END)?;
        Ok(Symmetry { docs, label, value, gauge, extent })
    }

    /// `a < b`
    pub(crate) fn comparison(&mut self) -> Result<Comparison, Diagnostic> {
        const RELATIONS: [(&str, Relation); 5] = [
            ("<=", Relation::LessOrEqual),
            (">=", Relation::GreaterOrEqual),
            ("!=", Relation::NotEqual),
            ("<", Relation::Less),
            (">", Relation::Greater),
        ];
        self.docs()?;
        let start = self.position();
        let left = self.expression()?;
        let Some((written, relation)) = RELATIONS.iter().find(|(written, _)| self.at_marks(written)) else {
            let reads = "an assumption reads `m > 0;`, with one of `< <= > >= !=`";
            return Err(if self.at_marks("=") {
                Diagnostic::new(self.here(), "an assumption is not an equation").evidence(reads).way_out(
                    "declare equal numbers once, and use that name twice: a symmetric matrix from six",
                )
            } else {
                habits::unexpected(self, "a comparison").or_way_out(reads)
            });
        };
        self.eat(written);
        let right = self.expression()?;
        if self.at_marks("<") || self.at_marks(">") {
            return Err(Diagnostic::new(self.since(start), "a chain of comparisons")
                .way_out("write one comparison per line: `0 < a; a < b;`"));
        }
        self.end(END)?;
        Ok(Comparison { left, relation: *relation, right, extent: self.since(start) })
    }

    /// `state = RobotState`
    pub(crate) fn renaming(&mut self) -> Result<Renaming, Diagnostic> {
        self.docs()?;
        let reads = "a type is renamed by `state = RobotState;`";
        let role = self.name("a generated type")?;
        if !TYPES.contains(&role.text.as_str()) {
            let all = TYPES.map(|word| format!("`{word}`")).join(", ");
            let error = Diagnostic::new(role.extent(), format!("there is no generated type `{}`", role.text));
            let known = format!("types that can be renamed: {all}");
            return Err(match did_you_mean(&role.text, TYPES) {
                Some(question) => error.evidence(known).way_out(question),
                None => error.way_out(known),
            });
        }
        self.equals(reads)?;
        let name = self.name("the new name of the type")?;
        self.end(END)?;
        Ok(Renaming { role, name })
    }

    /// `motor: [self.d1, self.d2]`
    pub(crate) fn method_derivative(&mut self) -> Result<MethodDerivative, Diagnostic> {
        let reads = "derivatives of a method read `motor: [self.motor_d1, self.motor_d2];`";
        self.docs()?;
        let method = self.name("a method")?;
        self.colon(reads)?;
        let Some(group) = self.eat_group(Delimiter::Bracket) else {
            return Err(self.expected("a list of methods in brackets").way_out(reads));
        };
        self.end(END)?;
        let mut inner = Self::inside(&group);
        let mut derivatives = Vec::new();
        while !inner.is_empty() {
            if !(inner.eat_word("self") && inner.eat(".")) {
                return Err(inner.expected("`self.` and a method").way_out(reads));
            }
            derivatives.push(inner.name("a method")?);
            if !inner.eat(",") && !inner.is_empty() {
                return Err(inner.expected("`,` or `]`").way_out(reads));
            }
        }
        Ok(MethodDerivative { method, derivatives })
    }
}

//! Expressions as they were written to expressions of the graph.

use std::rc::Rc;

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::ExprId;

use super::array::{Array, Part, Shape};
use super::context::{Context, Usage};
use super::homogeneity::ADDED;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::{Meaning, Named, Numbers, Role};
use crate::report::Diagnostic;
use crate::syntax::ast::{Binder, Expr, ExprKind, Name, Number, Place, Sign};

impl Resolver {
    /// A number.
    pub(super) fn number_value(&mut self, expr: &Expr) -> Outcome<ExprId> {
        let value = self.value(expr)?;
        self.as_number(expr, &value)
    }

    /// The number that a value should be.
    pub(super) fn as_number(&mut self, expr: &Expr, value: &Array) -> Outcome<ExprId> {
        value.as_number().ok_or_else(|| {
            let error = Diagnostic::new(expr.extent, format!("expected a number, this is {}", value.shape));
            self.report(
                expr,
                error.way_out("take an entry of it, as in `w[0]`, or a product such as `dot(w, w)`"),
            )
        })
    }

    /// A number, vector or matrix.
    pub(super) fn value(&mut self, expr: &Expr) -> Outcome<Array> {
        self.reports.visit(expr)?;
        self.open_conditions();
        let value = self.value_of(expr);
        self.close_conditions();
        value
    }

    fn value_of(&mut self, expr: &Expr) -> Outcome<Array> {
        match &expr.kind {
            ExprKind::Number(number) => self.literal(expr, number),
            ExprKind::Name(name) => self.named(expr, name, &[]),
            ExprKind::Index(of, indices) => {
                if let ExprKind::Name(name) = &of.kind {
                    return self.named(expr, name, indices);
                }
                let whole = self.value(of)?;
                let part = self.part("this", whole.shape, indices)?;
                Ok(whole.part(part))
            }
            ExprKind::Range(..) => Err(self.no_value(expr)),
            ExprKind::Der(of) => self.rate(expr, of),
            ExprKind::Call(name, arguments) => self.call(expr, name, arguments),
            ExprKind::Method(name, arguments) => self.method(expr, name, arguments),
            ExprKind::Sum(binders, body) => self.summation(expr, binders, body),
            ExprKind::Vector(parts) => self.vector(expr, parts),
            ExprKind::Negate(inner) => {
                let value = self.value(inner)?;
                self.entrywise(value, |this, entry| this.sum_of(expr, vec![(Rational::MINUS_ONE, entry)]))
            }
            ExprKind::Add(terms) => {
                let values: Vec<_> =
                    terms.iter().map(|(sign, term)| (*sign, term, self.value(term))).collect();
                let values: Outcome<Vec<_>> =
                    values.into_iter().map(|(sign, term, value)| Ok((sign, term, value?))).collect();
                self.added(expr, &values?)
            }
            ExprKind::Multiply(factors) => self.product(expr, factors),
            ExprKind::Power(base, exponent) => self.power(expr, base, exponent),
        }
    }

    /// Applies an operation to every entry.
    pub(super) fn entrywise(
        &mut self,
        value: Array,
        mut operation: impl FnMut(&mut Self, ExprId) -> Outcome<ExprId>,
    ) -> Outcome<Array> {
        let entries: Outcome<Vec<_>> =
            value.entries.into_iter().map(|entry| operation(self, entry)).collect();
        Ok(Array { shape: value.shape, entries: entries? })
    }

    /// A literal: chunks of digits, then the power of ten.
    fn literal(&mut self, expr: &Expr, number: &Number) -> Outcome<Array> {
        const CHUNK: usize = 18;
        self.reports.spend(expr.extent, number.digits.len() / CHUNK)?;
        let digits: Vec<char> = number.digits.chars().collect();
        let mut value = Rational::ZERO;
        for chunk in digits.chunks(CHUNK) {
            let text: String = chunk.iter().collect();
            let power = u32::try_from(chunk.len()).map_or(1, |length| 10_i64.pow(length));
            value = value * Rational::from(power) + Rational::from(text.parse::<i64>().unwrap_or(0));
        }
        let power = Rational::from(10).pow(i64::from(number.exponent)).unwrap_or(Rational::ONE);
        let entry = self.graph.number(value * power);
        Ok(Array::number(self.checked(expr, entry, 1)?))
    }

    /// A name, perhaps with indices.
    fn named(&mut self, expr: &Expr, name: &Name, indices: &[Expr]) -> Outcome<Array> {
        let Some(meaning) = self.scope.get(&name.text).cloned() else {
            if self.scope.pending.contains(&name.text) {
                return Err(self.not_yet_defined(expr, name));
            }
            let error = self.scope.unknown(name);
            return Err(self.reports.report_unknown(expr, &name.text, error));
        };
        let meaning = match meaning {
            Meaning::Shared(_) if self.context == Context::Constants => {
                let what = format!("the `let` `{}` cannot be used in `constants`", name.text);
                let error = Diagnostic::new(expr.extent, what)
                    .evidence("constants come before everything else")
                    .way_out("make it a constant as well");
                return Err(self.report(expr, error));
            }
            Meaning::Shared(place) => Meaning::Value(self.shared_value(place, name)?),
            meaning => meaning,
        };
        let whole = format!("`{}`", name.text);
        let shape = match &meaning {
            Meaning::Named(named) => named.shape,
            Meaning::Constant(constant) => constant.values.shape,
            Meaning::Value(value) | Meaning::Argument(value) => value.shape,
            Meaning::Time | Meaning::Pi | Meaning::Index(_) => Shape::Number,
            Meaning::Function(place) => return Err(self.bare_function(*place, expr, name)),
            Meaning::Shared(_) | Meaning::Broken => return Err(Reported),
        };
        let part = self.part(&whole, shape, indices)?;
        match meaning {
            Meaning::Named(named) => {
                if matches!(named.role, Role::Input | Role::Parameter) {
                    self.mentioned.insert(name.text.clone());
                }
                let usage = match named.role {
                    Role::Velocity | Role::ImpliedVelocity | Role::FrameVelocity => Some(Usage::Velocity),
                    Role::Input => Some(Usage::Input),
                    Role::Auxiliary => Some(Usage::Auxiliary),
                    Role::Parameter | Role::Coordinate => None,
                };
                if let Some(usage) = usage {
                    self.check_usage(expr, usage, &name.text, expr.extent)?;
                }
                self.symbols(expr, &named.symbols, part)
            }
            Meaning::Constant(constant) => {
                self.reports.spend(expr.extent, part.shape.len())?;
                Ok(self.constants(&constant, part))
            }
            Meaning::Value(value) | Meaning::Argument(value) => {
                self.reports.spend(expr.extent, part.shape.len())?;
                self.uses_abbreviation(&name.text);
                Ok(value.part(part))
            }
            Meaning::Time => {
                self.check_usage(expr, Usage::Time, "t", expr.extent)?;
                Ok(Array::number(self.time()))
            }
            Meaning::Pi => Ok(Array::number(self.graph.pi())),
            Meaning::Index(value) => Ok(Array::number(self.graph.number(value))),
            Meaning::Shared(_) | Meaning::Function(_) | Meaning::Broken => Err(Reported),
        }
    }

    /// Constants: in the definitions of others, numbers.
    fn constants(&mut self, constant: &Numbers, part: Part) -> Array {
        let mut found = constant.values.part(part);
        if self.context != Context::Constants {
            for (entry, name) in found.entries.iter_mut().zip(&constant.names[part.positions()]) {
                if let Some(name) = name {
                    *entry = self.graph.constant(*name);
                }
            }
        }
        found
    }

    /// A velocity of `velocities` or `frame` where it has no meaning yet.
    fn not_yet_defined(&mut self, expr: &Expr, name: &Name) -> Reported {
        let text = &name.text;
        let context = self.shared.user().unwrap_or(self.context);
        let checked = context.check(Usage::Velocity, text, name.extent());
        if self.keep(expr, checked).is_err() {
            return Reported;
        }
        let error = Diagnostic::new(
            name.extent(),
            format!("the section `{text}` of the frame cannot be used in `{}`", context.keyword()),
        )
        .evidence("the frame is made of the sections that `basis`, `anchor` and `brackets` declare")
        .way_out("write its definition out");
        self.report(expr, error)
    }

    /// A range is an index, and nothing else.
    fn no_value(&mut self, expr: &Expr) -> Reported {
        self.report(expr, Diagnostic::new(expr.extent, "a range is not a value"))
    }

    /// The symbols of a part of a family.
    pub(super) fn symbols(
        &mut self,
        expr: &Expr,
        symbols: &[nonholonomic_core::id::SymbolId],
        part: Part,
    ) -> Outcome<Array> {
        self.reports.spend(expr.extent, part.shape.len())?;
        let entries = symbols[part.positions()].iter().map(|symbol| self.graph.symbol(*symbol)).collect();
        Ok(Array { shape: part.shape, entries })
    }

    /// A base coordinate, a family of them, or a row.
    pub(super) fn coordinate(&mut self, place: &Place) -> Outcome<(Rc<Named>, Part)> {
        let text = &place.name.text;
        let at = place.name.extent();
        let error = match self.scope.get(text).cloned() {
            Some(Meaning::Named(named)) if named.role == Role::Coordinate => {
                let part = self.part(&format!("`{text}`"), named.shape, &place.indices)?;
                return Ok((named, part));
            }
            Some(Meaning::Broken) => return Err(Reported),
            None => {
                if self.scope.is_known_elsewhere(text) {
                    let error = self.scope.unknown(&place.name);
                    return Err(self.reports.report_unknown(place, text, error));
                }
                let error = Diagnostic::new(at, format!("there is no base coordinate `{text}`"));
                let nearest = self.scope.did_you_mean(text, &[Role::Coordinate]);
                let error = error.way_out(
                    nearest
                        .or_else(|| self.scope.nearest(text))
                        .unwrap_or_else(|| "base coordinates are declared in `base { x, y }`".to_owned()),
                );
                return Err(self.reports.report_unknown(place, text, error));
            }
            Some(meaning) => {
                let (what, way_out) = match meaning {
                    Meaning::Named(named) => match named.role {
                        Role::Parameter => ("a parameter, whose derivative is 0", "leave the term out"),
                        Role::Input => (
                            "an input",
                            "inputs have no known rates; an auxiliary state has: `auxiliary { der(z) = …; }`",
                        ),
                        Role::Auxiliary => {
                            ("an auxiliary state", "its rate is given in `auxiliary`, and nowhere else")
                        }
                        _ => ("a velocity", "accelerations are what is derived; they cannot be used"),
                    },
                    Meaning::Time => ("the time, whose derivative is 1", "write `1`"),
                    Meaning::Pi | Meaning::Index(_) | Meaning::Constant(_) => {
                        ("a constant", "leave the term out")
                    }
                    Meaning::Function(_) => ("a function", "give it its arguments"),
                    Meaning::Value(_) | Meaning::Argument(_) | Meaning::Shared(_) | Meaning::Broken => {
                        ("an abbreviation", "name the coordinates in it")
                    }
                };
                Diagnostic::new(at, format!("`der` takes a base coordinate, and `{text}` is {what}"))
                    .way_out(way_out)
            }
        };
        Err(self.report(place, error))
    }

    /// `sum(i in a..b: body)`; an empty sum is 0.
    fn summation(&mut self, expr: &Expr, binders: &[Binder], body: &Expr) -> Outcome<Array> {
        let mut terms: Vec<Outcome<Array>> = Vec::new();
        self.each_value(binders, &mut |this| terms.push(this.value(body)))?;
        let terms: Outcome<Vec<_>> = terms.into_iter().map(|term| Ok((Sign::Plus, body, term?))).collect();
        let terms = terms?;
        if terms.is_empty() {
            return Ok(Array::number(self.graph.zero()));
        }
        self.added(expr, &terms)
    }

    /// Adds values of the same shape, at least one; 0 is the zero of any shape.
    fn added(&mut self, expr: &Expr, terms: &[(Sign, &Expr, Array)]) -> Outcome<Array> {
        let mut shape = terms[0].2.shape;
        let mut kept = Vec::new();
        if terms.iter().any(|(_, _, term)| term.shape != Shape::Number) {
            let is_zero = |term: &Array| term.as_number().is_some_and(|n| self.graph.is_literal_zero(n));
            kept.extend(terms.iter().filter(|(_, _, term)| !is_zero(term)).cloned());
            shape = kept.first().map_or(shape, |(_, _, first)| first.shape);
        }
        let terms = if kept.is_empty() { terms } else { kept.as_slice() };
        if let Some((_, term, other)) = terms.iter().find(|(_, _, term)| term.shape != shape) {
            let error = Diagnostic::new(term.extent, "only what has the same shape can be added")
                .evidence(format!("this is {}, what stands before it is {shape}", other.shape));
            return Err(self.report(*term, error));
        }
        let mut entries = Vec::with_capacity(shape.len());
        for k in 0..shape.len() {
            let summand = |(sign, _, term): &(Sign, &Expr, Array)| match sign {
                Sign::Plus => (Rational::ONE, term.entries[k]),
                Sign::Minus => (Rational::MINUS_ONE, term.entries[k]),
            };
            let entry = (shape != Shape::Number).then_some(k);
            let sides = terms.iter().map(|(_, at, term)| self.written(at, term.entries[k], entry)).collect();
            self.same_unit(expr, ADDED, sides);
            entries.push(self.combination_of(expr, terms.iter().map(summand).collect())?);
        }
        Ok(Array { shape, entries })
    }

    /// `[a, b, c]`, of numbers or of rows.
    fn vector(&mut self, expr: &Expr, parts: &[Expr]) -> Outcome<Array> {
        let values: Vec<_> = parts.iter().map(|part| self.value(part)).collect();
        let values = values.into_iter().collect::<Outcome<Vec<_>>>()?;
        let known = values.iter().find(|value| value.shape != Shape::Number).or(values.first());
        let shape = known.map_or(Shape::Number, |first| first.shape);
        let values: Vec<Array> =
            values.iter().map(|value| self.in_shape(value, shape).unwrap_or_else(|| value.clone())).collect();
        let first = values.first().map_or(Shape::Number, |first| first.shape);
        let shape = if values.iter().all(|value| value.shape == shape) { shape } else { first };
        if let Some((part, value)) = parts.iter().zip(&values).find(|(_, value)| value.shape != shape) {
            let error = Diagnostic::new(part.extent, "the entries of a vector have the same shape")
                .evidence(format!("this is {}, the first entry is {shape}", value.shape));
            return Err(self.report(part, error));
        }
        let Some(shape) = shape.times(parts.len()) else {
            let error =
                Diagnostic::new(expr.extent, "a vector of matrices").way_out("name each of them with `let`");
            return Err(self.report(expr, error));
        };
        Ok(Array { shape, entries: values.into_iter().flat_map(|value| value.entries).collect() })
    }

    /// `base ^ exponent`
    fn power(&mut self, expr: &Expr, base: &Expr, exponent: &Expr) -> Outcome<Array> {
        let (value, power) = (self.value(base), self.number_value(exponent));
        let (value, power) = (value?, power?);
        let Some(number) = value.as_number() else {
            let error = Diagnostic::new(base.extent, format!("a power of {}", value.shape))
                .way_out("for the square of a length write `dot(v, v)`");
            return Err(self.report(base, error));
        };
        let Some(power) = self.graph.value_of(power).cloned() else {
            let error = Diagnostic::new(exponent.extent, "an exponent must be a rational number")
                .evidence("this one is not known when the equations are derived")
                .way_out("write a^b as `exp(b * ln(a))`, for a > 0");
            return Err(self.report(exponent, error));
        };
        Ok(Array::number(self.power_of(expr, number, power, exponent)?))
    }
}

//! Helpers of the tests of this stage, and of those that begin with it.

use proc_macro2::TokenStream;

use super::ast::{Expr, ExprKind, Factor, Sign, SystemDecl};
use super::parse;
use super::stream::Stream;
use crate::report::{Diagnostic, Extent};

/// The declaration, or its errors.
pub(crate) fn declaration(attribute: &str, item: &str) -> Result<SystemDecl, Vec<Diagnostic>> {
    let attribute: TokenStream = attribute.parse().expect("tokens");
    parse(attribute, item.parse().expect("tokens")).map_err(|malformed| malformed.errors)
}

/// The texts of the errors.
pub(crate) fn messages(attribute: &str, item: &str) -> Vec<String> {
    match declaration(attribute, item) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.iter().map(ToString::to_string).collect(),
    }
}

/// What the errors underline, with the text of each.
pub(crate) fn underlined(attribute: &str) -> Vec<(String, String)> {
    let tokens: TokenStream = attribute.parse().expect("tokens");
    let errors = parse(tokens, "struct S;".parse().expect("tokens")).expect_err("errors").errors;
    let of = |error: &Diagnostic| {
        let (first, last) = (error.extent.first.start(), error.extent.last.end());
        let line: Vec<char> = attribute.lines().nth(first.line - 1).unwrap_or("").chars().collect();
        let end = if last.line == first.line { last.column } else { line.len() };
        line.get(first.column..end).unwrap_or(&[]).iter().collect::<String>()
    };
    errors
        .iter()
        .map(|error| (of(error), error.to_string().lines().next().unwrap_or_default().to_owned()))
        .collect()
}

/// An expression alone.
pub(crate) fn expression(tokens: TokenStream) -> Result<Expr, Diagnostic> {
    let around = Extent::at(proc_macro2::Span::call_site());
    Stream::new(tokens, around).last_expression("the end")
}

/// The expression with all its parentheses.
pub(crate) fn shown(expr: &Expr) -> String {
    let list = |parts: &[Expr]| parts.iter().map(shown).collect::<Vec<_>>().join(", ");
    let entry =
        |indices: &[Expr]| indices.iter().map(|i| format!("[{}]", shown(i))).collect::<Vec<_>>().concat();
    match &expr.kind {
        ExprKind::Number(number) => number.text.clone(),
        ExprKind::Name(name) => name.text.clone(),
        ExprKind::Index(of, indices) => format!("{}{}", shown(of), entry(indices)),
        ExprKind::Range(from, to) => format!("{}..{}", shown(from), shown(to)),
        ExprKind::Der(of) => format!("der({})", shown(of)),
        ExprKind::Call(name, arguments) => format!("{}({})", name.text, list(arguments)),
        ExprKind::Method(name, arguments) => format!("self.{}({})", name.text, list(arguments)),
        ExprKind::Sum(binders, body) => {
            let binder =
                |b: &super::ast::Binder| format!("{} in {}..{}", b.name.text, shown(&b.from), shown(&b.to));
            let binders = binders.iter().map(binder).collect::<Vec<_>>().join(", ");
            format!("sum({binders}: {})", shown(body))
        }
        ExprKind::Vector(parts) => format!("[{}]", list(parts)),
        ExprKind::Negate(inner) => format!("(-{})", shown(inner)),
        ExprKind::Add(terms) => {
            let term = |(k, (sign, term)): (usize, &(Sign, Expr))| match (k, sign) {
                (0, _) => shown(term),
                (_, Sign::Plus) => format!(" + {}", shown(term)),
                (_, Sign::Minus) => format!(" - {}", shown(term)),
            };
            format!("({})", terms.iter().enumerate().map(term).collect::<Vec<_>>().concat())
        }
        ExprKind::Multiply(factors) => {
            let factor = |(k, (kind, factor)): (usize, &(Factor, Expr))| match (k, kind) {
                (0, _) => shown(factor),
                (_, Factor::Times) => format!(" * {}", shown(factor)),
                (_, Factor::Over) => format!(" / {}", shown(factor)),
            };
            format!("({})", factors.iter().enumerate().map(factor).collect::<Vec<_>>().concat())
        }
        ExprKind::Power(base, exponent) => format!("({}^{})", shown(base), shown(exponent)),
    }
}

/// A small generator of pseudo-random numbers (splitmix64), the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        usize::try_from(z % bound.max(1) as u64).expect("a small number")
    }

    pub(crate) fn pick<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }
}

//! Expressions as a person would write them, for messages: loop variables by their values.

use super::scope::{Meaning, Scope};
use crate::syntax::ast::{Binder, Expr, ExprKind, Factor, Sign};

/// Messages quote this many letters and no more.
const LONGEST: usize = 60;

/// How strongly an expression holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Power,
    Atom,
}

/// An expression as text, in backquotes, cut where it is long.
pub(super) fn quoted(expr: &Expr, scope: &Scope) -> String {
    let mut text = String::new();
    write(&mut text, expr, scope, Strength::Sum);
    if text.chars().count() > LONGEST {
        text = text.chars().take(LONGEST).chain(['…']).collect();
    }
    format!("`{text}`")
}

fn write(text: &mut String, expr: &Expr, scope: &Scope, around: Strength) {
    if text.len() > 4 * LONGEST {
        return;
    }
    let parentheses = strength(expr) < around;
    text.push_str(if parentheses { "(" } else { "" });
    write_bare(text, expr, scope);
    text.push_str(if parentheses { ")" } else { "" });
}

fn strength(expr: &Expr) -> Strength {
    match &expr.kind {
        ExprKind::Add(_) => Strength::Sum,
        ExprKind::Multiply(_) => Strength::Product,
        ExprKind::Power(..) | ExprKind::Negate(_) => Strength::Power,
        _ => Strength::Atom,
    }
}

fn write_bare(text: &mut String, expr: &Expr, scope: &Scope) {
    match &expr.kind {
        ExprKind::Number(number) => text.push_str(&number.text),
        ExprKind::Name(name) => match scope.get(&name.text) {
            Some(Meaning::Index(value)) => text.push_str(&value.to_string()),
            _ => text.push_str(&name.text),
        },
        ExprKind::Index(of, indices) => {
            write(text, of, scope, Strength::Atom);
            write_indices(text, indices, scope);
        }
        ExprKind::Der(of) => {
            text.push_str("der(");
            write(text, of, scope, Strength::Sum);
            text.push(')');
        }
        ExprKind::Range(from, to) => {
            write(text, from, scope, Strength::Sum);
            text.push_str("..");
            write(text, to, scope, Strength::Sum);
        }
        ExprKind::Call(name, arguments) => {
            text.push_str(&name.text);
            write_list(text, '(', arguments, ')', scope);
        }
        ExprKind::Method(name, arguments) => {
            text.extend(["self.", &name.text]);
            write_list(text, '(', arguments, ')', scope);
        }
        ExprKind::Sum(binders, body) => {
            text.push_str("sum(");
            write_binders(text, binders, scope);
            text.push_str(": ");
            write(text, body, scope, Strength::Sum);
            text.push(')');
        }
        ExprKind::Vector(parts) => write_list(text, '[', parts, ']', scope),
        ExprKind::Negate(inner) => {
            text.push('-');
            write(text, inner, scope, Strength::Product);
        }
        ExprKind::Add(terms) => {
            for (k, (sign, term)) in terms.iter().enumerate() {
                text.push_str(match sign {
                    Sign::Plus if k == 0 => "",
                    Sign::Plus => " + ",
                    Sign::Minus => " - ",
                });
                write(text, term, scope, Strength::Product);
            }
        }
        ExprKind::Multiply(factors) => {
            for (k, (kind, factor)) in factors.iter().enumerate() {
                text.push_str(match kind {
                    Factor::Times if k == 0 => "",
                    Factor::Times => "*",
                    Factor::Over => "/",
                });
                write(text, factor, scope, Strength::Power);
            }
        }
        ExprKind::Power(base, exponent) => {
            write(text, base, scope, Strength::Atom);
            text.push('^');
            write(text, exponent, scope, Strength::Power);
        }
    }
}

fn write_indices(text: &mut String, indices: &[Expr], scope: &Scope) {
    for index in indices {
        text.push('[');
        write(text, index, scope, Strength::Sum);
        text.push(']');
    }
}

fn write_list(text: &mut String, open: char, parts: &[Expr], close: char, scope: &Scope) {
    text.push(open);
    for (k, part) in parts.iter().enumerate() {
        text.push_str(if k == 0 { "" } else { ", " });
        write(text, part, scope, Strength::Sum);
    }
    text.push(close);
}

fn write_binders(text: &mut String, binders: &[Binder], scope: &Scope) {
    for (k, binder) in binders.iter().enumerate() {
        text.extend([if k == 0 { "" } else { ", " }, &binder.name.text, " in "]);
        write(text, &binder.from, scope, Strength::Sum);
        text.push_str("..");
        write(text, &binder.to, scope, Strength::Sum);
    }
}

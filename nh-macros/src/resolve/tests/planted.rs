//! Wrong units that are planted: in every term of every example a factor is left out, or has a wrong power.

use std::collections::BTreeSet;
use std::path::Path;

use nonholonomic_core::units::Unit;
use proc_macro2::TokenStream;

use super::catalogue::in_folder;
use super::resolve;
use crate::emit::Layout;
use crate::syntax;
use crate::syntax::ast::{Equation, Expr, ExprKind, ImpactLine, Item, Let, Number, PositionLine, SystemDecl};

/// What is done to a factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mistake {
    LeftOut,
    Squared,
}

fn parsed(attribute: &TokenStream, item: &TokenStream) -> SystemDecl {
    syntax::parse(attribute.clone(), item.clone()).expect("well-formed")
}

/// The errors of a declaration, or its names with a unit that is not that of a pure number.
fn judged(declaration: &SystemDecl, attribute: &TokenStream) -> Result<BTreeSet<String>, Vec<String>> {
    let mut layout = Layout::of_struct(&declaration.structure, attribute.clone());
    match resolve(declaration, &mut layout) {
        Ok(resolved) => {
            let is_pure =
                |unit: &Unit| *unit == Unit::Known("1".into()) || *unit == Unit::Known("rad".into());
            let units = resolved.model.units.iter();
            let dimensional = units.filter(|quantity| !is_pure(&quantity.unit));
            let family = |name: &str| name.split(']').next().unwrap_or(name).replace("[0", "[]");
            Ok(dimensional.map(|quantity| family(&quantity.name)).collect())
        }
        Err(unresolved) => Err(unresolved.errors.iter().map(ToString::to_string).collect()),
    }
}

/// Visits all factors that are names, entries (as `w[]`) or rates; not what stands in indices, exponents and ranges.
fn factors(expr: &mut Expr, visit: &mut dyn FnMut(&mut Expr, &str, bool)) {
    let name = match &expr.kind {
        ExprKind::Name(name) => Some((name.text.clone(), false)),
        ExprKind::Der(of) => match &of.kind {
            ExprKind::Name(name) => Some((name.text.clone(), true)),
            _ => None,
        },
        ExprKind::Index(of, _) => match &of.kind {
            ExprKind::Name(name) => Some((format!("{}[]", name.text), false)),
            _ => None,
        },
        _ => None,
    };
    if let Some((name, is_rate)) = name {
        visit(expr, &name, is_rate);
        return;
    }
    match &mut expr.kind {
        ExprKind::Call(_, parts) | ExprKind::Method(_, parts) | ExprKind::Vector(parts) => {
            for part in parts {
                factors(part, visit);
            }
        }
        ExprKind::Sum(_, inner)
        | ExprKind::Negate(inner)
        | ExprKind::Der(inner)
        | ExprKind::Power(inner, _) => factors(inner, visit),
        ExprKind::Add(terms) => terms.iter_mut().for_each(|(_, term)| factors(term, visit)),
        ExprKind::Multiply(list) => list.iter_mut().for_each(|(_, factor)| factors(factor, visit)),
        ExprKind::Index(of, _) => factors(of, visit),
        _ => {}
    }
}

/// Visits the expressions of a line of a section.
type OfLine<'a, T> = dyn FnMut(&mut T, &mut dyn FnMut(&mut Expr)) + 'a;

fn lines<T>(items: &mut [Item<T>], own: &mut OfLine<'_, T>, visit: &mut dyn FnMut(&mut Expr)) {
    for item in items {
        match item {
            Item::Let(Let { value, .. }) => visit(value),
            Item::For(block) => lines(&mut block.items, own, visit),
            Item::One(line) => own(line, visit),
        }
    }
}

/// Visits the expressions of the equations.
fn expressions(declaration: &mut SystemDecl, visit: &mut dyn FnMut(&mut Expr)) {
    let s = &mut declaration.sections;
    if let Some(section) = &mut s.anchor {
        lines(&mut section.body, &mut |line, visit| visit(&mut line.value), visit);
    }
    if let Some(section) = &mut s.lagrangian {
        section.body.lets.iter_mut().for_each(|line| visit(&mut line.value));
        visit(&mut section.body.value);
    }
    let sides = &mut |line: &mut Equation, visit: &mut dyn FnMut(&mut Expr)| {
        // what is said to be 0 is so with any factor
        if !(is_zero(&line.right) && is_factor(&line.left)) {
            visit(&mut line.left);
        }
        visit(&mut line.right);
    };
    if let Some(section) = &mut s.constraints {
        lines(&mut section.body, sides, visit);
    }
    if let Some(section) = &mut s.holonomic {
        let equations = &mut |line: &mut PositionLine, visit: &mut dyn FnMut(&mut Expr)| match line {
            PositionLine::Equation(equation) => sides(equation, visit),
            PositionLine::Redundant(_) => {}
        };
        lines(&mut section.body, equations, visit);
    }
    if let Some(section) = &mut s.impacts {
        let rows = &mut |line: &mut ImpactLine, visit: &mut dyn FnMut(&mut Expr)| {
            line.rows.iter_mut().for_each(|row| sides(&mut row.sides, visit));
            line.restitution.iter_mut().for_each(visit);
        };
        lines(&mut section.body, rows, visit);
    }
    if let Some(section) = &mut s.forces {
        lines(&mut section.body, &mut |line, visit| visit(&mut line.value), visit);
    }
    if let Some(section) = &mut s.outputs {
        lines(&mut section.body, &mut |line, visit| visit(&mut line.value), visit);
    }
}

/// Makes a mistake in the factor with this number, if there are so many; its name.
fn planted(declaration: &mut SystemDecl, wanted: usize, mistake: Mistake) -> Option<(String, bool)> {
    let mut number = 0;
    let mut found = None;
    expressions(declaration, &mut |expr| {
        factors(expr, &mut |factor, name, is_rate| {
            if number == wanted {
                found = Some((name.to_owned(), is_rate));
                let extent = factor.extent;
                let literal = |digits: &str| Expr {
                    kind: ExprKind::Number(Number {
                        text: digits.into(),
                        digits: digits.into(),
                        exponent: 0,
                    }),
                    extent,
                };
                *factor = match mistake {
                    Mistake::LeftOut => literal("1"),
                    Mistake::Squared => Expr {
                        kind: ExprKind::Power(Box::new(factor.clone()), Box::new(literal("2"))),
                        extent,
                    },
                };
            }
            number += 1;
        });
    });
    found
}

fn is_zero(expr: &Expr) -> bool {
    matches!(&expr.kind, ExprKind::Number(number) if number.text == "0")
}

fn is_factor(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Name(_) => true,
        ExprKind::Der(of) | ExprKind::Index(of, _) => matches!(of.kind, ExprKind::Name(_)),
        _ => false,
    }
}

#[test]
fn wrong_powers_and_missing_factors_are_found_in_every_example() {
    let all = in_folder(Path::new("../examples/examples"));
    let (mut machines, mut mistakes, mut missed) = (0, 0, Vec::new());
    for (attribute, item) in &all {
        // a piece of a `macro_rules!`
        if attribute.to_string().contains('$') {
            continue;
        }
        let right = parsed(attribute, item);
        let name = right.structure.name.to_string();
        assert!(right.sections.units.is_some(), "{name} declares no units");
        let dimensional = judged(&right, attribute).unwrap_or_else(|errors| panic!("{name}: {errors:?}"));
        machines += 1;
        for mistake in [Mistake::LeftOut, Mistake::Squared] {
            for number in 0.. {
                let mut wrong = parsed(attribute, item);
                let Some((factor, is_rate)) = planted(&mut wrong, number, mistake) else { break };
                if !is_rate && !dimensional.contains(&factor) {
                    continue;
                }
                let found = judged(&wrong, attribute);
                let what = format!("{name}: {factor}, factor {number}, {mistake:?}");
                match found.err() {
                    None => missed.push(what),
                    Some(errors) if errors.len() > 3 || !errors[0].starts_with("the units") => {
                        missed.push(format!("{what}: {errors:#?}"));
                    }
                    Some(_) => mistakes += 1,
                }
            }
        }
    }
    assert!(missed.is_empty(), "{} of {mistakes}: {missed:#?}", missed.len());
    assert!(all.is_empty() || (machines >= 10 && mistakes > 300), "{mistakes} in {machines} machines");
}

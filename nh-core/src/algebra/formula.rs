//! Formulas as they are written on paper: `graph.formula(m * l.square() * sin(a) + k * (b - c))`.
//!
//! Operators on [`ExprId`]s only note what is to be computed: a formula is a value of a type that has its shape, without
//! allocation, and no graph is borrowed while it is written. [`Graph::formula`] builds it, operands from the left to the
//! right. *This is the place where formulas are simplified, and the only one*: every operation goes through the
//! automatic identities at the head of `sum.rs`, `product.rs` and `transcendental.rs`, so that `0 * x + y` is `y` and
//! `x - x` is 0. Nothing is expanded, collected over products or put over a common denominator until somebody asks for
//! it with `simplify`, `expand` or a form.

use super::graph::Graph;
use super::number::Rational;
use crate::id::ExprId;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What a formula is made of: expressions, whole numbers, fractions, and operations on these.
pub trait Term {
    /// The expression in the graph.
    fn build(self, graph: &mut Graph) -> ExprId;
}

/// An operation on terms that has not been built yet.
#[derive(Clone, Copy, Debug)]
#[must_use = "a formula is nothing until `Graph::formula` builds it"]
pub struct Formula<T>(T);

/// `a + b`, not built yet.
#[derive(Clone, Copy, Debug)]
pub struct Plus<A, B>(A, B);
/// `a − b`, not built yet.
#[derive(Clone, Copy, Debug)]
pub struct Minus<A, B>(A, B);
/// `a · b`, not built yet.
#[derive(Clone, Copy, Debug)]
pub struct Times<A, B>(A, B);
/// `a / b`, not built yet.
#[derive(Clone, Copy, Debug)]
pub struct Over<A, B>(A, B);
/// `−a`, not built yet.
#[derive(Clone, Copy, Debug)]
pub struct Negative<A>(A);
/// A power or function of a term, not built yet.
#[derive(Clone, Copy, Debug)]
pub struct Applied<A>(A, fn(&mut Graph, ExprId) -> ExprId);

impl Graph {
    /// Builds a formula, with the automatic identities of sums, products and functions.
    pub fn formula(&mut self, formula: impl Term) -> ExprId {
        formula.build(self)
    }
}

impl Term for ExprId {
    fn build(self, _: &mut Graph) -> ExprId {
        self
    }
}

impl Term for &ExprId {
    fn build(self, _: &mut Graph) -> ExprId {
        *self
    }
}

impl Term for i64 {
    fn build(self, graph: &mut Graph) -> ExprId {
        graph.number(self)
    }
}

impl Term for Rational {
    fn build(self, graph: &mut Graph) -> ExprId {
        graph.number(self)
    }
}

impl<T: Term> Term for Formula<T> {
    fn build(self, graph: &mut Graph) -> ExprId {
        self.0.build(graph)
    }
}

impl<A: Term> Term for Negative<A> {
    fn build(self, graph: &mut Graph) -> ExprId {
        let a = self.0.build(graph);
        graph.neg(a)
    }
}

impl<A: Term> Term for Applied<A> {
    fn build(self, graph: &mut Graph) -> ExprId {
        let a = self.0.build(graph);
        (self.1)(graph, a)
    }
}

macro_rules! operators {
    ($($operator:ident::$name:ident as $shape:ident by $build:ident),*) => {$(
        impl<A: Term, B: Term> Term for $shape<A, B> {
            fn build(self, graph: &mut Graph) -> ExprId {
                let (a, b) = (self.0.build(graph), self.1.build(graph));
                graph.$build(a, b)
            }
        }

        impl<B: Term> $operator<B> for ExprId {
            type Output = Formula<$shape<ExprId, B>>;
            fn $name(self, other: B) -> Self::Output {
                Formula($shape(self, other))
            }
        }

        impl<B: Term> $operator<B> for &ExprId {
            type Output = Formula<$shape<ExprId, B>>;
            fn $name(self, other: B) -> Self::Output {
                Formula($shape(*self, other))
            }
        }

        impl<A: Term, B: Term> $operator<B> for Formula<A> {
            type Output = Formula<$shape<A, B>>;
            fn $name(self, other: B) -> Self::Output {
                Formula($shape(self.0, other))
            }
        }

        operators! { number i64: $operator::$name as $shape }
        operators! { number Rational: $operator::$name as $shape }
    )*};
    (number $number:ty: $operator:ident::$name:ident as $shape:ident) => {
        impl $operator<ExprId> for $number {
            type Output = Formula<$shape<$number, ExprId>>;
            fn $name(self, other: ExprId) -> Self::Output {
                Formula($shape(self, other))
            }
        }

        impl $operator<&ExprId> for $number {
            type Output = Formula<$shape<$number, ExprId>>;
            fn $name(self, other: &ExprId) -> Self::Output {
                Formula($shape(self, *other))
            }
        }

        impl<B: Term> $operator<Formula<B>> for $number {
            type Output = Formula<$shape<$number, B>>;
            fn $name(self, other: Formula<B>) -> Self::Output {
                Formula($shape(self, other.0))
            }
        }
    };
}

operators! { Add::add as Plus by add, Sub::sub as Minus by sub, Mul::mul as Times by mul, Div::div as Over by div }

impl Neg for ExprId {
    type Output = Formula<Negative<ExprId>>;
    fn neg(self) -> Self::Output {
        Formula(Negative(self))
    }
}

impl Neg for &ExprId {
    type Output = Formula<Negative<ExprId>>;
    fn neg(self) -> Self::Output {
        Formula(Negative(*self))
    }
}

impl<A: Term> Neg for Formula<A> {
    type Output = Formula<Negative<A>>;
    fn neg(self) -> Self::Output {
        Formula(Negative(self.0))
    }
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident)*) => {
        impl ExprId {$(
            $(#[$doc])*
            pub fn $name(self) -> Formula<Applied<ExprId>> {
                Formula(Applied(self, Graph::$name))
            }
        )*}

        impl<A: Term> Formula<A> {$(
            $(#[$doc])*
            pub fn $name(self) -> Formula<Applied<A>> {
                Formula(Applied(self.0, Graph::$name))
            }
        )*}
    };
}

functions! {
    /// `x²`, not built yet.
    square
    /// `√x`, not built yet.
    sqrt
    /// `sin x`, not built yet.
    sin
    /// `cos x`, not built yet.
    cos
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_what_its_operations_give_one_by_one() {
        let mut graph = Graph::new();
        let [a, b, c] = ["a", "b", "c"].map(|name| {
            let symbol = graph.new_symbol(name);
            graph.symbol(symbol)
        });
        let built = graph.formula(2 * a * b.square() - (b + c).sqrt() / -a + Rational::new(1, 2) * a.sin());
        let twice = graph.scale(Rational::from(2), a);
        let square = graph.square(b);
        let first = graph.mul(twice, square);
        let sum = graph.add(b, c);
        let root = graph.sqrt(sum);
        let minus = graph.neg(a);
        let second = graph.div(root, minus);
        let sine = graph.sin(a);
        let third = graph.scale(Rational::new(1, 2), sine);
        let difference = graph.sub(first, second);
        assert_eq!(built, graph.add(difference, third));
        // references to expressions are written as they stand
        let (x, y) = (&a, &b);
        assert_eq!(graph.formula(x * y + -x - y), graph.formula(a * b - a - b));
    }

    #[test]
    fn automatic_identities_hold_in_formulas() {
        let mut graph = Graph::new();
        let symbol = graph.new_symbol("x");
        let x = graph.symbol(symbol);
        let nothing = graph.formula(0 * x + x - x);
        assert!(graph.is_literal_zero(nothing));
        let one = graph.one();
        assert_eq!(graph.formula(x * 3 / (x * 3)), one);
    }
}

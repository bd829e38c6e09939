//! A recursive-descent parser of the printed syntax, independent of the printer.

use super::tree::Tree;
use nonholonomic_core::algebra::{Function, Rational};

/// Reads a whole text.
pub(crate) fn parse(text: &str) -> Result<Tree, String> {
    let mut parser = Parser { rest: text };
    let tree = parser.sum()?;
    parser.spaces();
    if parser.rest.is_empty() { Ok(tree) } else { Err(format!("left over: {}", parser.rest)) }
}

struct Parser<'a> {
    rest: &'a str,
}

impl Parser<'_> {
    fn spaces(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn take(&mut self, token: char) -> bool {
        self.spaces();
        match self.rest.strip_prefix(token) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, token: char) -> Result<(), String> {
        if self.take(token) { Ok(()) } else { Err(format!("expected {token} before {}", self.rest)) }
    }

    fn sum(&mut self) -> Result<Tree, String> {
        let mut terms = vec![self.signed()?];
        loop {
            if self.take('+') {
                terms.push(self.term()?);
            } else if self.take('-') {
                terms.push(negative(self.term()?));
            } else {
                return Ok(Tree::Sum(terms));
            }
        }
    }

    fn signed(&mut self) -> Result<Tree, String> {
        if self.take('-') { Ok(negative(self.term()?)) } else { self.term() }
    }

    fn term(&mut self) -> Result<Tree, String> {
        let mut factors = vec![self.power()?];
        loop {
            if self.take('*') {
                factors.push(self.power()?);
            } else if self.take('/') {
                factors.push(Tree::Power(Box::new(self.power()?), Rational::MINUS_ONE));
            } else {
                return Ok(Tree::Product(factors));
            }
        }
    }

    fn power(&mut self) -> Result<Tree, String> {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        let exponent = if self.take('(') {
            let negative = self.take('-');
            let numerator = self.integer()?;
            let denominator = if self.take('/') { self.integer()? } else { 1 };
            self.expect(')')?;
            Rational::new(if negative { -numerator } else { numerator }, denominator)
        } else {
            self.integer()?.into()
        };
        Ok(Tree::Power(Box::new(base), exponent))
    }

    fn integer(&mut self) -> Result<i64, String> {
        self.word(|c| c.is_ascii_digit()).parse().map_err(|error| format!("{error} before {}", self.rest))
    }

    fn word(&mut self, belongs: impl Fn(char) -> bool) -> String {
        self.spaces();
        let end = self.rest.find(|c| !belongs(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word.into()
    }

    fn atom(&mut self) -> Result<Tree, String> {
        self.spaces();
        if self.take('(') {
            let inside = self.sum()?;
            self.expect(')')?;
            return Ok(inside);
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return Ok(Tree::Number(self.integer()?.into()));
        }
        let name = self.word(char::is_alphanumeric);
        if let Some(symbol) = ["x", "y", "z"].iter().position(|known| *known == name) {
            return Ok(Tree::Symbol(symbol));
        }
        if name == "pi" {
            return Ok(Tree::Pi);
        }
        self.expect('(')?;
        let argument = Box::new(self.sum()?);
        self.expect(')')?;
        let function = match name.as_str() {
            "sqrt" => return Ok(Tree::Power(argument, Rational::new(1, 2))),
            "sin" => Function::Sin,
            "cos" => Function::Cos,
            "exp" => Function::Exp,
            "sinh" => Function::Sinh,
            "cosh" => Function::Cosh,
            "tanh" => Function::Tanh,
            "atan" => Function::Atan,
            _ => return Err(format!("unknown function {name}")),
        };
        Ok(Tree::Apply(function, argument))
    }
}

fn negative(tree: Tree) -> Tree {
    Tree::Product(vec![Tree::Number(Rational::MINUS_ONE), tree])
}

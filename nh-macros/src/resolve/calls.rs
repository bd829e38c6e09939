//! Calls: elementary functions, `dot` and `cross`.

use nonholonomic_core::algebra::{Function, Function2, Rational};
use nonholonomic_core::id::ExprId;
use nonholonomic_core::model::MethodCall;
use nonholonomic_core::units::Unknown;

use super::alike::Measured;
use super::array::{Array, Shape};
use super::context::Usage;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::Meaning;
use super::tensors::{Tensor, tensor_names};
use crate::report::Diagnostic;
use crate::suggest::did_you_mean;
use crate::syntax::ast::{Expr, Name};
use crate::syntax::vocabulary::FUNCTIONS;

/// What is called by a name.
pub(super) enum Called {
    One(Function),
    Two(Function2),
    Tan,
    Sqrt,
    Dot,
    Cross,
}

/// Letters of an argument in the name of a call.
const ARGUMENT: usize = 40;

/// What other languages call our functions, and what to write.
const ELSEWHERE: [(&str, &str); 23] = [
    ("d", "der(x)"),
    ("dt", "der(x)"),
    ("ddt", "der(x)"),
    ("log", "ln(x)"),
    ("log10", "ln(x) / ln(10)"),
    ("log2", "ln(x) / ln(2)"),
    ("pow", "x^2"),
    ("powi", "x^2"),
    ("powf", "x^2"),
    ("sq", "x^2"),
    ("square", "x^2"),
    ("cbrt", "x^(1/3)"),
    ("hypot", "sqrt(x^2 + y^2)"),
    ("arcsin", "asin(x)"),
    ("arccos", "acos(x)"),
    ("arctan", "atan(x)"),
    ("arctan2", "atan2(y, x)"),
    ("cot", "1 / tan(x)"),
    ("sec", "1 / cos(x)"),
    ("fabs", "abs(x)"),
    ("signum", "sign(x)"),
    ("skew", "hat(v)"),
    ("eye", "identity(3)"),
];

impl Called {
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "sin" => Self::One(Function::Sin),
            "cos" => Self::One(Function::Cos),
            "tan" => Self::Tan,
            "asin" => Self::One(Function::Asin),
            "acos" => Self::One(Function::Acos),
            "atan" => Self::One(Function::Atan),
            "atan2" => Self::Two(Function2::Atan2),
            "sinh" => Self::One(Function::Sinh),
            "cosh" => Self::One(Function::Cosh),
            "tanh" => Self::One(Function::Tanh),
            "exp" => Self::One(Function::Exp),
            "ln" => Self::One(Function::Ln),
            "sqrt" => Self::Sqrt,
            "abs" => Self::One(Function::Abs),
            "sign" => Self::One(Function::Sign),
            "min" => Self::Two(Function2::Min),
            "max" => Self::Two(Function2::Max),
            "dot" => Self::Dot,
            "cross" => Self::Cross,
            _ => return None,
        })
    }

    /// How a call with the right arguments reads.
    fn usage(&self, name: &str) -> String {
        match self {
            Self::One(_) | Self::Tan | Self::Sqrt => format!("{name}(x)"),
            Self::Two(Function2::Atan2) => "atan2(y, x)".to_owned(),
            Self::Two(_) => format!("{name}(a, b)"),
            Self::Dot | Self::Cross => format!("{name}(u, v)"),
        }
    }

    fn arity(&self) -> usize {
        match self {
            Self::One(_) | Self::Tan | Self::Sqrt => 1,
            Self::Two(_) | Self::Dot | Self::Cross => 2,
        }
    }

    fn branches(&self) -> bool {
        matches!(self, Self::One(Function::Abs | Function::Sign) | Self::Two(Function2::Min | Function2::Max))
    }
}

impl Resolver {
    /// `f(a, b)`
    pub(super) fn call(&mut self, expr: &Expr, name: &Name, arguments: &[Expr]) -> Outcome<Array> {
        if matches!(self.scope.get(&name.text), Some(Meaning::Broken)) {
            // a function of the user's that carries the name of one of the language was reported
            return Err(Reported);
        }
        if let Some(tensor) = Tensor::named(&name.text) {
            return self.tensor(expr, name, tensor, arguments);
        }
        let Some(called) = Called::named(&name.text) else {
            let values: Vec<_> = arguments.iter().map(|argument| self.value(argument)).collect();
            return match self.scope.get(&name.text).cloned() {
                Some(Meaning::Function(place)) => {
                    self.called(place, (expr, name), values.into_iter().collect::<Outcome<_>>()?)
                }
                Some(Meaning::Broken) => Err(Reported),
                _ => Err(self.not_a_function(name)),
            };
        };
        if called.branches() {
            self.check_usage(name, Usage::Branches, &name.text, name.extent())?;
        }
        let values: Vec<_> = arguments.iter().map(|argument| self.value(argument)).collect();
        self.count_of_called(&called, expr, name, arguments.len())?;
        let values = values.into_iter().collect::<Outcome<Vec<_>>>()?;
        match (called, values.as_slice()) {
            (Called::Dot, [u, v]) => self.dot(expr, u, v),
            (Called::Cross, [u, v]) => self.cross(expr, u, v),
            (called, values) => self.elementary(expr, &called, arguments, values),
        }
    }

    /// Whether a function of the language has as many arguments as it takes.
    pub(super) fn count_of_called(
        &mut self,
        called: &Called,
        expr: &Expr,
        name: &Name,
        given: usize,
    ) -> Outcome<()> {
        self.counted(expr, name, given, called.arity(), || called.usage(&name.text))
    }

    /// Whether a function has as many arguments as it takes; `usage` is how it is written.
    pub(super) fn counted(
        &mut self,
        expr: &Expr,
        name: &Name,
        given: usize,
        wanted: usize,
        usage: impl FnOnce() -> String,
    ) -> Outcome<()> {
        if given == wanted {
            return Ok(());
        }
        let plural = if wanted == 1 { "argument" } else { "arguments" };
        let what = format!("`{}` takes {wanted} {plural}, and {given} are given", name.text);
        let error = Diagnostic::new(expr.extent, what).way_out(format!("write `{}`", usage()));
        Err(self.report(expr, error))
    }

    /// A function of numbers.
    fn elementary(
        &mut self,
        expr: &Expr,
        called: &Called,
        arguments: &[Expr],
        values: &[Array],
    ) -> Outcome<Array> {
        let numbers: Vec<_> =
            arguments.iter().zip(values).map(|(argument, value)| self.as_number(argument, value)).collect();
        let numbers = numbers.into_iter().collect::<Outcome<Vec<_>>>()?;
        self.arguments_fit(expr, called, arguments, &numbers);
        let result = match (called, numbers.as_slice()) {
            (Called::One(function), [x]) => self.apply(*function, *x),
            (Called::Tan, [x]) => {
                let angle = self.graph.in_integers(*x);
                self.graph.tan(angle)
            }
            (Called::Sqrt, [x]) => {
                return Ok(Array::number(self.product_of(expr, &[(*x, Rational::new(1, 2))])?));
            }
            (Called::Two(function), [x, y]) => self.graph.apply2(*function, *x, *y),
            _ => return Err(Reported),
        };
        Ok(Array::number(self.checked(expr, result, 1)?))
    }

    /// Arguments are pure numbers, or alike.
    fn arguments_fit(&mut self, expr: &Expr, called: &Called, arguments: &[Expr], values: &[ExprId]) {
        let mut sides: Vec<_> =
            arguments.iter().zip(values).map(|(at, value)| self.written(at, *value, None)).collect();
        match called {
            Called::One(Function::Abs | Function::Sign) | Called::Sqrt | Called::Dot | Called::Cross => {}
            Called::Two(_) => self.same_unit(expr, "stands beside", sides),
            Called::One(_) | Called::Tan => {
                sides.insert(0, Measured::expected("the argument of a function", expr.extent));
                self.same_unit(expr, "is", sides);
            }
        }
    }

    pub(super) fn apply(&mut self, function: Function, x: ExprId) -> ExprId {
        match function {
            Function::Sin | Function::Cos => {
                // multiples of an angle have to do with each other
                let angle = self.graph.in_integers(x);
                if function == Function::Sin { self.graph.sin(angle) } else { self.graph.cos(angle) }
            }
            function => self.graph.apply(function, x),
        }
    }

    fn dot(&mut self, expr: &Expr, u: &Array, v: &Array) -> Outcome<Array> {
        match (u.shape, v.shape) {
            (Shape::Vector(n), Shape::Vector(m)) if n == m => {
                Ok(Array::number(self.inner_product(expr, &u.entries, &v.entries)?))
            }
            (a, b) => {
                let error = Diagnostic::new(expr.extent, "`dot` takes two vectors of the same length")
                    .evidence(format!("these are {a} and {b}"));
                Err(self.report(expr, error))
            }
        }
    }

    pub(super) fn cross(&mut self, expr: &Expr, u: &Array, v: &Array) -> Outcome<Array> {
        if (u.shape, v.shape) != (Shape::Vector(3), Shape::Vector(3)) {
            let error = Diagnostic::new(expr.extent, "`cross` takes two vectors of 3 entries")
                .evidence(format!("these are {} and {}", u.shape, v.shape));
            return Err(self.report(expr, error));
        }
        let mut entries = Vec::with_capacity(3);
        for (i, j) in [(1, 2), (2, 0), (0, 1)] {
            let plus = self.times(expr, u.entries[i], v.entries[j])?;
            let minus = self.times(expr, u.entries[j], v.entries[i])?;
            entries.push(self.sum_of(expr, vec![(Rational::ONE, plus), (Rational::MINUS_ONE, minus)])?);
        }
        Ok(Array::vector(entries))
    }

    /// `self.motor(a, b)`: the same call is made once.
    pub(super) fn method(&mut self, expr: &Expr, name: &Name, arguments: &[Expr]) -> Outcome<Array> {
        self.check_usage(expr, Usage::Method, &format!("self.{}(…)", name.text), expr.extent)?;
        let values: Vec<_> = arguments.iter().map(|argument| self.number_value(argument)).collect();
        let values = values.into_iter().collect::<Outcome<Vec<_>>>()?;
        for (k, (at, value)) in arguments.iter().zip(&values).enumerate() {
            let text = format!("argument {} of `self.{}`", k + 1, name.text);
            let expected = Measured::expected(text, expr.extent);
            let expected = expected.unknown(Unknown::Argument(name.text.clone(), k));
            let given = self.written(at, *value, None);
            self.same_unit(at, "is", vec![expected, given]);
        }
        let arguments = values;
        let same = |call: &&MethodCall| call.method == name.text && call.arguments == arguments;
        if let Some(call) = self.calls.iter().find(same) {
            let symbol = call.symbol;
            return Ok(Array::number(self.graph.symbol(symbol)));
        }
        self.reports.spend(expr.extent, self.calls.len())?;
        let texts: Vec<_> =
            arguments.iter().map(|argument| self.graph.text_within(*argument, ARGUMENT)).collect();
        let symbol = self.graph.new_symbol(format!("self.{}({})", name.text, texts.join(", ")));
        let origin = self.origin(expr.extent);
        let method = name.text.clone();
        self.methods.entry(method.clone()).or_insert_with(|| name.ident.clone());
        self.calls.push(MethodCall { symbol, method, arguments, derivatives: None, origin });
        Ok(Array::number(self.graph.symbol(symbol)))
    }

    pub(super) fn not_a_function(&mut self, name: &Name) -> Reported {
        let text = &name.text;
        let error = if self.scope.get(text).is_some() {
            let has_entries = match self.scope.get(text) {
                Some(Meaning::Named(named)) => named.shape != Shape::Number,
                Some(Meaning::Value(value)) => value.shape != Shape::Number,
                _ => false,
            };
            let entry =
                if has_entries { format!("an entry is written `{text}[…]`, ") } else { String::new() };
            Diagnostic::new(name.extent(), format!("`{text}` is not a function"))
                .way_out(format!("{entry}for a product write `{text} * (…)`"))
        } else {
            let known = FUNCTIONS.into_iter().chain(["sum", "dot", "cross"]).chain(tensor_names());
            let known: Vec<&str> = known.chain(self.scope.functions()).collect();
            let elsewhere = ELSEWHERE.iter().find(|(other, _)| other == text);
            let way_out = match elsewhere {
                _ if text == "ddot" => {
                    "accelerations follow from the equations; `der(x)` is a velocity".to_owned()
                }
                Some((_, ours)) => format!("write `{ours}`"),
                None => did_you_mean(text, known).unwrap_or_else(|| {
                    let branches = |word: &&str| Called::named(word).is_some_and(|called| called.branches());
                    let (branching, smooth): (Vec<&str>, Vec<&str>) =
                        FUNCTIONS.into_iter().filter(|word| *word != "der").partition(branches);
                    let smooth: Vec<&str> =
                        smooth.into_iter().chain(["dot", "cross"]).chain(tensor_names()).collect();
                    format!(
                        "functions are {}, and in `forces` and `outputs` also {}; one of yours stands between the \
                         sections: `let {text}(a) = …;`",
                        smooth.join(", "),
                        branching.join(", ")
                    )
                }),
            };
            let error = Diagnostic::new(name.extent(), format!("unknown function `{text}`")).way_out(way_out);
            return self.reports.report_unknown(name, text, error);
        };
        self.report(name, error)
    }
}

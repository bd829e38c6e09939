//! Runs a program without compiling it.

use super::step::{Program, Step, Value};
use crate::algebra::{Function, Function2, Rational};
use crate::id::{Id, SymbolId, Table};

/// The numbers that a program is run with.
pub trait Arithmetic: Clone {
    /// The number nearest to `value`.
    fn number(value: &Rational) -> Self;
    /// π.
    fn pi() -> Self;
    /// `self + other`.
    #[must_use]
    fn add(&self, other: &Self) -> Self;
    /// `self − other`.
    #[must_use]
    fn sub(&self, other: &Self) -> Self;
    /// `self · other`.
    #[must_use]
    fn mul(&self, other: &Self) -> Self;
    /// `self · other + summand`, as targets without an instruction for it compute it.
    #[must_use]
    fn mul_add(&self, other: &Self, summand: &Self) -> Self {
        self.mul(other).add(summand)
    }
    /// `self · other + summand` where that is the rounding error of a product or a quotient, [`Program::is_rest`].
    #[must_use]
    fn rest(&self, other: &Self, summand: &Self) -> Self {
        self.mul_add(other, summand)
    }
    /// `self / other`.
    #[must_use]
    fn div(&self, other: &Self) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(&self) -> Self;
    /// The real cube root.
    #[must_use]
    fn cbrt(&self) -> Self;
    /// The power with a positive real exponent.
    #[must_use]
    fn pow(&self, exponent: &Rational) -> Self;
    /// A function of one argument.
    #[must_use]
    fn apply(&self, function: Function) -> Self;
    /// A function of two arguments.
    #[must_use]
    fn apply2(&self, function: Function2, other: &Self) -> Self;
    /// What pivots are compared by.
    fn magnitude(&self) -> f64;
}

impl Arithmetic for f64 {
    fn number(value: &Rational) -> Self {
        value.to_f64()
    }
    fn pi() -> Self {
        std::f64::consts::PI
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn rest(&self, other: &Self, summand: &Self) -> Self {
        f64::mul_add(*self, *other, *summand)
    }
    fn div(&self, other: &Self) -> Self {
        self / other
    }
    fn sqrt(&self) -> Self {
        (*self).sqrt()
    }
    fn cbrt(&self) -> Self {
        (*self).cbrt()
    }
    fn pow(&self, exponent: &Rational) -> Self {
        self.powf(exponent.to_f64())
    }
    fn apply(&self, function: Function) -> Self {
        match function {
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Asin => self.asin(),
            Function::Acos => self.acos(),
            Function::Atan => self.atan(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            Function::Tanh => self.tanh(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Abs => self.abs(),
            Function::Sign if *self == 0.0 => *self,
            Function::Sign => self.signum(),
        }
    }
    fn apply2(&self, function: Function2, other: &Self) -> Self {
        match function {
            Function2::Atan2 => self.atan2(*other),
            Function2::Min => self.min(*other),
            Function2::Max => self.max(*other),
        }
    }
    fn magnitude(&self) -> f64 {
        self.abs()
    }
}

/// The outputs of a program in double precision.
///
/// ```
/// use nonholonomic_core::algebra::Graph;
/// use nonholonomic_core::mechanics::Procedure;
/// use nonholonomic_core::program::{interpret, schedule};
/// let mut g = Graph::new();
/// let x = g.new_symbol("x");
/// let e = { let x = g.symbol(x); g.square(x) };
/// let program = schedule(&g, &Procedure::of(vec![e]));
/// assert_eq!(interpret(&program, |_| 3.0), [9.0]);
/// ```
pub fn interpret(program: &Program, symbol: impl FnMut(SymbolId) -> f64) -> Vec<f64> {
    interpret_in(program, symbol)
}

/// The outputs of a program in any arithmetic.
pub fn interpret_in<A: Arithmetic>(program: &Program, mut symbol: impl FnMut(SymbolId) -> A) -> Vec<A> {
    let one = A::number(&Rational::ONE);
    let zero = A::number(&Rational::ZERO);
    let mut results: Table<Value, A> = Table::new();
    let mut solutions: Vec<(Value, Vec<A>)> = Vec::new();
    for (value, step) in program.steps.iter_ids() {
        let result = match step {
            Step::Constant(number) => A::number(number),
            Step::Pi => A::pi(),
            Step::Load(id) => symbol(*id),
            Step::Add(a, b) => results[*a].add(&results[*b]),
            Step::Sub(a, b) => results[*a].sub(&results[*b]),
            Step::Mul(a, b) => results[*a].mul(&results[*b]),
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                let signed = |value: &A, minus: bool| if minus { zero.sub(value) } else { value.clone() };
                let factor = signed(&results[*a], *minus_product);
                let summand = signed(&results[*c], *minus_c);
                if program.is_rest(step) {
                    factor.rest(&results[*b], &summand)
                } else {
                    factor.mul_add(&results[*b], &summand)
                }
            }
            Step::Div(a, b) => results[*a].div(&results[*b]),
            Step::Neg(a) => zero.sub(&results[*a]),
            Step::Recip(a) => one.div(&results[*a]),
            Step::Sqrt(a) => results[*a].sqrt(),
            Step::Cbrt(a) => results[*a].cbrt(),
            Step::PowReal(a, exponent) => results[*a].pow(exponent),
            Step::SinCos(angle) => results[*angle].clone(),
            Step::SinOf(pair) => results[*pair].apply(Function::Sin),
            Step::CosOf(pair) => results[*pair].apply(Function::Cos),
            Step::Apply(function, a) => results[*a].apply(*function),
            Step::Apply2(function, a, b) => results[*a].apply2(*function, &results[*b]),
            // a method of the user's has a value in the compiled program only
            Step::Call { .. } => zero.div(&zero),
            Step::Solve { matrix, right } => {
                let of = |values: &Vec<Value>| values.iter().map(|v| results[*v].clone()).collect();
                let solution = solve(matrix.iter().map(of).collect(), of(right));
                solutions.push((value, solution));
                zero.clone()
            }
            Step::Component(solution, index) => {
                let found = solutions.iter().find(|(value, _)| value == solution);
                found.map_or_else(|| zero.clone(), |(_, unknowns)| unknowns[*index].clone())
            }
        };
        debug_assert_eq!(results.len(), value.index());
        results.push(result);
    }
    program.outputs.iter().map(|output| results[*output].clone()).collect()
}

/// Elimination with partial pivoting, rows compared by their largest entries, as emitted code does it.
fn solve<A: Arithmetic>(mut matrix: Vec<Vec<A>>, mut right: Vec<A>) -> Vec<A> {
    let n = right.len();
    let largest = |row: &Vec<A>| row.iter().map(A::magnitude).fold(0.0, f64::max);
    let mut scales: Vec<f64> = matrix.iter().map(|row| largest(row).recip()).collect();
    for column in 0..n {
        let size = |row: usize| matrix[row][column].magnitude() * scales[row];
        let pivot = (column..n).fold(column, |best, row| if size(row) > size(best) { row } else { best });
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        scales.swap(column, pivot);
        let (above, below) = matrix.split_at_mut(column + 1);
        let pivots = &above[column];
        for (offset, row) in below.iter_mut().enumerate() {
            let factor = row[column].div(&pivots[column]);
            for (entry, pivot) in row.iter_mut().zip(pivots).skip(column) {
                *entry = entry.sub(&factor.mul(pivot));
            }
            let target = column + 1 + offset;
            right[target] = right[target].sub(&factor.mul(&right[column]));
        }
    }
    for row in (0..n).rev() {
        for k in row + 1..n {
            right[row] = right[row].sub(&matrix[row][k].mul(&right[k]));
        }
        right[row] = right[row].div(&matrix[row][row]);
    }
    right
}

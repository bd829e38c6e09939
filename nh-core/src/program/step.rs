//! The instructions of a straight-line program.

use crate::algebra::{Function, Function2, Rational};
use crate::id::{Id, SymbolId, Table, ids};
use std::collections::BTreeMap;

ids! {
    /// The result of a step.
    pub struct Value;
}

/// One instruction. Operands are results of earlier steps.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// A number.
    Constant(Rational),
    /// The number π.
    Pi,
    /// The value of a coordinate, velocity, parameter, input, or the time.
    Load(SymbolId),
    /// The sum.
    Add(Value, Value),
    /// The first less the second.
    Sub(Value, Value),
    /// The product.
    Mul(Value, Value),
    /// `a·b + c`, the product or `c` perhaps negative: one rounding where the target has an
    /// instruction for it.
    MulAdd {
        /// A factor.
        a: Value,
        /// The other factor.
        b: Value,
        /// The summand.
        c: Value,
        /// Whether the product is subtracted.
        minus_product: bool,
        /// Whether the summand is subtracted.
        minus_c: bool,
    },
    /// The first over the second.
    Div(Value, Value),
    /// The negative.
    Neg(Value),
    /// One over the operand.
    Recip(Value),
    /// The square root.
    Sqrt(Value),
    /// The real cube root.
    Cbrt(Value),
    /// A real power with a positive exponent that is neither an integer nor a half or third of one.
    PowReal(Value, Rational),
    /// Sine and cosine of one angle together, to be taken apart by `SinOf` and `CosOf`.
    SinCos(Value),
    /// The sine out of a `SinCos`.
    SinOf(Value),
    /// The cosine out of a `SinCos`.
    CosOf(Value),
    /// A function of one argument; `Sin` or `Cos` only if the other one is not needed.
    Apply(Function, Value),
    /// A function of two arguments.
    Apply2(Function2, Value, Value),
    /// A method of the user's, called with values.
    Call {
        /// Its name.
        method: String,
        /// What it is called with.
        arguments: Vec<Value>,
    },
    /// The solution of a linear system by elimination with pivoting, to be taken apart by
    /// `Component`.
    Solve {
        /// The rows of the square matrix.
        matrix: Vec<Vec<Value>>,
        /// The right-hand side.
        right: Vec<Value>,
    },
    /// One unknown of a `Solve`.
    Component(Value, usize),
}

impl Step {
    /// The operands in order.
    #[must_use]
    pub fn operands(&self) -> Vec<Value> {
        let mut operands = Vec::new();
        self.each_operand(|operand| operands.push(operand));
        operands
    }

    /// Visits the operands in order: as [`Self::operands`], without a list.
    pub(super) fn each_operand(&self, mut visit: impl FnMut(Value)) {
        match self {
            Self::Constant(_) | Self::Pi | Self::Load(_) => {}
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) | Self::Apply2(_, a, b) => {
                visit(*a);
                visit(*b);
            }
            Self::MulAdd { a, b, c, .. } => {
                visit(*a);
                visit(*b);
                visit(*c);
            }
            Self::Neg(a)
            | Self::Recip(a)
            | Self::Sqrt(a)
            | Self::Cbrt(a)
            | Self::PowReal(a, _)
            | Self::SinCos(a)
            | Self::SinOf(a)
            | Self::CosOf(a)
            | Self::Apply(_, a)
            | Self::Component(a, _) => visit(*a),
            Self::Call { arguments, .. } => arguments.iter().copied().for_each(visit),
            Self::Solve { matrix, right } => {
                matrix.iter().flatten().chain(right).copied().for_each(visit);
            }
        }
    }

    /// Whether this only names a number: nothing is computed.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        matches!(self, Self::Constant(_) | Self::Pi | Self::Load(_))
    }
}

/// A function as a list of steps without branches.
///
/// Every operand precedes its use, no step occurs twice, and every step is needed by an output.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// The steps in order of execution.
    pub steps: Table<Value, Step>,
    /// The results.
    pub outputs: Vec<Value>,
    /// The symbols of definitions, for the values that they name, in order.
    pub names: BTreeMap<Value, SymbolId>,
}

impl Program {
    /// How often each value is used, as an operand or an output.
    #[must_use]
    pub fn uses(&self) -> Table<Value, usize> {
        let mut uses: Table<Value, usize> = self.steps.iter().map(|_| 0).collect();
        self.steps.iter().for_each(|step| step.each_operand(|value| uses[value] += 1));
        self.outputs.iter().for_each(|value| uses[*value] += 1);
        uses
    }

    /// Which values some values are computed from, themselves included.
    #[must_use]
    pub fn needed_by(&self, results: &[Value]) -> Table<Value, bool> {
        let mut needed: Table<Value, bool> = self.steps.iter().map(|_| false).collect();
        for value in results {
            needed[*value] = true;
        }
        for value in self.steps.ids().rev() {
            if needed[value] {
                self.steps[value].each_operand(|operand| needed[operand] = true);
            }
        }
        needed
    }

    /// Whether a multiply-add is the rounding error of a product, `a b − (a b)`, or what a quotient leaves,
    /// `c − (c / b) b`: nothing without its exact product.
    #[must_use]
    pub fn is_rest(&self, step: &Step) -> bool {
        let Step::MulAdd { a, b, c, .. } = step else { return false };
        let is_same = |x: Value, y: Value| match (&self.steps[x], &self.steps[y]) {
            _ if x == y => true,
            (Step::Constant(x), Step::Constant(y)) => *x == -y.clone(),
            _ => false,
        };
        let is_product = matches!(&self.steps[*c], Step::Mul(x, y)
            if (is_same(*x, *a) && is_same(*y, *b)) || (is_same(*x, *b) && is_same(*y, *a)));
        let is_quotient = |quotient: Value, divisor: Value| match &self.steps[quotient] {
            Step::Div(x, y) => is_same(*x, *c) && is_same(*y, divisor),
            Step::Recip(y) => *y == divisor && matches!(&self.steps[*c], Step::Constant(_)),
            _ => false,
        };
        is_product || is_quotient(*a, *b) || is_quotient(*b, *a)
    }

    /// Which values are made of numbers and parameters alone.
    pub(super) fn fixed(&self, is_parameter: impl Fn(SymbolId) -> bool) -> Vec<bool> {
        let mut fixed: Vec<bool> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            fixed.push(match step {
                Step::Load(symbol) => is_parameter(*symbol),
                Step::Call { .. } => false,
                _ => {
                    let mut all = true;
                    step.each_operand(|operand| all &= fixed[operand.index()]);
                    all
                }
            });
        }
        fixed
    }

    /// The symbols that are loaded, in the order of their first use.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        let load = |step: &Step| if let Step::Load(symbol) = step { Some(*symbol) } else { None };
        self.steps.iter().filter_map(load).collect()
    }
}

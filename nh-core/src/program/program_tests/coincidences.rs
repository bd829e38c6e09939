//! Steps that have one value by an identity, and such that only seem to.

use super::symbols;
use crate::algebra::{Function, Graph, Rational};
use crate::choose::lowered;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::program::{Cost, Program, Scheduled, interpret, schedules};

/// What is emitted for some expressions, which is proved.
fn emitted(g: &Graph, outputs: Vec<ExprId>) -> Program {
    let lowered = lowered(g, &Procedure::of(outputs), &[], |program| program).unwrap();
    lowered.proof.unwrap();
    lowered.program
}

fn operations(g: &Graph, outputs: Vec<ExprId>) -> usize {
    let program = emitted(g, outputs);
    let Cost { sin_cos, .. } = Cost::of(&program);
    Cost::of(&program).operations() - sin_cos
}

/// What is the same is computed once, with either sign, and numbers are not computed.
#[test]
fn identities_are_found() {
    let mut g = Graph::new();
    let [a, b, c, q] = symbols(&mut g, ["a", "b", "c", "q"]);
    let (sine, cosine) = (g.apply(Function::Sin, q), g.apply(Function::Cos, q));
    let (squares, other) = (g.square(sine), g.square(cosine));
    // a (sin² + cos²) + b, where a factor stands in the way of the sum
    let turned = g.formula(a * squares + a * other + b);
    assert_eq!(operations(&g, vec![turned]), 1);
    // (a + b) (a − b) − a² + b² + c
    let [sum, difference] = [g.formula(a + b), g.formula(a - b)];
    let remaining = g.formula(sum * difference - a * a + b * b + c);
    assert_eq!(operations(&g, vec![remaining]), 0);
    // (a + b) (a − b), beside b² − a²
    let product = g.formula(sum * difference);
    let opposite = g.formula(b * b - a * a);
    assert_eq!(operations(&g, vec![product, opposite]), 4);
}

/// What is equal on one branch is not, and what is nearly equal is not.
#[test]
fn seeming_is_not_being() {
    let mut g = Graph::new();
    let [a, b, c] = symbols(&mut g, ["a", "b", "c"]);
    let size = g.apply(Function::Abs, a);
    let of = |program: &Program, numbers: [f64; 3]| {
        interpret(program, |symbol: SymbolId| numbers[crate::id::Id::index(symbol)])
    };
    let outputs = vec![g.formula(size * b), g.formula(a * b)];
    assert_eq!(of(&emitted(&g, outputs), [-2.0, 3.0, 0.0]), [6.0, -6.0]);
    let tiny = g.number(Rational::from(10).pow(-25).unwrap());
    let outputs = vec![g.formula(a * b), g.formula(a * b + tiny * c)];
    assert_eq!(of(&emitted(&g, outputs), [0.0, 3.0, 2.0]), [0.0, 2e-25]);
}

/// What exists at a place does not become what does not, though it is the same elsewhere and shorter.
#[test]
fn values_stay_where_they_exist() {
    let mut g = Graph::new();
    let [q, b] = symbols(&mut g, ["q", "b"]);
    let one = g.one();
    let powers: Vec<ExprId> = (0..8).map(|exponent| g.pow(q, Rational::from(exponent))).collect();
    let series = g.sum(&powers);
    let last = g.pow(q, Rational::from(8));
    // (1 − q⁸) / (1 − q), which is the series where q is not 1
    let closed = g.formula((one - last) / (one - q));
    let outputs = vec![closed, g.formula(series * b)];
    for Scheduled { program, .. } in schedules(&g, &Procedure::of(outputs), &[]) {
        let found = interpret(&program, |symbol| [1.0, 3.0][crate::id::Id::index(symbol)]);
        assert!((found[1] - 24.0).abs() < 1e-12, "{}", program.text(&g));
    }
}

//! What numbers alone give is a number, however much cancels in it.

use super::symbols;
use crate::algebra::{Function, Function2, Graph, Rational};
use crate::id::ExprId;
use crate::mechanics::Procedure;
use crate::program::{Program, corrected, interpret, schedule};

fn program(g: &Graph, output: ExprId) -> Program {
    schedule(g, &Procedure::of(vec![output]))
}

/// What a program gives where it is printed.
fn printed(program: &Program, x: f64) -> f64 {
    interpret(&program.with_known_numbers(), |_| x)[0]
}

fn is_near(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 2.0 * f64::EPSILON * expected.abs()
}

/// exp(π √163) − 262537412640768744, √2 − 1.41421356, arcs, and what is beyond the range in between.
fn numbers(g: &mut Graph) -> Vec<(ExprId, f64)> {
    let half = Rational::new(1, 2);
    let root = |g: &mut Graph, n: i64| {
        let n = g.number(n);
        g.pow(n, half.clone())
    };
    let (root_of_two, root) = (root(g, 2), root(g, 163));
    let pi = g.pi();
    let angle = g.formula(pi * root);
    let exponential = g.apply(Function::Exp, angle);
    let near = g.number(262_537_412_640_768_744);
    let decimals = g.number(Rational::new(141_421_356, 100_000_000));
    let (large, larger) = (g.number(799), g.number(800));
    let [large, larger] = [large, larger].map(|x| g.apply(Function::Exp, x));
    let small = g.number(Rational::new(1, 1_000_000_000));
    let (cosine, one) = (g.apply(Function::Cos, small), g.one());
    let (y, x) = (g.number(1), g.number(1_000_000));
    let arc = g.apply2(Function2::Atan2, y, x);
    vec![
        (g.formula(exponential - near), -7.499_274_028_018_143e-13),
        (g.formula(root_of_two - decimals), 2.373_095_048_801_688_7e-9),
        (g.formula(larger / large), std::f64::consts::E),
        (g.formula(one - cosine), 5e-19),
        (g.formula(arc - y / x), -3.333_333_333_331_333_4e-19),
    ]
}

#[test]
fn cancelling_numbers_keep_their_digits() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    for (number, expected) in numbers(&mut g) {
        let (product, sum) = (g.formula(number * x), g.formula(number + x));
        for (expression, expected) in [(number, expected), (product, 3.0 * expected), (sum, expected)] {
            let at = if expression == sum { 0.0 } else { 3.0 };
            let program = program(&g, expression);
            for program in [corrected(&program), program] {
                let found = printed(&program, at);
                assert!(is_near(found, expected), "{program:?}: {found:e}, not {expected:e}");
            }
        }
    }
}

#[test]
fn other_numbers_are_left_alone() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let (two, pi) = (g.number(2), g.pi());
    let root = g.pow(two, Rational::new(1, 2));
    let number = g.formula(root + pi);
    let sine = g.apply(Function::Sin, number);
    let expression = g.formula(sine * x);
    let program = program(&g, expression);
    assert!(program.known_numbers().is_empty(), "{program:?}");
}

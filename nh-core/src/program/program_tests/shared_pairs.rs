//! Pairs that are shared, where a list has the pair and what it is, too.

use super::symbols;
use crate::algebra::{Graph, Rational};
use crate::choose::prove_program;
use crate::mechanics::Procedure;
use crate::program::{Scheduled, schedules};

/// T = c r + 2 c s is factored to c (r + 2 s): where both factors stand beside T, all three are there.
#[test]
fn a_product_beside_its_own_factors() {
    let mut g = Graph::new();
    let [c, r, s, m, x, y] = symbols(&mut g, ["c", "r", "s", "m", "x", "y"]);
    let twice = g.scale(Rational::from(2), s);
    let sum = g.formula(r + twice);
    let whole = g.formula(c * r + c * twice);
    let factors = |list: &[crate::id::ExprId]| list.iter().map(|f| (*f, Rational::ONE)).collect::<Vec<_>>();
    let outputs = vec![
        whole,
        g.product(&factors(&[whole, m])),
        g.product(&factors(&[whole, c, sum, m])),
        g.product(&factors(&[whole, c, sum, m, x])),
        g.product(&factors(&[whole, whole, sum, y])),
    ];
    let procedure = Procedure::of(outputs);
    for Scheduled { program, .. } in schedules(&g, &procedure, &[]) {
        prove_program(&g, &procedure, &program).unwrap_or_else(|_| panic!("{}", program.text(&g)));
    }
}

/// The same of sums.
#[test]
fn a_sum_beside_its_own_summands() {
    let mut g = Graph::new();
    let [a, b, c, d, f] = symbols(&mut g, ["a", "b", "c", "d", "f"]);
    let [inner, twice] = [g.formula(a + b), g.scale(Rational::from(2), a)];
    let product = g.formula(f * inner);
    let outputs = vec![
        inner,
        product,
        g.formula(f * a + f * b + a + b + c),
        g.formula(f * a + f * b + a + b + d),
        g.formula(f * a + f * b + product + twice + b + d),
    ];
    let procedure = Procedure::of(outputs);
    for Scheduled { program, .. } in schedules(&g, &procedure, &[]) {
        prove_program(&g, &procedure, &program).unwrap_or_else(|_| panic!("{}", program.text(&g)));
    }
}

//! Sums at the scale at which they are used.

use super::symbols;
use crate::algebra::{Graph, Rational, Residue};
use crate::choose::prove_program;
use crate::id::ExprId;
use crate::mechanics::Procedure;
use crate::program::import::import;
use crate::program::scales::scaled;
use crate::program::{Cost, schedule, schedules};

/// ½ (a − 2 h) f, four times, and ¼ (a − 2 h)² b: no product with a number is left.
#[test]
fn halves_and_doubles_go_into_sums() {
    let mut g = Graph::new();
    let [a, b, h, x, y] = symbols(&mut g, ["a", "b", "h", "x", "y"]);
    let twice = g.scale(Rational::from(2), h);
    let sum = g.formula(a - twice);
    let mut outputs = Vec::new();
    for other in [a, b, x, y] {
        let product = g.formula(other * sum);
        outputs.push(g.scale(Rational::new(1, 2), product));
    }
    let square = g.formula(b * sum.square());
    outputs.push(g.scale(Rational::new(1, 4), square));
    let procedure = Procedure::of(outputs);
    let arena = import(&g, &procedure, &[]);
    assert!(scaled(&arena).is_some());
    let program = schedule(&g, &procedure);
    prove_program(&g, &procedure, &program).unwrap_or_else(|_| panic!("{}", program.text(&g)));
    let cost = Cost::of(&program);
    // ½ a − h, that times each, and once more
    assert_eq!((cost.multiply_adds, cost.multiplications), (1, 5), "{}", program.text(&g));

    let unscaled = Procedure::of(vec![g.formula(x * (a - h)), g.formula(y * (b + h))]);
    assert!(scaled(&import(&g, &unscaled, &[])).is_none());
}

/// Random sums and products with numbers in them, and roots, sines and quotients of those: what every program computes is
/// what was asked for.
#[test]
fn scales_change_no_value() {
    let mut changed = 0;
    for seed in 0..200 {
        let mut g = Graph::new();
        let mut terms: Vec<ExprId> = symbols(&mut g, ["a", "b", "c", "d"]).to_vec();
        let word = |k: usize| Residue::mixed(seed, k as u64).word();
        for k in 0..30 {
            let of = |salt: u64| terms[usize::try_from((word(k) >> salt) % terms.len() as u64).unwrap_or(0)];
            let (x, y) = (of(5), of(23));
            let number = Rational::new(
                [1, 1, 2, 3, 4][(word(k) % 5) as usize],
                [1, 2, 4, 8][(word(k) >> 40) as usize % 4],
            );
            let scaled = g.scale(number, x);
            terms.push(match (word(k) >> 50) % 8 {
                0 => g.formula(x / (y.square() + 2)),
                1 => g.formula((y.square() + 1).sqrt() * scaled),
                2 => g.formula(x.sin() + scaled),
                3 | 4 => g.formula(scaled * y),
                5 => g.formula(scaled - y),
                _ => g.formula(scaled + y),
            });
        }
        let procedure = Procedure::of(terms.split_off(terms.len() - 4));
        changed += usize::from(scaled(&import(&g, &procedure, &[])).is_some());
        for scheduled in schedules(&g, &procedure, &[]) {
            let program = scheduled.program;
            prove_program(&g, &procedure, &program)
                .unwrap_or_else(|_| panic!("{seed}: {}", program.text(&g)));
        }
    }
    assert!(changed > 50, "{changed}");
}

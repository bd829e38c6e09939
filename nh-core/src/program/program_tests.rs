//! A program has the value of its procedure, and the known cases cost what they should.

use super::{Cost, Program, Step, corrected, interpret, interpret_in, schedule, schedule_grouping};
use crate::algebra::{Accuracy, Bounded, Function, Function2, Graph, Node, Rational};
use crate::id::{ExprId, Id, SymbolId};
use crate::limits::timed;
use crate::mechanics::{Definition, Procedure};
use proptest::prelude::*;
use std::collections::HashMap;

mod accuracy_levels;
mod coincidences;
mod derivatives;
mod exponents;
mod kept_digits;
mod numbers_alone;
mod shared_pairs;
mod sums_at_scales;

/// The value of a procedure, node by node.
fn evaluate(graph: &Graph, procedure: &Procedure, symbol: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    let mut defined: HashMap<SymbolId, f64> = HashMap::new();
    let value = |defined: &HashMap<SymbolId, f64>, root: ExprId| {
        let mut values: HashMap<ExprId, f64> = HashMap::new();
        for id in graph.reachable(&[root]) {
            let result = match graph.node(id) {
                Node::Number(number) => number.to_f64(),
                Node::Pi => std::f64::consts::PI,
                Node::Constant(constant) => graph.constants()[*constant].value.to_f64(),
                Node::Symbol(s) => defined.get(s).copied().unwrap_or_else(|| symbol(*s)),
                Node::Sum { constant, terms } => {
                    constant.to_f64() + terms.iter().map(|(t, c)| values[t] * c.to_f64()).sum::<f64>()
                }
                Node::Product { coefficient, factors } => {
                    let power = |(base, e): &(ExprId, Rational)| match e.to_i64() {
                        Some(e) => values[base].powi(i32::try_from(e).unwrap()),
                        None => values[base].powf(e.to_f64()),
                    };
                    coefficient.to_f64() * factors.iter().map(power).product::<f64>()
                }
                Node::Apply(f, x) => super::Arithmetic::apply(&values[x], *f),
                Node::Apply2(f, x, y) => super::Arithmetic::apply2(&values[x], *f, &values[y]),
            };
            values.insert(id, result);
        }
        values[&root]
    };
    for definition in &procedure.definitions {
        if let Definition::Value { symbol, value: expression } = definition {
            let result = value(&defined, *expression);
            defined.insert(*symbol, result);
        }
    }
    procedure.outputs.iter().map(|output| value(&defined, *output)).collect()
}

/// Instructions from which an expression is built: an operation and two earlier results.
fn random() -> impl Strategy<Value = (Vec<(u8, usize, usize)>, Vec<f64>)> {
    let instructions = prop::collection::vec((0u8..16, 0usize..1000, 0usize..1000), 1..60);
    (instructions, prop::collection::vec(0.2f64..2.0, 5))
}

fn build(graph: &mut Graph, instructions: &[(u8, usize, usize)]) -> Procedure {
    let symbols: Vec<SymbolId> = ["a", "b", "x", "y", "z"].map(|name| graph.new_symbol(name)).into();
    let mut procedure = Procedure::default();
    let mut pool: Vec<ExprId> = symbols.iter().map(|s| graph.symbol(*s)).collect();
    for (operation, i, j) in instructions {
        let (x, y) = (pool[i % pool.len()], pool[j % pool.len()]);
        let coefficient = Rational::new(i64::try_from(i % 7).unwrap() - 3, 1 + i64::try_from(j % 3).unwrap());
        let result = match operation {
            0..=2 => graph.formula(x + y),
            3 => graph.formula(x - y),
            4..=6 => graph.formula(x * y),
            7 => graph.linear_combination(&[(coefficient.clone(), x), (-coefficient, y)]),
            8 => graph.sin(x),
            9 => graph.cos(x),
            10 => {
                let (square, one) = (graph.square(y), graph.one());
                graph.formula(x / (square + one))
            }
            11 => graph.square(x),
            12 => {
                let (square, one) = (graph.square(x), graph.one());
                let positive = graph.formula(square + one);
                graph.pow(positive, Rational::new(i64::try_from(j % 9).unwrap() - 4, 2))
            }
            13 => graph.apply(Function::Tanh, x),
            14 => graph.apply2(Function2::Atan2, x, y),
            _ => procedure.define(graph, "d", x),
        };
        pool.push(result);
    }
    procedure.outputs = pool.iter().rev().take(4).copied().collect();
    procedure
}

fn assert_well_formed(program: &Program) {
    let uses = program.uses();
    for (value, step) in program.steps.iter_ids() {
        assert!(step.operands().iter().all(|operand| *operand < value), "operands come first");
        assert!(uses[value] > 0, "no dead step {value:?}: {step:?}");
    }
}

/// Whether a program asks for the angle of a point that is on the negative axis as far as rounding tells, where angles
/// jump from π to −π: the sign of a zero is no part of the algebra.
fn is_on_a_cut(program: &Program, symbol: impl Fn(SymbolId) -> f64) -> bool {
    let points = program.steps.iter().filter_map(|step| match step {
        Step::Apply2(Function2::Atan2, y, x) => Some([*y, *x]),
        _ => None,
    });
    let mut arguments = program.clone();
    arguments.outputs = points.flatten().collect();
    let values = interpret_in(&arguments, |s| Bounded { value: symbol(s), error: 0.0 });
    let is_zero = |y: &Bounded| y.value.abs() <= y.error || y.value == 0.0;
    values.chunks_exact(2).any(|point| is_zero(&point[0]) && (point[1].value < 0.0 || is_zero(&point[1])))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_program_has_the_value_of_its_procedure((instructions, values) in random()) {
        let mut graph = Graph::new();
        let procedure = build(&mut graph, &instructions);
        let program = schedule_grouping(&graph, &procedure, &[SymbolId::from_index(0)]);
        assert_well_formed(&program);
        let symbol = |s: SymbolId| values[s.index()];
        prop_assume!(!is_on_a_cut(&program, symbol));
        let expected = evaluate(&graph, &procedure, symbol);
        // at every level of accuracy
        graph.set_accuracy(Accuracy::Fast);
        let fast = schedule(&graph, &procedure);
        assert_well_formed(&fast);
        let careful = corrected(&program);
        assert_well_formed(&careful);
        let size = expected.iter().fold(1.0f64, |m, v| m.max(v.abs()));
        for program in [program, fast, careful] {
            let found = interpret_in(&program, |s| Bounded { value: symbol(s), error: 0.0 });
            prop_assert_eq!(found.len(), expected.len());
            for (Bounded { value, error }, expected) in found.iter().zip(&expected) {
                prop_assume!(expected.is_finite() && size < 1e12);
                // what is computed in another order is as far off as rounding takes either
                let allowed = 1e-6 * size + 2.0 * error;
                prop_assert!((value - expected).abs() <= allowed, "{} for {}", value, expected);
            }
        }
    }
}

/// A graph with symbols, and an expression parser small enough for tests.
fn symbols<const N: usize>(graph: &mut Graph, names: [&str; N]) -> [ExprId; N] {
    names.map(|name| {
        let symbol = graph.new_symbol(name);
        graph.symbol(symbol)
    })
}

fn cost(graph: &Graph, outputs: &[ExprId]) -> Cost {
    let program = schedule(graph, &Procedure::of(outputs.to_vec()));
    assert_well_formed(&program);
    Cost::of(&program)
}

fn count(additions: usize, multiplications: usize, divisions: usize) -> Cost {
    Cost { additions, multiplications, divisions, ..Cost::default() }
}

#[test]
fn the_kinetic_energy_is_factored() {
    let mut g = Graph::new();
    let [m, v1, v2, v3] = symbols(&mut g, ["m", "v1", "v2", "v3"]);
    let squares = [v1, v2, v3].map(|v| g.square(v));
    let terms = squares.map(|s| g.formula(m * s));
    let sum = g.sum(&terms);
    let energy = g.scale(Rational::new(1, 2), sum);
    // m/2 (v1² + v2² + v3²)
    assert_eq!(cost(&g, &[energy]), Cost { multiply_adds: 2, ..count(0, 3, 0) });
}

#[test]
fn a_polynomial_takes_horners_form() {
    let mut g = Graph::new();
    let [x, a, b, c, d] = symbols(&mut g, ["x", "a", "b", "c", "d"]);
    let mut sum = d;
    for (power, coefficient) in [(1, c), (2, b), (3, a)] {
        let power = g.pow(x, Rational::from(power));
        sum = g.formula(sum + coefficient * power);
    }
    assert_eq!(cost(&g, &[sum]), Cost { multiply_adds: 3, ..Cost::default() });
}

#[test]
fn products_in_sums_are_fused_with_either_sign() {
    let mut g = Graph::new();
    let [a, b, c, d, x] = symbols(&mut g, ["a", "b", "c", "d", "x"]);
    let (p, q) = (g.formula(a * b), g.formula(c * d));
    // x − a b − c d starts with what is no product
    let (minus_p, minus_q) = (g.formula(-p), g.formula(-q));
    let sum = g.sum(&[minus_p, x, minus_q]);
    assert_eq!(cost(&g, &[sum]), Cost { multiply_adds: 2, ..Cost::default() });
    let difference = g.formula(p - x);
    assert_eq!(cost(&g, &[difference]), Cost { multiply_adds: 1, ..Cost::default() });
    // a product that is needed itself is not computed twice
    assert_eq!(cost(&g, &[difference, p]), count(1, 1, 0));
    // x² − a² stays what it is under a root: fused it may be less than zero where x = a
    let (x2, a2) = (g.square(x), g.square(a));
    let difference = g.formula(x2 - a2);
    let root = g.sqrt(difference);
    let under_root = cost(&g, &[root]);
    assert_eq!(under_root.multiply_adds, 0);
}

#[test]
fn powers_share_their_chain() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let powers = [2, 3, 4].map(|n| g.pow(x, Rational::from(n)));
    assert_eq!(cost(&g, &powers), count(0, 3, 0));
    let inverse = g.pow(x, Rational::from(-3));
    assert_eq!(cost(&g, &[inverse]), count(0, 2, 1));
}

#[test]
fn one_reciprocal_per_shared_denominator() {
    let mut g = Graph::new();
    let [a, b, c, x, y] = symbols(&mut g, ["a", "b", "c", "x", "y"]);
    let denominator = g.formula(x + y);
    let quotients = [a, b, c].map(|n| g.formula(n / denominator));
    assert_eq!(cost(&g, &quotients), count(1, 3, 1));
    let lone = g.formula(a / denominator);
    assert_eq!(cost(&g, &[lone]), count(1, 0, 1));
    let xy = g.formula(x * y);
    let nested = g.formula(a / xy);
    assert_eq!(cost(&g, &[nested]), count(0, 1, 1));
    let both = [a, b].map(|n| g.formula(n / xy));
    assert_eq!(cost(&g, &both), count(0, 3, 1));
}

#[test]
fn halves_of_powers_are_roots() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let powers = [1, 3, -1].map(|n| g.pow(x, Rational::new(n, 2)));
    let expected = Cost { multiplications: 1, divisions: 1, square_roots: 1, ..Cost::default() };
    assert_eq!(cost(&g, &powers), expected);
}

#[test]
fn differences_share_up_to_the_sign() {
    let mut g = Graph::new();
    let [x, y, z, w] = symbols(&mut g, ["x", "y", "z", "w"]);
    let a = g.sum(&[x, y, z]);
    let negative = g.formula(-y);
    let (nx, nz) = (g.formula(-x), g.formula(-z));
    let b = g.sum(&[w, nx, negative, nz]);
    // w − (x + y + z)
    assert_eq!(cost(&g, &[a, b]), count(3, 0, 0));
    let (d, e) = (g.formula(x - y), g.formula(y - x));
    assert_eq!(cost(&g, &[d, e]), count(2, 0, 0));
}

#[test]
fn sine_and_cosine_of_one_angle_come_together() {
    let mut g = Graph::new();
    let [x] = symbols(&mut g, ["x"]);
    let both = [g.sin(x), g.cos(x)];
    let program = schedule(&g, &Procedure::of(both.to_vec()));
    assert_eq!(program.steps.iter().filter(|s| matches!(s, Step::SinCos(_))).count(), 1);
    let alone = schedule(&g, &Procedure::of(vec![both[0]]));
    assert!(alone.steps.iter().any(|s| matches!(s, Step::Apply(Function::Sin, _))));
}

#[test]
fn parameters_meet_first() {
    let mut g = Graph::new();
    let [x, m, y, l] = symbols(&mut g, ["x", "m", "y", "l"]);
    let product = g.product(&[x, m, y, l].map(|f| (f, Rational::ONE)));
    let parameters: Vec<_> = [m, l].iter().filter_map(|id| g.as_symbol(*id)).collect();
    let program = schedule_grouping(&g, &Procedure::of(vec![product]), &parameters);
    let first = program.steps.iter().find(|step| matches!(step, Step::Mul(..))).unwrap();
    let loads = first.operands().into_iter().map(|v| program.steps[v].clone()).collect::<Vec<_>>();
    assert_eq!(loads, parameters.iter().map(|s| Step::Load(*s)).collect::<Vec<_>>());
}

/// The Chaplygin sleigh, CLMM section 6.1.
#[test]
fn the_sleigh_is_as_cheap_as_by_hand() {
    let mut g = Graph::new();
    let [m, j, a, theta, omega, v] = symbols(&mut g, ["m", "J", "a", "theta", "omega", "v"]);
    let (sin, cos) = (g.sin(theta), g.cos(theta));
    let (dx, dy) = (g.formula(v * cos), g.formula(v * sin));
    let aa = g.square(a);
    let inertia = g.formula(j + m * aa);
    let numerator = g.product(&[m, a, omega, v].map(|f| (f, Rational::ONE)));
    let (domega, omega2) = (g.formula(-(numerator / inertia)), g.square(omega));
    let dv = g.formula(a * omega2);
    let cost = cost(&g, &[omega, dx, dy, domega, dv]);
    // −J − (m a) a; ((m a) (ω v)) / …; a ω²
    let expected = Cost { multiply_adds: 1, sin_cos: 1, ..count(0, 7, 1) };
    assert_eq!(cost, expected);
}

#[test]
fn definitions_and_linear_systems_are_computed_once() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let mut procedure = Procedure::default();
    let sum = g.formula(x + y);
    let s = procedure.define(&mut g, "s", sum);
    let square = g.square(s);
    let (two, one) = (g.number(2), g.one());
    let unknowns = vec![g.new_symbol("p"), g.new_symbol("q")];
    let (p, q) = (g.symbol(unknowns[0]), g.symbol(unknowns[1]));
    let matrix = vec![vec![two, one], vec![one, two]];
    procedure.definitions.push(Definition::Solve { unknowns, matrix, right: vec![x, y] });
    procedure.outputs = vec![square, p, q];
    let program = schedule(&g, &procedure);
    assert_well_formed(&program);
    assert_eq!(program.steps.iter().filter(|s| matches!(s, Step::Solve { .. })).count(), 1);
    let found = interpret(&program, |symbol| if symbol.index() == 0 { 4.0 } else { 5.0 });
    for (found, expected) in found.iter().zip([81.0, 1.0, 2.0]) {
        assert!((found - expected).abs() < 1e-14);
    }
}

#[test]
fn large_procedures_schedule_in_linear_time() {
    let mut g = Graph::new();
    let names: Vec<String> = (0..300).map(|i| format!("x{i}")).collect();
    let x: Vec<ExprId> = names
        .iter()
        .map(|name| {
            let symbol = g.new_symbol(name.clone());
            g.symbol(symbol)
        })
        .collect();
    let mut outputs = Vec::new();
    for i in 0..300 {
        let products: Vec<ExprId> =
            (0..12).map(|k| g.formula(x[(i + k) % 300] * x[(i * 7 + k * k) % 300])).collect();
        outputs.push(g.sum(&products));
    }
    let (program, seconds) = timed(|| schedule(&g, &Procedure::of(outputs)));
    assert!(seconds < 10.0, "{seconds} s");
    assert_well_formed(&program);
}

#[test]
fn negations_go_where_they_are_free() {
    let mut g = Graph::new();
    let [a, b, x, y, z] = symbols(&mut g, ["a", "b", "x", "y", "z"]);
    let (p, q) = (g.formula(a * b), g.formula(x - y));
    let difference = g.formula(p - z);
    let negative = g.formula(-(q / difference));
    assert_eq!(cost(&g, &[negative]), Cost { multiply_adds: 1, ..count(1, 0, 1) });
    // the difference is needed with its own sign too: the divisor takes the other one
    assert_eq!(cost(&g, &[negative, q]), Cost { multiply_adds: 1, ..count(1, 0, 1) });
    let program = schedule(&g, &Procedure::of(vec![negative, q]));
    let values = [2.0, 3.0, 7.0, 5.0, 4.0];
    assert_eq!(interpret(&program, |symbol| values[symbol.index()]), [-1.0, 2.0]);
    // a number changes its sign
    let half = g.scale(Rational::new(1, 2), q);
    let outputs = [p, z].map(|factor| g.formula(-(half * factor)));
    assert_eq!(cost(&g, &outputs), count(1, 4, 0));
    let program = schedule(&g, &Procedure::of(outputs.to_vec()));
    assert_eq!(interpret(&program, |symbol| values[symbol.index()]), [-6.0, -4.0]);
}

#[test]
fn what_varies_is_multiplied_by_reciprocals_of_parameters() {
    let mut g = Graph::new();
    let symbols = ["m", "l", "x", "y"].map(|name| g.new_symbol(name));
    let [m, l, x, y] = symbols.map(|symbol| g.symbol(symbol));
    let (by_parameters, by_state, fixed) = (g.formula(x / (m + l)), g.formula(x / y), g.formula(m / l));
    let outputs = vec![by_parameters, by_state, fixed];
    let divisions = |parameters: &[SymbolId]| {
        let program = schedule_grouping(&g, &Procedure::of(outputs.clone()), parameters);
        let count = |is: fn(&Step) -> bool| program.steps.iter().filter(|step| is(step)).count();
        (count(|step| matches!(step, Step::Div(..))), count(|step| matches!(step, Step::Recip(_))))
    };
    assert_eq!(divisions(&[]), (3, 0));
    assert_eq!(divisions(&symbols[..2]), (2, 1));
}

#[test]
fn a_divisor_of_parameters_meets_other_parameters_first() {
    let mut g = Graph::new();
    let symbols = ["m", "l", "x", "y"].map(|name| g.new_symbol(name));
    let [m, l, x, y] = symbols.map(|symbol| g.symbol(symbol));
    let inertia = g.formula(m + l);
    let force = g.product(&[m, x, y].map(|factor| (factor, Rational::ONE)));
    let acceleration = g.formula(force / inertia);
    let program = schedule_grouping(&g, &Procedure::of(vec![acceleration]), &symbols[..2]);
    // what is left to do where m/(m + l) is known
    let mut varies = vec![false; program.steps.len()];
    let mut left = 0;
    for (value, step) in program.steps.iter_ids() {
        let mut moves = matches!(step, Step::Load(symbol) if symbols[2..].contains(symbol));
        step.each_operand(|operand| moves |= varies[operand.index()]);
        varies[value.index()] = moves;
        left += usize::from(moves && !step.is_leaf());
    }
    assert_eq!(left, 2, "{program:?}");
}

//! Digits that are kept where parameters lie decades apart.

use super::symbols;
use crate::algebra::Graph;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Definition, Procedure};
use crate::program::{Program, corrected, interpret, schedule};

/// Mass, lever, mass and radius of gyration: m l² is 10²⁰ times i k².
const APART: [f64; 4] = [3e4, 7e3, 2e-3, 2.5e-3];
/// i k².
const INERTIA: f64 = 1.25e-8;

fn run(program: &Program) -> Vec<f64> {
    interpret(program, |symbol| APART.get(symbol.index()).copied().unwrap_or(0.7))
}

fn is_near(found: f64, expected: f64) -> bool {
    (found - expected).abs() < 1e-12 * expected.abs()
}

/// A body on a lever, with what its elimination starts from: m, m l, i k² + m l².
struct Body {
    g: Graph,
    procedure: Procedure,
    m: ExprId,
    lever: ExprId,
    turned: ExprId,
}

fn body() -> Body {
    let mut g = Graph::new();
    let [m, l, i, k] = symbols(&mut g, ["m", "l", "i", "k"]);
    let inertia = g.formula(i * k.square());
    let mut procedure = Procedure::default();
    let lever = g.formula(m * l);
    let lever = procedure.define(&mut g, "lever", lever);
    let turned = g.formula(inertia + lever * l);
    let turned = procedure.define(&mut g, "turned", turned);
    Body { g, procedure, m, lever, turned }
}

/// i k² + m l² − (m l)² / m.
#[test]
fn what_elimination_leaves_keeps_its_digits() {
    let Body { mut g, mut procedure, m, lever, turned } = body();
    let ratio = g.formula(lever / m);
    let ratio = procedure.define(&mut g, "ratio", ratio);
    let pivot = g.formula(turned - lever * ratio);
    let pivot = procedure.define(&mut g, "pivot", pivot);
    procedure.outputs = vec![g.formula(m / pivot)];
    let program = schedule(&g, &procedure);
    let expected = APART[0] / INERTIA;
    assert!(!is_near(run(&program)[0], expected), "{:?}", run(&program));
    let kept = run(&corrected(&program));
    assert!(is_near(kept[0], expected), "{kept:?} for {expected}");
}

/// i k² + m l² sin² x + m l² cos² x − m l², mathematics (60).
#[test]
fn sine_and_cosine_lie_on_the_circle_where_that_matters() {
    let mut g = Graph::new();
    let [m, l, i, k] = symbols(&mut g, ["m", "l", "i", "k"]);
    let inertia = g.formula(i * k.square());
    let x = g.new_symbol("x");
    let x = g.symbol(x);
    let mut procedure = Procedure::default();
    let (sin, cos) = (g.sin(x), g.cos(x));
    let [across, along] = [sin, cos].map(|part| g.formula(l * part));
    let across = procedure.define(&mut g, "across", across);
    let along = procedure.define(&mut g, "along", along);
    let (first, second) = (g.square(across), g.square(along));
    let sum = g.formula(inertia + m * first + m * second);
    let sum = procedure.define(&mut g, "sum", sum);
    let square = g.square(l);
    let rest = g.formula(sum - m * square);
    let rest = procedure.define(&mut g, "rest", rest);
    procedure.outputs = vec![g.formula(x / rest)];
    let program = schedule(&g, &procedure);
    let expected = 0.7 / INERTIA;
    assert!(!is_near(run(&program)[0], expected), "{:?}", run(&program));
    let kept = run(&corrected(&program));
    assert!((kept[0] / expected - 1.0).abs() < 1e-6, "{kept:?} for {expected}");
}

/// Mathematics (61), on [[i k² + m l², m l], [m l, m]].
#[test]
fn pivoted_solutions_are_refined() {
    let Body { mut g, mut procedure, m, lever, turned } = body();
    let unknowns: Vec<SymbolId> = ["a", "b"].map(|name| g.new_symbol(name)).to_vec();
    procedure.outputs = unknowns.iter().map(|symbol| g.symbol(*symbol)).collect();
    let matrix = vec![vec![turned, lever], vec![lever, m]];
    procedure.definitions.push(Definition::Solve { unknowns, matrix, right: vec![lever, lever] });
    let program = schedule(&g, &procedure);
    // i k² is 10⁻¹⁰ of m l²
    let [mass, lever, inertia] = [2.0, 3e2, 1.8e-5];
    let values = |symbol: SymbolId| [mass, lever, inertia, 1.0][symbol.index()];
    // i k² a = m l (1 − l)
    let expected = mass * lever * (1.0 - lever) / inertia;
    let found = |program: &Program| interpret(program, values)[0];
    assert!((found(&program) / expected - 1.0).abs() > 1e-8, "{}", found(&program));
    let kept = found(&corrected(&program));
    assert!((kept / expected - 1.0).abs() < 1e-11, "{kept} for {expected}");
}

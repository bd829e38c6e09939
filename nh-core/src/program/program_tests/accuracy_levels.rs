//! What the levels of accuracy do to programs.

use super::{assert_well_formed, symbols};
use crate::algebra::{Accuracy, Graph, Rational};
use crate::choose::lowered;
use crate::id::{ExprId, Id};
use crate::mechanics::Procedure;
use crate::program::{
    Program, Step, corrected, error_growth, error_growth_apart, error_growth_apart_in_runs,
    error_growth_in_runs, interpret, schedule,
};

#[test]
fn corrected_sums_and_quotients_are_exact_where_rounding_would_tell() {
    let mut g = Graph::new();
    let [x, y, z] = symbols(&mut g, ["x", "y", "z"]);
    let (sum, product) = (g.formula(x + y), g.formula(x * y));
    // intermediate results, which the algebra does not cancel
    let mut procedure = Procedure::default();
    let sum = procedure.define(&mut g, "s", sum);
    let product = procedure.define(&mut g, "p", product);
    let quotient = g.formula(product / y);
    let quotient = procedure.define(&mut g, "q", quotient);
    procedure.outputs = vec![g.formula(sum - x), g.formula(quotient - x), g.formula(z - x)];
    let values = [1.0, 1e-30, 3.0];
    let run = |program: &Program| interpret(program, |symbol| values[symbol.index()]);
    let program = schedule(&g, &procedure);
    assert_eq!(run(&program), [0.0, 0.0, 2.0]);
    assert_eq!(run(&corrected(&program)), [1e-30, 0.0, 2.0]);
}

#[test]
fn a_divisor_is_corrected_before_anything_is_divided_by_it() {
    let mut g = Graph::new();
    let [x, y, z] = symbols(&mut g, ["x", "y", "z"]);
    let mut procedure = Procedure::default();
    let sum = g.formula(x + y);
    let sum = procedure.define(&mut g, "s", sum);
    let difference = g.formula(sum - x);
    let difference = procedure.define(&mut g, "d", difference);
    // y² z / y and z / y, where the computed sum keeps nothing of y
    let square = g.square(difference);
    let square = procedure.define(&mut g, "dd", square);
    procedure.outputs = vec![g.formula(square * z / difference), g.formula(z / difference)];
    let values = [1.0, 2f64.powi(-60), 3.0];
    let run = |program: &Program| interpret(program, |symbol| values[symbol.index()]);
    let program = schedule(&g, &procedure);
    assert!(run(&program).iter().all(|value| !value.is_normal()), "{:?}", run(&program));
    assert_eq!(run(&corrected(&program)), [3.0 * values[1], 3.0 / values[1]]);
}

#[test]
fn programs_that_differ_where_symbols_are_far_apart_are_told_apart() {
    // J + m l² − (m l)² / (M + m), and without what cancels: alike where all are of ordinary size
    let mut g = Graph::new();
    let [j, m, l, cart] = symbols(&mut g, ["J", "m", "l", "M"]);
    let mut procedure = Procedure::default();
    let lever = g.formula(m * l);
    let lever = procedure.define(&mut g, "lever", lever);
    let (mass, squared, turned) = (g.formula(cart + m), g.square(lever), g.formula(lever * l));
    let (carried, sum) = (g.formula(squared / mass), g.formula(j + turned));
    procedure.outputs = vec![g.formula(sum - carried)];
    let (rest, square) = (g.formula(m * cart), g.square(l));
    let short = Procedure::of(vec![g.formula(j + rest * square / mass)]);
    let programs = [schedule(&g, &procedure), schedule(&g, &short)];
    let (ordinary, apart) = (error_growth(&g, &programs), error_growth_apart(&g, &programs));
    assert!(ordinary[0] < 64.0 && ordinary[1] < 2.0, "{ordinary:?}");
    assert!(apart[0] > 4096.0 && apart[1] < 2.0, "{apart:?}");
}

/// A vector that is turned twenty times: a bound grows with each turn, the error does not. What adds a large number and
/// takes it away again is seen in runs as well.
#[test]
fn what_a_bound_finds_fault_with_is_seen_in_runs() {
    let mut g = Graph::new();
    let [x, y, angle, load] = symbols(&mut g, ["x", "y", "angle", "load"]);
    let twentieth = g.scale(Rational::new(1, 20), angle);
    let mut turned = Procedure::default();
    let [sine, cosine] = [g.sin(twentieth), g.cos(twentieth)];
    let [sine, cosine] = [sine, cosine].map(|value| turned.define(&mut g, "", value));
    let (mut a, mut b) = (x, y);
    for _ in 0..20 {
        let next = [g.formula(cosine * a - sine * b), g.formula(sine * a + cosine * b)];
        [a, b] = next.map(|value| turned.define(&mut g, "", value));
    }
    turned.outputs = vec![a, b];
    let (sine, cosine) = (g.sin(angle), g.cos(angle));
    let at_once = vec![g.formula(cosine * x - sine * y), g.formula(sine * x + cosine * y)];
    let mut loaded = Procedure::default();
    let large = g.scale(Rational::from(1000), load);
    let sums: Vec<ExprId> = at_once.iter().map(|value| g.formula(*value + large)).collect();
    let sums: Vec<ExprId> = sums.into_iter().map(|sum| loaded.define(&mut g, "", sum)).collect();
    loaded.outputs = sums.iter().map(|sum| g.formula(*sum - large)).collect();
    let programs = [turned, loaded, Procedure::of(at_once)].map(|procedure| schedule(&g, &procedure));
    let bounds = error_growth(&g, &programs);
    let runs = error_growth_in_runs(&g, &programs.each_ref(), &programs[2]);
    assert!(bounds[0] > 16.0 && bounds[1] > 16.0, "{bounds:?}");
    assert!(runs[0] < 2.0 && runs[1] > 16.0 && runs[2] < 1.1, "{runs:?}");
    // where the load is up to eight decades larger than the vector
    let apart = error_growth_apart(&g, &programs);
    let runs = error_growth_apart_in_runs(&g, &programs.each_ref(), &programs[2]);
    assert!(apart[0] > 16.0 && apart[1] > 1e6, "{apart:?}");
    assert!(runs[0] < 8.0 && runs[1] > 1e6 && runs[2] < 1.1, "{runs:?}");
}

#[test]
fn fast_code_takes_sines_of_sums_from_those_of_the_parts() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let (sum, difference) = (g.formula(x + y), g.formula(x - y));
    let twice = g.scale(Rational::from(-2), x);
    let angles = [x, y, sum, difference, twice];
    let outputs: Vec<ExprId> = angles.into_iter().flat_map(|angle| [g.sin(angle), g.cos(angle)]).collect();
    let evaluations = |g: &Graph| {
        let program = schedule(g, &Procedure::of(outputs.clone()));
        let found = interpret(&program, |symbol| [0.3, -1.1][symbol.index()]);
        for (index, angle) in [0.3, -1.1, -0.8, 1.4, -0.6_f64].into_iter().enumerate() {
            assert!((found[2 * index] - angle.sin()).abs() < 1e-15, "sin {angle}");
            assert!((found[2 * index + 1] - angle.cos()).abs() < 1e-15, "cos {angle}");
        }
        program.steps.iter().filter(|step| matches!(step, Step::SinCos(_))).count()
    };
    assert_eq!(evaluations(&g), 5);
    g.set_accuracy(Accuracy::Fast);
    assert_eq!(evaluations(&g), 2);
}

/// Balanced code does where nothing is lost by it: what is left of a small sine is the result here, and a summand there.
#[test]
fn balanced_code_takes_sines_of_sums_from_parts_where_results_keep_their_digits() {
    let mut g = Graph::new();
    let [x, y, mass, load] = symbols(&mut g, ["x", "y", "mass", "load"]);
    let difference = g.formula(x - y);
    let parts: Vec<ExprId> = [x, y].into_iter().flat_map(|angle| [g.sin(angle), g.cos(angle)]).collect();
    let of = |g: &mut Graph, turned: ExprId| {
        let mut outputs = parts.clone();
        outputs.push(turned);
        let lowered = lowered(g, &Procedure::of(outputs), &[], |program| program).unwrap();
        assert!(lowered.proof.is_ok());
        lowered.program.steps.iter().filter(|step| matches!(step, Step::SinCos(_) | Step::Apply(..))).count()
    };
    let sine = g.sin(difference);
    assert_eq!(of(&mut g, sine), 3);
    let cosine = g.cos(difference);
    let inertia = g.formula(mass + load.square() * (mass + load * cosine).square());
    assert_eq!(of(&mut g, inertia), 2);
}

#[test]
fn no_sine_is_taken_from_angles_that_contain_it() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let inner = g.formula(x - y);
    let sine = g.sin(inner);
    // their difference is the angle of the sine in both
    let angles = [g.formula(x + sine), g.formula(y + sine)];
    let outputs = angles.map(|angle| g.sin(angle)).to_vec();
    g.set_accuracy(Accuracy::Fast);
    let program = schedule(&g, &Procedure::of(outputs));
    assert_well_formed(&program);
    let found = interpret(&program, |symbol| [0.3, -1.1][symbol.index()]);
    let sine = 1.4_f64.sin();
    for (found, angle) in found.iter().zip([0.3 + sine, -1.1 + sine]) {
        assert!((found - angle.sin()).abs() < 1e-15, "sin {angle}");
    }
}

#[test]
fn a_form_that_cancels_has_the_larger_error() {
    let mut g = Graph::new();
    let [x, y] = symbols(&mut g, ["x", "y"]);
    let difference = g.formula(x - y);
    let square = g.square(difference);
    let (x2, y2, xy) = (g.square(x), g.square(y), g.formula(x * y));
    let two = Rational::from(2);
    let expanded = g.linear_combination(&[(Rational::ONE, x2), (-two, xy), (Rational::ONE, y2)]);
    let programs = [square, expanded].map(|form| schedule(&g, &Procedure::of(vec![form])));
    let growth = error_growth(&g, &programs);
    assert!(growth[0] <= 1.0 && growth[1] > 4.0, "{growth:?}");
}

//! Derivatives step by step are those of the expressions, whatever is solved on the way.

use super::super::{Systems, Wanted, accumulated};
use crate::algebra::{Graph, Rational};
use crate::choose::prove_equal;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definiteness, Definition, Procedure, derivative_along, jacobian, solve_symmetric};

/// Three coupled unknowns with coefficients that depend on x and y, then a result in which they meet again.
fn coupled(graph: &mut Graph, definiteness: Definiteness) -> (Procedure, [SymbolId; 3]) {
    let symbols = ["x", "y", "m"].map(|name| graph.new_symbol(name));
    let [x, y, m] = symbols.map(|symbol| graph.symbol(symbol));
    let (sine, cosine) = (graph.sin(x), graph.cos(y));
    let square = graph.square(x);
    let far = graph.number(5);
    let entries = [graph.formula(far + square), graph.formula(m * sine), graph.formula(m * cosine)];
    let more = [graph.formula(far + m * sine * sine), graph.formula(x * y), graph.formula(far + cosine * y)];
    let matrix = vec![
        vec![entries[0], entries[1], entries[2]],
        vec![entries[1], more[0], more[1]],
        vec![entries[2], more[1], more[2]],
    ];
    let right = [graph.formula(x * m), graph.formula(sine / y), graph.formula(y * y)];
    let mut procedure = Procedure::default();
    let solution = solve_symmetric(graph, &matrix, &right, definiteness, &mut procedure, "v");
    let met = graph.formula(solution[0] * solution[1] + solution[2] * sine);
    procedure.outputs = [solution, vec![met]].concat();
    (procedure, symbols)
}

fn weighted(graph: &mut Graph, rows: &[ExprId], weights: &[SymbolId]) -> Vec<ExprId> {
    let weights: Vec<ExprId> = weights.iter().map(|weight| graph.symbol(*weight)).collect();
    let columns = rows.len() / weights.len();
    let column = |column: usize| rows.iter().copied().skip(column).step_by(columns).collect();
    let by_column: Vec<Vec<ExprId>> = (0..columns).map(column).collect();
    by_column.iter().map(|column| graph.inner_product(column, &weights)).collect()
}

#[test]
fn what_is_solved_is_differentiated_with_its_factors() {
    for definiteness in [Definiteness::Definite, Definiteness::Unknown] {
        let mut graph = Graph::new();
        let (procedure, symbols) = coupled(&mut graph, definiteness);
        assert_eq!(procedure.solved.len(), usize::from(definiteness == Definiteness::Definite));
        let arguments = &symbols[..2];
        let direction = ["a", "b"].map(|name| graph.new_symbol(name));
        let weights = ["p", "q", "r", "s"].map(|name| graph.new_symbol(name));
        let components = direction.map(|symbol| graph.symbol(symbol));
        let rows = jacobian(&mut graph, &procedure, arguments).expect("there are no methods");
        let along = derivative_along(&mut graph, &procedure, arguments.iter().copied().zip(components));
        let along = along.expect("there are no methods");
        let sums = weighted(&mut graph, &rows.outputs, &weights);
        let sums = rows.with_outputs(sums);
        for systems in [Systems::All, Systems::Pivoted] {
            let mut agree = |wanted: Wanted, expected: &Procedure| {
                let found = accumulated(&mut graph, &procedure, (arguments, &symbols[2..]), systems, wanted);
                let Some(found) = found.expect("there are no methods") else {
                    assert_eq!((systems, definiteness), (Systems::All, Definiteness::Unknown));
                    return;
                };
                prove_equal(&graph, &found, expected).expect("the same derivatives");
                // a factor of what is solved that is not used would not be noticed otherwise
                let of_other_sign = found.outputs.iter().map(|output| graph.formula(-*output)).collect();
                assert!(prove_equal(&graph, &found.with_outputs(of_other_sign), expected).is_err());
            };
            agree(Wanted::Jacobian, &rows);
            agree(Wanted::AlongDirection(&direction), &along);
            agree(Wanted::OfWeightedSum(&weights), &sums);
        }
    }
}

/// A pivoted system whose matrix is not symmetric: weights are pulled back through its transpose.
#[test]
fn a_matrix_that_is_not_symmetric_is_transposed() {
    let mut graph = Graph::new();
    let [x, y] = ["x", "y"].map(|name| graph.new_symbol(name));
    let [ex, ey] = [x, y].map(|symbol| graph.symbol(symbol));
    let unknowns = ["u", "v"].map(|name| graph.new_symbol(name));
    let [u, v] = unknowns.map(|symbol| graph.symbol(symbol));
    let three = graph.number(3);
    let matrix = vec![vec![ex, three], vec![ey, graph.formula(ex * ey)]];
    let right = vec![graph.sin(ex), ey];
    let mut procedure = Procedure::of(vec![graph.formula(u * ex), graph.formula(u - v)]);
    procedure.definitions.push(Definition::Solve { unknowns: unknowns.to_vec(), matrix, right });
    let weights = ["p", "q"].map(|name| graph.new_symbol(name));
    let rows = jacobian(&mut graph, &procedure, &[x, y]).expect("there are no methods");
    let sums = weighted(&mut graph, &rows.outputs, &weights);
    let wanted = Wanted::OfWeightedSum(&weights);
    let found = accumulated(&mut graph, &procedure, (&[x, y], &[]), Systems::Pivoted, wanted);
    let found = found.expect("there are no methods").expect("another way");
    prove_equal(&graph, &found, &rows.with_outputs(sums)).expect("the same derivatives");
}

/// d x^(3/2) is 0 at 0, where the root that the power is computed by has no derivative.
#[test]
fn powers_beyond_roots_are_left_to_expressions() {
    let mut graph = Graph::new();
    let x = graph.new_symbol("x");
    let ex = graph.symbol(x);
    for (power, is_left) in [(Rational::new(3, 2), true), (Rational::new(1, 2), false)] {
        let procedure = Procedure::of(vec![graph.pow(ex, power)]);
        let found = accumulated(&mut graph, &procedure, (&[x], &[]), Systems::Pivoted, Wanted::Jacobian);
        assert_eq!(found.expect("there are no methods").is_none(), is_left);
    }
}

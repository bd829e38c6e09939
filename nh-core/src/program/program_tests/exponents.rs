//! Exponents at the ends of the integers.

use super::*;

/// Where the sum of two exponents, or its opposite, does not fit, the powers stay apart.
#[test]
fn steep_exponents_keep_their_parity() {
    let ends = [i32::MIN, i32::MIN + 1, i32::MAX - 1, i32::MAX].map(i64::from);
    let exponents = ends.into_iter().chain([i64::from(i32::MAX) + 1, (1 << 53) - 1]);
    for exponent in exponents {
        let mut graph = Graph::new();
        let [x, y, a] = symbols(&mut graph, ["x", "y", "a"]);
        let steep = graph.pow(x, Rational::from(exponent));
        let cube = graph.pow(y, Rational::from(-3));
        let product = graph.formula(steep * cube);
        let more = graph.formula(product * a);
        let sum = graph.sum(&[more, product, x]);
        // x stands behind a definition, which is put in place
        let inner = graph.new_symbol("inner");
        let named = graph.symbol(inner);
        let steeper = graph.pow(named, Rational::from(2));
        let outputs = vec![steep, product, sum, graph.formula(steeper * cube)];
        let mut procedure = Procedure::of(outputs.clone());
        procedure.definitions.push(Definition::Value { symbol: inner, value: steep });
        let program = schedule_grouping(&graph, &procedure, &[]);
        assert_well_formed(&program);
        let sign = if exponent % 2 == 0 { 1.0_f64 } else { -1.0 };
        let found = interpret(&program, |symbol| if symbol.index() < 2 { -1.0 } else { 0.0 });
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found), bits(&[sign, -sign, -sign - 1.0, -1.0]), "{exponent}: {found:?}");
    }
}

//! Where the determinant of a choice of velocities can vanish.

use crate::algebra::{
    Echelon, Facts, FieldPoint, Function, Graph, Matrix, Node, Residue, Substitution, Verdict,
};
use crate::id::{ExprId, SymbolId};

/// What is known of the zeros of a pivot: it vanishes nowhere but where one of these factors of it does.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PivotZeros {
    /// Expressions of parameters alone.
    pub conditions: Vec<ExprId>,
    /// Where one of these vanishes the constraints are dependent.
    pub rank_drops: Vec<ExprId>,
    /// These may vanish somewhere else.
    pub elsewhere: Vec<ExprId>,
}

/// The setting in which pivots are judged.
#[derive(Clone, Copy, Debug)]
pub struct PivotSetting<'a> {
    /// Φ, a column for each velocity; or derivatives of what vanishes, a column for each coordinate.
    pub annihilator: &'a Matrix,
    /// Φ on the embedded base, where independence is judged.
    pub on_base: &'a Matrix,
    /// Symbols that do not change along a motion.
    pub parameters: &'a [SymbolId],
    /// What is known of their ranges.
    pub facts: &'a Facts,
}

impl PivotSetting<'_> {
    /// Judges one pivot.
    pub fn zeros(&self, graph: &mut Graph, pivot: ExprId) -> PivotZeros {
        let simple = graph.simplify(pivot);
        let simple = self.without_coordinates(graph, simple).unwrap_or(simple);
        let mut found = PivotZeros::default();
        for (base, exponent) in graph.factors(simple) {
            if exponent.is_negative() || self.vanishes_nowhere(graph, base) {
                continue;
            }
            let kind = if self.is_of_parameters(graph, base) {
                &mut found.conditions
            } else if self.constraints_are_dependent_where(graph, base) {
                &mut found.rank_drops
            } else if graph.has_no_zeros(base, self.facts) {
                continue;
            } else {
                &mut found.elsewhere
            };
            kind.push(graph.without_content(base));
        }
        found
    }

    /// By its range, or as a number.
    fn vanishes_nowhere(&self, graph: &Graph, expression: ExprId) -> bool {
        graph.vanishes_nowhere(expression, self.facts)
            || (graph.symbols_in(&[expression]).is_empty() && graph.zero_test(expression).is_nonzero())
    }

    fn is_of_parameters(&self, graph: &Graph, expression: ExprId) -> bool {
        graph.symbols_in(&[expression]).iter().all(|symbol| self.parameters.contains(symbol))
    }

    /// An equal expression of parameters alone, if the coordinates drop out by identities.
    fn without_coordinates(&self, graph: &mut Graph, expression: ExprId) -> Option<ExprId> {
        let coordinates: Vec<SymbolId> = graph
            .symbols_in(&[expression])
            .into_iter()
            .filter(|symbol| !self.parameters.contains(symbol))
            .collect();
        for value in [0, 1] {
            let value = graph.number(value);
            let fixed =
                Substitution::new(coordinates.iter().map(|symbol| (*symbol, value))).apply(graph, expression);
            if !graph.is_undefined(fixed) {
                let difference = graph.formula(expression - fixed);
                return (graph.zero_test(difference) == Verdict::Zero).then_some(fixed);
            }
        }
        None
    }

    /// Whether Φ has less than full rank wherever `factor` vanishes, tried at points there.
    fn constraints_are_dependent_where(&self, graph: &mut Graph, factor: ExprId) -> bool {
        const POINTS: u64 = 4;
        (0..POINTS).all(|index| {
            let start = 4_000 + 100 * index;
            let points: Option<Vec<FieldPoint>> =
                (0..64).map(|seed| point_on_zero(graph, factor, start + seed)).collect();
            let Some(points) = points else { return false };
            let at = |seed: u64| {
                usize::try_from(seed).ok().and_then(|i| points.get(i).cloned()).unwrap_or_default()
            };
            graph
                .matrix_in_field(self.annihilator, at)
                .is_ok_and(|rows| Echelon::of(rows).rank() < self.annihilator.len())
        })
    }
}

/// A point of the field where the factor vanishes, for the kinds of factor that can be solved.
pub(crate) fn point_on_zero(graph: &mut Graph, factor: ExprId, seed: u64) -> Option<FieldPoint> {
    let mut point = FieldPoint::random(seed);
    let sign = if seed.is_multiple_of(2) { Residue::ONE } else { -Residue::ONE };
    match *graph.node(factor) {
        Node::Symbol(symbol) => {
            point.chosen.insert(symbol, Residue::ZERO);
            point.circle.insert(symbol, (Residue::ONE, Residue::ZERO));
            Some(point)
        }
        Node::Apply(function @ (Function::Sin | Function::Cos), x) => {
            let symbol = graph.as_symbol(x)?;
            let turn = if function == Function::Sin { (sign, Residue::ZERO) } else { (Residue::ZERO, sign) };
            point.circle.insert(symbol, turn);
            Some(point)
        }
        Node::Sum { .. } => {
            let symbols = graph.symbols_in(&[factor]);
            symbols.into_iter().rev().find_map(|symbol| {
                let form = graph.linear_form(factor, &[symbol]).ok()?;
                let values = graph.evaluate_in_field(&[form.coefficients[0], form.rest], &point).ok()?;
                let root = -values[1] * values[0].inverse()?;
                let mut point = point.clone();
                point.chosen.insert(symbol, root);
                Some(point)
            })
        }
        _ => None,
    }
}

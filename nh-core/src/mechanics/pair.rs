//! Two linear equations with a symmetric matrix.

use super::procedure::Procedure;
use super::symmetric_solve::Definiteness;
use crate::algebra::{Graph, Matrix, Node, Rational};
use crate::id::ExprId;

/// `a x + b y = f`, `b x + d y = g`.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    /// a, b, d.
    pub(super) matrix: [ExprId; 3],
    /// f, g.
    pub(super) right: [ExprId; 2],
}

/// Pairs whose entries have more operations than this are not simplified as a whole.
const SIMPLIFIED_WHOLE: u64 = 240;
/// What Cramer's rule costs on top of the entries: six products, three differences and two quotients,
/// in the units of `operation_count`.
const OPERATIONS: u64 = 21;
/// How many times more the shortest way may lose where symbols are far apart.
const MUCH: f64 = 256.0;
/// What one unknown may cost, given the other, that nothing else is tried.
const SHORT: u64 = 12;

impl Pair {
    /// The solution in the shortest way, unless that loses digits where symbols are far apart that another keeps.
    pub(super) fn solve(
        self,
        graph: &mut Graph,
        definiteness: Definiteness,
        procedure: &mut Procedure,
        names: &[String; 2],
    ) -> [ExprId; 2] {
        let mut own = procedure.clone();
        own.definitions.clear();
        let mut values = self.shortest(graph, definiteness, &mut own, names);
        if let Some((other, kept)) = self.without_cancellation(graph, procedure, &names[0]) {
            let [shortest, kept_out] = [(&own, &values), (&other, &kept)]
                .map(|(way, values)| way.with_outputs(values.to_vec()).written_out(graph));
            let [cheap, dear] = [(&own, &values), (&other, &kept)]
                .map(|(way, values)| graph.operation_count(&way.with_outputs(values.to_vec()).values(graph)));
            let gains = shortest.iter().zip(&kept_out).map(|(short, kept)| graph.gain_apart(*kept, *short));
            if dear * 4 <= cheap * 5 && gains.fold(0.0, f64::max) > MUCH {
                (own, values) = (other, kept);
            }
        }
        procedure.definitions.extend(own.definitions);
        values
    }

    /// The solution in the shortest way that the level of accuracy allows against Cramer's rule.
    ///
    /// Terms of the determinant often cancel identically (the sleigh's m²b², say), so that the solution
    /// simplified as a whole is mostly cheaper than the rule, and nothing is lost to that cancellation.
    /// Cheaper still is one unknown from the other, where one row is short.
    fn shortest(
        self,
        graph: &mut Graph,
        definiteness: Definiteness,
        procedure: &mut Procedure,
        names: &[String; 2],
    ) -> [ExprId; 2] {
        let entries = [self.matrix.as_slice(), &self.right].concat();
        let written_out = graph.operation_count(&entries) + OPERATIONS;
        if written_out > SIMPLIFIED_WHOLE {
            return self.named(graph, procedure, &names[0]).by_cramer(graph);
        }
        let rule = self.by_cramer(graph);
        if let Some([mean, half_difference]) = self.by_halves(graph) {
            let values = [graph.formula(mean + half_difference), graph.formula(mean - half_difference)];
            if graph.is_as_accurate(&values, &rule) {
                let mean = procedure.define(graph, &format!("{}_mean", names[0]), mean);
                let half_difference = procedure.define(graph, &format!("{}_half", names[0]), half_difference);
                return [graph.formula(mean + half_difference), graph.formula(mean - half_difference)];
            }
        }
        let whole = rule.map(|value| graph.simplify(value));
        let whole_is_accurate = graph.is_as_accurate(&whole, &rule);
        if let Some((last, [rest, slope])) = self.relation(graph, definiteness, whole) {
            let first = 1 - last;
            let length = graph.operation_count(&[whole[first], rest, slope]);
            let is_shorter =
                graph.operation_count(&[rest, slope]) <= SHORT || length < graph.operation_count(&whole);
            let mut values = whole;
            values[last] = substituted(graph, [rest, slope], whole[first]);
            // what cancels identically in the solution as a whole may be left in the relation
            let best = if whole_is_accurate { whole } else { rule };
            if is_shorter && length <= written_out && graph.is_as_accurate(&values, &best) {
                values[first] = procedure.define(graph, &names[first], whole[first]);
                values[last] = substituted(graph, [rest, slope], values[first]);
                return values;
            }
        }
        if graph.operation_count(&whole) <= written_out && whole_is_accurate {
            return whole;
        }
        self.named(graph, procedure, &names[0]).by_cramer(graph)
    }

    /// The solution simplified as a whole, where that is no longer than the rule.
    pub(super) fn simplified(self, graph: &mut Graph) -> Option<[ExprId; 2]> {
        let entries = [self.matrix.as_slice(), &self.right].concat();
        let written_out = graph.operation_count(&entries) + OPERATIONS;
        if written_out > SIMPLIFIED_WHOLE {
            return None;
        }
        let rule = self.by_cramer(graph);
        let whole = rule.map(|value| graph.simplify(value));
        (graph.operation_count(&whole) <= written_out && graph.is_as_accurate(&whole, &rule)).then_some(whole)
    }

    /// The entries as intermediate results.
    fn named(self, graph: &mut Graph, procedure: &mut Procedure, name: &str) -> Self {
        let mut index = 0;
        let mut named = |entry: ExprId| {
            index += 1;
            procedure.define(graph, &format!("{name}_entry{}", index - 1), entry)
        };
        Self { matrix: self.matrix.map(&mut named), right: self.right.map(&mut named) }
    }

    /// Cramer's rule.
    fn by_cramer(self, graph: &mut Graph) -> [ExprId; 2] {
        let ([a, b, d], [f, g]) = (self.matrix, self.right);
        let determinant = difference_of_products(graph, (a, d), (b, b));
        let determinant = graph.simplify(determinant);
        let first = difference_of_products(graph, (d, f), (b, g));
        let second = difference_of_products(graph, (a, g), (b, f));
        [graph.formula(first / determinant), graph.formula(second / determinant)]
    }

    /// The rows of the inverse of the matrix, by the same rule.
    pub(super) fn inverse(self, graph: &mut Graph) -> Matrix {
        let (zero, one) = (graph.zero(), graph.one());
        let [first, second] =
            [[one, zero], [zero, one]].map(|right| Self { right, ..self }.by_cramer(graph).to_vec());
        // it is symmetric
        vec![first, second]
    }

    /// Cramer's rule, with differences of products in which nothing cancels identically: `(J + m l²) m − (m l)²` as
    /// `J m`. Where inertias are far apart nothing else is left of J.
    fn without_cancellation(
        self,
        graph: &mut Graph,
        procedure: &Procedure,
        name: &str,
    ) -> Option<(Procedure, [ExprId; 2])> {
        let ([a, b, d], [f, g]) = (self.matrix, self.right);
        let pairs = [((a, d), (b, b)), ((d, f), (b, g)), ((a, g), (b, f))];
        let differences = pairs.map(|(first, second)| {
            let difference = difference_of_products(graph, first, second);
            graph.simplify(difference)
        });
        let saved = differences.map(|difference| {
            let length = graph.operation_count(&[difference]);
            graph.without_cancellation(difference, length)
        });
        if saved.iter().all(Option::is_none) {
            return None;
        }
        let [determinant, first, second] = std::array::from_fn(|k| saved[k].unwrap_or(differences[k]));
        let mut own = procedure.clone();
        own.definitions.clear();
        let determinant = own.define(graph, &format!("{name}_determinant"), determinant);
        Some((own, [graph.formula(first / determinant), graph.formula(second / determinant)]))
    }

    /// Where a = d, as for two equal wheels: (x + y)/2 and (x − y)/2, each from an equation of its own.
    fn by_halves(self, graph: &mut Graph) -> Option<[ExprId; 2]> {
        let ([a, b, d], [f, g]) = (self.matrix, self.right);
        let difference = graph.formula(a - d);
        if !graph.zero_test(difference).is_zero() {
            return None;
        }
        Some([Rational::ONE, Rational::MINUS_ONE].map(|sign| {
            let force = graph.linear_combination(&[(Rational::ONE, f), (sign.clone(), g)]);
            let mass = graph.linear_combination(&[(Rational::from(2), a), (sign * Rational::from(2), b)]);
            let quotient = graph.formula(force / mass);
            graph.simplify(quotient)
        }))
    }

    /// An unknown as `rest − slope · other` by its own equation: the one for which that is shorter. What is
    /// divided by has to be different from zero, and no condition is added for speed alone: a pivot is no sum, or a
    /// factor of the determinant, by which the solution as a whole divides as well.
    fn relation(
        self,
        graph: &mut Graph,
        definiteness: Definiteness,
        whole: [ExprId; 2],
    ) -> Option<(usize, [ExprId; 2])> {
        if definiteness != Definiteness::Definite {
            return None;
        }
        let ([a, b, d], right) = (self.matrix, self.right);
        let pivots = [a, d].map(|pivot| graph.simplify(pivot));
        let is_sum = |pivot: ExprId| matches!(graph.node(pivot), Node::Sum { .. });
        let unknowns = (0..2).filter(|k| !is_sum(pivots[*k]) || divide_by(graph, &whole, pivots[*k]));
        let unknowns: Vec<usize> = unknowns.collect();
        let relations = unknowns.into_iter().map(|k| {
            let relation = [right[k], b].map(|entry| {
                let quotient = graph.formula(entry / pivots[k]);
                graph.simplify(quotient)
            });
            (k, relation)
        });
        let relations: Vec<_> = relations.collect();
        relations.into_iter().min_by_key(|(_, relation)| graph.operation_count(relation))
    }
}

/// `rest − slope · other`.
fn substituted(graph: &mut Graph, [rest, slope]: [ExprId; 2], other: ExprId) -> ExprId {
    graph.formula(rest - slope * other)
}

fn difference_of_products(graph: &mut Graph, first: (ExprId, ExprId), second: (ExprId, ExprId)) -> ExprId {
    let (x, y) = (graph.formula(first.0 * first.1), graph.formula(second.0 * second.1));
    graph.formula(x - y)
}

/// Whether some quotient in the values is by a power of the divisor.
fn divide_by(graph: &Graph, values: &[ExprId], divisor: ExprId) -> bool {
    graph.reachable(values).into_iter().any(|id| match graph.node(id) {
        Node::Product { factors, .. } => factors.iter().any(|(base, e)| *base == divisor && e.is_negative()),
        _ => false,
    })
}

//! Definite matrices as L D Lᵀ with unit lower triangular L, unrolled and without pivoting.

use super::procedure::Procedure;
use crate::algebra::{Graph, Matrix, Rational};
use crate::id::ExprId;

/// An entry on the way to the solution: as it is computed, from intermediate results, and in terms of
/// the matrix and the right-hand side alone, while that is short.
///
/// Intermediate results hide what cancels identically. Written out, it is seen.
#[derive(Clone, Copy, Debug)]
struct Entry {
    value: ExprId,
    written_out: Option<ExprId>,
}

/// `L D Lᵀ` with unit lower triangular L.
#[derive(Clone, Debug)]
pub(super) struct Ldl {
    /// Below the diagonal: L.
    lower: Vec<Vec<Entry>>,
    /// D.
    diagonal: Vec<Entry>,
}

/// Entries of the factorisation with more operations than this are not simplified.
pub(super) const SIMPLIFIED: u64 = 40;
/// Simplified entries with no more operations than this stay in place, so that later ones simplify.
const IN_PLACE: u64 = 6;
/// Entries that are longer written out are not looked at any more.
const WRITTEN_OUT: u64 = 160;

impl Entry {
    /// An entry of what is given.
    fn given(graph: &Graph, value: ExprId) -> Self {
        Self { value, written_out: (graph.operation_count(&[value]) <= WRITTEN_OUT).then_some(value) }
    }

    fn zero(graph: &mut Graph) -> Self {
        let zero = graph.zero();
        Self { value: zero, written_out: Some(zero) }
    }

    /// `entry − Σ Π factors`.
    fn less_products(self, graph: &mut Graph, products: &[Vec<Self>]) -> Self {
        let mut difference = |of: fn(&Self) -> Option<ExprId>| {
            let mut terms = vec![(Rational::ONE, of(&self)?)];
            for factors in products {
                let factors: Option<Vec<ExprId>> = factors.iter().map(of).collect();
                let product = factors?.into_iter().reduce(|a, b| graph.formula(a * b))?;
                terms.push((Rational::MINUS_ONE, product));
            }
            Some(graph.linear_combination(&terms))
        };
        let value = difference(|entry| Some(entry.value)).unwrap_or(self.value);
        let written_out = difference(|entry| entry.written_out);
        let is_short = |whole: &ExprId| graph.operation_count(&[*whole]) <= WRITTEN_OUT;
        Self { value, written_out: written_out.filter(is_short) }
    }

    /// `entry / divisor`.
    fn over(self, graph: &mut Graph, divisor: Self) -> Self {
        let value = graph.formula(self.value / divisor.value);
        let written_out = self.written_out.zip(divisor.written_out).map(|(a, b)| graph.formula(a / b));
        Self { value, written_out }
    }

    /// What is seen where it is written out: that it vanishes, or that it is shorter and depends on less than
    /// its way through intermediate results.
    fn looked_at(self, graph: &mut Graph) -> Self {
        let Some(whole) = self.written_out else { return self };
        if graph.zero_test(whole).is_zero() {
            return Self::zero(graph);
        }
        let short = graph.freed(whole).unwrap_or(whole);
        let is_shorter = graph.operation_count(&[short]) < graph.operation_count(&[self.value]);
        if is_shorter && graph.error_growth(short, whole) <= graph.accuracy().growth() {
            return Self { value: short, written_out: Some(short) };
        }
        self.without_cancellation(graph, whole)
    }

    /// Simplified, where terms that cancel identically would take digits with them that the rest needs: what elimination
    /// leaves of a chain of bodies, `J + m l² − (m l)²/m`, say, at inertias that are far apart.
    fn without_cancellation(self, graph: &mut Graph, whole: ExprId) -> Self {
        let length = graph.operation_count(&[self.value]);
        match graph.without_cancellation(whole, length) {
            Some(short) => Self { value: short, written_out: Some(short) },
            None => self,
        }
    }

    /// A short entry simplified: where a pivot is a mass, say, much of what follows cancels.
    fn simplified(mut self, graph: &mut Graph) -> Self {
        if graph.operation_count(&[self.value]) <= SIMPLIFIED {
            let short = graph.simplify(self.value);
            if short == self.value || graph.error_growth(short, self.value) <= graph.accuracy().growth() {
                if self.written_out == Some(self.value) {
                    self.written_out = Some(short);
                }
                self.value = short;
            }
        }
        self
    }

    /// The entry simplified, as an intermediate result unless it is short.
    fn named(self, graph: &mut Graph, procedure: &mut Procedure, name: &str) -> Self {
        let mut entry = self.simplified(graph);
        if graph.operation_count(&[entry.value]) > IN_PLACE {
            entry.value = procedure.define(graph, name, entry.value);
        }
        entry
    }
}

/// What becomes of the numerators u_ij = l_ij d_j.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Numerators {
    /// They are intermediate results, unless division by the pivot cancels: a product less wherever an
    /// entry is updated.
    Kept,
    /// Only the quotients are, in which more cancels.
    Divided,
}

impl Ldl {
    pub(super) fn of(
        graph: &mut Graph,
        matrix: &[Vec<ExprId>],
        numerators: Numerators,
        procedure: &mut Procedure,
        name: &str,
    ) -> Self {
        let n = matrix.len();
        let zero = Entry::zero(graph);
        let mut lower = vec![vec![zero; n]; n];
        let mut diagonal: Vec<Entry> = Vec::with_capacity(n);
        // l_ik d_k as factors: u_ik where it has a name
        let mut scaled = vec![vec![Vec::new(); n]; n];
        for j in 0..n {
            // u_ij = a_ij − Σ_k l_ik d_k l_jk, d_j = u_jj
            let column: Vec<Entry> = (j..n)
                .map(|i| {
                    let product = |k: usize| [scaled[i][k].as_slice(), &[lower[j][k]]].concat();
                    let products: Vec<_> = (0..j).map(product).collect();
                    let entry = Entry::given(graph, matrix[i][j]).less_products(graph, &products);
                    if j > 0 { entry.looked_at(graph) } else { entry }
                })
                .collect();
            let pivot = column[0].named(graph, procedure, &format!("{name}_d{j}"));
            diagonal.push(pivot);
            // l_ij = u_ij / d_j
            for (i, numerator) in (j + 1..n).zip(&column[1..]) {
                let quotient = numerator.over(graph, pivot).simplified(graph);
                let letter = format!("{name}_l{i}{j}");
                let [above, divided] = [numerator, &quotient].map(|e| graph.operation_count(&[e.value]));
                if numerators == Numerators::Divided || divided <= above {
                    lower[i][j] = quotient.named(graph, procedure, &letter);
                    scaled[i][j] = vec![lower[i][j], pivot];
                } else {
                    let numerator = numerator.named(graph, procedure, &format!("{name}_u{i}{j}"));
                    lower[i][j] = numerator.over(graph, pivot).named(graph, procedure, &letter);
                    scaled[i][j] = vec![numerator];
                }
            }
        }
        Self { lower, diagonal }
    }

    /// The rows of L left of the diagonal, and D.
    pub(super) fn into_factors(self) -> (Matrix, Vec<ExprId>) {
        let left = |(i, row): (usize, Vec<Entry>)| row[..i].iter().map(|entry| entry.value).collect();
        let lower = self.lower.into_iter().enumerate().map(left).collect();
        (lower, self.diagonal.iter().map(|entry| entry.value).collect())
    }

    pub(super) fn solve(
        &self,
        graph: &mut Graph,
        right: &[ExprId],
        procedure: &mut Procedure,
        name: &str,
    ) -> Vec<ExprId> {
        let n = right.len();
        // L z = right
        let mut forward: Vec<Entry> = Vec::with_capacity(n);
        for (i, entry) in right.iter().enumerate() {
            let products: Vec<_> = (0..i).map(|k| vec![self.lower[i][k], forward[k]]).collect();
            let entry = Entry::given(graph, *entry).less_products(graph, &products);
            let entry = if i > 0 { entry.looked_at(graph) } else { entry };
            forward.push(entry.named(graph, procedure, &format!("{name}_z{i}")));
        }
        // Lᵀ x = D⁻¹ z
        let mut solution: Vec<ExprId> = forward.iter().map(|entry| entry.value).collect();
        for i in (0..n).rev() {
            let column: Vec<ExprId> = (i + 1..n).map(|k| self.lower[k][i].value).collect();
            let known = graph.inner_product(&column, &solution[i + 1..]);
            let value = graph.formula(forward[i].value / self.diagonal[i].value - known);
            let entry = Entry { value, written_out: None };
            solution[i] = entry.named(graph, procedure, &format!("{name}_x{i}")).value;
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Accuracy;
    use crate::mechanics::Definition;

    #[test]
    fn what_cancels_behind_intermediate_results_is_seen() {
        let mut g = Graph::new();
        let names = ["m", "I", "K", "a", "b", "x", "y", "f", "h", "k"];
        let [m, i, k, a, b, x, y, f, h, r] = names.map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        // two levers too long to be put in place
        let lever = |g: &mut Graph, angle: ExprId| {
            let (sin, cos, square) = (g.sin(angle), g.cos(angle), g.square(angle));
            let terms = [g.formula(a * sin), g.formula(b * cos), square];
            g.sum(&terms)
        };
        let (p, q) = (lever(&mut g, x), lever(&mut g, y));
        let (mp, mq) = (g.formula(m * p), g.formula(m * q));
        let (mpp, mpq, mqq) = (g.formula(mp * p), g.formula(mp * q), g.formula(mq * q));
        let (ip, kq) = (g.formula(i + mpp), g.formula(k + mqq));
        let matrix = vec![vec![m, mp, mq], vec![mp, ip, mpq], vec![mq, mpq, kq]];
        // the force f on the mass, and moments about it
        let (fp, fq) = (g.formula(f * p), g.formula(f * q));
        let right = [f, g.formula(h + fp), g.formula(r + fq)];
        let mut procedure = Procedure::default();
        let factors = Ldl::of(&mut g, &matrix, Numerators::Kept, &mut procedure, "m");
        let zero = g.zero();
        assert_eq!(factors.diagonal.iter().map(|d| d.value).collect::<Vec<_>>(), [m, i, k]);
        assert_eq!(factors.lower[2][1].value, zero);
        let solution = factors.solve(&mut g, &right, &mut procedure, "x");
        assert_eq!(solution[1..], [g.formula(h / i), g.formula(r / k)]);
        // the levers are all that has a name
        let named = procedure.definitions.iter().map(|definition| match definition {
            Definition::Value { symbol, .. } => g.symbols()[*symbol].as_str(),
            _ => "",
        });
        assert_eq!(named.filter(|name| name.starts_with("m_")).collect::<Vec<_>>(), ["m_l10", "m_l20"]);
    }

    #[test]
    fn what_was_divided_is_not_multiplied_again() {
        let mut g = Graph::new();
        // elsewhere the pivot is written out, so that nothing cancels
        g.set_accuracy(Accuracy::Fast);
        let [a, b, c, d, e, f] = ["a", "b", "c", "d", "e", "f"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let mut procedure = Procedure::default();
        let matrix = vec![vec![a, b, c], vec![b, d, e], vec![c, e, f]];
        Ldl::of(&mut g, &matrix, Numerators::Kept, &mut procedure, "m");
        let named = |name: &str| {
            procedure.definitions.iter().find_map(|definition| match definition {
                Definition::Value { symbol, value } if g.symbols()[*symbol] == name => {
                    Some((*symbol, *value))
                }
                _ => None,
            })
        };
        // d₂ = f − c l₂₀ − u₂₁ l₂₁, and not f − d₀ l₂₀² − d₁ l₂₁²
        let ((numerator, _), (_, pivot)) = named("m_u21").zip(named("m_d2")).expect("these are long");
        assert!(g.depends_on(pivot, &[numerator]));
    }
}

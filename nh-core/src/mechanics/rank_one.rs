//! Mass matrices that are a diagonal less one product, as those of bodies that roll about a point:
//! `diag(I) + m (ρ·ρ − ρ ρᵀ)`. Mathematics (8′), Sherman and Morrison's formula.

use super::procedure::Procedure;
use super::solved::Inverse;
use crate::algebra::{Facts, Graph, Matrix, Node, Rational};
use crate::count::Count;
use crate::id::ExprId;
use std::collections::{BTreeMap, BTreeSet};

/// `D − κ u uᵀ` with κ ≥ 0. Where it is positive definite, D_i is no less than its diagonal entry, and
/// `1 − κ Σ u_i² / D_i` is positive: nothing is divided by that elimination does not divide by as well.
#[derive(Clone, Debug)]
pub(super) struct RankOne {
    diagonal: Vec<ExprId>,
    /// κ.
    weight: ExprId,
    /// u.
    vector: Vec<ExprId>,
}

/// Matrices with more operations than this are not looked at.
const LONGEST: u64 = 240;

impl RankOne {
    /// The matrix in this form, if it has it: proved entry by entry.
    pub(super) fn of(graph: &mut Graph, matrix: &Matrix) -> Option<Self> {
        let n = matrix.len();
        let off_diagonal = |(i, j): &(usize, usize)| matrix[*i][*j];
        let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
        let is_coupled = pairs.iter().map(off_diagonal).all(|entry| graph.zero_test(entry).is_nonzero());
        if n < 3 || !is_coupled || graph.operation_count(&matrix.concat()) > LONGEST {
            return None;
        }
        // 1. κ u_i² = − M_ij M_ik / M_jk
        let mut shares: Vec<Monomial> = Vec::with_capacity(n);
        for i in 0..n {
            let (j, k) = ((i + 1) % n, (i + 2) % n);
            let share = graph.formula(-(matrix[i][j] * matrix[i][k] / matrix[j][k]));
            let share = graph.simplify(share);
            shares.push(Monomial::of(graph, share)?);
        }
        let (weight, first) = shares[0].taken_apart(graph, &shares)?;
        let mut vector = vec![first];
        for entry in &matrix[0][1..] {
            let quotient = graph.formula(-(entry / (weight * first)));
            vector.push(graph.simplify(quotient));
        }
        // 2. it is so
        let parts = [vector.as_slice(), &[weight]].concat();
        if !graph.divisors(&parts).is_subset(&graph.divisors(&matrix.concat())) {
            return None;
        }
        for (i, j) in &pairs {
            let product = product(graph, [weight, vector[*i], vector[*j]]);
            let defect = graph.formula(matrix[*i][*j] + product);
            if !graph.zero_test(defect).is_zero() {
                return None;
            }
        }
        // 3. D_i = M_ii + κ u_i²
        let entries: Vec<ExprId> = (0..n).map(|i| matrix[i][i]).collect();
        if !is_taken_off(graph, weight, &vector, &entries) {
            return None;
        }
        let mut diagonal = Vec::with_capacity(n);
        for (entry, part) in entries.iter().zip(&vector) {
            let product = product(graph, [weight, *part, *part]);
            let sum = graph.formula(entry + product);
            diagonal.push(graph.simplify(sum));
        }
        Some(Self { diagonal, weight, vector })
    }

    /// `x = D⁻¹ (f + μ u)`, and what solves for other right-hand sides.
    pub(super) fn solve(
        &self,
        graph: &mut Graph,
        right: &[ExprId],
        procedure: &mut Procedure,
        name: &str,
    ) -> (Vec<ExprId>, Inverse) {
        let mut named = |graph: &mut Graph, part: &str, values: &[ExprId]| -> Vec<ExprId> {
            values.iter().map(|value| procedure.define(graph, &format!("{name}_{part}"), *value)).collect()
        };
        let (first, differences) = self.first(graph);
        let one = graph.one();
        let over: Vec<ExprId> = self.diagonal.iter().map(|entry| graph.formula(one / entry)).collect();
        let over = named(graph, "over", &over);
        let vector = named(graph, "u", &self.vector);
        let right = named(graph, "f", right);
        // u_j / D_j, for all but the first
        let others: Vec<usize> = (0..vector.len()).filter(|j| *j != first).collect();
        let reach: Vec<ExprId> = others.iter().map(|j| graph.formula(vector[*j] * over[*j])).collect();
        let reach = named(graph, "reach", &reach);
        // μ (D_k − κ u·u + κ Σ_j (D_j − D_k) u_j² / D_j) = κ (u_k f_k + D_k Σ_j u_j f_j / D_j)
        let mut along = Vec::new();
        let mut turned = Vec::new();
        for (j, reach) in others.iter().zip(&reach) {
            along.push(graph.formula(reach * right[*j]));
            turned.push(product(graph, [differences[*j], vector[*j], *reach]));
        }
        let along = graph.sum(&along);
        let along = graph.formula(self.diagonal[first] * along);
        let above = graph.formula(self.weight * (vector[first] * right[first] + along));
        let squares = graph.inner_product(&self.vector, &self.vector);
        let rest = graph.formula(self.diagonal[first] - self.weight * squares);
        let rest = graph.simplify(rest);
        let turned = graph.sum(&turned);
        let below = graph.formula(rest + self.weight * turned);
        let multiplier = graph.formula(above / below);
        let multiplier = named(graph, "mu", &[multiplier])[0];
        let parts = right
            .iter()
            .zip(&vector)
            .zip(&over)
            .map(|((f, u), over)| graph.formula((f + u * multiplier) * over));
        let values = parts.collect();
        let mut along = vec![graph.formula(vector[first] * over[first]); vector.len()];
        for (j, reach) in others.into_iter().zip(reach) {
            along[j] = reach;
        }
        let weight = graph.formula(self.weight * self.diagonal[first] / below);
        (values, Inverse { over, along, weight })
    }

    /// The k whose D_k differs least from the others, and D_j − D_k.
    fn first(&self, graph: &mut Graph) -> (usize, Vec<ExprId>) {
        let differences = |k: usize| -> Vec<ExprId> {
            let from_it = self.diagonal.iter().map(|entry| {
                let difference = graph.formula(entry - self.diagonal[k]);
                graph.simplify(difference)
            });
            from_it.collect()
        };
        let choices: Vec<Vec<ExprId>> = (0..self.diagonal.len()).map(differences).collect();
        let length =
            |choice: &Vec<ExprId>| choice.iter().map(|e| graph.operation_count(&[*e])).sum::<Count>();
        choices.into_iter().enumerate().min_by_key(|(_, choice)| length(choice)).unwrap_or_default()
    }
}

fn product(graph: &mut Graph, factors: [ExprId; 3]) -> ExprId {
    graph.product(&factors.map(|factor| (factor, Rational::ONE)))
}

/// Whether κ is not negative where the matrix with this diagonal is positive: as it stands, or because
/// it is the multiple of a mass, with which every diagonal entry grows – as that of a point does which
/// the mass is at, by κ Σ_{j≠i} u_j², if not by more.
fn is_taken_off(graph: &mut Graph, weight: ExprId, vector: &[ExprId], diagonal: &[ExprId]) -> bool {
    let is_not_negative = |graph: &Graph, e: ExprId| graph.range(e, &Facts::default()).is_not_negative();
    if is_not_negative(graph, weight) && diagonal.iter().all(|entry| is_not_negative(graph, *entry)) {
        return true;
    }
    let squares: Vec<ExprId> = vector.iter().map(|part| graph.square(*part)).collect();
    graph.symbols_in(&[weight]).into_iter().any(|mass| {
        let (without, factor) = (graph.at_zero(weight, &[mass]), graph.partial(weight, mass));
        let is_multiple = graph.is_literal_zero(without) && !graph.depends_on(factor, &[mass]);
        is_multiple
            && is_not_negative(graph, factor)
            && (0..diagonal.len()).all(|i| {
                let slope = graph.partial(diagonal[i], mass);
                let others: Vec<ExprId> =
                    (0..squares.len()).filter(|j| *j != i).map(|j| squares[j]).collect();
                let others = graph.sum(&others);
                let more = graph.formula(slope - factor * others);
                let more = graph.simplify(more);
                is_not_negative(graph, more) && !graph.depends_on(more, &[mass])
            })
    })
}

/// A number times whole powers.
struct Monomial {
    coefficient: Rational,
    exponents: BTreeMap<ExprId, Rational>,
}

impl Monomial {
    /// The expression as such; `None` where it divides.
    fn of(graph: &Graph, expression: ExprId) -> Option<Self> {
        let (coefficient, exponents) = match graph.node(expression) {
            Node::Number(value) => (value.clone(), BTreeMap::new()),
            Node::Product { coefficient, factors } => {
                (coefficient.clone(), factors.iter().cloned().collect())
            }
            _ => (Rational::ONE, BTreeMap::from([(expression, Rational::ONE)])),
        };
        let is_whole = exponents.values().all(|e: &Rational| e.is_integer() && !e.is_negative());
        is_whole.then_some(Self { coefficient, exponents })
    }

    fn exponent(&self, base: ExprId) -> Rational {
        self.exponents.get(&base).cloned().unwrap_or(Rational::ZERO)
    }

    /// `κ` and `u` of `κ u²`, where κ is what it has in common with all.
    fn taken_apart(&self, graph: &mut Graph, all: &[Self]) -> Option<(ExprId, ExprId)> {
        let (mut common, mut root) = (Vec::new(), Vec::new());
        let bases: BTreeSet<ExprId> = self.exponents.keys().copied().collect();
        for base in bases {
            let least = all.iter().map(|monomial| monomial.exponent(base)).min()?;
            let rest = self.exponent(base) - least.clone();
            if rest.has_odd_numerator() {
                return None;
            }
            common.push((base, least));
            root.push((base, rest * Rational::new(1, 2)));
        }
        let common = graph.product(&common);
        Some((graph.scale(self.coefficient.clone(), common), graph.product(&root)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::ldl::{Ldl, Numerators};
    use crate::mechanics::{Definiteness, Definition, Factors, Solved, solve_symmetric};

    const NAMES: [&str; 13] = ["I", "J", "K", "m", "r", "a", "x", "y", "z", "f", "g", "h", "n"];

    fn named(g: &mut Graph) -> [ExprId; 13] {
        NAMES.map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        })
    }

    /// `diag(inertias) + sign · m (ρ·ρ − ρ ρᵀ)`.
    fn about(g: &mut Graph, inertias: [ExprId; 3], mass: ExprId, rho: [ExprId; 3]) -> Matrix {
        let square = g.inner_product(&rho, &rho);
        let mut matrix = vec![Vec::new(); 3];
        for i in 0..3 {
            for j in 0..3 {
                let product = g.formula(rho[i] * rho[j]);
                let rest = if i == j { g.formula(square - product) } else { g.formula(-product) };
                let point = g.formula(mass * rest);
                let entry = if i == j { g.formula(inertias[i] + point) } else { point };
                matrix[i].push(g.simplify(entry));
            }
        }
        matrix
    }

    #[test]
    fn a_ball_that_rolls_is_a_diagonal_less_one_product() {
        let mut g = Graph::new();
        let [i, j, k, m, r, a, x, y, z, e, f, h, _] = named(&mut g);
        // the contact of a ball whose centre of mass is off its centre
        let [u, v, w] = [x, y, z].map(|part| g.formula(r * part));
        let w = g.formula(w - a);
        let matrix = about(&mut g, [i, j, k], m, [u, v, w]);
        let found = RankOne::of(&mut g, &matrix).expect("it has this form");
        for (inertia, entry) in [i, j, k].iter().zip(&found.diagonal) {
            let squares = g.inner_product(&[u, v, w], &[u, v, w]);
            let point = g.formula(m * squares);
            let defect = g.linear_combination(&[
                (Rational::ONE, *entry),
                (Rational::MINUS_ONE, *inertia),
                (Rational::MINUS_ONE, point),
            ]);
            assert!(g.zero_test(defect).is_zero());
        }
        // it is preferred, and solves the equations
        let right = [e, f, h];
        let mut procedure = Procedure::default();
        let solution = solve_symmetric(&mut g, &matrix, &right, Definiteness::Definite, &mut procedure, "w");
        assert!(procedure.definitions.iter().any(|definition| match definition {
            Definition::Value { symbol, .. } => g.symbols()[*symbol] == "w_mu",
            _ => false,
        }));
        let solution = procedure.with_outputs(solution).written_out(&mut g);
        for (row, right) in matrix.iter().zip(right) {
            let left = g.inner_product(row, &solution);
            let defect = g.formula(left - right);
            assert!(g.zero_test(defect).is_zero());
        }
    }

    /// A rotor on an axis of the ball: it leaves first, and what is left is that of a ball.
    #[test]
    fn so_is_one_with_a_rotor_in_it() {
        let mut g = Graph::new();
        let [i, j, k, m, r, _, x, y, z, e, f, h, n] = named(&mut g);
        let mut matrix = about(&mut g, [i, j, k], m, [x, y, z]);
        matrix[0][0] = g.formula(matrix[0][0] + r);
        let zero = g.zero();
        for (row, entry) in matrix.iter_mut().zip([r, zero, zero]) {
            row.push(entry);
        }
        matrix.push(vec![r, zero, zero, r]);
        assert!(RankOne::of(&mut g, &matrix).is_none());
        let right = [e, f, h, n];
        let mut procedure = Procedure::default();
        let solution = solve_symmetric(&mut g, &matrix, &right, Definiteness::Definite, &mut procedure, "w");
        let [Solved { factors: Factors::DiagonalAndOne { hanging, .. }, .. }] = &procedure.solved[..] else {
            panic!("it is preferred: {:?}", procedure.solved);
        };
        assert_eq!(hanging.len(), 1);
        let solution = procedure.with_outputs(solution).written_out(&mut g);
        for (row, right) in matrix.iter().zip(right) {
            let left = g.inner_product(row, &solution);
            let defect = g.formula(left - right);
            assert!(g.zero_test(defect).is_zero());
        }
    }

    #[test]
    fn light_bodies_cost_no_digits() {
        let mut g = Graph::new();
        let symbols = named(&mut g);
        let [i, j, k, m, _, _, x, y, z, e, f, h, _] = symbols;
        let matrix = about(&mut g, [i, j, k], m, [x, y, z]);
        let found = RankOne::of(&mut g, &matrix).expect("it has this form");
        let inline = &mut Procedure::inline();
        let (solution, _) = found.solve(&mut g, &[e, f, h], inline, "w");
        let by_elimination =
            Ldl::of(&mut g, &matrix, Numerators::Kept, inline, "w").solve(&mut g, &[e, f, h], inline, "w");
        // inertias of 10⁻⁹ about a point that a mass of 1 is away from: whichever of them is the least
        for turn in 0..3 {
            let sizes = [1e-9, 1.5e-9, 3e-9];
            let values = [sizes[turn], sizes[(turn + 1) % 3], sizes[(turn + 2) % 3], 1.0];
            let values = [&values[..], &[1.0, 1.0, 0.3, -0.7, 0.5, 0.9, 0.4, -1.1, 1.0]].concat();
            let at = |symbol| values[symbols.iter().position(|e| g.as_symbol(*e) == Some(symbol)).unwrap()];
            let relative = |solution: &[ExprId]| {
                let values = g.evaluate(solution, at).into_iter();
                values.map(|b| b.error / b.value.abs()).fold(0.0, f64::max)
            };
            // some dozens of roundings, and forces of which a tenth is left; and the ratio of inertias
            assert!(relative(&solution) < 1e3 * f64::EPSILON, "{turn}: {:e}", relative(&solution));
            assert!(
                relative(&by_elimination) > 1e6 * f64::EPSILON,
                "{turn}: {:e}",
                relative(&by_elimination)
            );
        }
    }

    #[test]
    fn other_matrices_do_not_have_this_form() {
        let mut g = Graph::new();
        let [i, j, k, m, r, _, x, y, z, e, f, h, n] = named(&mut g);
        // the product added: D_i are inertias, one of which may vanish
        let mut matrix = vec![vec![i, x, y], vec![x, j, z], vec![y, z, k]];
        for (a, u) in [x, y, z].into_iter().enumerate() {
            for (b, v) in [x, y, z].into_iter().enumerate() {
                let product = product(&mut g, [m, u, v]);
                matrix[a][b] = if a == b { g.formula(matrix[a][a] + product) } else { product };
            }
        }
        assert!(RankOne::of(&mut g, &matrix).is_none());
        // of six numbers, D would divide by products of inertia
        let matrix = vec![vec![i, e, f], vec![e, j, h], vec![f, h, k]];
        assert!(RankOne::of(&mut g, &matrix).is_none());
        // an offset of either sign is no mass
        let offset = g.formula(m * r);
        let ball = about(&mut g, [i, j, k], offset, [x, y, z]);
        assert!(RankOne::of(&mut g, &ball).is_none());
        // four unknowns, coupled otherwise
        let mut matrix = about(&mut g, [i, j, k], m, [x, y, z]);
        for (row, entry) in matrix.iter_mut().zip([e, f, h]) {
            row.push(entry);
        }
        matrix.push(vec![e, f, h, n]);
        assert!(RankOne::of(&mut g, &matrix).is_none());
    }
}

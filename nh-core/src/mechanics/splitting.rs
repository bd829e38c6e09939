//! How D lies to the vertical sections, the kernel of the anchor or the directions of a symmetry group:
//! the classification of reduced systems, CM section 4.2.

use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Graph, Matrix, Substitution};
use crate::geometry::ConstraintDistribution;
use crate::id::{CoordId, ExprId, Id, SymbolId};

/// D over M (or over the coordinates that no symmetry moves), with V the kernel of the anchor there and
/// S = D ∩ V; ranks at generic points.
#[derive(Clone, Debug)]
pub struct Splitting {
    /// The coordinates that V leaves: all of them, or where the anchor is injective those that no
    /// symmetry moves, which are coordinates of the quotient.
    pub coordinates: Vec<CoordId>,
    /// Whether coordinates along a symmetry group are left out of them.
    pub by_group: bool,
    /// The rank of D.
    pub rank: usize,
    /// The rank of V.
    pub vertical: usize,
    /// The rank of ρ(D) over those coordinates.
    pub horizontal: usize,
    /// The velocities of D (by position) along which ρ is one to one.
    pub(super) lifted: Vec<usize>,
}

impl Splitting {
    /// The splitting, with the coordinates along a symmetry group; `None` where V = 0, or the anchor is
    /// not onto the others.
    pub fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
        group: &[CoordId],
    ) -> Option<Self> {
        let algebroid = &system.algebroid;
        let (n, s) = (algebroid.anchor.coordinates.len(), algebroid.rank());
        let whole = graph.generic_rank(&algebroid.anchor.entries).ok()?;
        let by_group = whole == s;
        let coordinates: Vec<CoordId> =
            (0..n).map(CoordId::from_index).filter(|id| !(by_group && group.contains(id))).collect();
        let rows: Matrix = rows(&algebroid.anchor.entries, &coordinates);
        let onto = graph.generic_rank(&rows).ok()?;
        if onto < coordinates.len() || onto == s {
            return None;
        }
        let field = along(graph, &rows, distribution);
        let lifted = graph.independent_columns(&field).ok()?;
        Some(Self {
            coordinates,
            by_group,
            rank: distribution.rank(),
            vertical: s - onto,
            horizontal: lifted.len(),
            lifted,
        })
    }

    /// The rank of S = D ∩ V.
    #[must_use]
    pub fn shared(&self) -> usize {
        self.rank - self.horizontal
    }

    /// Whether D + V = E: the dimension assumption.
    #[must_use]
    pub fn spans(&self) -> bool {
        self.horizontal == self.coordinates.len()
    }

    /// ρ^i_α B^α_a: the rates of the coordinates along the basis of D.
    #[must_use]
    pub fn projection(
        &self,
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
    ) -> Matrix {
        let rows = rows(&system.algebroid.anchor.entries, &self.coordinates);
        along(graph, &rows, distribution)
    }

    /// The constraints on V, whatever basis D has; `None` unless V is spanned by declared sections.
    #[must_use]
    pub fn constraints_on_vertical(
        &self,
        graph: &Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
    ) -> Option<Matrix> {
        let rows = rows(&system.algebroid.anchor.entries, &self.coordinates);
        let vertical: Vec<usize> = (0..system.algebroid.rank())
            .filter(|section| rows.iter().all(|row| graph.is_literal_zero(row[*section])))
            .collect();
        let on_vertical = |row: &Vec<ExprId>| vertical.iter().map(|section| row[*section]).collect();
        (vertical.len() == self.vertical)
            .then(|| distribution.constraints.annihilator.iter().map(on_vertical).collect())
    }

    /// Φ above ρ over the coordinates: the matrix of which S = D ∩ V is the kernel, whatever basis D has.
    #[must_use]
    pub fn constraints_and_rates(
        &self,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
    ) -> Matrix {
        let mut matrix = distribution.constraints.annihilator.clone();
        matrix.extend(rows(&system.algebroid.anchor.entries, &self.coordinates));
        matrix
    }

    /// Whether ρ is an isomorphism from D to the tangent spaces: a Chaplygin system.
    #[must_use]
    pub fn is_chaplygin(&self) -> bool {
        self.shared() == 0 && self.spans() && self.vertical > 0 && self.rank > 0
    }
}

/// The rows of the coordinates.
pub(super) fn rows(entries: &Matrix, coordinates: &[CoordId]) -> Matrix {
    coordinates.iter().map(|id| entries[id.index()].clone()).collect()
}

/// ρ^i_α B^α_a.
pub(super) fn along(graph: &mut Graph, rows: &Matrix, distribution: &ConstraintDistribution) -> Matrix {
    let sections = distribution.sections();
    rows.iter().map(|row| graph.image(&sections, row)).collect()
}

/// The horizontal lifts of a Chaplygin system, and the force of their curvature.
#[derive(Clone, Debug)]
pub struct Chaplygin {
    /// h_i, with ρ(h_i) = ∂_i, in D.
    pub lifts: Matrix,
    /// K_ij = [h_i, h_j], i < j, pairs in lexicographic order.
    pub curvature: Vec<Vec<ExprId>>,
    /// L̄ = L∘h at the rates ẋ^i.
    pub lagrangian: ExprId,
    /// ⟨J, K⟩_i = −p(K_ij) ẋ^j on D, in the velocities of D: the force on the right of the
    /// Euler–Lagrange equations of L̄.
    pub force: Vec<ExprId>,
}

impl Chaplygin {
    /// Derives them; `rates` are symbols for the ẋ^i, in the order of the coordinates.
    pub fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
        splitting: &Splitting,
        rates: &[SymbolId],
    ) -> Option<Self> {
        let algebroid = &system.algebroid;
        let rows = rows(&algebroid.anchor.entries, &splitting.coordinates);
        let m = rows.len();
        // 1. h_i = B_a (ρB)⁻¹
        let field = along(graph, &rows, distribution);
        let identity = graph.identity(m);
        let inverse = graph.solve_linear(&field, &identity)?.values;
        let mut lifts = Matrix::new();
        for i in 0..m {
            let column: Vec<ExprId> = inverse.iter().map(|row| row[i]).collect();
            let lift = graph.image(&distribution.basis, &column);
            lifts.push(lift.into_iter().map(|component| graph.simplify(component)).collect());
        }
        // 2. K(∂_i, ∂_j) = [h_i, h_j] − h[∂_i, ∂_j]
        let mut curvature = Vec::new();
        for i in 0..m {
            for j in i + 1..m {
                let bracket = algebroid.bracket(graph, &lifts[i], &lifts[j]);
                curvature.push(bracket.into_iter().map(|c| graph.simplify(c)).collect::<Vec<_>>());
            }
        }
        // 3. L̄
        let symbols: Vec<ExprId> = rates.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let columns = Graph::transposed(&lifts);
        let velocity = graph.image(&columns, &symbols);
        let images = algebroid.velocities.iter().copied().zip(velocity);
        let lagrangian = Substitution::new(images).apply(graph, system.lagrangian);
        let lagrangian = graph.simplify(lagrangian);
        // 4. −p(K_ij) ẋ^j, with ẋ = ρ(B v)
        let mut restriction = distribution.restriction(graph, &algebroid.velocities);
        let momenta = system.momenta(graph);
        let momenta = restriction.apply_all(graph, &momenta);
        let speeds = graph.image(&rows, &distribution.velocity);
        let mut terms: Vec<Vec<ExprId>> = vec![Vec::new(); m];
        let mut pairs = curvature.iter();
        for i in 0..m {
            for j in i + 1..m {
                let along = pairs.next().map_or(graph.zero(), |k| graph.inner_product(k, &momenta));
                let (first, second) = (graph.mul(along, speeds[j]), graph.mul(along, speeds[i]));
                terms[i].push(graph.neg(first));
                terms[j].push(second);
            }
        }
        let force = terms.iter().map(|terms| {
            let sum = graph.sum(terms);
            graph.simplify(sum)
        });
        let force = force.collect();
        Some(Self { lifts, curvature, lagrangian, force })
    }
}

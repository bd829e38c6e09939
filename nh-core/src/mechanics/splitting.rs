//! How D lies to the vertical sections, the kernel of the anchor or the directions of a symmetry group:
//! the classification of reduced systems, CM section 4.2.

use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Derivation, Graph, Matrix, Substitution};
use crate::geometry::{Algebroid, ConstraintDistribution, Manifold};
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
    /// The dimension of what they run through: less than their number where they are embedded.
    pub dimension: usize,
    /// The rank of D.
    pub rank: usize,
    /// The rank of V.
    pub vertical: usize,
    /// The rank of ρ(D) over those coordinates.
    pub horizontal: usize,
    /// The velocities of D (by position) along which ρ is one to one.
    pub(super) lifted: Vec<usize>,
    /// Coordinates that determine the rates of all (by position), those of constant rates first.
    pub(super) chosen: Vec<usize>,
    /// Whether some of the coordinates are embedded, so that they have no independent rates.
    pub embedded: bool,
}

/// Why there is no splitting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotSplit {
    /// V = 0.
    NothingVertical,
    /// The anchor has this rank over coordinates that run through so many dimensions.
    NotOnto {
        /// The rank.
        rank: usize,
        /// The dimension.
        dimension: usize,
    },
    /// The reason, where a rank could not be decided.
    Undecided,
}

impl Splitting {
    /// The splitting, with the coordinates along a symmetry group, over a base that may be embedded.
    ///
    /// # Errors
    /// V = 0, or an anchor that is not onto the other coordinates.
    pub fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
        group: &[CoordId],
        base: &Manifold,
    ) -> Result<Self, NotSplit> {
        let algebroid = &system.algebroid;
        let (n, s) = (algebroid.anchor.coordinates.len(), algebroid.rank());
        let rank = |graph: &mut Graph, rows: &Matrix| {
            let rows = base.restrict_matrix(graph, rows);
            graph.generic_rank(&rows).map_err(|_| NotSplit::Undecided)
        };
        let by_group = rank(graph, &algebroid.anchor.entries)? == s;
        let coordinates: Vec<CoordId> =
            (0..n).map(CoordId::from_index).filter(|id| !(by_group && group.contains(id))).collect();
        let rows: Matrix = rows(&algebroid.anchor.entries, &coordinates);
        let onto = rank(graph, &rows)?;
        if onto == s {
            return Err(NotSplit::NothingVertical);
        }
        let symbols: Vec<SymbolId> =
            coordinates.iter().map(|id| algebroid.anchor.coordinates[id.index()]).collect();
        let dimension = base.dimension_of(graph, &symbols).map_err(|_| NotSplit::Undecided)?;
        if onto < dimension {
            return Err(NotSplit::NotOnto { rank: onto, dimension });
        }
        let field = along(graph, &rows, distribution);
        let field = base.restrict_matrix(graph, &field);
        let lifted = graph.independent_columns(&field).map_err(|_| NotSplit::Undecided)?;
        let chosen = independent_rows(graph, &field, &lifted).map_err(|_| NotSplit::Undecided)?;
        let embedded = symbols.iter().any(|symbol| !base.is_free(*symbol));
        Ok(Self {
            dimension,
            chosen,
            embedded,
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
        self.horizontal == self.dimension
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

/// Coordinates whose rates determine all of ρ(D), those of constant rates first, ascending.
fn independent_rows(graph: &Graph, field: &Matrix, lifted: &[usize]) -> Result<Vec<usize>, String> {
    if lifted.is_empty() {
        return Ok(Vec::new());
    }
    let columns = Graph::transposed(field);
    let mut order: Vec<usize> = (0..field.len()).collect();
    order.sort_by_key(|row| field[*row].iter().filter(|entry| graph.as_number(**entry).is_none()).count());
    let along: Matrix = lifted.iter().map(|a| order.iter().map(|row| columns[*a][*row]).collect()).collect();
    let independent = graph.independent_columns(&along)?;
    let mut chosen: Vec<usize> = independent.into_iter().map(|place| order[place]).collect();
    chosen.sort_unstable();
    Ok(chosen)
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

/// (RᵀR + SSᵀ)⁻¹Rᵀ: with R on a complement of its kernel, which the S_ρ span, one to one; it takes a rate that
/// R does not reach for the nearest that it does.
pub(super) fn left_inverse(graph: &mut Graph, rates: &Matrix, kernel: &[Vec<ExprId>]) -> Option<Matrix> {
    let columns = Graph::transposed(rates);
    let size = columns.len();
    let mut gram = Matrix::new();
    for a in 0..size {
        let mut row = Vec::new();
        for b in 0..size {
            let mut terms = vec![graph.inner_product(&columns[a], &columns[b])];
            terms.extend(kernel.iter().map(|section| graph.formula(section[a] * section[b])));
            let entry = graph.sum(&terms);
            row.push(graph.simplify(entry));
        }
        gram.push(row);
    }
    Some(graph.solve_linear(&gram, &columns)?.values)
}

/// [ρ(σ), ρ(τ)] along the coordinates of the splitting.
fn commutator(
    graph: &mut Graph,
    algebroid: &Algebroid,
    [first, second]: [&[ExprId]; 2],
    splitting: &Splitting,
) -> Vec<ExprId> {
    let anchor = &algebroid.anchor;
    let fields = [first, second].map(|section| anchor.vector_field(graph, section));
    let mut along = fields
        .each_ref()
        .map(|field| Derivation::new(anchor.coordinates.iter().copied().zip(field.iter().copied())));
    let mut found = Vec::new();
    for id in &splitting.coordinates {
        let forth = along[0].apply(graph, fields[1][id.index()]);
        let back = along[1].apply(graph, fields[0][id.index()]);
        found.push(graph.formula(forth - back));
    }
    found
}

/// The horizontal lifts of a Chaplygin system, and the force of their curvature, mathematics (23).
#[derive(Clone, Debug)]
pub struct Chaplygin {
    /// h_i in D, with ρ(h_i) = ∂_i, or the part of it that is tangent to an embedded base.
    pub lifts: Matrix,
    /// K_ij = [h_i, h_j] − h[ρ(h_i), ρ(h_j)], i < j, pairs in lexicographic order.
    pub curvature: Vec<Vec<ExprId>>,
    /// L̄ = L∘h at the rates ẋ^i.
    pub lagrangian: ExprId,
    /// ⟨J, K⟩_i = −p(K_ij) ẋ^j on D, in the symbols by which D has its velocity: the force on the right of
    /// the Euler–Lagrange equations of L̄.
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
        // 1. h_i = B_a (ρB)⁻¹; of embedded coordinates the lift of what is tangent to them in ∂_i
        let field = along(graph, &rows, distribution);
        let inverse = if splitting.embedded {
            left_inverse(graph, &field, &[])?
        } else {
            let identity = graph.identity(m);
            graph.solve_linear(&field, &identity)?.values
        };
        let mut lifts = Matrix::new();
        for i in 0..m {
            let column: Vec<ExprId> = inverse.iter().map(|row| row[i]).collect();
            let lift = graph.image(&distribution.basis, &column);
            lifts.push(lift.into_iter().map(|component| graph.simplify(component)).collect());
        }
        // 2. K(X_i, X_j) = [h_i, h_j] − h[X_i, X_j], X_i = ρ(h_i): where the coordinates are free, X_i = ∂_i
        let mut curvature = Vec::new();
        for i in 0..m {
            for j in i + 1..m {
                let mut bracket = algebroid.bracket(graph, &lifts[i], &lifts[j]);
                if splitting.embedded {
                    let fields = commutator(graph, algebroid, [&lifts[i], &lifts[j]], splitting);
                    let lifted = graph.image(&Graph::transposed(&lifts), &fields);
                    bracket =
                        bracket.into_iter().zip(lifted).map(|(b, lift)| graph.formula(b - lift)).collect();
                }
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
        // 4. −p(K_ij) ẋ^j, with ẋ = ρ(y)
        let mut restriction = distribution.restriction(graph, &algebroid.velocities);
        let momenta = system.momenta(graph);
        let momenta = restriction.apply_all(graph, &momenta);
        let speeds = graph.image(&rows, &distribution.velocity);
        let mut terms: Vec<Vec<ExprId>> = vec![Vec::new(); m];
        let mut pairs = curvature.iter();
        for i in 0..m {
            for j in i + 1..m {
                let along = pairs.next().map_or(graph.zero(), |k| graph.inner_product(k, &momenta));
                let (first, second) = (graph.formula(along * speeds[j]), graph.formula(along * speeds[i]));
                terms[i].push(graph.formula(-first));
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

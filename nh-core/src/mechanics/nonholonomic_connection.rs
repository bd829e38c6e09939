//! The nonholonomic connection: S = D ∩ V, the lifts to D that are orthogonal to it, and their brackets
//! (CM section 4.2, mathematics (25)).

use super::euler_lagrange::LagrangianSystem;
use super::kinetic_metric::kinetic_metric;
use super::splitting::{Splitting, along, left_inverse, rows};
use crate::algebra::{Facts, Graph, Matrix, Node, Rational};
use crate::geometry::{Algebroid, ConstraintDistribution};
use crate::id::{CoordId, ExprId, SymbolId};

/// A basis {S_ρ, h_κ} of D.
#[derive(Clone, Debug)]
pub struct NonholonomicConnection {
    /// Sections S_ρ of S = D ∩ V.
    pub vertical: Matrix,
    /// A velocity of D for each, along which it lies and the others do not.
    pub named: Vec<SymbolId>,
    /// The coordinates of the h_κ: all of them where D + V = E, else as many as ρ(D) determines.
    pub coordinates: Vec<CoordId>,
    /// h_κ in D with ẋ^λ = δ^λ_κ for these coordinates, orthogonal to S in the kinetic metric; where they are
    /// embedded, over the part of ∂/∂x^κ that is tangent to ρ(D), so that y = h_κ ẋ^κ + S_ρ v^ρ as ever.
    pub lifts: Matrix,
    /// The locked inertia ⟨S_ρ, S_σ⟩, where there is a kinetic metric on the base; without entries where S = 0.
    pub inertia: Option<Matrix>,
    /// The S-components of a section of D from its components there, where there is no metric: a row
    /// of D-components for each.
    pub components: Matrix,
}

impl NonholonomicConnection {
    /// The basis; `None` where it could not be solved for.
    pub fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
        splitting: &Splitting,
        facts: &Facts,
    ) -> Option<Self> {
        // 1. R, the rates of independent coordinates in D
        let anchor = rows(&system.algebroid.anchor.entries, &splitting.coordinates);
        let field = along(graph, &anchor, distribution);
        let independent: Matrix = splitting.chosen.iter().map(|row| field[*row].clone()).collect();
        // the rates of embedded coordinates are not independent, and none is left out
        let (rates, coordinates) = if splitting.embedded {
            (field, splitting.coordinates.clone())
        } else {
            let chosen = splitting.chosen.iter().map(|row| splitting.coordinates[*row]);
            (independent.clone(), chosen.collect())
        };
        // 2. S, with R S = 0
        let free: Vec<usize> = (0..splitting.rank).filter(|a| !splitting.lifted.contains(a)).collect();
        let base = &system.algebroid.anchor.coordinates;
        let (inside, scales) = kernel(graph, &independent, &splitting.lifted, &free, base, facts)?;
        // 3. the lifts: where S = 0 there is nothing for them to be orthogonal to
        let sections = distribution.sections();
        let metric = if inside.is_empty() { Some(Matrix::new()) } else { metric(graph, system, &sections) };
        let lifts = match &metric {
            Some(metric) if splitting.embedded => {
                let lifts = left_inverse(graph, &rates, &inside)?;
                without_vertical(graph, metric, &inside, Graph::transposed(&lifts))?
            }
            None if splitting.embedded => Graph::transposed(&left_inverse(graph, &rates, &inside)?),
            Some(metric) if !inside.is_empty() => orthogonal(graph, metric, &rates)?,
            _ => along_pivots(graph, &rates, &splitting.lifted)?,
        };
        let inertia = metric.map(|metric| {
            let mut inertia = Matrix::new();
            for first in &inside {
                let momenta = graph.image(&metric, first);
                let mut entries = Vec::new();
                for second in &inside {
                    let entry = graph.inner_product(&momenta, second);
                    entries.push(graph.simplify(entry));
                }
                inertia.push(entries);
            }
            inertia
        });
        // 4. v^ρ = (v^f − h_κ^f ẋ^κ) / scale
        let mut components = Matrix::new();
        for (f, scale) in free.iter().zip(&scales) {
            let mut row = Vec::new();
            for a in 0..splitting.rank {
                let column: Vec<ExprId> = rates.iter().map(|rate| rate[a]).collect();
                let along: Vec<ExprId> = lifts.iter().map(|lift| lift[*f]).collect();
                let share = graph.inner_product(&along, &column);
                let own = if a == *f { graph.one() } else { graph.zero() };
                row.push(graph.formula((own - share) / scale));
            }
            components.push(row);
        }
        let mut in_bundle = |inside: &Matrix| -> Matrix {
            let mut found = Matrix::new();
            for section in inside {
                let mut components = Vec::new();
                for row in &distribution.basis {
                    let component = graph.inner_product(row, section);
                    components.push(graph.simplify(component));
                }
                found.push(components);
            }
            found
        };
        let (vertical, lifts) = (in_bundle(&inside), in_bundle(&lifts));
        let named = free.iter().map(|a| distribution.independent[*a]).collect();
        Some(Self { vertical, named, coordinates, lifts, inertia, components })
    }

    /// K(∂_κ, ∂_λ) = [h_κ, h_λ].
    pub fn curvature(
        &self,
        graph: &mut Graph,
        algebroid: &Algebroid,
        kappa: usize,
        lambda: usize,
    ) -> Vec<ExprId> {
        simplified_bracket(graph, algebroid, &self.lifts[kappa], &self.lifts[lambda])
    }

    /// Υ_κρ = [h_κ, S_ρ].
    pub fn coefficients(
        &self,
        graph: &mut Graph,
        algebroid: &Algebroid,
        kappa: usize,
        rho: usize,
    ) -> Vec<ExprId> {
        simplified_bracket(graph, algebroid, &self.lifts[kappa], &self.vertical[rho])
    }

    /// [S_ρ, S_σ].
    pub fn bracket(&self, graph: &mut Graph, algebroid: &Algebroid, rho: usize, sigma: usize) -> Vec<ExprId> {
        simplified_bracket(graph, algebroid, &self.vertical[rho], &self.vertical[sigma])
    }
}

fn simplified_bracket(
    graph: &mut Graph,
    algebroid: &Algebroid,
    sigma: &[ExprId],
    tau: &[ExprId],
) -> Vec<ExprId> {
    let bracket = algebroid.bracket(graph, sigma, tau);
    bracket.into_iter().map(|component| graph.simplify(component)).collect()
}

/// A basis of the kernel of R in components of D, e_f − e_p (R_p⁻¹ R_f) times a scale: the determinant of
/// R_p where that may vanish and something is divided by it.
fn kernel(
    graph: &mut Graph,
    rates: &Matrix,
    pivots: &[usize],
    free: &[usize],
    coordinates: &[SymbolId],
    facts: &Facts,
) -> Option<(Matrix, Vec<ExprId>)> {
    let rank = pivots.len() + free.len();
    let (zero, one) = (graph.zero(), graph.one());
    let pick =
        |set: &[usize]| -> Matrix { rates.iter().map(|row| set.iter().map(|a| row[*a]).collect()).collect() };
    let (mut whole, mut solved) = (one, Matrix::new());
    if !pivots.is_empty() && !free.is_empty() {
        let solution = graph.solve_linear(&pick(pivots), &pick(free))?;
        for divisor in solution.divisors {
            let divisor = graph.simplify(divisor);
            if !graph.vanishes_nowhere(divisor, facts) {
                whole = graph.formula(whole * divisor);
            }
        }
        solved = solution.values;
    }
    let (mut found, mut scales) = (Matrix::new(), Vec::new());
    for (f, a) in free.iter().enumerate() {
        let column: Vec<ExprId> = solved.iter().map(|row| graph.simplify(row[f])).collect();
        // no more than the common denominator: the section shall vanish nowhere that it need not
        let least = common_denominator(graph, &column, facts);
        let excess = graph.formula(whole / least);
        let excess = graph.simplify(excess);
        let clears = graph.depends_on(excess, coordinates)
            && column.iter().all(|entry| {
                let product = graph.formula(least * entry);
                let product = graph.simplify(product);
                !has_pole(graph, product, facts)
            });
        let scale = if clears { least } else { whole };
        let mut section = vec![zero; rank];
        section[*a] = scale;
        for (entry, p) in column.into_iter().zip(pivots) {
            let share = graph.formula(-(scale * entry));
            section[*p] = graph.simplify(share);
        }
        found.push(section);
        scales.push(scale);
    }
    Some((found, scales))
}

/// The product of what the expressions are divided by and may vanish, each factor in its highest power.
fn common_denominator(graph: &mut Graph, expressions: &[ExprId], facts: &Facts) -> ExprId {
    let mut found: Vec<(ExprId, Rational)> = Vec::new();
    for expression in expressions {
        let terms = graph.as_linear(*expression).1;
        for (term, _) in terms {
            let Node::Product { factors, .. } = graph.node(term) else { continue };
            for (base, exponent) in factors.iter().filter(|(_, exponent)| exponent.is_negative()) {
                if graph.vanishes_nowhere(*base, facts) {
                    continue;
                }
                let power = -exponent.clone();
                match found.iter_mut().find(|(known, _)| known == base) {
                    Some((_, most)) if *most < power => *most = power,
                    Some(_) => {}
                    None => found.push((*base, power)),
                }
            }
        }
    }
    graph.product(&found)
}

/// Whether it divides by something that may vanish.
fn has_pole(graph: &Graph, expression: ExprId, facts: &Facts) -> bool {
    graph.reachable(&[expression]).into_iter().any(|id| match graph.node(id) {
        Node::Product { factors, .. } => factors
            .iter()
            .any(|(base, exponent)| exponent.is_negative() && !graph.vanishes_nowhere(*base, facts)),
        _ => false,
    })
}

/// The kinetic metric in the basis of D, where it is a function on the base.
fn metric(graph: &mut Graph, system: &LagrangianSystem, sections: &Matrix) -> Option<Matrix> {
    let metric = kinetic_metric(graph, system, sections);
    let strangers: Vec<SymbolId> =
        system.algebroid.velocities.iter().copied().chain(system.clock.symbols()).collect();
    let constant = metric.iter().flatten().all(|entry| !graph.depends_on(*entry, &strangers));
    constant.then_some(metric)
}

/// The lifts of least kinetic energy, C⁻¹Rᵀ (R C⁻¹Rᵀ)⁻¹.
fn orthogonal(graph: &mut Graph, metric: &Matrix, rates: &Matrix) -> Option<Matrix> {
    if rates.is_empty() {
        return Some(Matrix::new());
    }
    let raised = graph.solve_linear(metric, &Graph::transposed(rates))?.values;
    let raised = Graph::transposed(&raised);
    let mut gram = Matrix::new();
    for row in rates {
        let mut entries = Vec::new();
        for column in &raised {
            let entry = graph.inner_product(row, column);
            entries.push(graph.simplify(entry));
        }
        gram.push(entries);
    }
    let unit = graph.identity(rates.len());
    let inverse = graph.solve_linear(&gram, &unit)?.values;
    let mut lifts = Matrix::new();
    for weights in Graph::transposed(&inverse) {
        let mut lift = Vec::new();
        for a in 0..metric.len() {
            let along: Vec<ExprId> = raised.iter().map(|column| column[a]).collect();
            let component = graph.inner_product(&along, &weights);
            lift.push(graph.simplify(component));
        }
        lifts.push(lift);
    }
    Some(lifts)
}

/// The lifts less their part along S in the kinetic metric, S (SᵀCS)⁻¹ SᵀC h.
fn without_vertical(graph: &mut Graph, metric: &Matrix, inside: &Matrix, lifts: Matrix) -> Option<Matrix> {
    let mut momenta = Matrix::new();
    for section in inside {
        momenta.push(graph.image(metric, section));
    }
    let mut inertia = Matrix::new();
    for momentum in &momenta {
        let row = graph.image(inside, momentum);
        inertia.push(row.into_iter().map(|entry| graph.simplify(entry)).collect());
    }
    let mut found = Matrix::new();
    for lift in lifts {
        let right: Matrix =
            momenta.iter().map(|momentum| vec![graph.inner_product(momentum, &lift)]).collect();
        let along: Vec<ExprId> = if inside.is_empty() {
            Vec::new()
        } else {
            graph.solve_linear(&inertia, &right)?.values.into_iter().map(|row| row[0]).collect()
        };
        let mut rest = Vec::new();
        for (a, component) in lift.into_iter().enumerate() {
            let column: Vec<ExprId> = inside.iter().map(|section| section[a]).collect();
            let share = graph.inner_product(&column, &along);
            let component = graph.formula(component - share);
            rest.push(graph.simplify(component));
        }
        found.push(rest);
    }
    Some(found)
}

/// The lifts along the pivots alone, R_p⁻¹.
fn along_pivots(graph: &mut Graph, rates: &Matrix, pivots: &[usize]) -> Option<Matrix> {
    let rank = rates.first().map_or(0, Vec::len);
    let matrix: Matrix = rates.iter().map(|row| pivots.iter().map(|a| row[*a]).collect()).collect();
    let unit = graph.identity(rates.len());
    let inverse = graph.solve_linear(&matrix, &unit)?.values;
    let mut lifts = Matrix::new();
    for kappa in 0..rates.len() {
        let mut lift = vec![graph.zero(); rank];
        for (row, p) in inverse.iter().zip(pivots) {
            lift[*p] = graph.simplify(row[kappa]);
        }
        lifts.push(lift);
    }
    Some(lifts)
}

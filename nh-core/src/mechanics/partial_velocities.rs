//! Velocities on D by named partial velocities.
//!
//! On D every velocity is u^k = θ^k(B_a) v^a + θ^k(y₀). The coefficients, Kane's partial velocities,
//! depend on the configuration alone, and so do those of the constrained velocities themselves: the
//! curvature tan δ / L of a car's path, say. As intermediate results they stay in one piece, and the
//! mass matrix is a sum of products of them, where expansion would bring everything over a common
//! denominator.

use super::procedure::Procedure;
use super::restricted::Restricted;
use super::velocity_forms::VelocityForms;
use crate::algebra::{Derivation, Graph, Matrix, Node, Rational, Residue};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};

impl Restricted {
    /// The velocities with their coefficients as intermediate results; `None` where there is nothing
    /// to name, or where levels of momenta determine velocities besides.
    pub(super) fn by_partial_velocities(
        graph: &mut Graph,
        distribution: &ConstraintDistribution,
        velocities: &[SymbolId],
        forms: &VelocityForms,
    ) -> Option<Self> {
        if !distribution.eliminated.is_empty() {
            return None;
        }
        let independent = &distribution.independent;
        // 1. the coefficients of y and of û^k
        let mut restriction = distribution.restriction(graph, velocities);
        let mut names = PartialVelocities::default();
        let mut components = Matrix::new();
        for (symbol, value) in velocities.iter().zip(&distribution.velocity) {
            components.push(names.coefficients(graph, *symbol, *value, independent));
        }
        let mut restricted = Matrix::new();
        for (symbol, form) in &forms.forms {
            let value = restriction.apply(graph, *form);
            restricted.push(names.coefficients(graph, *symbol, value, independent));
        }
        // 2. their names, the shortest first
        if names.unnamed.is_empty() {
            return None;
        }
        names.define(graph);
        // 3. y and û^k by them
        let basis: Matrix = components.iter().map(|row| names.row(graph, row)).collect();
        let velocity = basis.iter().map(|row| combined(graph, row, independent)).collect();
        let restricted = restricted.iter().map(|row| {
            let row = names.row(graph, row);
            combined(graph, &row, independent)
        });
        let forms = Some(restricted.collect());
        let mut sections = Graph::transposed(&basis);
        sections.truncate(independent.len());
        Some(Self {
            definitions: names.definitions,
            velocity,
            eliminated: Vec::new(),
            sections,
            partials: independent.iter().map(|symbol| Derivation::partial(graph, *symbol)).collect(),
            forms,
            simplified: true,
        })
    }
}

/// θ(B_a) v^a + θ(y₀).
fn combined(graph: &mut Graph, row: &[ExprId], independent: &[SymbolId]) -> ExprId {
    let mut terms: Vec<ExprId> = Vec::with_capacity(row.len());
    for (coefficient, symbol) in row.iter().zip(independent) {
        let velocity = graph.symbol(*symbol);
        terms.push(graph.formula(coefficient * velocity));
    }
    terms.extend(&row[independent.len()..]);
    graph.sum(&terms)
}

/// Coefficients with their names, up to numbers.
#[derive(Default)]
struct PartialVelocities {
    /// What is to be named, with the names.
    unnamed: Vec<(ExprId, String)>,
    definitions: Procedure,
    /// What each coefficient is in terms of names.
    images: Vec<(ExprId, ExprId)>,
}

impl PartialVelocities {
    /// θ(B_a), and θ(y₀) at the end. Sums and quotients among them are to be named.
    fn coefficients(
        &mut self,
        graph: &mut Graph,
        form: SymbolId,
        value: ExprId,
        independent: &[SymbolId],
    ) -> Vec<ExprId> {
        let mut row: Vec<ExprId> = independent.iter().map(|symbol| graph.partial(value, *symbol)).collect();
        row.push(graph.at_zero(value, independent));
        for (index, coefficient) in row.iter_mut().enumerate() {
            *coefficient = graph.simplify(*coefficient);
            let (_, core) = graph.split_coefficient(*coefficient);
            if !is_monomial(graph, core) && self.unnamed.iter().all(|(known, _)| *known != core) {
                let symbols = graph.symbols();
                let along = independent.get(index).map(|symbol| format!("_per_{}", symbols[*symbol]));
                let name = format!("{}{}", symbols[form], along.unwrap_or_else(|| "_drift".into()));
                self.unnamed.push((core, name));
            }
        }
        row
    }

    /// Names them, the shortest first.
    fn define(&mut self, graph: &mut Graph) {
        self.unnamed.sort_by_key(|(core, _)| graph.operation_count(&[*core]));
        let mut named: Vec<Named> = Vec::new();
        for (core, name) in &self.unnamed {
            let samples = samples(graph, *core);
            let image = by_named(graph, &named, *core, samples).unwrap_or_else(|| {
                let image = self.definitions.define(graph, name, *core);
                named.push(Named { value: *core, name: image, samples });
                image
            });
            self.images.push((*core, image));
        }
    }

    fn row(&self, graph: &mut Graph, row: &[ExprId]) -> Vec<ExprId> {
        let mut image = |coefficient: &ExprId| {
            let (number, core) = graph.split_coefficient(*coefficient);
            let named = self.images.iter().find(|(value, _)| *value == core);
            named.map_or(*coefficient, |(_, name)| graph.scale(number, *name))
        };
        row.iter().map(&mut image).collect()
    }
}

/// Whether an expression is a product of positive powers of symbols and functions.
fn is_monomial(graph: &Graph, expression: ExprId) -> bool {
    match graph.node(expression) {
        Node::Sum { .. } => false,
        Node::Product { factors, .. } => factors
            .iter()
            .all(|(base, power)| !power.is_negative() && !matches!(graph.node(*base), Node::Sum { .. })),
        _ => true,
    }
}

/// A coefficient with a name.
struct Named {
    value: ExprId,
    name: ExprId,
    /// Its values at the sample points.
    samples: [f64; 2],
}

impl Named {
    /// Whether another coefficient may be this one times a symbol, as far as samples tell.
    fn may_divide(&self, graph: &Graph, other: ExprId, samples: [f64; 2]) -> bool {
        graph.symbols_in(&[self.value, other]).into_iter().any(|symbol| {
            (0..2).all(|point| {
                let product = sample(point, symbol) * self.samples[point];
                is_close(product - samples[point], product)
            })
        })
    }

    /// Whether another coefficient, less this one times a sign, may be a number, as far as samples tell.
    fn may_be_beside(&self, sign: &Rational, samples: [f64; 2]) -> bool {
        let sign = sign.to_f64();
        let [first, second] = [0, 1].map(|point| samples[point] - sign * self.samples[point]);
        is_close(first - second, samples[0].abs() + samples[1].abs() + first.abs())
    }
}

/// Whether a difference is nothing beside values of a size; one that is no number may be.
fn is_close(difference: f64, size: f64) -> bool {
    difference.is_nan() || difference.abs() <= 1e-6 * size.abs()
}

/// The values at the sample points.
fn samples(graph: &Graph, value: ExprId) -> [f64; 2] {
    [0, 1].map(|point| graph.evaluate(&[value], |symbol| sample(point, symbol))[0].value)
}

/// A number of ordinary size that the point and the symbol determine.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn sample(point: usize, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(23_000 + point as u64, symbol.index() as u64).word();
    0.5 + (word & 0xF_FFFF) as f64 / f64::from(1 << 20)
}

/// A coefficient as a named one times a length, or plus a number, as for two points of one body.
fn by_named(graph: &mut Graph, named: &[Named], core: ExprId, samples: [f64; 2]) -> Option<ExprId> {
    for other in named {
        // most are neither, which is seen without normal forms
        if other.may_divide(graph, core, samples) {
            let quotient = graph.formula(core / other.value);
            let quotient = graph.simplify(quotient);
            if graph.as_symbol(quotient).is_some() {
                return Some(graph.formula(quotient * other.name));
            }
        }
        for sign in [Rational::ONE, Rational::MINUS_ONE] {
            if !other.may_be_beside(&sign, samples) {
                continue;
            }
            let rest = graph.linear_combination(&[(Rational::ONE, core), (-sign.clone(), other.value)]);
            let rest = graph.simplify(rest);
            if graph.as_number(rest).is_some() {
                return Some(graph.linear_combination(&[(Rational::ONE, rest), (sign, other.name)]));
            }
        }
    }
    None
}

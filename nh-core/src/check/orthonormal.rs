//! A basis of D that is orthonormal in the kinetic metric, where the declaration asks for one.

use super::evidence::{counted, shown};
use super::formulation::Chosen;
use crate::algebra::{Facts, Graph, Matrix, Rational};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definiteness, LagrangianSystem, definiteness, kinetic_metric};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// The choice with the basis made orthonormal by Gram and Schmidt, so that C is the identity and the
/// equations are those of M 2.2; as it is, where the declaration does not ask.
///
/// # Errors
/// Where there is no basis of D, another number of names, or no metric.
pub fn orthonormal(
    model: &mut Model,
    system: &LagrangianSystem,
    chosen: Chosen,
    facts: &Facts,
) -> Result<Chosen, Vec<Violation>> {
    let Some((names, origin)) = model.orthonormal.clone() else { return Ok(chosen) };
    let refused = |what: String, evidence: String, way_out: &str| {
        Err(vec![Violation { law: Law::Choice, origin, what, evidence, way_out: way_out.into() }])
    };
    let (distribution, conditions, reason) = match chosen {
        Chosen::Adapted { distribution, conditions, reason } => (distribution, conditions, reason),
        Chosen::Projected { reason } => {
            return refused(
                "there is no basis of D to make orthonormal".into(),
                reason,
                "leave `orthonormal` out, or choose velocities by `independent`",
            );
        }
    };
    if model.distribution.is_some() {
        return refused(
            "`orthonormal` beside `distribution`".into(),
            "the state keeps the velocities of the sections that span D".into(),
            "describe D by `constraints`, or give sections that are orthonormal",
        );
    }
    if names.len() != distribution.rank() {
        return refused(
            format!("{} for an orthonormal basis of D", counted(names.len(), "name", "names")),
            format!("the rank of D is {}", distribution.rank()),
            "give a name to each of its velocities",
        );
    }
    let graph = &mut model.graph;
    let sections = distribution.sections();
    let metric = kinetic_metric(graph, system, &sections);
    let all = metric.concat();
    if let Some(entry) = all.iter().find(|entry| graph.depends_on(**entry, &system.algebroid.velocities)) {
        return refused(
            "the Lagrangian has no kinetic metric".into(),
            format!("the mass matrix depends on the velocities: {}", shown(graph, *entry)),
            "`orthonormal` is for kinetic energies that are quadratic in the velocities",
        );
    }
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    if definiteness(graph, &metric, &parameters, facts) != Definiteness::Definite {
        return refused(
            "the kinetic metric is not positive on D".into(),
            "its square roots would not be real".into(),
            "leave `orthonormal` out, or `assume` what makes it positive",
        );
    }
    let change = gram_schmidt(graph, &metric);
    let basis = distribution.rebased(graph, &change, names);
    let reason = format!("{reason}; its basis is orthonormal in the kinetic metric");
    Ok(Chosen::Adapted { distribution: Box::new(basis), conditions, reason })
}

/// Columns n_k / √d_k with n_k = e_k − Σ_{j<k} (n_jᵀ C e_k / d_j) n_j and d_k = n_kᵀ C e_k.
fn gram_schmidt(graph: &mut Graph, metric: &Matrix) -> Matrix {
    let rank = metric.len();
    let (mut columns, mut squares): (Matrix, Vec<ExprId>) = (Matrix::new(), Vec::new());
    for (k, along) in metric.iter().enumerate() {
        let mut column = graph.unit_vector(rank, k);
        for (earlier, square) in columns.iter().zip(&squares) {
            let product = graph.inner_product(earlier, along);
            let share = graph.formula(product / square);
            for (entry, other) in column.iter_mut().zip(earlier) {
                let part = graph.formula(share * other);
                let rest = graph.linear_combination(&[(Rational::ONE, *entry), (Rational::MINUS_ONE, part)]);
                *entry = graph.simplify(rest);
            }
        }
        let square = graph.inner_product(&column, along);
        squares.push(graph.simplify(square));
        columns.push(column);
    }
    for (column, square) in columns.iter_mut().zip(squares) {
        let length = graph.sqrt(square);
        for entry in column {
            *entry = graph.formula(*entry / length);
        }
    }
    Graph::transposed(&columns)
}

//! Brackets of the declared observables, and what their rates have beyond the bracket with the energy.

use super::on_request::{energy_gradient, judge, nonholonomic_bracket, not_differentiable, shortened, state};
use super::proved::{Derived, Proved};
use crate::algebra::Graph;
use crate::id::{ExprId, Origin};
use crate::mechanics::{Drift, Procedure, jacobian};
use crate::violation::{Law, Violation};

/// {f_i, f_j}_nh = df_i · Π df_j, {f_i, E_L}_nh = df_i · Π dE_L, and R_L(f_i) + ∂_tf_i: the last two are
/// the rate of f_i, mathematics (17). Auxiliary states are given functions of the time.
pub(super) fn of_outputs(
    proved: &mut Proved,
    derived: &Derived<'_>,
    observables: &Procedure,
    origin: Origin,
) -> Result<[Procedure; 3], Vec<Violation>> {
    if observables.outputs.is_empty() {
        return Err(vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: "there are no functions to take brackets of".into(),
            evidence: String::new(),
            way_out: "declare them: `outputs { spin = …; }`".into(),
        }]);
    }
    let arguments = state(proved, derived);
    let clock = proved.system.clock.symbols();
    let with_time = [arguments.as_slice(), &clock].concat();
    let mut differentials = jacobian(&mut proved.model.graph, observables, &with_time)
        .map_err(|error| vec![not_differentiable(error, origin)])?;
    let rows = std::mem::take(&mut differentials.outputs);
    let rows: Vec<&[ExprId]> = rows.chunks(with_time.len()).collect();
    let (rows, slopes): (Vec<&[ExprId]>, Vec<&[ExprId]>) =
        rows.into_iter().map(|row| row.split_at(arguments.len())).unzip();
    // ∂_tf_i + ż ∂_zf_i
    let graph = &mut proved.model.graph;
    let rates: Vec<ExprId> = proved.system.clock.rates(graph).into_iter().map(|(_, rate)| rate).collect();
    let changes: Vec<ExprId> = slopes.iter().map(|row| graph.inner_product(row, &rates)).collect();
    Ok([
        with_each_other(proved, derived, differentials.clone(), &rows),
        with_energy(proved, derived, differentials.clone(), &rows),
        drift(proved, derived, differentials, (&rows, &changes)),
    ])
}

/// df_i · Π df_j, row by row.
fn with_each_other(
    proved: &mut Proved,
    derived: &Derived<'_>,
    mut procedure: Procedure,
    differentials: &[&[ExprId]],
) -> Procedure {
    let judge = judge(proved);
    let bracket = nonholonomic_bracket(proved, derived);
    let graph = &mut proved.model.graph;
    let (n, count) = (bracket.coordinates.len(), differentials.len());
    let mut fields = Vec::with_capacity(count);
    for differential in differentials {
        let (rates, accelerations) = bracket.sharp(graph, &judge, differential.split_at(n), &mut procedure);
        fields.push([rates, accelerations].concat());
    }
    let mut outputs = vec![graph.zero(); count * count];
    for i in 0..count {
        for j in i + 1..count {
            let value = graph.inner_product(differentials[i], &fields[j]);
            let value = graph.simplify(value);
            outputs[i * count + j] = value;
            outputs[j * count + i] = graph.formula(-value);
        }
    }
    procedure.outputs = outputs;
    shortened(graph, procedure)
}

/// df_i · Π dE_L.
fn with_energy(
    proved: &mut Proved,
    derived: &Derived<'_>,
    mut procedure: Procedure,
    differentials: &[&[ExprId]],
) -> Procedure {
    let judge = judge(proved);
    let arguments = state(proved, derived);
    let bracket = nonholonomic_bracket(proved, derived);
    let graph = &mut proved.model.graph;
    let slopes = energy_gradient(graph, &proved.system, derived, &arguments);
    let covector = slopes.split_at(bracket.coordinates.len());
    let (rates, accelerations) = bracket.sharp(graph, judge, covector, &mut procedure);
    procedure.outputs = along(graph, differentials, &[rates, accelerations].concat());
    shortened(graph, procedure)
}

/// R_L(f_i) + ∂_tf_i + ż ∂_zf_i.
fn drift(
    proved: &mut Proved,
    derived: &Derived<'_>,
    mut procedure: Procedure,
    (differentials, changes): (&[&[ExprId]], &[ExprId]),
) -> Procedure {
    let judge = judge(proved);
    let manifold = proved.constraints.manifold(&mut proved.model.graph, &proved.system.algebroid.velocities);
    let (graph, system) = (&mut proved.model.graph, &proved.system);
    let field = match derived {
        Derived::Adapted { distribution, equations, .. } => {
            let definite = judge(graph, &equations.mass);
            Drift::adapted(graph, system, distribution, equations, definite, &mut procedure)
        }
        Derived::Projected { residuals, equations } => {
            let constraints = (*residuals, &manifold);
            Drift::projected(graph, system, constraints, equations, judge, &mut procedure)
        }
    };
    let field = [field.rates, field.accelerations].concat();
    let beyond = along(graph, differentials, &field);
    procedure.outputs =
        beyond.into_iter().zip(changes).map(|(f, change)| graph.formula(f + change)).collect();
    shortened(graph, procedure)
}

/// The derivatives of functions along a vector field.
fn along(graph: &mut Graph, differentials: &[&[ExprId]], field: &[ExprId]) -> Vec<ExprId> {
    differentials
        .iter()
        .map(|differential| {
            let change = graph.inner_product(differential, field);
            graph.simplify(change)
        })
        .collect()
}

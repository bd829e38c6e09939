//! The Levi-Civita connection of the kinetic metric on E and the constrained connection.

use super::on_request::{asked, judge, shortened};
use super::proved::{Derived, Proved};
use crate::algebra::{Graph, Matrix};
use crate::check::evidence::shown;
use crate::functions::{CHRISTOFFEL, CONNECTION, Functions};
use crate::geometry::{Christoffel, koszul};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{LagrangianSystem, Procedure, SaddleEquations, solve_symmetric};
use crate::model::Request;
use crate::violation::{Law, Violation};

/// Both connections, if they are asked for.
pub(super) fn derive(
    proved: &mut Proved,
    derived: &Derived<'_>,
    found: &mut Functions,
) -> Result<(), Vec<Violation>> {
    let Some(origin) = asked(&proved.model, Request::Connection) else { return Ok(()) };
    let refuse = |evidence: String| {
        vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: "there is no connection of the kinetic metric".into(),
            evidence,
            way_out: "connections belong to Lagrangians T − V with T a regular quadratic form in the velocities, and \
                      to constraints that are linear in them"
                .into(),
        }]
    };
    let metric = metric(&mut proved.model.graph, &proved.system).map_err(refuse)?;
    let restricted = proved.base.restrict_matrix(&mut proved.model.graph, &metric);
    if proved.model.graph.generic_rank(&restricted) != Ok(metric.len()) {
        return Err(refuse("the mass matrix is singular on E".into()));
    }
    let residuals = proved.constraints.residuals.clone();
    let is_linear = proved.constraints.linear.as_ref().is_some_and(|linear| {
        linear.drift.iter().all(|drift| proved.base.zero_test(&mut proved.model.graph, *drift).is_zero())
    });
    if !is_linear || proved.system.clock.occurs_in(&proved.model.graph, &residuals) {
        return Err(refuse("the constraints are not linear, or depend on the time".into()));
    }
    let judge = judge(proved);
    let (graph, algebroid) = (&mut proved.model.graph, &proved.system.algebroid);
    // 1. ∇ on E
    let units = graph.identity(metric.len());
    let lowered = koszul(graph, algebroid, &metric, &units);
    let definite = judge(graph, &metric);
    let solve = |graph: &mut Graph, right: &[ExprId], procedure: &mut Procedure| {
        solve_symmetric(graph, &metric, right, definite, procedure, "christoffel")
    };
    let christoffel = raised(graph, &lowered, solve);
    // 2. ∇̌
    let connection = match derived {
        Derived::Adapted { distribution, equations, .. } => {
            let sections = distribution.sections();
            let lowered = koszul(graph, algebroid, &metric, &sections);
            let definite = judge(graph, &equations.mass);
            let solve = |graph: &mut Graph, right: &[ExprId], procedure: &mut Procedure| {
                solve_symmetric(graph, &equations.mass, right, definite, procedure, "connection")
            };
            raised(graph, &lowered, solve)
        }
        Derived::Projected { equations, .. } => {
            let symbols = christoffel.written_out(graph);
            let complement = complement(graph, equations, judge);
            constrained(graph, &proved.system, &symbols, &complement)
        }
    };
    found.add(&CHRISTOFFEL, shortened(graph, christoffel));
    found.add(&CONNECTION, shortened(graph, connection));
    Ok(())
}

/// G_{αβ} = ∂²L/∂y^α∂y^β, which depends neither on velocities nor on the time; else what it is.
fn metric(graph: &mut Graph, system: &LagrangianSystem) -> Result<Matrix, String> {
    let velocities = &system.algebroid.velocities;
    let momenta = system.momenta(graph);
    let mut metric = Matrix::with_capacity(momenta.len());
    for momentum in momenta {
        let mut row = Vec::with_capacity(velocities.len());
        for velocity in velocities {
            let entry = graph.partial(momentum, *velocity);
            let entry = graph.simplify(entry);
            let strangers: Vec<SymbolId> = velocities.iter().copied().chain(system.clock.symbols()).collect();
            if graph.depends_on(entry, &strangers) {
                let text = shown(graph, entry);
                return Err(format!(
                    "an entry of the mass matrix is {text}, which is no function on the base"
                ));
            }
            row.push(entry);
        }
        metric.push(row);
    }
    Ok(metric)
}

/// Γ^c_{ab} from the covariant components.
fn raised(
    graph: &mut Graph,
    lowered: &Christoffel,
    solve: impl Fn(&mut Graph, &[ExprId], &mut Procedure) -> Vec<ExprId>,
) -> Procedure {
    let mut procedure = Procedure::default();
    let mut outputs = Vec::new();
    for components in lowered.iter().flatten() {
        let solved = solve(graph, components, &mut procedure);
        outputs.extend(solved);
    }
    procedure.outputs = outputs;
    procedure
}

/// Q = 1 − P, the projection to the kinetic-energy orthogonal complement of D: a row for each component.
fn complement(
    graph: &mut Graph,
    equations: &SaddleEquations,
    judge: impl Fn(&Graph, &Matrix) -> crate::mechanics::Definiteness,
) -> Matrix {
    let zero = graph.zero();
    let columns: Matrix = (0..equations.mass.len())
        .map(|beta| {
            let bias = equations.jacobian.iter().map(|row| row[beta]).collect();
            let normal =
                SaddleEquations { force: vec![zero; equations.mass.len()], bias, ..equations.clone() };
            let mut procedure = Procedure::inline();
            let (column, _) = normal.solve(graph, &judge, &mut procedure);
            let column = procedure.with_outputs(column).written_out(graph);
            column.into_iter().map(|entry| graph.simplify(entry)).collect()
        })
        .collect();
    Graph::transposed(&columns)
}

/// ∇̌_σ τ = P∇_στ + ∇_σ(Qτ) on all of E (CLMM Example 3.6).
fn constrained(
    graph: &mut Graph,
    system: &LagrangianSystem,
    symbols: &[ExprId],
    complement: &Matrix,
) -> Procedure {
    let s = complement.len();
    let of = |a: usize, b: usize, c: usize| symbols[(a * s + b) * s + c];
    let mut outputs = Vec::with_capacity(s * s * s);
    for a in 0..s {
        let mut along = system.algebroid.anchor.along(crate::id::Id::from_index(a));
        for b in 0..s {
            let derivative: Vec<ExprId> = (0..s).map(|c| of(a, b, c)).collect();
            for (c, row) in complement.iter().enumerate() {
                let normal = graph.inner_product(row, &derivative);
                let change = along.apply(graph, row[b]);
                let column: Vec<ExprId> = complement.iter().map(|row| row[b]).collect();
                let turned: Vec<ExprId> = (0..s).map(|d| of(a, d, c)).collect();
                let turned = graph.inner_product(&column, &turned);
                let terms = [
                    (1.into(), derivative[c]),
                    ((-1).into(), normal),
                    (1.into(), change),
                    (1.into(), turned),
                ];
                let sum = graph.linear_combination(&terms);
                outputs.push(graph.simplify(sum));
            }
        }
    }
    Procedure::of(outputs)
}

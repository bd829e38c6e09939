//! Momenta of symmetries: which there are, and the functions that compute them.

use super::proved::{Proved, Symmetries};
use super::velocities_of_state::requested;
use crate::algebra::Substitution;
use crate::check::{self, Constraints, Motion, Setting};
use crate::functions::{Functions, MOMENTA, MOMENTUM_RATES};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use crate::limits;
use crate::mechanics::{LagrangianSystem, Procedure, cyclic_coordinates};
use crate::model::{Model, Request};
use crate::violation::Violation;

/// Lagrangians with more operations than this are searched for cyclic coordinates, but not for
/// their momenta unless these are asked for.
const SEARCHED: u64 = 250;

/// Judges the declared sections, and finds the cyclic coordinates.
///
/// # Errors
/// Declared sections that are neither in D nor symmetries; a request for momenta of which there are
/// none.
pub(super) fn symmetries(
    model: &mut Model,
    motion: &Motion,
    system: &LagrangianSystem,
    constraints: &Constraints,
    spanned: Option<&ConstraintDistribution>,
) -> Result<Symmetries, Vec<Violation>> {
    let mut more = constraints.residuals.clone();
    if let Some(linear) = &constraints.linear {
        more.extend(linear.annihilator.iter().flatten().chain(&linear.drift));
    }
    if let Some(distribution) = spanned {
        more.extend(distribution.basis.iter().flatten());
    }
    more.extend(model.identities.iter().map(|identity| identity.value));
    more.extend(model.positions.iter().map(|position| position.value));
    more.extend(model.calls.iter().flat_map(|call| &call.arguments));
    more.extend(model.auxiliary.iter().map(|state| state.value));
    let cyclic = cyclic_coordinates(&mut model.graph, system, &more);
    let asked = model.requests.iter().find(|(request, _)| *request == Request::Momenta).copied();
    let small = model.graph.operation_count(&[system.lagrangian]) <= SEARCHED;
    let needed = asked.is_some() || !model.routh.is_empty();
    let search = !cyclic.is_empty() && (small || needed);
    if model.symmetries.is_empty() && !search {
        return match asked {
            Some((_, origin)) => Err(vec![check::no_momenta(origin)]),
            None => Ok(Symmetries { cyclic, ..Symmetries::default() }),
        };
    }
    let setting = Setting::new(&mut model.graph, system, constraints, spanned);
    let declared = check::symmetries(model, motion, &setting)?;
    let mut of_cyclic = || check::of_cyclic_coordinates(model, &setting, &cyclic);
    let mut found = match (search, needed) {
        (false, _) => Vec::new(),
        (true, true) => of_cyclic(),
        (true, false) => limits::attempt(limits::REMARK, of_cyclic).unwrap_or_default(),
    };
    found.retain(|(_, symmetry)| declared.iter().all(|known| known.section != symmetry.section));
    match asked {
        Some((_, origin))
            if declared.is_empty() && found.iter().all(|(_, symmetry)| !symmetry.is_horizontal()) =>
        {
            Err(vec![check::no_momenta(origin)])
        }
        _ => Ok(Symmetries { declared, cyclic, found }),
    }
}

/// σ^α p_α − f and its rate on the constraint manifold, for the declared sections, or else for those
/// found if momenta are asked for.
///
/// In D the rate is the right side of the momentum equation (12); elsewhere it is the derivative
/// along the motion, so that the forces of constraint are in it.
pub(super) fn momenta(
    proved: &mut Proved,
    restriction: &mut Substitution,
    derivative: &Procedure,
    velocities: &[SymbolId],
) -> (Vec<String>, Functions) {
    let mut symmetries = proved.symmetries.declared.clone();
    if symmetries.is_empty() {
        if !requested(&proved.model, Request::Momenta) {
            return Default::default();
        }
        let found = proved.symmetries.found.iter().map(|(_, symmetry)| symmetry);
        symmetries.extend(found.filter(|symmetry| symmetry.is_horizontal()).cloned());
    }
    let system = &proved.system;
    let graph = &mut proved.model.graph;
    let auxiliary = system.clock.auxiliary.iter().map(|(state, _)| *state);
    let state: Vec<SymbolId> =
        system.algebroid.anchor.coordinates.iter().chain(velocities).copied().chain(auxiliary).collect();
    let (mut values, mut rates) = (Vec::new(), Vec::new());
    for symmetry in &symmetries {
        let value = restriction.apply(graph, symmetry.momentum.value);
        let value = graph.simplify(value);
        let rate = if symmetry.is_conserved {
            graph.zero()
        } else if symmetry.in_distribution() {
            let rate = symmetry.momentum.rate(graph);
            let rate = restriction.apply(graph, rate);
            graph.simplify(rate)
        } else {
            let mut terms = vec![graph.partial(value, system.clock.time)];
            for (symbol, velocity) in state.iter().zip(&derivative.outputs) {
                let partial = graph.partial(value, *symbol);
                terms.push(graph.formula(partial * velocity));
            }
            graph.sum(&terms)
        };
        values.push(value);
        rates.push(rate);
    }
    let names = symmetries.into_iter().map(|symmetry| symmetry.name).collect();
    let rates: Vec<ExprId> = rates;
    let mut found = Functions::default();
    found.add(&MOMENTA, Procedure::of(values));
    found.add(&MOMENTUM_RATES, derivative.with_outputs(rates));
    (names, found)
}

//! What is found about a derived system beside its functions: the last stage before the report, which prints it.

mod bracket_entries;
mod closure;
mod held_forces;
mod integrable;
mod momenta_found;
mod real_states;
mod reduced_form;
mod singular_places;
mod velocities_to_name;

use crate::algebra::{Function2, Graph, Node};
use crate::check::{
    Condition, domain, domain_of, domain_of_derivatives, not_conservative, with_zeros, without_slopes_at_rest,
};
use crate::compile::{Derived, Proved};
use crate::geometry::suggested_velocities::Suggested;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::moving_energy_section;
use crate::model::Request;

pub(crate) use bracket_entries::{BracketEntries, Jacobi};
pub(crate) use closure::Closure;
pub(crate) use integrable::Integrable;
pub(crate) use momenta_found::{LevelMomentum, Rate, SymmetryMomentum};
pub(crate) use reduced_form::{Connection, Quantities, ReducedForm, Split};
use singular_places::SingularPlaces;
pub(crate) use singular_places::{LongBlock, SingularPlace};

/// What the report says beyond the declaration and the equations.
#[derive(Clone, Debug)]
pub(crate) struct Findings {
    /// Whether it is not known that any real state is as declared.
    pub(crate) no_state_is_known: bool,
    /// Where alone the equations have a value.
    pub(crate) domain: Vec<Condition>,
    /// What holds of their derivatives, where these are asked for.
    pub(crate) of_derivatives: OfDerivatives,
    /// The claimed first integrals, in their order.
    pub(crate) claims: Vec<FirstIntegral>,
    /// Where alone the quasi-velocities are a chart: these vanish somewhere.
    pub(crate) chart_divisors: Vec<ExprId>,
    /// Whether D is closed under the bracket; `None` where its sections are not known.
    pub(crate) closure: Option<Closure>,
    /// Whether the constraints on velocities are the rates of equations between positions.
    pub(crate) integrable: Integrable,
    /// Factors of the determinant of the mass matrix, or of the saddle matrix, that vanish in some states, or for some parameters.
    pub(crate) singular_mass: Vec<SingularPlace>,
    /// Blocks of the same whose determinants are too long to be written out.
    pub(crate) long_blocks: Vec<LongBlock>,
    /// The factors of its short determinants that are made of parameters alone.
    pub(crate) parameter_factors: Vec<ExprId>,
    /// What reduction theory calls the equations.
    pub(crate) reduced: ReducedForm,
    /// The declared symmetries.
    pub(crate) symmetries: Vec<SymmetryMomentum>,
    /// The momenta on levels.
    pub(crate) levels: Vec<LevelMomentum>,
    /// R = L − v^ρ μ_ρ on the levels, mathematics (22).
    pub(crate) routhian: Option<ExprId>,
    /// Whether the energy is conserved.
    pub(crate) keeps_energy: bool,
    /// Whether an energy is conserved and the Lagrangian contains the angle of a point, by which energies jump.
    pub(crate) has_turns: bool,
    /// ξ of a moving energy E_L − ξ^α p_α, where the energy itself is not conserved.
    pub(crate) moving_energy: Option<Vec<ExprId>>,
    /// The symmetries whose momenta are conserved, with these.
    pub(crate) conserved_momenta: Vec<(String, ExprId)>,
    /// The velocities that the declaration might name, where the state keeps all of them unasked.
    pub(crate) suggested: Option<Suggested>,
    /// What forces act along that constraints hold.
    pub(crate) held_forces: Vec<String>,
}

/// Where the derivatives of the equations have values.
#[derive(Clone, Debug, Default)]
pub(crate) struct OfDerivatives {
    /// What they need besides what the equations do.
    pub(crate) unless: Vec<Condition>,
    /// Whether they tend to values wherever roots vanish by which they divide, and there are such roots.
    pub(crate) go_on: bool,
}

/// Where a claimed first integral is one.
#[derive(Clone, Debug)]
pub(crate) struct FirstIntegral {
    /// Where alone it has a value, besides where the equations have.
    pub(crate) domain: Vec<Condition>,
    /// Whether it contains the angle of a point, which jumps by a turn.
    pub(crate) has_turns: bool,
}

impl Findings {
    /// Finds them.
    pub(crate) fn of(proved: &mut Proved, derived: &Derived<'_>) -> Self {
        let no_state_is_known = real_states::undecided(proved);
        let domain = domain(&mut proved.model, &proved.facts);
        let of_derivatives = of_derivatives(proved, &domain);
        let claims = first_integrals(proved, &domain);
        let chart_divisors = with_zeros(&mut proved.model, &proved.motion.divisors);
        let closure = Closure::of(proved, derived);
        let integrable = integrable::found(proved, closure);
        let SingularPlaces { places: singular_mass, of_parameters: parameter_factors, long: long_blocks } =
            singular_places::found(proved, derived, domain.is_empty());
        let reduced = ReducedForm::of(proved, derived);
        let symmetries = momenta_found::symmetries(proved, derived);
        let (levels, routhian) = momenta_found::levels(proved, derived);
        let Proved { model, system, constraints, .. } = &mut *proved;
        let keeps_energy = not_conservative(model, system, constraints).is_none();
        let lagrangian = system.lagrangian;
        let moving_energy = if keeps_energy { None } else { moving_energy(proved) };
        let tells_energy = keeps_energy || moving_energy.is_some();
        let has_turns = tells_energy && has_turns(&proved.model.graph, lagrangian);
        let conserved_momenta = momenta_found::conserved(proved, derived);
        let suggested = velocities_to_name::suggestion(proved, derived);
        let held_forces = held_forces::found(proved, derived);
        Self {
            no_state_is_known,
            domain,
            of_derivatives,
            claims,
            chart_divisors,
            closure,
            integrable,
            singular_mass,
            long_blocks,
            parameter_factors,
            reduced,
            symmetries,
            levels,
            routhian,
            keeps_energy,
            has_turns,
            moving_energy,
            conserved_momenta,
            suggested,
            held_forces,
        }
    }
}

fn of_derivatives(proved: &mut Proved, of_equations: &[Condition]) -> OfDerivatives {
    let Proved { model, facts, .. } = proved;
    let is_asked = |request: &Request| request.computes_slopes() || *request == Request::Taylor;
    if !model.requests.iter().any(|(request, _)| is_asked(request)) {
        return OfDerivatives::default();
    }
    let conditions = domain_of_derivatives(model, facts, of_equations);
    // power series have no values that they tend to, and where the equations have none, neither have their derivatives
    let has_series = model.requests.iter().any(|(request, _)| *request == Request::Taylor);
    if has_series || of_equations.iter().any(|condition| matches!(condition, Condition::Positive(_))) {
        return OfDerivatives { unless: conditions, go_on: false };
    }
    let unless = without_slopes_at_rest(model, facts, &conditions);
    let go_on = unless.is_empty() && !conditions.is_empty();
    OfDerivatives { unless, go_on }
}

fn first_integrals(proved: &mut Proved, of_equations: &[Condition]) -> Vec<FirstIntegral> {
    let Proved { model, facts, .. } = proved;
    let values: Vec<ExprId> = model.claims.iter().map(|claim| claim.value).collect();
    let found = values.into_iter().map(|value| {
        let domain = domain_of(model, facts, (&[value], 0), of_equations);
        FirstIntegral { domain, has_turns: has_turns(&model.graph, value) }
    });
    found.collect()
}

/// Whether an expression contains the angle of a point, which jumps by a turn.
pub(super) fn has_turns(graph: &Graph, value: ExprId) -> bool {
    let mut parts = graph.reachable(&[value]).into_iter();
    parts.any(|part| matches!(graph.node(part), Node::Apply2(Function2::Atan2, ..)))
}

/// ξ for which E_L − ξ^α p_α is conserved, where one is found (mathematics section 4).
fn moving_energy(proved: &mut Proved) -> Option<Vec<ExprId>> {
    let parameters = parameters(proved);
    let Proved { model, system, constraints, .. } = proved;
    let linear = constraints.linear.as_ref()?;
    let graph = &mut model.graph;
    let autonomous = !system.clock.occurs_in(graph, &constraints.residuals)
        && !system.clock.moves(graph, system.lagrangian);
    let free = system.is_free(graph);
    if !autonomous || !free {
        return None;
    }
    let manifold = constraints.manifold(graph, &system.algebroid.velocities);
    moving_energy_section(graph, system, linear, &parameters, &manifold)
}

fn parameters(proved: &Proved) -> Vec<SymbolId> {
    proved.model.parameters.iter().map(|parameter| parameter.symbol).collect()
}

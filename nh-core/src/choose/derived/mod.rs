//! Proofs of the functions that are derived beside the motion: each is compared, at points of the field, with what
//! its definition says of the declared data and of the motion that is proved already. Derivatives are taken there in
//! numbers (`algebra/tangent.rs`), linear systems are solved there, with no rule of those that made the expressions.

mod added_conditions;
mod claimed_forms;
mod definition;
mod divisors;
mod held;
mod jumps;
mod kinetic_energy;
mod place;
mod procedure_derivative;
mod proof_of_bracket;
mod proof_of_connection;
mod proof_of_flow;
mod proof_of_jacobian;
mod proof_of_product;
mod proof_of_splitting;
mod real_zeros;
mod returns;
#[cfg(test)]
mod wrong_derivative_tests;

use super::ledger::Proof;
use super::proof::{
    Defect, FIRST_SEED, at_points, bits_of_a_point, defined, has_branches, run, unless_roots_are_missing,
};
use super::reference::{Reference, inner};
use crate::algebra::{Direction, Facts, FieldPass, FieldPoint, Graph, Node, Radicands, Residue};
use crate::id::{ExprId, SymbolId};
use crate::limits;
use crate::mechanics::{HamiltonianSide, Procedure};
use crate::phase_space::{HeldEquations, StepForm, VariationalForm};
use crate::system::{Embedding, ImpactForm, PositionReturn, Projection};
pub(crate) use claimed_forms::{
    AlmostPoissonForm, AppliedForce, BracketForm, GyroscopicForm, PowerForm, SplittingForm, ValuesForm,
    VelocityNames,
};
use place::Place;
pub(crate) use proof_of_product::prove_product;

/// What is claimed of a derived function.
#[derive(Clone, Copy)]
pub(crate) enum Derived<'p> {
    /// The derivatives of a function by arguments, a row for each of its outputs.
    Jacobian(&'p Procedure, &'p Procedure, &'p [SymbolId]),
    /// The values of a function, then its derivatives in the same way.
    Linearized(&'p Procedure, &'p Procedure, &'p [SymbolId]),
    /// The derivatives of a function along the motion.
    Rates(&'p Procedure, &'p Procedure),
    /// Σ ∂f_i/∂x_i of the motion, where functions of time and place vanish.
    Divergence(&'p Procedure, &'p [ExprId]),
    /// The density of a volume that the motion keeps there.
    Density(&'p Procedure, &'p [ExprId]),
    /// Π and ∂E.
    Sharp(AlmostPoissonForm<'p>),
    /// Brackets of outputs.
    Bracket(BracketForm<'p>),
    /// E_L, mathematics (6).
    Energy(&'p Procedure),
    /// The momenta, their inverse, h, brackets and Hamilton's equations, mathematics (16), (17), with the energy.
    Hamiltonian(&'p HamiltonianSide, &'p Procedure),
    /// Velocities over the base whose momenta are claimed, and which the motion keeps: the last images.
    Section(&'p Procedure, &'p [ExprId]),
    /// The symbols of the Levi-Civita connection.
    Christoffel(&'p Procedure),
    /// Those of the constrained connection, beside the former.
    Connection(&'p Procedure, &'p Procedure),
    /// The nonholonomic connection.
    Splitting(SplittingForm<'p>),
    /// ⟨J, K⟩ of a Chaplygin system.
    Gyroscopic(GyroscopicForm<'p>),
    /// The power of forces and constraints.
    Power(PowerForm<'p>),
    /// Declared functions at the state.
    Values(ValuesForm<'p>),
    /// σ^α p_α − f, by sections and gauges.
    Momenta(&'p Procedure, &'p [(Vec<ExprId>, Option<ExprId>)]),
    /// y at the state.
    Velocity(&'p Procedure),
    /// Functions of (t, x, y).
    Residual(&'p Procedure, &'p [ExprId]),
    /// A step back to these constraints on velocities.
    Projection(&'p Projection, &'p [ExprId]),
    /// A step back to constraints on positions, the first of so many, and one to these constraints on velocities.
    Return(&'p PositionReturn, usize, &'p [ExprId]),
    /// Equations that a step keeps by itself, the first of them so many on positions.
    Held(&'p HeldEquations, usize),
    /// A jump of the velocities, with the rows Ψ y + b.
    Jump(&'p ImpactForm, &'p [ExprId]),
    /// A step back to an embedded base.
    Normalisation(&'p Embedding, &'p [ExprId]),
    /// The kick of the leapfrog.
    Leapfrog(&'p StepForm),
    /// What a variational step is made of.
    Variational(&'p VariationalForm),
    /// The discrete momentum on a Lie algebra.
    DiscreteMomentum(&'p StepForm),
}

/// The motion: rates of the state, by the state, and the time.
#[derive(Clone, Copy)]
pub(crate) struct Motion<'p> {
    pub(crate) derivative: &'p Procedure,
    pub(crate) state: &'p [SymbolId],
    pub(crate) time: SymbolId,
}

/// What is known of parameters, and of the rest.
#[derive(Clone, Copy)]
pub(crate) struct Allowed<'f> {
    pub(crate) parameters: &'f [SymbolId],
    /// The parameters that nothing forbids to be 0.
    pub(crate) may_vanish: &'f [SymbolId],
    pub(crate) facts: &'f Facts,
    /// What `validate` checks not to be 0.
    pub(crate) conditions: &'f [ExprId],
}

/// Where something is claimed: everywhere, or where symbols are these functions of others.
pub(crate) type Images<'p> = &'p [(SymbolId, ExprId)];

impl Derived<'_> {
    /// The functions that it is about.
    pub(crate) fn procedures(&self) -> Vec<&Procedure> {
        match *self {
            Self::Jacobian(a, b, _)
            | Self::Linearized(a, b, _)
            | Self::Rates(a, b)
            | Self::Connection(a, b) => {
                vec![a, b]
            }
            Self::Divergence(a, _)
            | Self::Density(a, _)
            | Self::Energy(a)
            | Self::Section(a, _)
            | Self::Christoffel(a)
            | Self::Momenta(a, _)
            | Self::Velocity(a)
            | Self::Residual(a, _) => vec![a],
            Self::Sharp(form) => vec![form.gradient, form.sharp, form.energy],
            Self::Bracket(form) => {
                vec![form.outputs, form.bracket, form.with_energy, form.drift, form.energy]
            }
            Self::Hamiltonian(side, energy) => {
                let HamiltonianSide { legendre, inverse, hamiltonian, equations, bracket, drift, .. } = side;
                vec![energy, legendre, inverse, hamiltonian, equations, bracket, drift]
            }
            Self::Splitting(form) => {
                let SplittingForm { vertical, lifts, inertia, coefficients, curvature, .. } = form;
                let SplittingForm { momenta, velocities, force, .. } = form;
                let all = [vertical, lifts, inertia, coefficients, curvature, momenta, velocities, force];
                all.into_iter().flatten().collect()
            }
            Self::Gyroscopic(form) => vec![form.force],
            Self::Power(form) => [form.power, form.energy].into_iter().chain(form.multipliers).collect(),
            Self::Values(form) => vec![form.values],
            Self::Projection(projection, _) => vec![&projection.step],
            Self::Return(positions, ..) => {
                [&positions.residual, &positions.step].into_iter().chain(&positions.velocities).collect()
            }
            Self::Held(held, _) => vec![&held.map],
            Self::Jump(impact, _) => vec![&impact.jump],
            Self::Normalisation(embedding, _) => vec![&embedding.step],
            Self::Leapfrog(form) | Self::DiscreteMomentum(form) => vec![&form.map],
            Self::Variational(form) => vec![&form.slopes, &form.residual, &form.change],
        }
    }

    /// The expressions that it is about beside procedures and the declared equations.
    fn further(&self) -> Vec<ExprId> {
        match *self {
            Self::Divergence(_, functions)
            | Self::Density(_, functions)
            | Self::Section(_, functions)
            | Self::Residual(_, functions)
            | Self::Projection(_, functions)
            | Self::Return(_, _, functions)
            | Self::Jump(_, functions)
            | Self::Normalisation(_, functions) => functions.to_vec(),
            Self::Held(held, _) => held.functions.clone(),
            Self::Splitting(form) => form.group.concat(),
            Self::Power(form) => {
                let row = |force: &AppliedForce| force.along.clone().unwrap_or_default();
                let forces = form.forces.iter().flat_map(|force| [vec![force.value], row(force)].concat());
                let rows = form.rows.iter().flat_map(|rows| rows.iter().flatten().copied());
                forces.chain(rows).chain(form.names.expressions()).collect()
            }
            Self::Values(form) => form.declared.iter().copied().chain(form.names.expressions()).collect(),
            Self::Momenta(_, sections) => {
                sections.iter().flat_map(|(section, gauge)| section.iter().chain(gauge)).copied().collect()
            }
            _ => Vec::new(),
        }
    }

    /// Whether it is claimed where the constraints and the identities of the base hold, and need not be so elsewhere.
    pub(crate) fn is_about_constraints(&self) -> bool {
        matches!(
            self,
            Self::Rates(..)
                | Self::Divergence(..)
                | Self::Density(..)
                | Self::Sharp(_)
                | Self::Bracket(_)
                | Self::Hamiltonian(..)
                | Self::Section(..)
                | Self::Christoffel(_)
                | Self::Connection(..)
                | Self::Splitting(_)
                | Self::Gyroscopic(_)
                | Self::Power(_)
        )
    }

    /// Whether its definition leaves factors open: that of a density, and the basis of S, which has none without poles
    /// where S turns.
    fn has_open_factors(&self) -> bool {
        match self {
            Self::Density(..) => true,
            Self::Splitting(form) => form.vertical.is_some(),
            _ => false,
        }
    }

    fn holds(&self, place: &mut Place) -> Result<bool, Defect> {
        match *self {
            Self::Jacobian(function, jacobian, arguments) => {
                proof_of_jacobian::is_jacobian(place, (function, arguments), &place.run(jacobian)?)
            }
            Self::Linearized(function, linearized, arguments) => {
                proof_of_jacobian::is_linearized(place, (function, arguments), &place.run(linearized)?)
            }
            Self::Rates(function, rates) => Ok(place.slopes(function, &place.flow()?)? == place.run(rates)?),
            Self::Divergence(stored, vanishing) => {
                Ok(place.run(stored)? == [proof_of_flow::divergence(place, vanishing)?])
            }
            Self::Density(density, vanishing) => proof_of_flow::is_kept(place, density, vanishing),
            Self::Sharp(form) => proof_of_bracket::sharp(place, &form),
            Self::Bracket(form) => proof_of_bracket::of_outputs(place, &form),
            Self::Energy(energy) => Ok(place.run(energy)? == [place.instant.energy()?]),
            Self::Hamiltonian(side, energy) => proof_of_flow::is_hamiltonian(place, side, energy),
            Self::Section(lifted, claimed) => proof_of_flow::is_solution(place, lifted, claimed),
            Self::Christoffel(symbols) => proof_of_connection::is_christoffel(place, symbols),
            Self::Connection(symbols, christoffel) => {
                proof_of_connection::is_constrained(place, symbols, christoffel)
            }
            Self::Splitting(form) => proof_of_splitting::holds(place, &form),
            Self::Gyroscopic(form) => proof_of_splitting::is_gyroscopic(place, &form),
            Self::Power(form) => proof_of_flow::is_power(place, &form),
            Self::Values(form) => are_values(place, &form),
            Self::Momenta(momenta, sections) => are_momenta(place, momenta, sections),
            Self::Velocity(velocity) => Ok(place.run(velocity)? == place.instant.velocity()),
            Self::Residual(residual, functions) => Ok(place.run(residual)? == place.values(functions)?),
            Self::Projection(projection, residuals) => returns::is_projection(place, projection, residuals),
            Self::Return(positions, constraints, residuals) => {
                let moves = returns::is_return(place, positions, constraints)?;
                Ok(moves && returns::is_change(place, positions.velocities.as_ref(), residuals)?)
            }
            Self::Held(held, positions) => held::are_held(place, held, positions),
            Self::Jump(impact, rows) => jumps::is_jump(place, impact, rows),
            Self::Normalisation(embedding, identities) => {
                returns::is_normalised(place, embedding, identities)
            }
            Self::Leapfrog(form) => returns::is_leapfrog(place, form),
            Self::Variational(form) => returns::is_variational(place, form),
            Self::DiscreteMomentum(form) => returns::is_discrete_momentum(place, form),
        }
    }
}

/// Points at which branches of roots are tried.
const BRANCHES: u64 = 48;
/// Steps of work after which it is not known whether a function adds a condition.
const CONDITIONS: u64 = 400_000;

/// Proves a claim; a function of the motion has values where that has, and what defines it, or it is said that this was
/// not decided.
///
/// # Errors
/// What is wrong, or why it could not be decided.
pub(crate) fn prove_derived(
    graph: &Graph,
    (reference, motion): (&Reference, Motion),
    claim: &Derived,
    images: Images,
    allowed: &Allowed,
) -> Result<(Proof, Option<String>), Defect> {
    let procedures: Vec<&Procedure> = claim.procedures().into_iter().chain([motion.derivative]).collect();
    let mut roots: Vec<ExprId> = procedures.iter().flat_map(|procedure| procedure.expressions()).collect();
    roots.extend(claim.further().into_iter().chain(reference.roots()));
    let solved: Vec<SymbolId> = images.iter().map(|(symbol, _)| *symbol).collect();
    if is_inside_functions(graph, &roots, &solved) {
        let reason =
            "it is claimed where constraints determine what stands in functions that are no formulas";
        return Err(Defect::Unknown(reason.into()));
    }
    let values_of = |images: Images| images.iter().map(|(_, image)| *image).collect::<Vec<ExprId>>();
    let values = values_of(images);
    roots.extend(&values);
    let division = graph.angle_division(&roots);
    let degree = degree(graph, reference, division, (&procedures, &claim.further(), &values));
    let mut determined: Vec<SymbolId> = procedures.iter().flat_map(|procedure| defined(procedure)).collect();
    determined.extend(reference.determined().iter().chain(&solved));
    let bits = bits_of_a_point(graph, (&roots, &determined), &procedures, degree, division)?;
    let radicands = Radicands::of(graph, &roots, &determined);
    let at = |mut point: FieldPoint, images: Images| -> Result<Place, Defect> {
        let on = FieldPass::new(graph, point.clone(), division).evaluate(&values_of(images))?;
        point.chosen.extend(images.iter().map(|(symbol, _)| *symbol).zip(on));
        let instant = reference.at(graph, point.clone(), division)?;
        Ok(Place { reference, instant, motion, point, division })
    };
    let point = |seed| radicands.point_in(seed, |point| FieldPass::new(graph, point, division));
    let holds = |point: FieldPoint| claim.holds(&mut at(point, images)?);
    let wrong = || Defect::Wrong("it is not what its definition says".into());
    let outcome = at_points(bits, point, |point| if holds(point)? { Ok(()) } else { Err(wrong()) });
    // what is wrong agrees nowhere; what holds for one choice of its roots does so at some points
    let agrees = |seed: u64| holds(point(seed)).is_ok_and(|holds| holds);
    let is_of_a_branch = matches!(outcome, Err(Defect::Wrong(_)))
        && has_branches(graph, &roots)
        && (FIRST_SEED..FIRST_SEED + BRANCHES).any(agrees);
    if is_of_a_branch {
        let reason =
            "it holds for one choice of its roots of roots, and the field does not tell which is taken";
        return Err(Defect::Unknown(reason.into()));
    }
    let proof = unless_roots_are_missing(graph, &roots, outcome)?;
    let declared = reference.roots();
    // where a section of D* is defined depends on the base alone, and its own velocities are known only there
    let given = match claim {
        Derived::Section(lifted, _) => &images[..images.len() - lifted.outputs.len().min(images.len())],
        _ => images,
    };
    let about = (declared.as_slice(), motion, given);
    let added = limits::attempt(CONDITIONS, || {
        let at = |point| at(point, given);
        added_conditions::added_condition(graph, claim, about, reference.system(), allowed, point, at)
    });
    added_conditions::judged(proof, added)
}

/// Whether symbols stand in the arguments of functions whose values in the field are chosen beside theirs.
fn is_inside_functions(graph: &Graph, roots: &[ExprId], symbols: &[SymbolId]) -> bool {
    !symbols.is_empty()
        && graph.reachable(roots).into_iter().any(|id| match graph.node(id) {
            Node::Apply(_, x) => graph.depends_on(*x, symbols),
            Node::Apply2(_, x, y) => graph.depends_on(*x, symbols) || graph.depends_on(*y, symbols),
            _ => false,
        })
}

/// A bound on the degrees of what is compared: entries are data, procedures and their derivatives, which have at most
/// three times the degree of their functions, at the images; what is solved are as many equations at most as
/// there are coordinates and velocities, twice.
fn degree(
    graph: &Graph,
    reference: &Reference,
    division: i64,
    (procedures, further, images): (&[&Procedure], &[ExprId], &[ExprId]),
) -> f64 {
    let mut degrees = reference.degrees(graph, division);
    let own: f64 = procedures.iter().map(|procedure| procedure.degree(&mut degrees)).sum();
    let functions = if further.is_empty() { 0.0 } else { degrees.most(further) };
    let declared = reference.degree(graph, division, own);
    let at = if images.is_empty() { 1.0 } else { 1.0 + reference.degrees(graph, division).most(images) };
    let algebroid = &reference.system().algebroid;
    let equations =
        2 * (algebroid.rank() + algebroid.anchor.coordinates.len() + reference.residuals().len()) + 1;
    let equations = f64::from(u32::try_from(equations).unwrap_or(u32::MAX));
    equations * equations * 3.0 * (own + functions + declared) * at
}

impl Motion<'_> {
    /// The direction in which the state moves.
    fn direction(&self, pass: &mut FieldPass) -> Result<Direction, Defect> {
        let rates = run(pass, self.derivative)?;
        let mut direction: Direction = self.state.iter().copied().zip(rates).collect();
        direction.insert(self.time, Residue::ONE);
        Ok(direction)
    }
}

impl VelocityNames<'_> {
    fn expressions(&self) -> impl Iterator<Item = ExprId> {
        self.replaced.iter().flat_map(|(_, row)| row.clone())
    }

    /// An evaluation that knows them, ẋ = ρ(y).
    fn known<'a>(&self, place: &Place<'a, '_>) -> Result<FieldPass<'a>, Defect> {
        let mut pass = place.pass();
        choose_all(&mut pass, self.rates, &place.instant.rates)?;
        for (symbol, row) in self.replaced {
            let value = inner(&pass.evaluate(row)?, place.instant.velocity());
            choose_all(&mut pass, &[*symbol], &[value])?;
        }
        Ok(pass)
    }
}

/// The declared functions.
fn are_values(place: &Place, form: &ValuesForm) -> Result<bool, Defect> {
    Ok(form.names.known(place)?.evaluate(form.declared)? == place.run(form.values)?)
}

/// σ^α p_α − f.
fn are_momenta(
    place: &Place,
    momenta: &Procedure,
    sections: &[(Vec<ExprId>, Option<ExprId>)],
) -> Result<bool, Defect> {
    let p: Vec<Residue> = place.momenta(Direction::default())?.iter().map(|dual| dual.value).collect();
    let mut wanted = Vec::new();
    for (section, gauge) in sections {
        let along = inner(&place.values(section)?, &p);
        let gauge =
            gauge.map_or(Ok(Residue::ZERO), |gauge| place.values(&[gauge]).map(|values| values[0]))?;
        wanted.push(along - gauge);
    }
    Ok(place.run(momenta)? == wanted)
}

fn choose_all(pass: &mut FieldPass, symbols: &[SymbolId], values: &[Residue]) -> Result<(), Defect> {
    let is_free = symbols.iter().zip(values).all(|(symbol, value)| pass.choose(*symbol, *value));
    if is_free { Ok(()) } else { Err(Defect::Wrong("a symbol has two values".into())) }
}

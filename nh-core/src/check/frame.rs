//! New sections as combinations of the declared ones: a change of basis, or a basis of D.

use super::dependence::dependent_columns;
use super::evidence::{listed, shown};
use super::kinematics::Motion;
use crate::algebra::{Facts, Graph, Matrix, NotLinear, Substitution};
use crate::geometry::{Algebroid, ChangeOfBasis, ConstraintDistribution, LinearConstraints, Manifold};
use crate::id::{ExprId, Id, Origin, SectionId, SymbolId};
use crate::model::{ForceDirection, Formulation, FrameDecl, Model, Request, Section};
use crate::violation::{Law, Violation};

/// The components of the sections of the frame in the declared basis.
///
/// # Errors
/// Right-hand sides that are no sections.
fn frame_components(model: &mut Model) -> Result<Matrix, Vec<Violation>> {
    let velocities: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
    let mut rows = Vec::new();
    let mut violations = Vec::new();
    for declaration in model.frame.clone() {
        match components(model, &velocities, &declaration) {
            Ok(row) => rows.push(row),
            Err(violation) => violations.push(violation),
        }
    }
    if violations.is_empty() { Ok(rows) } else { Err(violations) }
}

fn components(
    model: &mut Model,
    velocities: &[SymbolId],
    declaration: &FrameDecl,
) -> Result<Vec<ExprId>, Violation> {
    let base: Vec<SymbolId> = model
        .coordinates
        .iter()
        .map(|coordinate| coordinate.symbol)
        .chain(model.parameters.iter().map(|parameter| parameter.symbol))
        .collect();
    let graph = &mut model.graph;
    let blame = |evidence: String| Violation {
        law: Law::Frame,
        origin: declaration.origin,
        what: format!("`{}` is not a combination of the declared sections", declaration.name),
        evidence,
        way_out: "write it as a sum of sections with coefficients on the base, such as `d1 - A*xi`".into(),
    };
    let form = graph.linear_form(declaration.value, velocities).map_err(|error| match error {
        NotLinear::Curved(..) => blame(format!("{} is not linear in them", shown(graph, declaration.value))),
        NotLinear::Unknown(why) => blame(why),
    })?;
    if !graph.zero_test(form.rest).is_zero() {
        return Err(blame(format!("the term {} is not multiplied by a section", shown(graph, form.rest))));
    }
    match graph.symbols_in(&form.coefficients).into_iter().find(|symbol| !base.contains(symbol)) {
        None => Ok(form.coefficients),
        Some(stranger) => {
            let name = &graph.symbols()[stranger];
            Err(blame(format!("its coefficients depend on `{name}`, which is not on the base")))
        }
    }
}

/// Makes the frame the basis of the algebroid, mathematics (5). Sections that the frame leaves
/// unnamed stay: each new section takes the place of the declared one that its expression rests on.
///
/// From here on `model.sections` are those of the new basis, and the velocities of the replaced
/// ones stand for their expressions in the new velocities, as do the rates.
///
/// # Errors
/// A frame that is nowhere a basis.
pub fn change_to_frame(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: Algebroid,
    base: &Manifold,
    facts: &Facts,
) -> Result<Algebroid, Vec<Violation>> {
    if model.frame.is_empty() {
        return Ok(algebroid);
    }
    let rows = frame_components(model)?;
    let Some(places) = places(model, &rows, base, facts) else {
        return Err(vec![no_basis(model, &rows, base)]);
    };
    // 1. Ψ and Φ
    let rank = algebroid.rank();
    let graph = &mut model.graph;
    let identity = graph.identity(rank);
    let mut sections = identity.clone();
    for (row, place) in rows.iter().zip(&places) {
        for (line, component) in sections.iter_mut().zip(row) {
            line[*place] = *component;
        }
    }
    let Some(inverse) = graph.solve_linear(&sections, &identity) else {
        return Err(vec![no_basis(model, &rows, base)]);
    };
    motion.divisors.extend(inverse.divisors);
    let change = ChangeOfBasis { sections, velocities: inverse.values };
    // 2. the sections of the new basis
    let old: Vec<SymbolId> = algebroid.velocities.clone();
    for (declaration, place) in model.frame.iter().zip(&places) {
        model.sections[SectionId::from_index(*place)] = Section {
            name: declaration.name.clone(),
            symbol: declaration.symbol,
            origin: declaration.origin,
        };
    }
    let velocities: Vec<SymbolId> = model.sections.iter().map(|section| section.symbol).collect();
    let graph = &mut model.graph;
    let changed = change.apply(graph, &algebroid, velocities);
    // 3. what replaced velocities and the rates stand for
    let new = changed.velocity(graph);
    let replaced = change.old_velocity(graph, &new);
    let rates = changed.rates(graph, &new);
    motion.rates = Substitution::new(model.coordinates.iter().map(|coordinate| coordinate.rate).zip(rates));
    for place in &places {
        motion.rates.insert(old[*place], replaced[*place]);
        motion.replaced.push((old[*place], change.sections[*place].clone()));
        motion.named.push((old[*place], change.velocities.iter().map(|row| row[*place]).collect()));
    }
    for stays in (0..rank).filter(|place| !places.contains(place)) {
        let differs = graph.formula(replaced[stays] - new[stays]);
        if !graph.zero_test(differs).is_zero() {
            let was = graph.simplify(replaced[stays]);
            motion.shifted.push((old[stays], was));
        }
    }
    motion.anchor = changed.anchor.clone();
    Ok(changed)
}

/// The declared section whose place each new one takes: the first with a coefficient that vanishes
/// nowhere, or else the first that leaves the whole a basis.
fn places(model: &mut Model, rows: &Matrix, base: &Manifold, facts: &Facts) -> Option<Vec<usize>> {
    let rank = model.sections.len();
    let mut places: Vec<usize> = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let mut candidates: Vec<usize> = (0..rank).filter(|place| !places.contains(place)).collect();
        candidates.sort_by_key(|place| !model.graph.vanishes_nowhere(row[*place], facts));
        let found = candidates.into_iter().find(|candidate| {
            let mut chosen = places.clone();
            chosen.push(*candidate);
            let minor: Matrix =
                rows[..=index].iter().map(|row| chosen.iter().map(|place| row[*place]).collect()).collect();
            let minor = base.restrict_matrix(&mut model.graph, &minor);
            model.graph.generic_rank(&minor) == Ok(index + 1)
        })?;
        places.push(found);
    }
    Some(places)
}

fn no_basis(model: &mut Model, rows: &Matrix, base: &Manifold) -> Violation {
    let restricted = base.restrict_matrix(&mut model.graph, rows);
    let blamed = (1..=rows.len())
        .find(|count| model.graph.generic_rank(&restricted[..*count]).is_ok_and(|rank| rank < *count))
        .map_or(0, |count| count - 1);
    let declaration = &model.frame[blamed];
    let before: Vec<String> = model.frame[..blamed].iter().map(|d| format!("`{}`", d.name)).collect();
    let evidence = if before.is_empty() {
        format!("{} vanishes everywhere", shown(&model.graph, declaration.value))
    } else {
        format!("it is a combination of {}", listed(&before))
    };
    Violation {
        law: Law::Frame,
        origin: declaration.origin,
        what: format!("`{}` makes the frame no basis", declaration.name),
        evidence,
        way_out: "choose sections that are linearly independent at most points of the base".into(),
    }
}

/// D by sections that span it: its basis is as declared, so that nothing is divided by.
///
/// # Errors
/// Spanning sections that are nowhere independent, or a Lagrangian in the velocities of the frame.
pub fn spanned_distribution(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: &Algebroid,
    base: &Manifold,
) -> Result<Option<ConstraintDistribution>, Vec<Violation>> {
    let Some(spanning) = model.distribution.clone() else { return Ok(None) };
    let refused = excluded(model, &spanning)
        .or_else(|| nameless_multipliers(model, &spanning))
        .or_else(|| undetermined_reactions(model));
    if let Some(violation) = refused {
        return Err(vec![violation]);
    }
    let rows = frame_components(model)?;
    let new: Vec<SymbolId> = model.frame.iter().map(|declaration| declaration.symbol).collect();
    if model.graph.depends_on(model.lagrangian.value, &new) {
        return Err(vec![Violation {
            law: Law::Frame,
            origin: model.lagrangian.origin,
            what: "the Lagrangian is written in a velocity of the frame".into(),
            evidence: "with `distribution`, velocities of the frame have a meaning on D only".into(),
            way_out: "write it in the declared quasi-velocities".into(),
        }]);
    }
    if let Some(violation) = velocity_outside(model, &spanning) {
        return Err(vec![violation]);
    }
    let rank = algebroid.rank();
    let graph = &mut model.graph;
    let mut basis: Matrix = Vec::new();
    for (symbol, _) in &spanning {
        let declared = algebroid.velocities.iter().position(|velocity| velocity == symbol);
        match (declared, new.iter().position(|velocity| velocity == symbol)) {
            (Some(index), _) => basis.push(graph.unit_vector(rank, index)),
            (None, Some(index)) => basis.push(rows[index].clone()),
            (None, None) => {}
        }
    }
    let restricted = base.restrict_matrix(&mut model.graph, &basis);
    if let Some((index, evidence)) = dependent_columns(&model.graph, &restricted) {
        let (symbol, origin) = spanning[index];
        let name = &model.graph.symbols()[symbol];
        return Err(vec![Violation {
            law: Law::Independence,
            origin,
            what: format!("`{name}` is in the span of the sections before it"),
            evidence,
            way_out: "leave it out: the sections that span D are independent".into(),
        }]);
    }
    if let Some(violation) = two_meanings(model, &spanning, &restricted, algebroid) {
        return Err(vec![violation]);
    }
    motion.named.extend(new.into_iter().zip(rows));
    let annihilator = annihilator(model, &basis, rank);
    let drift = vec![model.graph.zero(); annihilator.len()];
    let basis = Graph::transposed(&basis);
    let constraints = LinearConstraints { annihilator, drift };
    let independent = spanning.into_iter().map(|(symbol, _)| symbol).collect();
    Ok(Some(ConstraintDistribution::spanned(&mut model.graph, constraints, independent, basis)))
}

/// An expression with the velocity of a section of the frame that does not span D: motions have none along it.
fn velocity_outside(model: &Model, spanning: &[(SymbolId, Origin)]) -> Option<Violation> {
    let graph = &model.graph;
    let mut others = model
        .frame
        .iter()
        .map(|declaration| declaration.symbol)
        .filter(|symbol| spanning.iter().all(|(other, _)| other != symbol));
    let outputs = model.outputs.iter().chain(&model.claims).map(|output| (output.value, output.origin));
    let densities = model.volume.iter().filter_map(|claim| Some((claim.density?, claim.origin)));
    let forces = model.forces.iter().map(|force| (force.value, force.origin));
    let auxiliary = model.auxiliary.iter().map(|state| (state.value, state.origin));
    let calls =
        model.calls.iter().flat_map(|call| call.arguments.iter().map(|argument| (*argument, call.origin)));
    let rows = model.impacts.iter().flat_map(|impact| &impact.rows).map(|row| (row.value, row.origin));
    let written: Vec<(ExprId, Origin)> =
        outputs.chain(densities).chain(forces).chain(auxiliary).chain(calls).chain(rows).collect();
    let (symbol, origin) = others.find_map(|symbol| {
        let place = written.iter().find(|(value, _)| graph.depends_on(*value, &[symbol]));
        place.map(|(_, origin)| (symbol, *origin))
    })?;
    let name = &graph.symbols()[symbol];
    Some(Violation {
        law: Law::Frame,
        origin,
        what: format!("`{name}` is no velocity of a motion"),
        evidence: format!("D is the span of {}, and `{name}` is not among these", names_of(model, spanning)),
        way_out:
            "write it in the velocities of the sections that span D, or in the declared quasi-velocities"
                .into(),
    })
}

/// A declared section that spans D beside another one with a part along it: the velocity along it that the state would
/// keep is not the quasi-velocity of that name.
fn two_meanings(
    model: &Model,
    spanning: &[(SymbolId, Origin)],
    basis: &Matrix,
    algebroid: &Algebroid,
) -> Option<Violation> {
    let graph = &model.graph;
    for (index, (symbol, origin)) in spanning.iter().enumerate() {
        let Some(place) = algebroid.velocities.iter().position(|velocity| velocity == symbol) else {
            continue;
        };
        let others = basis.iter().enumerate().filter(|(other, _)| *other != index);
        let mut along = others.map(|(other, row)| (other, row[place]));
        let Some((other, part)) = along.find(|(_, part)| !graph.zero_test(*part).is_zero()) else { continue };
        let (name, second) = (&graph.symbols()[*symbol], &graph.symbols()[spanning[other].0]);
        return Some(Violation {
            law: Law::Frame,
            origin: *origin,
            what: format!("`{name}` would mean two velocities"),
            evidence: format!(
                "the section `{second}` has the part {} along it, so that the velocity along `{name}` in D is not the \
                 quasi-velocity `{name}`",
                shown(graph, part)
            ),
            way_out: format!("give the section a name of its own, `frame {{ s = {name}; }}`, and list `s`"),
        });
    }
    None
}

/// What a distribution by span leaves no room for.
fn excluded(model: &Model, spanning: &[(SymbolId, Origin)]) -> Option<Violation> {
    let position = model.positions.first().map(|position| ("`holonomic`", position.origin));
    let constraint = model.constraints.iter().next().map(|c| ("`constraints`", c.origin));
    let constraint = position.or(constraint);
    let formulation = model.formulation.filter(|(asked, _)| *asked == Formulation::Projected);
    let formulation = formulation.map(|(_, origin)| ("the projected formulation", origin));
    // on levels of momenta the state keeps some of them alone
    let is_spanning = |symbol: &SymbolId| spanning.iter().any(|(other, _)| other == symbol);
    let named = model.independent.as_ref().filter(|named| {
        named.len() + model.routh.len() != spanning.len()
            || !named.iter().all(|(symbol, _)| is_spanning(symbol))
    });
    let named = named.and_then(|named| named.first());
    let named = named.map(|(_, origin)| ("`independent`", *origin));
    let (what, origin) = constraint.or(formulation).or(named)?;
    Some(Violation {
        law: Law::Choice,
        origin,
        what: format!("{what} beside `distribution`"),
        evidence: format!(
            "D is the span of {} already, and the state keeps their velocities",
            names_of(model, spanning)
        ),
        way_out: "keep one of the two descriptions".into(),
    })
}

/// A multiplier belongs to a constraint, and of a D that is spanned none is declared.
fn nameless_multipliers(model: &Model, spanning: &[(SymbolId, Origin)]) -> Option<Violation> {
    let (_, origin) = *model.requests.iter().find(|(request, _)| *request == Request::Multipliers)?;
    Some(Violation {
        law: Law::Choice,
        origin,
        what: "there are no multipliers of a distribution that is spanned".into(),
        evidence: format!(
            "D is the span of {}, and no constraint is declared that a multiplier would belong to",
            names_of(model, spanning)
        ),
        way_out: "ask for `reactions`, the forces of constraint along the sections, or state `constraints { … }` in \
                  place of `distribution`"
            .into(),
    })
}

/// The sections that span D, for a message.
fn names_of(model: &Model, spanning: &[(SymbolId, Origin)]) -> String {
    let names: Vec<&str> = spanning.iter().map(|(s, _)| model.graph.symbols()[*s].as_str()).collect();
    listed(&names)
}

/// A force along a spanning section acts on D alone, so that the reactions are not determined.
fn undetermined_reactions(model: &Model) -> Option<Violation> {
    let (_, origin) = *model.requests.iter().find(|(request, _)| *request == Request::Reactions)?;
    let new: Vec<SymbolId> = model.frame.iter().map(|declaration| declaration.symbol).collect();
    let force = model.forces.iter().find_map(|force| match force.direction {
        ForceDirection::Section(symbol) if new.contains(&symbol) => Some(symbol),
        _ => None,
    })?;
    let name = &model.graph.symbols()[force];
    Some(Violation {
        law: Law::Force,
        origin,
        what: "the reactions are not determined".into(),
        evidence: format!(
            "the force along `{name}` is known on D only; what of it the constraints bear is open"
        ),
        way_out: "give that force along declared sections, or leave `reactions` out".into(),
    })
}

/// Covectors that vanish on D, solved on components that are independent at most points.
fn annihilator(model: &mut Model, spanning: &Matrix, rank: usize) -> Matrix {
    let graph = &mut model.graph;
    let independent = graph.independent_columns(spanning).unwrap_or_default();
    if independent.len() != spanning.len() {
        return Matrix::new();
    }
    let square: Matrix =
        spanning.iter().map(|row| independent.iter().map(|column| row[*column]).collect()).collect();
    let others: Vec<usize> = (0..rank).filter(|column| !independent.contains(column)).collect();
    let right: Matrix =
        spanning.iter().map(|row| others.iter().map(|column| row[*column]).collect()).collect();
    if others.is_empty() {
        return Matrix::new();
    }
    // spanning_independent · X = spanning_others; e^other − X · e^independent vanishes on D
    let Some(solution) = graph.solve_linear(&square, &right) else { return Matrix::new() };
    let (zero, one) = (graph.zero(), graph.one());
    let mut rows = Matrix::new();
    for (index, other) in others.iter().enumerate() {
        let mut row = vec![zero; rank];
        row[*other] = one;
        for (position, column) in independent.iter().enumerate() {
            row[*column] = graph.formula(-solution.values[position][index]);
        }
        rows.push(row);
    }
    rows
}

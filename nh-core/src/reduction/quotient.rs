//! The quotient by a symmetry, constructed: CM section 4, CLMM 4.8–4.12.
//!
//! In a frame of invariant sections nothing that determines the motion depends on the coordinates
//! along the group; they are dropped, and the rest is a system of its own: brackets by mathematics
//! (5), the anchor on what is left of the base, L, D and the forces rewritten.

use super::bundle_map::linear;
use super::invariance::{Invariant, constraints};
use super::side::Side;
use super::{Refusal, fence};
use crate::algebra::{Graph, Matrix, Substitution};
use crate::check::evidence::shown;
use crate::compile::{self, Proved, frame_names, moved, with_translations};
use crate::geometry::{ChangeOfBasis, Fibres, InvariantFrame};
use crate::id::{CoordId, ExprId, Id, Origin, SymbolId};
use crate::limits::{Subject, about};
use crate::model::{Located, Model, PositionDecl};
use crate::violation::{Law, Violation};

/// A quotient, as it is declared.
#[derive(Clone, Debug)]
pub struct QuotientDecl {
    /// The whole of it: blamed where no line is at fault.
    pub origin: Origin,
    /// The coordinates along the group.
    pub dropped: Vec<CoordId>,
    /// The quasi-velocities of the invariant frame, with their names; those of the system if not given.
    pub velocities: Option<Vec<(String, Located)>>,
    /// Coordinates that are called otherwise in the quotient.
    pub renamed: Vec<(CoordId, String)>,
}

/// A derived system: what its declaration consists of, over the graph of the full one.
#[derive(Clone, Debug)]
pub struct Quotient {
    /// The full system; its graph holds every expression.
    pub source: Model,
    /// The names of the quasi-velocities.
    pub velocities: Vec<String>,
    /// Each of them in the velocities of the full system.
    pub map: Vec<ExprId>,
    /// The coordinates that are left, with their rates.
    pub anchor: Vec<(CoordId, ExprId)>,
    /// [e_α, e_β] as combinations of the velocity symbols, where they are not zero.
    pub brackets: Vec<(usize, usize, ExprId)>,
    /// The identities of an embedded base that are left.
    pub identities: Vec<ExprId>,
    /// Position constraints, those that follow from others last.
    pub positions: Vec<Equation>,
    /// Whether some follow from others.
    pub is_redundant: bool,
    /// L.
    pub lagrangian: ExprId,
    /// Constraints, as two sides of an equation.
    pub constraints: Vec<Equation>,
    /// Forces along sections.
    pub forces: Vec<(usize, ExprId)>,
    /// The rates of the auxiliary states, which go along, by their names.
    pub auxiliary: Vec<(String, ExprId)>,
}

/// A constraint of the quotient.
#[derive(Clone, Debug)]
pub struct Equation {
    /// Its label.
    pub label: Option<String>,
    /// The left side.
    pub left: ExprId,
    /// The right side.
    pub right: ExprId,
}

/// Derives the quotient.
///
/// # Errors
/// What depends on the dropped coordinates, with the derivative that should have been zero; a frame
/// that is none.
pub fn quotient(model: Model, declared: &QuotientDecl) -> Result<Quotient, Refusal> {
    let mut source = Side::of(model)?;
    about(Subject::Quotient);
    fence(super::on_moving_positions(&source, declared.origin).into_iter().collect())?;
    let lines = declared.velocities.iter().flatten().map(|(_, line)| ("velocity", *line)).collect();
    fence(super::rough(&mut source, lines))?;
    // 1. the frame: w = Φ y, Ψ = Φ⁻¹
    let derived = invariant_frame(&mut source, declared);
    let no_frame = derived.as_ref().err().cloned();
    let (names, rows, change) = match derived.ok().flatten() {
        Some(derived) => derived,
        None => frame(&mut source, declared).map_err(Refusal::Broken)?,
    };
    let symbols: Vec<SymbolId> = names.iter().map(|name| source.graph().new_symbol(name.clone())).collect();
    let graph = &mut source.proved.model.graph;
    let algebroid = change.apply(graph, &source.proved.system.algebroid, symbols);
    let new = algebroid.velocity(graph);
    let old = change.old_velocity(graph, &new);
    let mut in_frame = Substitution::new(source.velocities().to_vec().into_iter().zip(old));
    // 2. everything in the frame, without the dropped coordinates
    let mut invariant = Invariant::of(&mut source, declared, no_frame);
    let mut anchor = Vec::new();
    for (row, id) in algebroid.anchor.entries.iter().zip(ids(&invariant.side.proved.model)) {
        if declared.dropped.contains(&id) {
            continue;
        }
        let name = invariant.side.proved.model.coordinates[id].name.clone();
        let rate = invariant.side.graph().inner_product(row, &new);
        anchor.push((id, invariant.checked(rate, &format!("the rate of `{name}`"))));
    }
    let mut brackets = Vec::new();
    for a in 0..names.len() {
        for b in a + 1..names.len() {
            let graph = invariant.side.graph();
            let [alpha, beta] = [a, b].map(Id::from_index);
            let components: Vec<ExprId> = algebroid
                .sections()
                .map(|gamma| algebroid.structure.get(graph, gamma, alpha, beta))
                .collect();
            let bracket = graph.inner_product(&components, &new);
            let bracket = invariant.checked(bracket, &format!("the bracket [{}, {}]", names[a], names[b]));
            if !invariant.side.graph().is_literal_zero(bracket) {
                brackets.push((a, b, bracket));
            }
        }
    }
    let lagrangian = invariant.side.proved.system.lagrangian;
    let lagrangian = in_frame.apply(invariant.side.graph(), lagrangian);
    let lagrangian = invariant.checked(lagrangian, "the Lagrangian");
    let constraints = constraints(&mut invariant, &algebroid.velocities, &change, &mut in_frame);
    let forces = forces(&mut invariant, &change, &mut in_frame, &names);
    let auxiliary = auxiliary(&mut invariant, &mut in_frame);
    let identities = identities(&mut invariant);
    let positions = positions(&mut invariant);
    // 3. what was found to depend on them
    let violations = std::mem::take(&mut invariant.violations);
    fence(violations)?;
    let map = rows.into_iter().map(|row| source.graph().simplify(row)).collect();
    Ok(Quotient {
        velocities: names,
        map,
        anchor,
        brackets,
        identities,
        positions,
        is_redundant: !source.proved.positions.redundant.is_empty(),
        lagrangian,
        constraints,
        forces,
        auxiliary,
        source: source.proved.model,
    })
}

fn ids(model: &Model) -> Vec<CoordId> {
    model.coordinates.ids().collect()
}

/// The names and values of quasi-velocities, and the change to their frame.
type Frame = (Vec<String>, Vec<ExprId>, ChangeOfBasis);

/// The frame as it is given.
fn frame(source: &mut Side, declared: &QuotientDecl) -> Result<Frame, Vec<Violation>> {
    let rank = source.velocities().len();
    let velocity = source.proved.system.algebroid.velocity(&mut source.proved.model.graph);
    let names = source.proved.model.sections.iter().map(|section| section.name.clone());
    let located = velocity.into_iter().map(|value| Located { value, origin: declared.origin });
    let given = declared.velocities.clone().unwrap_or_else(|| names.zip(located).collect());
    let blame = |what: String, evidence: String| Violation {
        law: Law::Frame,
        origin: declared.origin,
        what,
        evidence,
        way_out: "give as many quasi-velocities as there are sections, linearly independent".into(),
    };
    if given.len() != rank {
        let what = format!("{} quasi-velocities for {rank} sections", given.len());
        return Err(vec![blame(what, format!("`{}` has {rank} sections", source.name()))]);
    }
    let (mut names, mut values, mut rows, mut violations) =
        (Vec::new(), Vec::new(), Matrix::new(), Vec::new());
    for (name, located) in given {
        let value = source.proved.motion.rates.apply(&mut source.proved.model.graph, located.value);
        match linear(source, Located { value, ..located }, &name) {
            Ok(row) => rows.push(row),
            Err(violation) => violations.push(violation),
        }
        names.push(name);
        values.push(value);
    }
    if !violations.is_empty() {
        return Err(violations);
    }
    let regular = source.rank_over_base(&rows) == Ok(rank);
    let graph = source.graph();
    let identity = graph.identity(rank);
    let inverse = if regular { graph.solve_linear(&rows, &identity) } else { None };
    let Some(inverse) = inverse else {
        let texts: Vec<String> = values.iter().map(|value| shown(source.graph(), *value)).collect();
        return Err(vec![blame("the quasi-velocities are no frame".into(), texts.join("; "))]);
    };
    let mut sections = Matrix::new();
    for row in inverse.values {
        sections.push(row.into_iter().map(|entry| source.graph().simplify(entry)).collect());
    }
    Ok((names, values, ChangeOfBasis { sections, velocities: rows }))
}

/// A frame that commutes with the declared symmetries, where no frame is given and there are symmetries
/// that move dropped coordinates alone.
///
/// # Errors
/// Why none was found.
fn invariant_frame(source: &mut Side, declared: &QuotientDecl) -> Result<Option<Frame>, String> {
    let within = |id| declared.dropped.contains(&id);
    let sections = compile::declared(&mut source.proved, within);
    if sections.is_empty() || declared.velocities.is_some() {
        return Ok(None);
    }
    let generators = with_translations(&mut source.proved, &sections, within);
    let Proved { model, system, base, constraints, .. } = &mut source.proved;
    let (graph, algebroid) = (&mut model.graph, &system.algebroid);
    let moved = moved(graph, &algebroid.anchor, &generators);
    let group: Vec<SymbolId> = moved.iter().map(|id| algebroid.anchor.coordinates[id.index()]).collect();
    let hints: Vec<ExprId> = constraints.residuals.iter().copied().chain([system.lagrangian]).collect();
    let frame = InvariantFrame::of(graph, algebroid, base, &generators, &group, &hints)?;
    let names = frame_names(model, &frame);
    let graph = &mut model.graph;
    let velocity = algebroid.velocity(graph);
    let values = graph.image(&frame.change.velocities, &velocity);
    Ok(Some((names, values, frame.change)))
}

/// Υ'_k = Ψ^α_k Υ_α.
fn forces(
    invariant: &mut Invariant<'_>,
    change: &ChangeOfBasis,
    in_frame: &mut Substitution,
    names: &[String],
) -> Vec<(usize, ExprId)> {
    let forces = invariant.side.proved.system.forces.clone();
    if let Some(what) = opaque(invariant.side) {
        let way_out = "let the force be an input, write it as a formula, or use `morphism!`";
        invariant.refuse("the forces cannot be rewritten".into(), what, way_out);
        return Vec::new();
    }
    let mut found = Vec::new();
    for (k, column) in Graph::transposed(&change.sections).iter().enumerate() {
        let graph = invariant.side.graph();
        let force = graph.inner_product(column, &forces);
        let force = in_frame.apply(graph, force);
        let force = invariant.checked(force, &format!("the force along `{}`", names[k]));
        if !invariant.side.graph().is_literal_zero(force) {
            found.push((k, force));
        }
    }
    found
}

/// The rates of the auxiliary states in the frame.
fn auxiliary(invariant: &mut Invariant<'_>, in_frame: &mut Substitution) -> Vec<(String, ExprId)> {
    let rates = invariant.side.rates.clone();
    let names: Vec<String> =
        invariant.side.proved.model.auxiliary.iter().map(|state| state.name.clone()).collect();
    let model = &invariant.side.proved.model;
    let symbols = model.graph.symbols_in(&rates);
    if let Some(call) = model.calls.iter().find(|call| symbols.contains(&call.symbol)) {
        let evidence = format!("it calls `self.{}`, which is no formula", call.method);
        let what = "the rate of an auxiliary state cannot be rewritten".to_owned();
        invariant.refuse(what, evidence, "write it as a formula, or use an input in its place");
        return Vec::new();
    }
    let mut found = Vec::with_capacity(names.len());
    for (name, rate) in names.into_iter().zip(rates) {
        let rate = in_frame.apply(invariant.side.graph(), rate);
        let rate = invariant.checked(rate, &format!("the rate of `{name}`"));
        found.push((name, rate));
    }
    found
}

/// Why the forces are no formulas in the frame.
fn opaque(side: &Side) -> Option<String> {
    let model = &side.proved.model;
    let values: Vec<ExprId> = model.forces.iter().map(|force| force.value).collect();
    let symbols = model.graph.symbols_in(&values);
    if let Some(call) = model.calls.iter().find(|call| symbols.contains(&call.symbol)) {
        return Some(format!("a force calls `self.{}`, which is no formula", call.method));
    }
    let (direction, _) = side.proved.system.forces_on_distribution.first()?;
    Some(format!("the force along `{}` is known on D only", model.graph.symbols()[*direction]))
}

/// The position constraints, whose functions have to be invariant themselves.
fn positions(invariant: &mut Invariant<'_>) -> Vec<Equation> {
    let Proved { model, positions, .. } = &invariant.side.proved;
    let all: Vec<_> = model.positions.iter().chain(&positions.redundant).cloned().collect();
    let zero = invariant.side.graph().zero();
    let mut found = Vec::new();
    for PositionDecl { label, value, .. } in all {
        let name =
            label.as_ref().map_or_else(|| "a position constraint".to_owned(), |label| format!("`{label}`"));
        found.push(Equation { left: invariant.checked(value, &name), right: zero, label });
    }
    found
}

/// The identities in which no dropped coordinate occurs; the others say how those are embedded.
fn identities(invariant: &mut Invariant<'_>) -> Vec<ExprId> {
    let mut identities: Vec<ExprId> =
        invariant.side.proved.model.identities.iter().map(|identity| identity.value).collect();
    let dropped = invariant.dropped.clone();
    let mut found = Vec::new();
    // embedded together with what is dropped, the rest has identities of its own, as a row of a rotation matrix
    let Proved { model, base, .. } = &mut invariant.side.proved;
    if let Some(fibres) = Fibres::of(&model.graph, base, &dropped)
        && let Some(implied) = fibres.identities(&mut model.graph)
    {
        let left = fibres.symbols();
        for identity in implied {
            found.push(invariant.checked(identity, "an identity"));
        }
        identities.retain(|identity| !invariant.side.graph().depends_on(*identity, &left));
    }
    for identity in identities {
        if !invariant.side.graph().depends_on(identity, &dropped) {
            found.push(invariant.checked(identity, "an identity"));
        }
    }
    found
}

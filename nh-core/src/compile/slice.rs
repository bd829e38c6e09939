//! What does not flow into what is tracked is left out.

use std::collections::BTreeSet;

use super::kept_outputs::KeptOutputs;
use super::proved::fence;
use crate::algebra::Graph;
use crate::functions::{Function, OUTPUTS, RESIDUAL, Sliced, TABLE};
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{Definition, Procedure};
use crate::model::{Formulation, Request, TrackedItem};
use crate::report::latex;
use crate::system::System;
use crate::violation::{Law, Violation};

/// The system with the variables that flow into the tracked ones, and the functions that depend on
/// no others; the whole system if nothing is tracked.
///
/// # Errors
/// Where something is asked for that depends on what is left out.
pub(super) fn slice(mut system: System) -> Result<System, Vec<Violation>> {
    let Some(tracked) = system.model.tracked.clone() else { return Ok(system) };
    let whole = system.state();
    let mut refused = Vec::new();
    let mut wanted = BTreeSet::new();
    for (item, origin) in &tracked {
        match item {
            TrackedItem::Variable(symbol) if whole.contains(symbol) => _ = wanted.insert(*symbol),
            TrackedItem::Variable(symbol) => refused.push(not_in_the_state(&system, *symbol, *origin)),
            TrackedItem::Output(index) => {
                if let Some(observables) = system.functions.get(&OUTPUTS) {
                    let value = observables.outputs.get(*index).copied();
                    wanted.extend(observables.depends_on(&system.model.graph, value.as_slice()));
                }
            }
        }
    }
    let needed = closure(&system, wanted);
    let state = |symbol: &SymbolId| whole.contains(symbol);
    let missing = |procedure: &Procedure, outputs: &[ExprId]| -> Vec<SymbolId> {
        let all = procedure.depends_on(&system.model.graph, outputs).into_iter();
        all.filter(|symbol| state(symbol) && !needed.contains(symbol)).collect()
    };
    let kept_outputs = KeptOutputs::of(&system, |symbol| state(symbol) && !needed.contains(symbol));
    refused.extend(of_outputs(&system, &kept_outputs, (&whole, &needed)));
    // what depends on something that is left out goes, or is refused where it is asked for
    let mut without: Vec<&'static str> = Vec::new();
    for Function { signature, procedure } in system.functions.iter() {
        let Sliced::Named(name) = signature.sliced else { continue };
        let missing = missing(procedure, &procedure.outputs);
        if missing.is_empty() || without.contains(&name) {
            continue;
        }
        without.push(name);
        let is_asked = |(asked, _): &&(Request, Origin)| Some(*asked) == signature.request();
        if let Some((_, origin)) = system.model.requests.iter().find(is_asked) {
            refused.push(left_out(&system, name, &missing, *origin));
        }
    }
    let dropped: Vec<SymbolId> = whole.iter().copied().filter(|symbol| !needed.contains(symbol)).collect();
    for (request, origin) in &system.model.requests {
        if !dropped.is_empty() && needs_all(*request) {
            refused.push(left_out(&system, "what is asked for here", &dropped, *origin));
        }
    }
    fence(refused)?;
    note(&mut system, &needed, &without, &kept_outputs);
    let is_there = |function: &Function| !matches!(function.signature.sliced, Sliced::Named(name) if without.contains(&name));
    system.functions.retain(is_there);
    kept_outputs.restrict(&mut system, &whole, &needed);
    restrict(&mut system, &whole, &needed);
    Ok(system)
}

/// What is asked for of the outputs, and cannot be computed for those that are kept.
fn of_outputs(
    system: &System,
    kept: &KeptOutputs,
    (whole, needed): (&[SymbolId], &BTreeSet<SymbolId>),
) -> Vec<Violation> {
    let is_in_state = |column: usize| whole.get(column).is_none_or(|symbol| needed.contains(symbol));
    let mut refused = Vec::new();
    for (request, origin) in &system.model.requests {
        let of_request = |function: &&Function| {
            function.signature.sliced == Sliced::Outputs && function.signature.request() == Some(*request)
        };
        let functions: Vec<&Function> = system.functions.iter().filter(of_request).collect();
        if functions.is_empty() {
            continue;
        }
        if kept.are_none() {
            let lines = kept.dropped(&system.model.graph, &system.model.outputs);
            refused.push(Violation {
                law: Law::Tracking,
                origin: *origin,
                what: "what is asked for here is about outputs, and `track` leaves none".into(),
                evidence: format!("left out: {}", lines.join("; ")),
                way_out: "track an output, or what it depends on; or do not ask for this".into(),
            });
            break;
        }
        let mut missing = BTreeSet::new();
        for function in functions {
            let part = kept.part(function, whole.len(), is_in_state);
            let found = part.depends_on(&system.model.graph, &part.outputs).into_iter();
            missing.extend(found.filter(|symbol| whole.contains(symbol) && !needed.contains(symbol)));
        }
        if !missing.is_empty() {
            let missing: Vec<SymbolId> = missing.into_iter().collect();
            refused.push(left_out(system, "what is asked for here", &missing, *origin));
        }
    }
    refused
}

/// Whether something is derived for the whole state only.
fn needs_all(request: Request) -> bool {
    let mut lines = TABLE.iter().filter(|line| line.request() == Some(request)).peekable();
    match request {
        Request::Jacobian
        | Request::SparseJacobian
        | Request::JacobianProduct
        | Request::AdjointProduct
        | Request::Taylor
        | Request::ReturnJacobian
        | Request::Prepared
        | Request::Explain
        | Request::Latex
        | Request::C => false,
        _ => lines.peek().is_none() || lines.any(|line| line.sliced == Sliced::Whole),
    }
}

/// The state variables that the wanted ones depend on, however indirectly.
fn closure(system: &System, wanted: BTreeSet<SymbolId>) -> BTreeSet<SymbolId> {
    let graph = &system.model.graph;
    let state = system.state();
    let mut needed: BTreeSet<SymbolId> = wanted.into_iter().filter(|symbol| state.contains(symbol)).collect();
    // the way back to the constraint manifold takes all velocities
    if system.formulation == Formulation::Projected {
        needed.extend(&system.state_velocities);
        let functions = [system.functions.get(&RESIDUAL), system.projection.as_ref().map(|p| &p.step)];
        for function in functions.into_iter().flatten() {
            needed.extend(function.depends_on(graph, &function.outputs).iter().filter(|s| state.contains(s)));
        }
    }
    // the way back to position constraints takes what these depend on
    if let Some(positions) = &system.positions {
        for procedure in [&positions.residual, &positions.step].into_iter().chain(&positions.velocities) {
            let found = procedure.depends_on(graph, &procedure.outputs);
            needed.extend(found.into_iter().filter(|symbol| state.contains(symbol)));
        }
    }
    // a jump changes all velocities
    for impact in &system.impacts {
        needed.extend(&system.state_velocities);
        for procedure in [&impact.gaps, &impact.terms, &impact.jump] {
            let found = procedure.depends_on(graph, &procedure.outputs);
            needed.extend(found.into_iter().filter(|symbol| state.contains(symbol)));
        }
    }
    // the way back to an embedded base takes all of its coordinates
    let embedded: BTreeSet<SymbolId> = match &system.embedding {
        None => BTreeSet::new(),
        Some(embedding) => embedding.residual.depends_on(graph, &embedding.residual.outputs),
    };
    let mut open: Vec<SymbolId> = needed.iter().copied().collect();
    while let Some(symbol) = open.pop() {
        let position = state.iter().position(|other| *other == symbol);
        let rate = position.and_then(|position| system.derivative.outputs.get(position).copied());
        let mut more = system.derivative.depends_on(graph, rate.as_slice());
        if embedded.contains(&symbol) {
            more.extend(&embedded);
        }
        open.extend(more.into_iter().filter(|other| state.contains(other) && needed.insert(*other)));
    }
    needed
}

/// Takes the other variables out of the state and of the functions.
pub(super) fn restrict(system: &mut System, whole: &[SymbolId], needed: &BTreeSet<SymbolId>) {
    let is_kept = |index: usize| whole.get(index).is_none_or(|symbol| needed.contains(symbol));
    let rows = |outputs: &[ExprId]| -> Vec<ExprId> {
        let rows = outputs.iter().enumerate().filter(|(row, _)| is_kept(*row));
        rows.map(|(_, output)| *output).collect()
    };
    system.derivative.outputs = rows(&system.derivative.outputs);
    for function in system.functions.iter_mut().filter(|f| f.signature.sliced == Sliced::Rows) {
        function.keep_rows(whole.len(), is_kept);
    }
    let width = whole.len() + system.model.inputs.len();
    if let Some(linearized) = &mut system.linearized {
        let (rates, matrix) = linearized.outputs.split_at(whole.len().min(linearized.outputs.len()));
        let kept = matrix.chunks(width.max(1)).enumerate().filter(|(row, _)| is_kept(*row));
        linearized.outputs = rows(rates).into_iter().chain(kept.flat_map(|(_, row)| rows(row))).collect();
    }
    if let Some(invariants) = &mut system.phase_space.invariants {
        let rows_of = invariants.gradients.outputs.chunks(whole.len().max(1));
        invariants.gradients.outputs = rows_of.flat_map(&rows).collect();
    }
    if let Some(positions) = &mut system.positions {
        let coordinates = positions.step.outputs.len();
        positions.step.outputs = rows(&positions.step.outputs[..coordinates]);
        if let Some(slopes) = &mut positions.slopes {
            let matrix = &slopes.positions.outputs;
            let kept = matrix.chunks(whole.len().max(1)).enumerate().filter(|(row, _)| is_kept(*row));
            slopes.positions.outputs = kept.flat_map(|(_, row)| rows(row)).collect();
            if let Some(by) = &mut slopes.velocities {
                let started = system.projection.as_ref().map_or(0, |projection| projection.start.len());
                let width = whole.len() + started;
                let is_start = |column: &usize| (coordinates..coordinates + started).contains(column);
                let place = |column: usize| if column < coordinates { column } else { column - started };
                let is_here = |column: &usize| is_start(column) || is_kept(place(*column));
                let columns: Vec<usize> = (0..width).filter(is_here).collect();
                let entry = |row: &[ExprId], column: &usize| row.get(*column).copied();
                by.outputs = by
                    .outputs
                    .chunks(width.max(1))
                    .flat_map(|row| columns.iter().filter_map(move |column| entry(row, column)))
                    .collect();
            }
        }
        positions.assembly.restrict(is_kept, |symbol| needed.contains(&symbol));
    }
    let keeps_base = match &mut system.embedding {
        None => false,
        Some(embedding) => {
            let coordinates = embedding.step.outputs.len();
            embedding.step.outputs = rows(&embedding.step.outputs[..coordinates]);
            let graph = &system.model.graph;
            embedding
                .residual
                .depends_on(graph, &embedding.residual.outputs)
                .iter()
                .any(|symbol| needed.contains(symbol))
        }
    };
    system.embedding = system.embedding.take().filter(|_| keeps_base);
    system.state_coordinates.retain(|symbol| needed.contains(symbol));
    system.state_velocities.retain(|symbol| needed.contains(symbol));
    system.state_auxiliary.retain(|symbol| needed.contains(symbol));
}

/// Says in the report and the documentation what is left out.
fn note(system: &mut System, needed: &BTreeSet<SymbolId>, without: &[&str], outputs: &KeptOutputs) {
    let state = system.state();
    let (kept, dropped): (Vec<SymbolId>, Vec<SymbolId>) =
        state.into_iter().partition(|symbol| needed.contains(symbol));
    let mut left_out = names(system, &dropped);
    if left_out.is_empty() && without.is_empty() {
        return;
    }
    left_out.extend(without.iter().map(|function| (*function).to_owned()));
    let outputs = outputs.dropped(&system.model.graph, &system.model.outputs);
    let left_out = [vec![left_out.join(", ")], outputs].concat().join("; ");
    let kept = names(system, &kept).join(", ");
    system.report.extend(["\nTracked variables\n  ", &kept, "\n  left out: ", &left_out, "\n"]);
    system.equations.extend([String::new(), format!("left out: {left_out}")]);
    if let Some(sections) = &mut system.latex {
        sections.push_str(&latex::tracked(&kept, &left_out));
    }
}

fn names(system: &System, symbols: &[SymbolId]) -> Vec<String> {
    symbols.iter().map(|symbol| system.model.graph.symbols()[*symbol].clone()).collect()
}

/// `what` needs variables that are left out.
fn left_out(system: &System, what: &str, missing: &[SymbolId], origin: Origin) -> Violation {
    let missing: Vec<String> = names(system, missing).iter().map(|name| format!("`{name}`")).collect();
    let missing = missing.join(", ");
    Violation {
        law: Law::Tracking,
        origin,
        what: format!("{what} cannot be computed without {missing}, which `track` leaves out"),
        evidence: String::new(),
        way_out: format!("track {missing} too, or leave {what} out"),
    }
}

fn not_in_the_state(system: &System, symbol: SymbolId, origin: Origin) -> Violation {
    let name = &system.model.graph.symbols()[symbol];
    Violation {
        law: Law::Tracking,
        origin,
        what: format!("`{name}` is not in the state"),
        evidence: "the constraints give it from the velocities that are".into(),
        way_out: format!("add `outputs {{ … = {name}; }}` and track that"),
    }
}

impl Procedure {
    /// The symbols that some outputs depend on, through the intermediate results.
    pub(crate) fn depends_on(&self, graph: &Graph, outputs: &[ExprId]) -> BTreeSet<SymbolId> {
        let mut found: BTreeSet<SymbolId> = graph.symbols_in(outputs).into_iter().collect();
        // later definitions are in terms of earlier ones
        for definition in self.definitions.iter().rev() {
            let (defined, operands) = match definition {
                Definition::Value { symbol, value } => (vec![*symbol], vec![*value]),
                Definition::Call { symbol, arguments, .. } => (vec![*symbol], arguments.clone()),
                Definition::Solve { unknowns, matrix, right } => {
                    (unknowns.clone(), matrix.iter().flatten().chain(right).copied().collect())
                }
            };
            if defined.iter().any(|symbol| found.contains(symbol)) {
                found.extend(graph.symbols_in(&operands));
            }
        }
        found
    }

    /// Other outputs, with the intermediate results that they depend on.
    pub(crate) fn as_far_as(&self, graph: &Graph, outputs: &[ExprId]) -> Self {
        let needed = self.depends_on(graph, outputs);
        let mut part = self.with_outputs(outputs.to_vec());
        part.definitions.retain(|definition| match definition {
            Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => needed.contains(symbol),
            Definition::Solve { unknowns, .. } => unknowns.iter().any(|unknown| needed.contains(unknown)),
        });
        part
    }
}

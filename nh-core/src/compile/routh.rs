//! Routh reduction: conserved momenta become parameters, and velocities with cyclic coordinates leave
//! the state (CM section 5).

use std::collections::BTreeSet;

use super::proved::{Level, Symmetries};
use crate::check::Symmetry;
use crate::check::evidence::shown;
use crate::functions::QUADRATURES;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::LagrangianSystem;
use crate::model::{Model, RouthDecl};
use crate::system::System;
use crate::violation::{Law, Violation};

/// The levels that are declared.
///
/// # Errors
/// Sections outside D, momenta that are not conserved, levels that are not constant.
pub(super) fn levels(model: &mut Model, symmetries: &Symmetries) -> Result<Vec<Level>, Vec<Violation>> {
    let mut levels: Vec<Level> = Vec::new();
    let mut violations = Vec::new();
    for declared in model.routh.clone() {
        match level(model, symmetries, &declared) {
            Ok(level) => levels.push(level),
            Err(violation) => violations.push(violation),
        }
    }
    if violations.is_empty() { Ok(levels) } else { Err(violations) }
}

fn level(model: &mut Model, symmetries: &Symmetries, declared: &RouthDecl) -> Result<Level, Violation> {
    let RouthDecl { symmetry: name, level, origin } = declared.clone();
    let blame = |what: String, evidence: String, way_out: &str| Violation {
        law: Law::Symmetry,
        origin,
        what,
        evidence,
        way_out: way_out.into(),
    };
    let found = symmetries.found.iter().map(|(_, symmetry)| symmetry);
    let Some(symmetry) = symmetries.declared.iter().chain(found).find(|symmetry| symmetry.name == name)
    else {
        let evidence = not_cyclic(model, &name);
        return Err(blame(
            format!("`{name}` is not cyclic"),
            evidence,
            "Routh reduction is by a symmetry in D: name a label of `symmetries`, or a cyclic coordinate",
        ));
    };
    if let Some(stranger) = not_constant(model, level) {
        return Err(blame(
            format!("the level of `{name}` is not constant"),
            format!("it depends on `{stranger}`"),
            "a momentum has a constant value along a motion: a field of the struct, or a number",
        ));
    }
    if !symmetry.is_conserved {
        return Err(not_conserved(model, symmetry, blame));
    }
    let graph = &mut model.graph;
    let residual = graph.formula(symmetry.momentum.value - level);
    Ok(Level { name, section: symmetry.section.clone(), value: level, residual, origin })
}

fn not_constant(model: &Model, level: ExprId) -> Option<String> {
    let is_parameter = |symbol: &SymbolId| model.parameters.iter().any(|p| p.symbol == *symbol);
    let stranger = model.graph.symbols_in(&[level]).into_iter().find(|symbol| !is_parameter(symbol))?;
    Some(model.graph.symbols()[stranger].clone())
}

/// Why a coordinate has no conserved momentum.
fn not_cyclic(model: &mut Model, name: &str) -> String {
    let coordinate = model.coordinates.iter().find(|coordinate| coordinate.name == name);
    let Some(symbol) = coordinate.map(|coordinate| coordinate.symbol) else { return String::new() };
    let graph = &mut model.graph;
    let change = graph.partial(model.lagrangian.value, symbol);
    let change = graph.simplify(change);
    if graph.is_literal_zero(change) {
        return "the anchor, the constraints or the forces depend on it, or the anchor does not tell which section moves it \
                alone"
            .into();
    }
    format!("the Lagrangian depends on it, at the rate {}", shown(graph, change))
}

fn not_conserved(
    model: &mut Model,
    symmetry: &Symmetry,
    blame: impl Fn(String, String, &str) -> Violation,
) -> Violation {
    let name = &symmetry.name;
    if let Some(component) = symmetry.outside {
        let component = shown(&model.graph, component);
        return blame(
            format!("`{name}` is not horizontal: its section is not in D"),
            format!("the constraints are {component} along it, so that their forces change its momentum"),
            "reduce by a symmetry in D; to leave out variables that nothing depends on, use `track`",
        );
    }
    let graph = &mut model.graph;
    let rate = symmetry.momentum.rate(graph);
    let rate = graph.simplify(rate);
    blame(
        format!("the momentum of `{name}` is not conserved"),
        format!("its rate is {}", shown(graph, rate)),
        "Routh reduction is by momenta that are conserved: correct the section, or leave it out",
    )
}

/// For each level a cyclic coordinate that its section moves: that of its own name first.
pub(super) fn quadratures(
    model: &mut Model,
    system: &LagrangianSystem,
    symmetries: &Symmetries,
    levels: &[Level],
) -> Vec<SymbolId> {
    let graph = &mut model.graph;
    let mut found: Vec<SymbolId> = Vec::new();
    for level in levels {
        let field = system.algebroid.anchor.vector_field(graph, &level.section);
        let mut candidates = symmetries.cyclic.clone();
        candidates.sort_by_key(|id| model.coordinates[*id].name != level.name);
        let moved = candidates.into_iter().find(|id| {
            let is_new = !found.contains(&model.coordinates[*id].symbol);
            is_new && graph.zero_test(field[id.index()]).is_nonzero()
        });
        found.extend(moved.map(|id| model.coordinates[id].symbol));
    }
    found
}

/// The system without those of the coordinates that no function of it depends on; with the rates of
/// these, for their reconstruction. What is tracked is left to the user.
pub(super) fn without(mut system: System, coordinates: &[SymbolId]) -> System {
    if system.model.tracked.is_some() {
        return system;
    }
    let whole = system.state();
    let gone: Vec<SymbolId> =
        coordinates.iter().copied().filter(|symbol| !system.depends_on(*symbol)).collect();
    if gone.is_empty() {
        return system;
    }
    let rows = whole.iter().zip(&system.derivative.outputs);
    let rates = rows.filter(|(symbol, _)| gone.contains(symbol)).map(|(_, rate)| *rate).collect();
    let rates = system.derivative.with_outputs(rates);
    let (left, kept): (Vec<SymbolId>, Vec<SymbolId>) =
        whole.iter().copied().partition(|symbol| gone.contains(symbol));
    let kept: BTreeSet<SymbolId> = kept.into_iter().collect();
    super::slice::restrict(&mut system, &whole, &kept);
    let names: Vec<&str> = left.iter().map(|symbol| system.model.graph.symbols()[*symbol].as_str()).collect();
    let line = format!("left to quadratures: {}; `quadratures` gives the rates", names.join(", "));
    system.report.extend(["\nCoordinates\n  ", &line, "\n"]);
    system.equations.extend([String::new(), line]);
    system.functions.add(&QUADRATURES, rates);
    system.quadratures = left;
    system
}

impl System {
    /// Whether anything that the system computes depends on a symbol.
    fn depends_on(&self, symbol: SymbolId) -> bool {
        let projection = self.projection.iter().map(|projection| &projection.step);
        let embedded = self.embedding.iter().map(|embedding| &embedding.residual);
        let invariants = self.phase_space.invariants.iter().flat_map(|form| [&form.values, &form.gradients]);
        let positions = self.positions.iter().flat_map(|positions| {
            [&positions.residual, &positions.step].into_iter().chain(&positions.velocities)
        });
        let others = projection.chain(embedded).chain(positions).chain(invariants).chain(&self.linearized);
        self.functions.depend_on(&self.model.graph, symbol)
            || std::iter::once(&self.derivative).chain(others).any(|procedure| {
                procedure.depends_on(&self.model.graph, &procedure.outputs).contains(&symbol)
            })
    }
}

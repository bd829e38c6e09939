//! A mode of a larger system: the same machine with more constraints, perhaps in fewer coordinates.
//!
//! Where Φ: E → E' has a way back, Φ(D) ⊂ D', L = L'∘Φ and the forces are related, the motions of the source are those of
//! the target under the further constraints, by the same principle of Lagrange and d'Alembert. They are no motions of the
//! target, since D' is larger; between them lie impacts and changes of the mode.

use super::assuming;
use super::bundle_map::BundleMap;
use super::maps;
use super::side::Side;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::model::Model;
use crate::violation::Violation;

/// A proved inclusion: the functions that it consists of, over the graph of the source.
#[derive(Clone, Debug)]
pub struct Inclusion {
    /// The source; its graph holds every expression.
    pub source: Model,
    /// The state of the source.
    pub state: Vec<SymbolId>,
    /// The state of the target, in its graph.
    pub target_state: Vec<SymbolId>,
    /// Outputs: the parameters of the target.
    pub parameters: Procedure,
    /// Outputs: the state of the target.
    pub included: Procedure,
    /// For each variable of the source's state, the variable of the target's that is the same.
    pub places: Vec<usize>,
    /// Whether the source has equations for its state, to which states of the target are returned.
    pub has_equations: bool,
    /// What was proved, as text.
    pub report: String,
}

/// Where each variable of the source's state stands in that of the target; nothing if one does not, or if the source
/// has as many velocities as the target.
pub(super) fn places(source: &mut Side, target: &Side, map: &BundleMap) -> Option<Vec<usize>> {
    let is_whole = |side: &Side| side.proved.model.tracked.is_none();
    if !(is_whole(source) && is_whole(target)) || source.rank() >= target.rank() {
        return None;
    }
    same_variables(source, target, map).into_iter().collect()
}

/// A variable of the source's state that is none of the target's, where the source has fewer velocities, as a mode has.
pub(super) fn stranger(source: &mut Side, target: &Side, map: &BundleMap) -> Option<String> {
    if source.rank() >= target.rank() {
        return None;
    }
    let index = same_variables(source, target, map).iter().position(Option::is_none)?;
    let symbol = source.state[index];
    Some(source.graph().symbols()[symbol].clone())
}

/// For each variable of the source's state, the variable of the target's that is the same.
fn same_variables(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Option<usize>> {
    let images = images(source, target, map);
    let symbols: Vec<Option<SymbolId>> =
        images.iter().map(|image| source.graph().as_symbol(*image)).collect();
    source.state.clone().iter().map(|own| symbols.iter().position(|known| *known == Some(*own))).collect()
}

/// The state of the target in that of the source.
fn images(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<ExprId> {
    let images = maps::reduced_state(source, target, map);
    let mut found = Vec::new();
    for (_, value) in images {
        let value = assuming(source, value);
        found.push(maps::in_state(source, value));
    }
    found
}

/// Derives the functions.
///
/// # Errors
/// Where the state of the target depends on what the source does not have.
pub(super) fn functions(
    mut source: Side,
    target: &Side,
    map: &BundleMap,
    places: Vec<usize>,
    undecided: &[String],
) -> Result<Inclusion, Violation> {
    let parameters = map.parameters.iter().map(|located| located.value).collect();
    let included = images(&mut source, target, map);
    maps::all_tracked(&source, map, &included, &[])?;
    let report = report(&mut source, target, &included, undecided);
    let has_equations = source.distribution.is_none() || !source.proved.model.positions.is_empty();
    Ok(Inclusion {
        has_equations,
        state: source.state.clone(),
        target_state: target.state.clone(),
        parameters: Procedure::of(parameters),
        included: Procedure::of(included),
        places,
        report,
        source: source.proved.model,
    })
}

/// What was proved, as text.
fn report(source: &mut Side, target: &Side, included: &[ExprId], undecided: &[String]) -> String {
    let (from, to) = (source.name(), target.name());
    let mut lines = vec![
        format!("{from} -> {to}"),
        String::new(),
        format!(
            "A mode: {from} is {to} with further constraints. A morphism of {}, (13) and (14), with a way back;",
            maps::algebroids(source, target)
        ),
        "L = L' after the map, D goes into D', the forces are related.".to_owned(),
        String::new(),
    ];
    let graph = &source.proved.model.graph;
    for (symbol, value) in target.state.iter().zip(included) {
        let name = &target.proved.model.graph.symbols()[*symbol];
        lines.push(format!("  {name} = {}", crate::check::evidence::shown(graph, *value)));
    }
    lines.push(String::new());
    lines.extend(undecided.iter().cloned().chain((!undecided.is_empty()).then(String::new)));
    lines.join("\n")
}

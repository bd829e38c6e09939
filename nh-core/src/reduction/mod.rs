//! Reductions: maps between two declared systems that carry the motion of one to that of the other,
//! MATHEMATICS.md section 6, CLMM 2.3 and Theorems 4.6 and 7.8.
//!
//! A bundle map Φ: E → E' over φ: M → M' is a reduction if it is a morphism of Lie algebroids, onto
//! on every fibre, L = L'∘Φ, Φ(D) = D', and the forces are related. Everything is proved; what fails
//! is a [`Violation`] with its defect, in the symbols of the first system.

mod assumed;
mod auxiliary_rates;
mod bundle_map;
mod dynamics;
mod forces;
mod inclusion;
mod invariance;
mod laws;
mod maps;
mod quotient;
mod side;

use crate::check::evidence::listed;
use crate::check::{domain, domain_of, not_smooth};
use crate::compile::Proved;
use crate::id::{CoordId, ExprId, InputId, Origin, ParamId, SymbolId};
use crate::limits::{Subject, about};
use crate::mechanics::Procedure;
use crate::model::{Located, Model};
use crate::violation::{Law, Violation};

pub use inclusion::Inclusion;
pub use quotient::{Equation, Quotient, QuotientDecl, quotient};

use bundle_map::BundleMap;
use side::Side;

/// A map between two declared systems, as it is declared: expressions of the source's graph for the
/// symbols of the target.
#[derive(Clone, Debug)]
pub struct MorphismDecl {
    /// The whole of it: blamed where no line is at fault.
    pub origin: Origin,
    /// The parameters of the target.
    pub parameters: Vec<(ParamId, Located)>,
    /// φ^i: the coordinates of the target.
    pub coordinates: Vec<(CoordId, Located)>,
    /// Φ y: the velocities of the target, by their symbols in its graph; may be left out where E' = TM'.
    pub velocities: Vec<(SymbolId, Located)>,
    /// The inputs of the target; inputs and the state of the source may occur.
    pub inputs: Vec<(InputId, Located)>,
}

/// A proved reduction: the functions that it consists of, over the graph of the source.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// The source; its graph holds every expression.
    pub source: Model,
    /// The state of the source.
    pub state: Vec<SymbolId>,
    /// The state of the target, in its graph.
    pub target_state: Vec<SymbolId>,
    /// Outputs: the parameters of the target.
    pub parameters: Procedure,
    /// Outputs: the state of the target.
    pub reduced: Procedure,
    /// Outputs: the inputs of the target.
    pub inputs: Procedure,
    /// The way back, where the velocities of the target determine those of the source.
    pub reconstruction: Option<Reconstruction>,
    /// What was proved, as text.
    pub report: String,
}

/// The way back from the state of the target and the coordinates that the reduction drops.
#[derive(Clone, Debug)]
pub struct Reconstruction {
    /// The coordinates of the source that are not coordinates of the target.
    pub dropped: Vec<SymbolId>,
    /// What stands for the state of the target.
    pub reduced: Vec<SymbolId>,
    /// Outputs: the rates of the dropped coordinates.
    pub rates: Procedure,
    /// Outputs: the state of the source.
    pub state: Procedure,
}

/// What a declared map was proved to be.
#[derive(Clone, Debug)]
pub enum Related {
    /// Motions of the source go to motions of the target.
    Reduction(Box<Reduction>),
    /// The source is the target with further constraints.
    Inclusion(Box<Inclusion>),
}

/// Why there is no reduction.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// One of the systems is ill-posed, as its own declaration says.
    IllPosed,
    /// Laws that the map breaks.
    Broken(Vec<Violation>),
}

/// Proves that a declared map is a reduction, or the inclusion of a mode, and derives its functions.
///
/// # Errors
/// The laws that the map breaks, each with its defect.
pub fn reduce(source: Model, target: Model, declared: &MorphismDecl) -> Result<Related, Refusal> {
    let mut source = Side::of(source)?;
    let target = Side::of(target)?;
    about(Subject::Map);
    fence([&source, &target].into_iter().filter_map(|side| on_level(side, declared)).collect())?;
    let sides = [&source, &target].into_iter();
    fence(sides.filter_map(|side| on_moving_positions(side, declared.origin)).collect())?;
    // 1. Φ: parameters, base and fibres, and the target pulled back by it
    let map = BundleMap::of(&mut source, &target, declared).map_err(Refusal::Broken)?;
    let lines = map.coordinates.iter().map(|line| ("coordinate", *line));
    let lines: Vec<_> = lines.chain(map.velocity.iter().map(|line| ("velocity", *line))).collect();
    fence(rough(&mut source, lines))?;
    let (broken, mut remarks) = assumed::assumed(&mut source, &target, &map);
    fence(broken)?;
    // 2. the laws of the map, mathematics (13) and (14): onto, unless the source is a mode of the target
    let places = inclusion::places(&mut source, &target, &map);
    let broken = laws::of_the_map(&mut source, &target, &map, places.is_none());
    fence(broken)?;
    // 3. what moves is related: L, D, forces
    let broken = dynamics::related(&mut source, &target, &map, places.is_none());
    fence(broken)?;
    remarks.extend(places_of_values(&mut source, &map));
    if [&source, &target].iter().any(|side| !side.proved.model.impacts.is_empty()) {
        remarks.push("All of it between impacts, which it does not relate.".to_owned());
    }
    // 4. the functions
    let related = match places {
        Some(places) => inclusion::functions(source, &target, &map, places, &remarks)
            .map(Box::new)
            .map(Related::Inclusion),
        None => maps::functions(source, &target, &map, &remarks).map(Box::new).map(Related::Reduction),
    };
    related.map_err(|violation| Refusal::Broken(vec![violation]))
}

/// Lines of a map that are not smooth: motions do not go to motions where one has an edge, or jumps.
fn rough(source: &mut Side, lines: Vec<(&str, Located)>) -> Vec<Violation> {
    let Proved { model, facts, .. } = &mut source.proved;
    let mut found: Vec<Violation> = Vec::new();
    for (what, line) in lines {
        if found.iter().all(|violation| violation.origin != line.origin) {
            found.extend(not_smooth(model, facts, what, line.value, line.origin));
        }
    }
    found
}

/// Where alone the map has a value, as far as the motion of the source has not.
fn places_of_values(source: &mut Side, map: &BundleMap) -> Option<String> {
    let Proved { model, facts, .. } = &mut source.proved;
    let of_equations = domain(model, facts);
    let lines = map.coordinates.iter().chain(&map.velocity);
    let lines: Vec<ExprId> = lines.map(|line| line.value).collect();
    let found = domain_of(model, facts, (&lines, 1), &of_equations);
    let places: Vec<String> = found.iter().map(|condition| condition.stated(&model.graph)).collect();
    (!places.is_empty()).then(|| {
        format!("The map has a value only where {}: it relates motions that stay there.", listed(&places))
    })
}

/// A side whose positions move: its velocities are no vector bundle over them.
fn on_moving_positions(side: &Side, origin: Origin) -> Option<Violation> {
    let Proved { model, positions, .. } = &side.proved;
    let all = model.positions.iter().chain(&positions.redundant);
    let position = all.into_iter().find(|position| model.graph.depends_on(position.value, &[model.time]))?;
    let label =
        position.label.as_ref().map_or_else(|| "a position constraint".to_owned(), |l| format!("`{l}`"));
    Some(Violation {
        law: Law::Morphism,
        origin,
        what: format!("{label} of `{}` depends on the time", side.name()),
        evidence:
            "the velocities of its motions are not closed under sums, and laws of maps are linear in them"
                .into(),
        way_out: "relate systems in coordinates that need no such constraint".into(),
    })
}

/// A side by Routh reduction, whose motions are those on one level alone.
fn on_level(side: &Side, declared: &MorphismDecl) -> Option<Violation> {
    let level = side.proved.levels.first()?;
    Some(Violation {
        law: Law::Symmetry,
        origin: declared.origin,
        what: format!("`{}` is on a level of a momentum, by `routh`", side.name()),
        evidence: format!("its motions are those on which the momentum of `{}` has this value", level.name),
        way_out: "relate the whole systems, declared without `routh`".into(),
    })
}

fn fence(broken: Vec<Violation>) -> Result<(), Refusal> {
    if broken.is_empty() { Ok(()) } else { Err(Refusal::Broken(broken)) }
}

/// An expression with the facts about the source's parameters put in.
fn assuming(source: &mut Side, value: ExprId) -> ExprId {
    let facts = source.proved.facts.clone();
    source.proved.model.graph.assuming(&[value], &facts)[0]
}

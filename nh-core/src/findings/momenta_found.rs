//! Symmetries, their momenta and the levels of these, in the velocities of the state.

use crate::algebra::Substitution;
use crate::check::{Invariance, Symmetry};
use crate::compile::{Derived, Proved};
use crate::id::{ExprId, SymbolId};

/// What is said of a declared symmetry.
#[derive(Clone, Debug)]
pub(crate) struct SymmetryMomentum {
    /// Its label.
    pub(crate) name: String,
    /// Its section.
    pub(crate) section: Vec<ExprId>,
    /// What it leaves as it is.
    pub(crate) kind: &'static str,
    /// Its momentum.
    pub(crate) momentum: ExprId,
    /// The rate of the momentum by the momentum equation; `None` where forces of constraint change it.
    pub(crate) rate: Option<Rate>,
}

/// The rate of a momentum.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rate {
    /// It is conserved.
    Zero,
    /// It has this rate.
    Of(ExprId),
}

/// A momentum on its level.
#[derive(Clone, Debug)]
pub(crate) struct LevelMomentum {
    /// The label of the symmetry.
    pub(crate) name: String,
    /// The momentum.
    pub(crate) momentum: ExprId,
    /// Its level μ.
    pub(crate) value: ExprId,
}

/// The declared symmetries, one after the other.
pub(super) fn symmetries(proved: &mut Proved, derived: &Derived<'_>) -> Vec<SymmetryMomentum> {
    let mut restriction = restriction(proved, derived);
    let declared = proved.symmetries.declared.clone();
    declared.iter().map(|symmetry| found(proved, &mut restriction, symmetry)).collect()
}

/// The momenta that are conserved.
pub(super) fn conserved(proved: &mut Proved, derived: &Derived<'_>) -> Vec<(String, ExprId)> {
    let mut restriction = restriction(proved, derived);
    let symmetries = proved.symmetries.clone();
    let found = symmetries.found.iter().map(|(_, symmetry)| symmetry);
    let conserved = symmetries.declared.iter().chain(found).filter(|symmetry| symmetry.is_conserved);
    conserved
        .map(|symmetry| {
            let value = on_constraints(proved, &mut restriction, symmetry.momentum.value);
            (symmetry.name.clone(), value)
        })
        .collect()
}

/// Each level, and the Routhian R = L − v^ρ μ_ρ on the levels, mathematics (22) (CM section 5).
pub(super) fn levels(proved: &mut Proved, derived: &Derived<'_>) -> (Vec<LevelMomentum>, Option<ExprId>) {
    let graph = &mut proved.model.graph;
    let mut levels = Vec::with_capacity(proved.levels.len());
    for level in &proved.levels {
        let momentum = graph.formula(level.residual + level.value);
        let momentum = graph.simplify(momentum);
        levels.push(LevelMomentum { name: level.name.clone(), momentum, value: level.value });
    }
    let routhian = if levels.is_empty() { None } else { routhian(proved, derived) };
    (levels, routhian)
}

/// R, where each section is that of the velocity that leaves the state.
fn routhian(proved: &mut Proved, derived: &Derived<'_>) -> Option<ExprId> {
    let Derived::Adapted { distribution, kept, .. } = derived else { return None };
    let velocities = &proved.system.algebroid.velocities;
    let graph = &mut proved.model.graph;
    let mut routhian = kept.restriction(graph, velocities).apply(graph, proved.system.lagrangian);
    for level in &proved.levels {
        let is_own = |symbol: &SymbolId| {
            let position = distribution.independent.iter().position(|known| known == symbol);
            position.is_some_and(|position| distribution.section(position) == level.section)
        };
        let (_, velocity) = kept.eliminated.iter().find(|(symbol, _)| is_own(symbol))?;
        routhian = graph.formula(routhian - velocity * level.value);
    }
    Some(graph.simplify(routhian))
}

fn found(proved: &mut Proved, restriction: &mut Substitution, symmetry: &Symmetry) -> SymmetryMomentum {
    let free = proved.constraints.linear.as_ref().is_some_and(|linear| linear.annihilator.is_empty());
    let kind = kind(free, symmetry);
    let momentum = on_constraints(proved, restriction, symmetry.momentum.value);
    let rate = if symmetry.is_conserved {
        Some(Rate::Zero)
    } else if symmetry.in_distribution() {
        let rate = symmetry.momentum.rate(&mut proved.model.graph);
        Some(Rate::Of(on_constraints(proved, restriction, rate)))
    } else {
        None
    };
    SymmetryMomentum { name: symmetry.name.clone(), section: symmetry.section.clone(), kind, momentum, rate }
}

/// What a section leaves as it is. `free`: there are no constraints.
fn kind(free: bool, symmetry: &Symmetry) -> &'static str {
    let invariance = (symmetry.keeps_lagrangian, symmetry.momentum.has_gauge);
    match (symmetry.in_distribution(), invariance, symmetry.keeps_constraints) {
        (_, (Invariance::Broken, _), _) if free => "L is not invariant",
        (_, (_, false), _) if free => "a symmetry: L is invariant",
        (_, (_, true), _) if free => {
            "a symmetry: L is invariant up to the rate of the function in the momentum"
        }
        (true, (Invariance::Broken, _), _) => "in D, L is not invariant",
        (true, (_, false), false) => "in D, L is invariant, D is not",
        (true, (_, true), false) => {
            "in D, L is invariant up to the rate of the function in the momentum, D is not invariant"
        }
        (true, (_, false), true) => "a horizontal symmetry: in D, which is invariant, and so is L",
        (true, (_, true), true) => {
            "a horizontal symmetry: in D, which is invariant, and so is L up to the rate of the function in the momentum"
        }
        (false, (_, false), _) => {
            "a symmetry of L and D that is not in D: the forces of constraint change its momentum"
        }
        (false, (_, true), _) => {
            "a symmetry of D, and of L up to the rate of the function in the momentum, that is not in D: the forces of constraint change its momentum"
        }
    }
}

fn on_constraints(proved: &mut Proved, restriction: &mut Substitution, function: ExprId) -> ExprId {
    let graph = &mut proved.model.graph;
    let restricted = restriction.apply(graph, function);
    graph.simplify(restricted)
}

fn restriction(proved: &Proved, derived: &Derived<'_>) -> Substitution {
    match derived {
        Derived::Adapted { kept, .. } => {
            kept.restriction(&proved.model.graph, &proved.system.algebroid.velocities)
        }
        Derived::Projected { .. } => Substitution::new([]),
    }
}

//! Symmetries and momenta.

use super::{combination, section_names, shown};
use crate::algebra::Substitution;
use crate::check::{Invariance, Symmetry};
use crate::compile::{Derived, Proved};
use crate::id::ExprId;

/// A line for each declared section, and for the cyclic coordinates.
pub(super) fn lines(proved: &mut Proved, derived: &Derived<'_>) -> Vec<String> {
    let mut restriction = restriction(proved, derived);
    let symmetries = proved.symmetries.clone();
    let mut lines: Vec<String> =
        symmetries.declared.iter().map(|symmetry| line(proved, &mut restriction, symmetry)).collect();
    if !symmetries.cyclic.is_empty() {
        let name = |id: &_| proved.model.coordinates[*id].name.as_str();
        let cyclic: Vec<&str> = symmetries.cyclic.iter().map(name).collect();
        let mut text = format!("cyclic coordinates, each left to a quadrature: {}", cyclic.join(", "));
        let horizontal = symmetries.found.iter().filter(|(_, symmetry)| symmetry.is_horizontal());
        let horizontal: Vec<&str> = horizontal.map(|(id, _)| name(id)).collect();
        if !horizontal.is_empty() {
            text.extend(["; horizontal symmetries: ", &horizontal.join(", ")]);
        }
        lines.push(text);
    }
    lines
}

/// The momenta that are conserved.
pub(super) fn conserved(proved: &mut Proved, derived: &Derived<'_>) -> Vec<String> {
    let mut restriction = restriction(proved, derived);
    let symmetries = proved.symmetries.clone();
    let found = symmetries.found.iter().map(|(_, symmetry)| symmetry);
    let mut lines = Vec::new();
    for symmetry in symmetries.declared.iter().chain(found).filter(|symmetry| symmetry.is_conserved) {
        let value = on_constraints(proved, &mut restriction, symmetry.momentum.value);
        lines.push(format!("the momentum of {}, {value} (CLMM Theorem 3.5)", symmetry.name));
    }
    lines
}

fn line(proved: &mut Proved, restriction: &mut Substitution, symmetry: &Symmetry) -> String {
    let names = section_names(&proved.model);
    let section = combination(&proved.model.graph, &symmetry.section, &names);
    let free = proved.constraints.linear.as_ref().is_some_and(|linear| linear.annihilator.is_empty());
    let kind = match (symmetry.in_distribution(), symmetry.keeps_lagrangian, symmetry.keeps_constraints) {
        (_, Invariance::Broken, _) if free => "L is not invariant",
        _ if free => "a symmetry: L is invariant",
        (true, Invariance::Broken, _) => "in D, L is not invariant",
        (true, _, false) => "in D, L is invariant, D is not",
        (true, _, true) => "a horizontal symmetry: in D, which is invariant, and so is L",
        (false, ..) => "a symmetry of L and D that is not in D: the forces of constraint change its momentum",
    };
    let momentum = on_constraints(proved, restriction, symmetry.momentum.value);
    let rate = if symmetry.is_conserved {
        "0".to_owned()
    } else if symmetry.in_distribution() {
        let rate = symmetry.momentum.rate(&mut proved.model.graph);
        on_constraints(proved, restriction, rate)
    } else {
        return format!("{}: {section}; {kind}; momentum {momentum}", symmetry.name);
    };
    format!("{}: {section}; {kind}; der({momentum}) = {rate}", symmetry.name)
}

fn on_constraints(proved: &mut Proved, restriction: &mut Substitution, function: ExprId) -> String {
    let graph = &mut proved.model.graph;
    let restricted = restriction.apply(graph, function);
    let restricted = graph.simplify(restricted);
    shown(graph, restricted)
}

fn restriction(proved: &Proved, derived: &Derived<'_>) -> Substitution {
    match derived {
        Derived::Adapted { kept, .. } => {
            kept.restriction(&proved.model.graph, &proved.system.algebroid.velocities)
        }
        Derived::Projected { .. } => Substitution::new([]),
    }
}

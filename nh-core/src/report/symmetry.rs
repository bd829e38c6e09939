//! Symmetries and momenta.

use super::{combination, section_names, shown};
use crate::algebra::Graph;
use crate::compile::Proved;
use crate::findings::{Rate, SymmetryMomentum};
use crate::id::ExprId;

/// A line for each declared section, and for the cyclic coordinates.
pub(super) fn lines(proved: &Proved, declared: &[SymmetryMomentum]) -> Vec<String> {
    let (model, symmetries) = (&proved.model, &proved.symmetries);
    let names = section_names(model);
    let mut lines: Vec<String> =
        declared.iter().map(|symmetry| line(&model.graph, &names, symmetry)).collect();
    if !symmetries.cyclic.is_empty() {
        let name = |id: &_| model.coordinates[*id].name.as_str();
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
pub(super) fn conserved(graph: &Graph, momenta: &[(String, ExprId)]) -> Vec<String> {
    let line = |(name, value): &(String, ExprId)| {
        format!("the momentum of {name}, {} (CLMM Theorem 3.5)", shown(graph, *value))
    };
    momenta.iter().map(line).collect()
}

fn line(graph: &Graph, names: &[String], symmetry: &SymmetryMomentum) -> String {
    let SymmetryMomentum { name, section, kind, momentum, rate } = symmetry;
    let (section, momentum) = (combination(graph, section, names), shown(graph, *momentum));
    match rate {
        Some(Rate::Zero) => format!("{name}: {section}; {kind}; der({momentum}) = 0"),
        Some(Rate::Of(rate)) => {
            format!("{name}: {section}; {kind}; der({momentum}) = {}", shown(graph, *rate))
        }
        None => format!("{name}: {section}; {kind}; momentum {momentum}"),
    }
}

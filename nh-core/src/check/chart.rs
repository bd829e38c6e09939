//! The coordinates that the declaration names as independent: a chart of the base N where positions are
//! constrained, or of an embedded base.

use super::evidence::{counted, listed};
use super::formulation::reached;
use super::positions::Positions;
use crate::algebra::{Facts, Matrix};
use crate::geometry::PivotSetting;
use crate::geometry::independent_velocities::{Choice, judge};
use crate::id::{CoordId, ExprId, Origin, SymbolId};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// The coordinates that the named ones determine, and where they do: where ∂f/∂x by them is invertible, f being what
/// vanishes on N. `None` where no coordinate is named.
///
/// # Errors
/// As many are named as are not left free, or such as do not determine the others anywhere.
pub fn chart(
    model: &mut Model,
    positions: &Positions,
    facts: &Facts,
) -> Result<Option<Choice<CoordId>>, Vec<Violation>> {
    let Some(named) = model.chart.clone() else { return Ok(None) };
    let origin = named.first().map_or(model.origin, |(_, origin)| *origin);
    let (rows, equations) = derivatives(model, positions).map_err(|why| vec![undecided(origin, why)])?;
    let wanted = model.coordinates.len() - rows.len();
    if named.len() != wanted {
        return Err(vec![miscounted(model, &named, wanted, &equations)]);
    }
    let is_named = |id: &CoordId| named.iter().any(|(symbol, _)| *symbol == model.coordinates[*id].symbol);
    let dependent: Vec<CoordId> = model.coordinates.ids().filter(|id| !is_named(id)).collect();
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let on_base = positions.manifold.restrict_matrix(&mut model.graph, &rows);
    let setting = PivotSetting { annihilator: &rows, on_base: &on_base, parameters: &parameters, facts };
    let mut judged =
        judge(&mut model.graph, &setting, &dependent).map_err(|why| vec![undecided(origin, why)])?;
    if let Some(choice) = &mut judged {
        choice.breaks_down = reached(model, &choice.breaks_down);
    }
    judged.map(Some).ok_or_else(|| {
        let names: Vec<String> =
            dependent.iter().map(|id| format!("`{}`", model.coordinates[*id].name)).collect();
        vec![Violation {
            law: Law::Choice,
            origin,
            what: "these coordinates are not independent where the equations for positions hold".into(),
            evidence: format!("the equations do not determine {}", listed(&names)),
            way_out: "name others, or leave the coordinates out".into(),
        }]
    })
}

/// ∂_i f^a, independent rows of it, for position constraints and the identities of `on`; and how many equations of each
/// kind these are, in words.
fn derivatives(model: &mut Model, positions: &Positions) -> Result<(Matrix, String), String> {
    let constraints = model.positions.iter().map(|position| position.value);
    let identities = model.identities.iter().map(|identity| identity.value);
    let functions: Vec<ExprId> = constraints.chain(identities).collect();
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    let graph = &mut model.graph;
    let mut rows = Matrix::new();
    for function in &functions {
        let row = coordinates.iter().map(|symbol| {
            let entry = graph.partial(*function, *symbol);
            graph.simplify(entry)
        });
        rows.push(row.collect());
    }
    let independent = positions.manifold.independent_rows(graph, &rows)?;
    let constraints = independent.iter().filter(|index| **index < model.positions.len()).count();
    let kinds = [
        (constraints, "position constraint", "position constraints"),
        (independent.len() - constraints, "identity of `on`", "identities of `on`"),
    ];
    let told = kinds.iter().filter(|(count, ..)| *count > 0);
    let told: Vec<String> = told.map(|(count, one, several)| counted(*count, one, several)).collect();
    Ok((independent.into_iter().map(|index| rows[index].clone()).collect(), listed(&told)))
}

fn miscounted(model: &Model, named: &[(SymbolId, Origin)], wanted: usize, equations: &str) -> Violation {
    Violation {
        law: Law::Choice,
        origin: named.first().map_or(model.origin, |(_, origin)| *origin),
        what: format!(
            "{} named as independent, but the number of independent coordinates is {wanted}",
            counted(named.len(), "coordinate is", "coordinates are")
        ),
        evidence: format!(
            "{} less {equations}",
            counted(model.coordinates.len(), "coordinate", "coordinates")
        ),
        way_out: format!("name {wanted}, or leave the coordinates out"),
    }
}

fn undecided(origin: Origin, why: String) -> Violation {
    Violation {
        law: Law::Decidable,
        origin,
        what: "which coordinates are independent could not be decided".into(),
        evidence: why,
        way_out: "leave the coordinates out of `independent`".into(),
    }
}

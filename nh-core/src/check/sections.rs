//! What a declaration says a section is: its components in the basis, and the function behind `up to`.

use super::evidence::shown;
use super::kinematics::Motion;
use super::symmetries::Setting;
use crate::algebra::{Graph, NotLinear};
use crate::id::{CoordId, ExprId, Id, SymbolId};
use crate::mechanics::translation;
use crate::model::{Kinematics, Model, SymmetryDecl};
use crate::violation::{Law, Violation};

/// The components σ^α in the basis.
pub(super) fn components(
    model: &mut Model,
    motion: &Motion,
    setting: &Setting<'_>,
    declared: &SymmetryDecl,
) -> Result<Vec<ExprId>, Violation> {
    let blame = |evidence: String| Violation {
        law: Law::Symmetry,
        origin: declared.origin,
        what: format!("`{}` is not a section", declared.name),
        evidence,
        way_out: "write it as a sum of quasi-velocities with coefficients on the base, such as \
                  `cos(theta) * v1 - sin(theta) * v2`"
            .into(),
    };
    // 1. what each name stands for: sections of the basis, other named sections, translations
    let rank = model.sections.len();
    let units = model.graph.identity(rank);
    let mut known: Vec<(SymbolId, Vec<ExprId>)> =
        model.sections.iter().map(|section| section.symbol).zip(units).collect();
    known.extend(motion.named.iter().cloned());
    let present = model.graph.symbols_in(&[declared.value]);
    for (id, coordinate) in model.coordinates.clone().iter_ids() {
        if present.contains(&coordinate.rate) && !matches!(model.kinematics, Kinematics::Tangent) {
            let section = translation_named(model, setting, id, declared)?;
            known.push((coordinate.rate, section));
        }
    }
    // 2. linear and homogeneous in them
    let symbols: Vec<SymbolId> = known.iter().map(|(symbol, _)| *symbol).collect();
    let graph = &mut model.graph;
    let form = graph.linear_form(declared.value, &symbols).map_err(|error| match error {
        NotLinear::Curved(..) => {
            blame(format!("{} is not linear in the quasi-velocities", shown(graph, declared.value)))
        }
        NotLinear::Unknown(why) => blame(why),
    })?;
    if !graph.zero_test(form.rest).is_zero() {
        let rest = shown(graph, form.rest);
        return Err(blame(format!("the term {rest} is not multiplied by a quasi-velocity")));
    }
    if let Some(stranger) = off_base(model, &form.coefficients) {
        return Err(blame(format!("its coefficients depend on `{stranger}`, which is not on the base")));
    }
    // 3. their combination
    let graph = &mut model.graph;
    let mut section = vec![graph.zero(); rank];
    for ((_, row), coefficient) in known.iter().zip(form.coefficients) {
        for (slot, entry) in section.iter_mut().zip(row) {
            *slot = graph.formula(*slot + coefficient * entry);
        }
    }
    let section: Vec<ExprId> = section.into_iter().map(|component| graph.simplify(component)).collect();
    if section.iter().all(|component| setting.constraints.base().zero_test(graph, *component).is_zero()) {
        return Err(blame("it vanishes everywhere".into()));
    }
    Ok(section)
}

/// The first symbol that is neither a coordinate, nor a parameter, nor the time.
fn off_base(model: &Model, expressions: &[ExprId]) -> Option<String> {
    let on_base = |symbol: &SymbolId| {
        *symbol == model.time
            || model.coordinates.iter().any(|coordinate| coordinate.symbol == *symbol)
            || model.parameters.iter().any(|parameter| parameter.symbol == *symbol)
    };
    let stranger = model.graph.symbols_in(expressions).into_iter().find(|symbol| !on_base(symbol))?;
    Some(model.graph.symbols()[stranger].clone())
}

/// What `der(x)` means beside a basis: its anchor expression, if that is the translation along x.
fn translation_named(
    model: &mut Model,
    setting: &Setting<'_>,
    coordinate: CoordId,
    declared: &SymmetryDecl,
) -> Result<Vec<ExprId>, Violation> {
    let anchor = &setting.system.algebroid.anchor;
    let name = model.coordinates[coordinate].name.clone();
    let graph = &mut model.graph;
    let row = &anchor.entries[coordinate.index()];
    let moves = anchor.vector_field(graph, row);
    let one = graph.one();
    let mut is_translation = true;
    for (i, component) in moves.iter().enumerate() {
        let defect = if i == coordinate.index() { graph.formula(component - one) } else { *component };
        is_translation &= setting.constraints.base().zero_test(graph, defect).is_zero();
    }
    if is_translation {
        return Ok(row.clone());
    }
    let names: Vec<String> = model.sections.iter().map(|section| section.name.clone()).collect();
    let graph = &mut model.graph;
    let way_out = match translation(graph, anchor, coordinate) {
        Some(section) => {
            let section = combination(graph, &section, &names);
            format!("the section that moves `{name}` alone is {section}")
        }
        None => "write the section with the names of the quasi-velocities".to_owned(),
    };
    Err(Violation {
        law: Law::Symmetry,
        origin: declared.origin,
        what: format!("`der({name})` is no section here"),
        evidence: format!(
            "it stands for {}, and as a section that does not move `{name}` alone at unit rate",
            combination(&model.graph, row, &names)
        ),
        way_out,
    })
}

/// `c1*e1 + c2*e2`.
pub(super) fn combination(graph: &Graph, section: &[ExprId], names: &[String]) -> String {
    let terms: Vec<String> = section
        .iter()
        .zip(names)
        .filter(|(component, _)| !graph.is_literal_zero(**component))
        .map(|(component, name)| match graph.as_number(*component) {
            Some(number) if number.is_one() => name.clone(),
            _ => format!("({})*{name}", shown(graph, *component)),
        })
        .collect();
    terms.join(" + ")
}

/// The function behind `up to` is on the base.
pub(super) fn check_gauge(model: &Model, declared: &SymmetryDecl) -> Result<(), Violation> {
    let Some(gauge) = declared.gauge else { return Ok(()) };
    match off_base(model, &[gauge]) {
        None => Ok(()),
        Some(stranger) => Err(Violation {
            law: Law::Symmetry,
            origin: declared.origin,
            what: format!("what `{}` holds up to is no function on the base", declared.name),
            evidence: format!("{} depends on `{stranger}`", shown(&model.graph, gauge)),
            way_out: "a function of the base coordinates, the parameters and the time stands there".into(),
        }),
    }
}

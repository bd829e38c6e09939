//! Embedded base coordinates: the identities that they satisfy, and that the anchor keeps them.

use super::assumptions::on_the_base;
use super::evidence::{not_zero_on, shown};
use super::kinematics::Motion;
use super::no_force::without_slope;
use crate::algebra::{Demand, Graph, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, Id, SectionId, SymbolId};
use crate::model::{Kinematics, Located, Model};
use crate::violation::{Law, Violation};

/// The embedded base: all of M where the declaration has no identities.
///
/// # Errors
/// Identities that depend on more than base coordinates, that could not be parametrised, or that a
/// section of the anchor leaves.
pub fn embedding(model: &mut Model, motion: &Motion) -> Result<Manifold, Vec<Violation>> {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let identities = model.identities.clone();
    let mut violations: Vec<Violation> =
        identities.iter().filter_map(|identity| stranger(model, &coordinates, *identity)).collect();
    if !violations.is_empty() {
        return Err(violations);
    }
    if let Some(violation) = without_real_point(model, &identities) {
        return Err(vec![violation]);
    }
    violations
        .extend(identities.iter().filter_map(|identity| without_direction(model, &coordinates, *identity)));
    if !violations.is_empty() {
        return Err(violations);
    }
    let functions: Vec<ExprId> = identities.iter().map(|identity| identity.value).collect();
    let mut base = Manifold::where_zero(&mut model.graph, &functions, &coordinates)
        .map_err(|index| vec![not_parametrised(model, identities[index])])?;
    let demands = on_the_base(model);
    base.keep_parts_with_points(&mut model.graph, &demands);
    let mut left = identities.iter().filter_map(|identity| left_by_anchor(model, motion, &base, *identity));
    // what moves off one identity is seen in the others that its coordinates stand in
    if let Some(mut violation) = left.next() {
        let others = left.count();
        if others > 0 {
            let identities = if others == 1 { "identity" } else { "identities" };
            let also = format!("; so it is with {others} more {identities}");
            violation.evidence.push_str(&also);
        }
        violations.push(violation);
    }
    if violations.is_empty() { Ok(base) } else { Err(violations) }
}

fn stranger(model: &Model, coordinates: &[SymbolId], identity: Located) -> Option<Violation> {
    let graph = &model.graph;
    let found = graph.symbols_in(&[identity.value]);
    let blame = |what: String, evidence: String| Violation {
        law: Law::Embedding,
        origin: identity.origin,
        what,
        evidence,
        way_out: "an identity relates base coordinates with numbers, such as `dot(g, g) = 1;`".into(),
    };
    if found.is_empty() {
        return Some(blame(
            "this identity has no base coordinate in it".into(),
            shown(graph, identity.value),
        ));
    }
    let stranger = found.into_iter().find(|symbol| !coordinates.contains(symbol))?;
    let name = &graph.symbols()[stranger];
    Some(blame(format!("this identity depends on `{name}`"), format!("`{name}` is not a base coordinate")))
}

/// An identity that holds at no real point at which those before it do.
fn without_real_point(model: &Model, identities: &[Located]) -> Option<Violation> {
    let demands: Vec<(ExprId, Demand)> =
        identities.iter().map(|identity| (identity.value, Demand::Zero)).collect();
    let is_refuted =
        |count: &usize| model.graph.contradiction(&touching(&model.graph, &demands[..*count])).is_some();
    let count = (1..=demands.len()).find(is_refuted)?;
    let identity = identities[count - 1];
    let together = if count == 1 { "" } else { " together with the identities before it" };
    Some(Violation {
        law: Law::Embedding,
        origin: identity.origin,
        what: format!("this identity holds nowhere{together}"),
        evidence: format!(
            "no real coordinates satisfy {} = 0{together}",
            shown(&model.graph, identity.value)
        ),
        way_out: "correct it, or leave it out".into(),
    })
}

/// The last demand with those that share symbols with it, also through others: where the rest can be met does not depend
/// on it.
fn touching(graph: &Graph, demands: &[(ExprId, Demand)]) -> Vec<(ExprId, Demand)> {
    let Some((last, before)) = demands.split_last() else { return Vec::new() };
    let mut symbols = graph.symbols_in(&[last.0]);
    let mut is_near = vec![false; before.len()];
    loop {
        let mut grows = false;
        for ((value, _), is_near) in before.iter().zip(&mut is_near).filter(|(_, is_near)| !**is_near) {
            let own = graph.symbols_in(&[*value]);
            if own.iter().any(|symbol| symbols.contains(symbol)) {
                symbols.extend(own);
                (*is_near, grows) = (true, true);
            }
        }
        if !grows {
            break;
        }
    }
    let near = before.iter().zip(is_near).filter(|(_, is_near)| *is_near).map(|(demand, _)| *demand);
    near.chain([*last]).collect()
}

/// An identity whose derivative vanishes where it holds, as that of a square does: there is no way back to it.
fn without_direction(model: &mut Model, coordinates: &[SymbolId], identity: Located) -> Option<Violation> {
    let (evidence, way_out) = without_slope(&mut model.graph, identity.value, coordinates)?;
    Some(Violation {
        law: Law::Embedding,
        origin: identity.origin,
        what: "the derivative of this identity vanishes where it holds: nothing leads back to it".into(),
        evidence,
        way_out: way_out.into(),
    })
}

fn not_parametrised(model: &Model, identity: Located) -> Violation {
    Violation {
        law: Law::Decidable,
        origin: identity.origin,
        what: "no points that satisfy this identity could be found, so nothing can be proved on it".into(),
        evidence: format!(
            "{} = 0 is neither a sphere, nor rotation matrices, nor solvable for a coordinate by \
                           a division or a square root",
            shown(&model.graph, identity.value)
        ),
        way_out: "write identities that define the embedding one by one, or leave them out".into(),
    }
}

/// A section whose vector field does not annihilate the identity on the embedded base.
fn left_by_anchor(
    model: &mut Model,
    motion: &Motion,
    base: &Manifold,
    identity: Located,
) -> Option<Violation> {
    for section in (0..model.sections.len()).map(SectionId::from_index) {
        let graph = &mut model.graph;
        let change = motion.anchor.along(section).apply(graph, identity.value);
        let (part, verdict) = base.judged(graph, change);
        if verdict.is_zero() {
            continue;
        }
        let change = graph.simplify(change);
        let name = &model.sections[section].name;
        let evidence = match &verdict {
            Verdict::NonZero(witness) if !has_parameters(witness, model) => {
                format!(
                    "along `{name}` it changes at the rate {}",
                    not_zero_on(&model.graph, change, witness, &part)
                )
            }
            _ => format!("along `{name}` it changes at the rate {}", shown(&model.graph, change)),
        };
        if let Verdict::Unknown(why) = &verdict {
            return Some(Violation {
                law: Law::Decidable,
                origin: identity.origin,
                what: "whether every motion stays on the embedded base could not be decided".into(),
                evidence: format!("{evidence}: {why}"),
                way_out: "write the identity without factors that vanish by themselves, as `a = b` instead of `a^2 = b^2`"
                    .into(),
            });
        }
        let (what, way_out) = match model.kinematics {
            Kinematics::Tangent => (
                "the velocities do not keep this identity",
                "without a basis every rate is free: declare a `basis` whose `anchor` keeps it, such as \
                 `der(g) = cross(g, w)`, or leave `on` out and constrain the rates",
            ),
            Kinematics::Anchor(_) | Kinematics::Coframe(_) => (
                "the anchor does not keep this identity",
                "correct the anchor, or the identity: every motion has to stay on the embedded base",
            ),
        };
        return Some(Violation {
            law: Law::Embedding,
            origin: identity.origin,
            what: what.into(),
            evidence,
            way_out: way_out.into(),
        });
    }
    None
}

/// Whether a witness is in terms of the parameters of the manifold, which mean nothing to the user.
fn has_parameters(witness: &crate::algebra::Witness, model: &Model) -> bool {
    let known: Vec<SymbolId> = model
        .coordinates
        .iter()
        .map(|c| c.symbol)
        .chain(model.parameters.iter().map(|p| p.symbol))
        .chain(model.sections.iter().map(|s| s.symbol))
        .collect();
    witness.point.iter().any(|(symbol, _)| !known.contains(symbol))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a² + b² = 1, c² + d² = 1, b² + e² = 1 and e² + 1 = a² are asked together but for the second.
    #[test]
    fn identities_are_asked_with_those_that_touch_them_through_others() {
        let mut g = Graph::new();
        let squares = ["a", "b", "c", "d", "e"].map(|name| {
            let symbol = g.new_symbol(name);
            let value = g.symbol(symbol);
            g.square(value)
        });
        let [a, b, c, d, e] = squares;
        let one = g.one();
        let values = [a + b - one, c + d - one, b + e - one, e + one - a].map(|value| g.formula(value));
        let demands = values.map(|value| (value, Demand::Zero));
        assert_eq!(touching(&g, &demands), [demands[0], demands[2], demands[3]]);
        assert_eq!(touching(&g, &demands[..2]), [demands[1]]);
        // the first and the third leave e² = a², which the last denies
        assert!(g.contradiction(&touching(&g, &demands)).is_some());
        assert!(g.contradiction(&touching(&g, &demands[..3])).is_none());
        assert!(g.contradiction(&[demands[0], demands[3]]).is_none());
    }
}

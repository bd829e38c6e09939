//! Position constraints that could not be solved for anything: which of them, and of the constraints on velocities beside
//! them, are independent is asked at points of N that are found modulo powers of primes.

use super::dependence::{left_out, place_of};
use super::evidence::{listed, name_of};
use crate::algebra::{Demand, Graph, Matrix, Node};
use crate::geometry::{Manifold, NearManifold, RowsOnPart, rows_on_parts};
use crate::id::{ConstraintId, ExprId, Id, SymbolId};
use crate::limits::attempt;
use crate::model::Model;
use crate::violation::{Law, Violation};

/// The work that the points may take.
const SEARCH: u64 = 12_000_000;

/// Position constraints, some of which could not be solved.
pub(super) struct Unsolved<'a> {
    /// All of them.
    pub values: &'a [ExprId],
    /// The base that they are on.
    pub base: &'a Manifold,
}

/// The part of N that is meant, by the rows that are independent there; and how many are on other parts.
pub(super) fn part_of_positions(
    model: &mut Model,
    positions: &Unsolved<'_>,
    rows: &Matrix,
) -> (Option<RowsOnPart>, Vec<usize>) {
    let identities = model.identities.iter().map(|identity| identity.value);
    let functions: Vec<ExprId> = identities.chain(positions.values.iter().copied()).collect();
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut model.graph;
    let mut parts = attempt(SEARCH, || rows_on_parts(graph, &functions, &coordinates, rows));
    if parts.as_ref().is_none_or(Vec::is_empty) {
        // an angle that follows a length, as on a rack, has no digits of both; solved for, the length has those that follow
        parts = attempt(SEARCH, || {
            let NearManifold { manifold, unsolved } = Manifold::of_linear_positions(
                graph,
                positions.base,
                positions.values,
                [&coordinates, &parameters],
            );
            let restrict = |index: &usize| manifold.restrict(graph, positions.values[*index]);
            let functions: Vec<ExprId> = unsolved.iter().map(restrict).collect();
            let rows = manifold.restrict_matrix(graph, rows);
            rows_on_parts(graph, &functions, &coordinates, &rows)
        });
    }
    chosen_part(parts.unwrap_or_default(), model.sections.len())
}

/// Of the parts on which something moves the one with the most independent rows: where fewer are independent these
/// cannot be solved for multipliers, which is noticed, while one too few would go unnoticed.
fn chosen_part(parts: Vec<RowsOnPart>, sections: usize) -> (Option<RowsOnPart>, Vec<usize>) {
    let counts: Vec<usize> = parts.iter().map(|part| part.rows.len()).collect();
    let most = |limit: usize| counts.iter().copied().filter(|count| *count < limit).max();
    let chosen = most(sections).or(most(usize::MAX));
    let mut elsewhere: Vec<usize> = counts.iter().copied().filter(|count| Some(*count) != chosen).collect();
    elsewhere.sort_unstable();
    elsewhere.dedup();
    (parts.into_iter().find(|part| Some(part.rows.len()) == chosen), elsewhere)
}

/// A part of N that is not the one that is meant.
#[derive(Clone, Debug)]
pub struct LesserPart {
    /// ` where s = 0`; none if only points of it were found.
    pub place: Option<String>,
    /// How many rates are independent there.
    pub rank: usize,
}

/// Takes the parts of N away where fewer rates are independent than on another on which something moves, as where the
/// links of a rhombus are folded onto one another; as with [`chosen_part`], with how many are independent where that was
/// asked at points. There multipliers are not determined, which is noticed. An equation that is written as a product says
/// "this or that", and no part is taken away: which is meant can be written. Nor is one where ranks cannot be found, of which
/// the question for independent rates then speaks.
pub(super) fn without_lesser_parts(
    model: &mut Model,
    manifold: &mut Manifold,
    rows: &Matrix,
    at_points: Option<usize>,
) -> Vec<LesserPart> {
    let moving: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let is_whole = manifold.parts().nth(1).is_none();
    let is_product = |value| vanishing_factors(&model.graph, value, &moving) > 1;
    if is_whole || model.positions.iter().any(|position| is_product(position.value)) {
        return Vec::new();
    }
    let mut ranks = Vec::new();
    for part in manifold.parts() {
        let restricted = part.restrict_matrix(&mut model.graph, rows);
        let Ok(rank) = model.graph.generic_rank(&restricted) else { return Vec::new() };
        ranks.push(rank);
    }
    let most = |limit: usize| ranks.iter().copied().filter(|rank| *rank < limit).max();
    let meant = at_points.or_else(|| most(model.sections.len())).or_else(|| most(usize::MAX)).unwrap_or(0);
    if ranks.iter().all(|rank| *rank < meant) {
        return Vec::new();
    }
    let lesser = manifold.parts().zip(&ranks).filter(|(_, rank)| **rank < meant);
    let lesser = lesser.map(|(part, rank)| {
        let is_named = !manifold.own_images(part.images()).is_empty();
        LesserPart { place: is_named.then(|| place_of(model, manifold, part)), rank: *rank }
    });
    let lesser: Vec<LesserPart> = lesser.collect();
    let mut is_kept = ranks.iter().map(|rank| *rank >= meant);
    manifold.keep_parts(|_| is_kept.next().unwrap_or(true));
    lesser
}

/// Where some functions on a base vanish, solved for coordinates or for some of the parameters, with the parts that the first
/// charts do not reach. `demands` hold on the base.
pub(super) fn on_all_parts(
    graph: &mut Graph,
    (base, demands): (&Manifold, Vec<(ExprId, Demand)>),
    functions: &[ExprId],
    [coordinates, parameters]: [&[SymbolId]; 2],
) -> NearManifold {
    let mut near = Manifold::of_positions(graph, base, functions, [coordinates, parameters]);
    if near.unsolved.is_empty() {
        let mut demands = demands;
        demands.extend(functions.iter().map(|function| (*function, Demand::Zero)));
        near.manifold.add_unreached_parts(graph, &demands, coordinates, |graph, further| {
            let functions = [further, functions].concat();
            let part = Manifold::of_positions(graph, base, &functions, [coordinates, parameters]);
            part.unsolved.is_empty().then_some(part.manifold)
        });
    }
    near
}

/// Where some of the position constraints hold, for any parameters.
pub(super) fn where_these_hold(model: &mut Model, positions: &[usize], base: &Manifold) -> NearManifold {
    let functions: Vec<ExprId> = positions.iter().map(|index| model.positions[*index].value).collect();
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let demands = super::assumptions::on_the_base(model);
    on_all_parts(&mut model.graph, (base, demands), &functions, [&coordinates, &[]])
}

/// Where an equation does not follow from others, if it does so on one part of where these hold.
pub(super) fn does_not_follow(model: &mut Model, others: &NearManifold, value: ExprId) -> Option<String> {
    let NearManifold { manifold, unsolved } = others;
    let graph = &mut model.graph;
    let mut vanishes = |part: &Manifold| {
        let restricted = part.restrict(graph, value);
        graph.zero_test(restricted).is_zero()
    };
    let follows: Vec<bool> = manifold.parts().map(&mut vanishes).collect();
    let part = manifold.parts().zip(&follows).find(|(_, follows)| !**follows).map(|(part, _)| part)?;
    let is_known = unsolved.is_empty() && follows.contains(&true);
    is_known.then(|| place_of(model, manifold, part))
}

/// How many factors a function is written as that change as symbols move, and may vanish.
pub(super) fn vanishing_factors(graph: &Graph, function: ExprId, moving: &[SymbolId]) -> usize {
    let Node::Product { factors, .. } = graph.node(function) else {
        return usize::from(graph.depends_on(function, moving));
    };
    factors.iter().filter(|(base, power)| !power.is_negative() && graph.depends_on(*base, moving)).count()
}

/// So many equations that nothing moves where they are independent, which they were not asked to be on N.
pub(super) fn unknown_motion(model: &Model) -> Violation {
    let (positions, sections) = (model.positions.len(), model.sections.len());
    Violation {
        law: Law::Decidable,
        origin: model.positions.last().map_or(model.origin, |position| position.origin),
        what: "whether the position constraints leave anything that moves could not be decided".into(),
        evidence: format!(
            "in general positions as many of them are independent as there are sections ({positions} of \
             {sections}); no point was found where all of them hold, and fewer may be independent there"
        ),
        way_out:
            "declare lengths as parameters, which loops are solved for; or leave out what follows from the others"
                .into(),
    }
}

/// `4 points modulo powers of 7 and 11`.
pub(crate) fn points_shown(part: &RowsOnPart) -> String {
    let mut primes = part.primes.clone();
    primes.sort_unstable();
    let primes: Vec<String> = primes.iter().map(u64::to_string).collect();
    let plural = if part.points == 1 { "" } else { "s" };
    format!("{} point{plural} modulo powers of {}", part.points, listed(&primes))
}

/// How many position constraints are independent on a part of N.
pub(super) fn rates_on_part(part: &RowsOnPart) -> String {
    format!(
        "where all position constraints hold, {} of their rates are independent, as was seen at {}",
        part.rows.len(),
        points_shown(part)
    )
}

/// The first constraint on velocities that depends on those before it where the position constraints hold.
pub(super) fn dependent_on_part(
    model: &mut Model,
    positions: &Unsolved<'_>,
    rows: &Matrix,
) -> Option<Violation> {
    let count = model.positions.len();
    if rows.len() == count {
        return None;
    }
    let (part, _) = part_of_positions(model, positions, rows);
    let part = part?;
    let index = (count..rows.len()).find(|row| !part.rows.contains(row))?;
    let id = ConstraintId::from_index(index);
    Some(Violation {
        law: Law::Independence,
        origin: model.constraints[id].origin,
        what: format!("{} follows from the constraints before it", name_of(model, id)),
        evidence: format!(
            "where the position constraints hold, {} of the {} constraints on velocities are independent, as was \
             seen at {}",
            part.rows.len(),
            rows.len(),
            points_shown(&part)
        ),
        way_out: left_out(model, id),
    })
}

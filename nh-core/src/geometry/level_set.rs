//! N = f⁻¹(0), where position constraints hold: points of it, by solving for coordinates or parameters.
//!
//! What is claimed on N is claimed for all parameters, so that a loop of links is as well the set of all
//! angles with one length that closes it: loops are linear in lengths. What could not be solved is left
//! open: the points found are then those of a larger set.

use super::manifold::Manifold;
use super::solutions::Ease;
use super::ways::ways_to_vanish;
use crate::algebra::{Graph, Node, Verdict, sample};
use crate::id::{ExprId, SymbolId};
use crate::limits::{attempt, spent};

/// A manifold in whose place a larger one stands, if some functions could not be solved.
#[derive(Clone, Debug)]
pub struct NearManifold {
    /// Where the functions vanish that could be solved.
    pub manifold: Manifold,
    /// The others, by position.
    pub unsolved: Vec<usize>,
}

/// The work that the search for points may take. Roots of what has roots take many trials for a point where all of
/// them are numbers.
const SEARCH: u64 = 20_000_000;

impl Manifold {
    /// Where position constraints hold over an embedded base, solved for coordinates or parameters: linear
    /// ones first, so that no root gets into what could be solved without.
    #[must_use]
    pub fn of_positions(
        graph: &mut Graph,
        base: &Self,
        functions: &[ExprId],
        [coordinates, parameters]: [&[SymbolId]; 2],
    ) -> NearManifold {
        let charted: Vec<SymbolId> = parameters.iter().chain(&base.chart).copied().collect();
        let further: [Way; 3] = [(Ease::Linear, &charted), (Ease::Root, &charted), (Ease::Root, coordinates)];
        Self::by_ways(graph, base, functions, [coordinates, parameters], &further)
    }

    /// The same by divisions for coordinates alone: what is left is for any parameters as it was.
    #[must_use]
    pub fn of_linear_positions(
        graph: &mut Graph,
        base: &Self,
        functions: &[ExprId],
        symbols: [&[SymbolId]; 2],
    ) -> NearManifold {
        Self::by_ways(graph, base, functions, symbols, &[])
    }

    /// Where functions vanish, each solved for a coordinate by a division, lengths before angles, or in the first of
    /// some further ways: without the terms that they share, if all can be solved then.
    fn by_ways(
        graph: &mut Graph,
        base: &Self,
        functions: &[ExprId],
        symbols: [&[SymbolId]; 2],
        further: &[Way],
    ) -> NearManifold {
        let shorter = less_one_another(graph, functions);
        let mut found = None;
        if shorter != functions {
            let apart = Self::in_order(graph, base, &shorter, symbols, (further, Roots::AfterProducts));
            found = apart.unsolved.is_empty().then_some(apart);
        }
        let mut found = found
            .unwrap_or_else(|| Self::in_order(graph, base, functions, symbols, (further, Roots::Always)));
        found.manifold.note_roots_of(graph, functions);
        found
    }

    /// The same of functions as they are, with roots taken late or wherever nothing easier is left.
    fn in_order(
        graph: &mut Graph,
        base: &Self,
        functions: &[ExprId],
        [coordinates, parameters]: [&[SymbolId]; 2],
        (further, roots): (&[Way], Roots),
    ) -> NearManifold {
        let (angles, lengths) = angles_and_lengths(graph, functions, coordinates);
        let mut ways: Vec<Way> = vec![
            (Ease::Number, &lengths),
            (Ease::Number, &angles),
            (Ease::Linear, &lengths),
            (Ease::Linear, &angles),
        ];
        ways.extend(further);
        let moving = [coordinates, &base.chart].concat();
        let search = Search { functions, parameters, moving: &moving, ways: &ways, roots, start: spent() };
        let near = |graph: &mut Graph, start: &Self, functions: &[ExprId]| {
            let found = Search { functions, ..search }.near(graph, start.clone());
            (found.manifold, found.unsolved)
        };
        let starts = base.parts().map(Self::alone).collect();
        let (mut manifold, unsolved) =
            Self::by_parts(graph, starts, (functions, coordinates), near, |_, _, _, _| None);
        // parts that fix parameters are none of a machine whose parameters have any values
        manifold.others.retain(|part| {
            let of_coordinates = |image: ExprId| graph.depends_on(image, &moving);
            part.images.iter().all(|(symbol, image)| !parameters.contains(symbol) || of_coordinates(*image))
        });
        manifold.open.extend(base.open.iter().cloned());
        NearManifold { manifold, unsolved }
    }
}

/// When roots are taken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Roots {
    /// Where no function that is left is a product: its factors may do without.
    AfterProducts,
    Always,
}

/// Functions, each less multiples of earlier ones as far as it depends on less then: so no root gets into what all of them say
/// of a few.
fn less_one_another(graph: &mut Graph, functions: &[ExprId]) -> Vec<ExprId> {
    let mut found: Vec<ExprId> = Vec::with_capacity(functions.len());
    for function in functions {
        let mut left = *function;
        for earlier in &found {
            left = graph.less_a_multiple(left, *earlier).unwrap_or(left);
        }
        found.push(left);
    }
    found
}

/// How functions are solved, and for what.
type Way<'a> = (Ease, &'a [SymbolId]);

/// What functions are solved for, and by which ways.
#[derive(Clone, Copy)]
struct Search<'a> {
    functions: &'a [ExprId],
    parameters: &'a [SymbolId],
    moving: &'a [SymbolId],
    ways: &'a [Way<'a>],
    roots: Roots,
    start: u64,
}

impl Search<'_> {
    /// The points of a manifold where as many of the functions vanish as could be solved.
    fn near(&self, graph: &mut Graph, manifold: Manifold) -> NearManifold {
        let mut found = NearManifold { manifold, unsolved: (0..self.functions.len()).collect() };
        while !found.unsolved.is_empty() {
            let left = SEARCH.saturating_sub(spent() - self.start);
            let Some(Some((solved, manifold))) = attempt(left, || self.step(graph, &found)) else { break };
            found.manifold = manifold;
            found.unsolved.retain(|index| *index != solved);
        }
        found
    }

    /// One function more that vanishes, by its position.
    fn step(&self, graph: &mut Graph, found: &NearManifold) -> Option<(usize, Manifold)> {
        let mut manifold = found.manifold.clone();
        let restricted: Vec<(usize, ExprId)> = found
            .unsolved
            .iter()
            .map(|index| (*index, manifold.restrict(graph, self.functions[*index])))
            .collect();
        let holds = restricted.iter().find(|(_, function)| graph.zero_test(*function) == Verdict::Zero);
        if let Some((index, _)) = holds {
            return Some((*index, manifold));
        }
        let (roots, divisions): (Vec<Way>, Vec<Way>) =
            self.ways.iter().partition(|(ease, _)| matches!(ease, Ease::Root));
        let mut solved = self.solved(graph, &mut manifold, &restricted, &divisions);
        if solved.is_none() {
            let waits = self.roots == Roots::AfterProducts
                && restricted.iter().any(|(_, function)| {
                    ways_to_vanish(graph, *function, self.moving).is_some_and(|ways| ways.is_exact)
                });
            if !waits {
                solved = self.solved(graph, &mut manifold, &restricted, &roots);
            }
        }
        solved.map(|index| (index, manifold))
    }

    /// The first of some functions on a manifold that is solved in the first of some ways.
    fn solved(
        &self,
        graph: &mut Graph,
        manifold: &mut Manifold,
        restricted: &[(usize, ExprId)],
        ways: &[Way],
    ) -> Option<usize> {
        ways.iter().find_map(|(ease, unknowns)| {
            let solved = restricted.iter().find(|(_, function)| {
                let is_meant =
                    |graph: &mut Graph, solution| is_meant(graph, *function, solution, self.parameters);
                manifold.solve(graph, *function, (unknowns, self.moving), *ease, &is_meant)
            });
            solved.map(|(index, _)| *index)
        })
    }
}

/// The coordinates that are arguments of functions, and the others: what these are solved for gets into no sine.
fn angles_and_lengths(
    graph: &Graph,
    functions: &[ExprId],
    coordinates: &[SymbolId],
) -> (Vec<SymbolId>, Vec<SymbolId>) {
    let arguments: Vec<ExprId> = graph
        .reachable(functions)
        .into_iter()
        .filter(|id| matches!(graph.node(*id), Node::Apply(..) | Node::Apply2(..)))
        .flat_map(|id| graph.node(id).operands().collect::<Vec<_>>())
        .collect();
    let inside = graph.symbols_in(&arguments);
    coordinates.iter().partition(|coordinate| inside.contains(coordinate))
}

/// Whether a solution of a function is one of what the function says as a whole. Parameters have all values: a length
/// that is a factor is not 0 for that. Neither is a factor of coordinates: in `r (sin a - sin b)` it is not known which
/// of the two is 0, so that a solution has to contain the other coordinates.
fn is_meant(
    graph: &mut Graph,
    function: ExprId,
    (symbol, image): (SymbolId, ExprId),
    parameters: &[SymbolId],
) -> bool {
    if parameters.contains(&symbol)
        && (graph.symbols_in(&[image]).iter().all(|other| parameters.contains(other))
            || !is_real(graph, image))
    {
        return false;
    }
    graph.symbols_in(&[function]).into_iter().all(|other| {
        let mut depends = |expression| {
            let slope = graph.partial(expression, other);
            !graph.zero_test(slope).is_zero()
        };
        other == symbol || parameters.contains(&other) || depends(image) || !depends(function)
    })
}

/// Whether a value is a number at one of some points.
fn is_real(graph: &Graph, image: ExprId) -> bool {
    const POINTS: u64 = 24;
    let symbols = graph.symbols_in(&[image]);
    let mut evaluator = graph.evaluator(&[image]);
    (0..POINTS).any(|point| {
        let at = |symbol| sample(point, symbols.iter().position(|known| *known == symbol).unwrap_or(0));
        evaluator.at(at)[0].value.is_finite()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::within_limits;

    /// Two arms of one length r at one height: r (sin a − sin b) is left of the second.
    #[test]
    fn a_factor_is_not_zero_for_that() {
        let mut g = Graph::new();
        let length = g.new_symbol("length");
        let coordinates = ["r", "z", "a", "b"].map(|name| g.new_symbol(name));
        let [r, z, a, b] = coordinates.map(|symbol| g.symbol(symbol));
        let (sin_a, sin_b, l) = (g.sin(a), g.sin(b), g.symbol(length));
        let functions = [
            g.formula(r * sin_a - z),
            g.formula(r * sin_b - z),
            g.formula(r.square() - z.square() - l.square()),
        ];
        let found = Manifold::of_positions(&mut g, &Manifold::whole(), &functions, [&coordinates, &[length]]);
        assert_eq!(found.unsolved, [1]);
        assert!(found.manifold.zero_test(&mut g, r).is_nonzero());
    }

    /// Two unit vectors at right angles, of which the second is given: solved in the order of the equations, an image of the
    /// first divides by what the last equation says is 0.
    #[test]
    fn no_image_divides_by_what_vanishes() {
        let mut g = Graph::new();
        let coordinates = ["a", "b", "u", "v"].map(|name| g.new_symbol(name));
        let [a, b, u, v] = coordinates.map(|symbol| g.symbol(symbol));
        let one = g.one();
        let functions = [
            g.formula(a * u + b * v),
            g.formula(a.square() + b.square() - one),
            g.formula(u.square() + v.square() - one),
            g.formula(u + v * v - one),
            v,
        ];
        for order in [[0, 1, 2, 3, 4], [0, 4, 3, 1, 2], [3, 0, 1, 4, 2]] {
            let functions = order.map(|place| functions[place]);
            let found = Manifold::of_positions(&mut g, &Manifold::whole(), &functions, [&coordinates, &[]]);
            assert_eq!(found.unsolved, [0; 0], "{order:?}");
            for (function, value) in [(a, 0), (u, 1), (v, 0)] {
                let value = g.number(value);
                let defect = g.formula(function - value);
                assert!(found.manifold.zero_test(&mut g, defect).is_zero(), "{order:?}");
            }
            assert!(found.manifold.zero_test(&mut g, b).is_nonzero());
        }
    }

    /// A row of bars, all as long as they are apart: each joint is where two circles meet, one of them about the joint
    /// before it.
    #[test]
    fn points_that_are_hard_to_find_are_left_open() {
        let mut g = Graph::new();
        let length = g.new_symbol("length");
        let coordinates: Vec<SymbolId> = (0..10).map(|i| g.new_symbol(format!("x{i}"))).collect();
        let l = g.symbol(length);
        let joints: Vec<[ExprId; 2]> =
            coordinates.chunks(2).map(|joint| [g.symbol(joint[0]), g.symbol(joint[1])]).collect();
        let mut functions = Vec::new();
        for (place, [x, y]) in joints.iter().copied().enumerate() {
            let foot = g.number(i64::try_from(place).unwrap());
            functions.push(g.formula((x - foot * l).square() + y.square() - l.square()));
        }
        for bar in joints.windows(2) {
            let [[x, y], [u, v]] = [bar[0], bar[1]];
            functions.push(g.formula((u - x).square() + (v - y).square() - l.square()));
        }
        let found = within_limits(|| {
            Manifold::of_positions(&mut g, &Manifold::whole(), &functions, [&coordinates, &[length]])
        });
        let found = found.expect("within limits");
        assert!((1..=4).contains(&found.unsolved.len()), "{:?}", found.unsolved);
        for (index, function) in functions.iter().enumerate() {
            let holds = found.manifold.zero_test(&mut g, *function).is_zero();
            assert_eq!(holds, !found.unsolved.contains(&index));
        }
    }
}

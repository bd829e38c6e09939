//! The rotations that an attitude is a product of, in the order from what carries to what is carried.

use super::free_turn::FreeTurn;
use super::sheet::{Square, Vector};
use crate::algebra::{Derivation, Function, Graph, Node, Rational, Substitution};
use crate::geometry::Algebroid;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Attitude, Body, Turn};

/// A factor of an attitude.
#[derive(Clone)]
pub(super) struct Hinge {
    pub(super) matrix: Square,
    pub(super) kind: Kind,
}

/// How a factor turns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// About an axis by a number.
    Fixed { axis: Vector, angle: ExprId },
    /// About an axis, of length 1, by an angle for whose sine a symbol stands.
    About { axis: Vector, angle: ExprId, sine: SymbolId },
    /// In all ways.
    Free(FreeTurn),
}

/// The sine of an angle with its sign: sin(−a) is −sin(a).
enum Sine {
    Number,
    Of(ExprId),
    Minus(ExprId),
}

/// Angles, and symbols for their sines and cosines.
pub(super) struct Hinges {
    angles: Vec<(ExprId, [SymbolId; 2])>,
    /// Symbols for sines and cosines.
    named: Substitution,
    /// Sines and cosines for the symbols.
    written: Substitution,
    by_symbols: Vec<(SymbolId, Derivation)>,
}

/// The factors of a body's attitude; `None` of a point, which has none.
pub(super) type Path = Option<Vec<Hinge>>;

impl Hinge {
    /// Whether one of these turns it, where symbols stand for sines.
    fn is_turned_by(&self, is_there: impl Fn(&SymbolId) -> bool) -> bool {
        match &self.kind {
            Kind::Fixed { .. } => false,
            Kind::About { sine, .. } => is_there(sine),
            Kind::Free(free) => free.level().iter().any(|(symbol, _)| is_there(symbol)),
        }
    }
}

impl Hinges {
    pub(super) fn new() -> Self {
        let empty = || Substitution::new([]);
        Self { angles: Vec::new(), named: empty(), written: empty(), by_symbols: Vec::new() }
    }

    /// The path to each body; `None` where a body is not in space, or a factor turns in another way.
    pub(super) fn paths(
        &mut self,
        graph: &mut Graph,
        bodies: &[Body],
        algebroid: &Algebroid,
    ) -> Option<Vec<Path>> {
        let mut paths: Vec<Path> = Vec::with_capacity(bodies.len());
        for body in bodies {
            paths.push(match &body.attitude {
                Attitude::None => None,
                Attitude::Angle(_) => return None,
                Attitude::Turns(turns) => Some(self.path(graph, turns, algebroid)?),
            });
        }
        self.join(graph, &mut paths, algebroid);
        Some(paths)
    }

    fn path(&mut self, graph: &mut Graph, turns: &[Turn], algebroid: &Algebroid) -> Option<Vec<Hinge>> {
        let coordinates = &algebroid.anchor.coordinates;
        let mut path: Vec<Hinge> = Vec::with_capacity(turns.len());
        for turn in turns {
            let kind = match &turn.about {
                Some((axis, angle)) => {
                    let axis: Vector = axis.as_slice().try_into().ok()?;
                    if axis.iter().any(|entry| graph.depends_on(*entry, coordinates)) {
                        return None;
                    }
                    self.about(graph, axis, *angle)
                }
                None => Kind::Free(FreeTurn::of(graph, &turn.matrix, algebroid)?),
            };
            if path.iter().any(|before| before.kind.shares(&kind)) {
                return None;
            }
            let matrix = std::array::from_fn(|i| std::array::from_fn(|j| turn.matrix[3 * i + j]));
            path.push(Hinge { matrix, kind });
        }
        Some(path)
    }

    fn about(&mut self, graph: &mut Graph, axis: Vector, angle: ExprId) -> Kind {
        match sine(graph, angle) {
            Sine::Number => Kind::Fixed { axis, angle },
            Sine::Of(own) => Kind::About { axis, angle: own, sine: self.symbols(graph, own)[0] },
            Sine::Minus(own) => {
                let axis = axis.map(|entry| graph.formula(-entry));
                Kind::About { axis, angle: own, sine: self.symbols(graph, own)[0] }
            }
        }
    }

    fn symbols(&mut self, graph: &mut Graph, angle: ExprId) -> [SymbolId; 2] {
        if let Some((_, known)) = self.angles.iter().find(|(other, _)| *other == angle) {
            return *known;
        }
        let [sine, cosine] = ["sine", "cosine"].map(|name| graph.new_symbol(name));
        let images = [sine, cosine].map(|symbol| graph.symbol(symbol));
        let nodes = [Function::Sin, Function::Cos].map(|function| graph.apply(function, angle));
        for ((node, image), symbol) in nodes.into_iter().zip(images).zip([sine, cosine]) {
            self.named.insert_node(node, image);
            self.written.insert(symbol, node);
        }
        self.angles.push((angle, [sine, cosine]));
        [sine, cosine]
    }

    /// Three angles of which the state has no rates, but those of what they turn, are one free attitude.
    fn join(&self, graph: &mut Graph, paths: &mut [Path], algebroid: &Algebroid) {
        let longest = paths.iter().flatten().max_by_key(|path| path.len()).cloned().unwrap_or_default();
        for three in longest.windows(3) {
            let is_three = |path: &[Hinge]| path.iter().zip(three).all(|(a, b)| a.kind == b.kind);
            let holds_some =
                |path: &Vec<Hinge>| path.iter().any(|hinge| three.iter().any(|of| of.kind == hinge.kind));
            let holds_all = |path: &Vec<Hinge>| path.windows(3).any(is_three);
            if paths.iter().flatten().any(|path| holds_some(path) && !holds_all(path)) {
                continue;
            }
            let Some(joined) = self.joined(graph, three, algebroid) else { continue };
            for path in paths.iter_mut().flatten() {
                if let Some(start) = path.windows(3).position(is_three) {
                    path.splice(start..start + 3, [joined.clone()]);
                }
            }
            return;
        }
    }

    fn joined(&self, graph: &mut Graph, three: &[Hinge], algebroid: &Algebroid) -> Option<Hinge> {
        let mut angles: Vec<ExprId> = Vec::with_capacity(3);
        for hinge in three {
            let Kind::About { angle, .. } = hinge.kind else { return None };
            if has_own_rate(graph, angle, algebroid) {
                return None;
            }
            angles.push(angle);
        }
        let [first, second, third] = [0, 1, 2].map(|k| three[k].matrix);
        let both = product(graph, &first, &second);
        let matrix = product(graph, &both, &third);
        let free = FreeTurn::of(graph, &matrix.concat(), algebroid)?;
        if !free.is_everywhere(graph, algebroid) {
            return None;
        }
        let ends = (graph.zero(), graph.one());
        let others = |symbol: SymbolId| {
            let known = self.angles.iter().find(|(angle, _)| graph.as_symbol(*angle) == Some(symbol));
            known.filter(|(angle, _)| angles.contains(angle)).map(|(_, symbols)| *symbols)
        };
        let free = free.by_sines(ends, others)?;
        Some(Hinge { matrix, kind: Kind::Free(free) })
    }

    /// With symbols in the place of sines and cosines.
    pub(super) fn named(&mut self, graph: &mut Graph, values: Vector) -> Vector {
        values.map(|value| self.named.apply(graph, value))
    }

    /// With sines and cosines in the place of their symbols.
    pub(super) fn written_out(&mut self, graph: &mut Graph, values: Vector) -> Vector {
        values.map(|value| self.written.apply(graph, value))
    }

    /// The path at rest: its angles at 0, its free attitudes where they are 1. A place may depend on others as well,
    /// those of hinges beside the path: what carries it is then moved by these.
    pub(super) fn level(&self, graph: &mut Graph, path: &[Hinge]) -> Substitution {
        let mut level = Substitution::new([]);
        for hinge in path {
            match &hinge.kind {
                Kind::Fixed { .. } => {}
                Kind::About { sine, .. } => {
                    let known = self.angles.iter().find(|(_, [other, _])| other == sine);
                    if let Some((_, [sine, cosine])) = known {
                        level.insert(*sine, graph.zero());
                        level.insert(*cosine, graph.one());
                    }
                }
                Kind::Free(free) => {
                    for (symbol, value) in free.level() {
                        level.insert(*symbol, *value);
                    }
                }
            }
        }
        level
    }

    /// The derivative by a symbol.
    pub(super) fn by_symbol(&mut self, graph: &mut Graph, values: Vector, symbol: SymbolId) -> Vector {
        let known = self.by_symbols.iter().position(|(other, _)| *other == symbol);
        let index = known.unwrap_or_else(|| {
            self.by_symbols.push((symbol, Derivation::partial(graph, symbol)));
            self.by_symbols.len() - 1
        });
        values.map(|value| self.by_symbols[index].1.apply(graph, value))
    }
}

impl Kind {
    /// Whether two factors are turned by the same.
    fn shares(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::About { sine, .. }, Self::About { sine: other, .. }) => sine == other,
            (Self::Free(free), Self::Free(other)) => {
                free.level().iter().any(|(symbol, _)| other.level().iter().any(|(known, _)| known == symbol))
            }
            _ => false,
        }
    }
}

/// Whether the rate of an angle is a velocity of the state, or a number of them.
fn has_own_rate(graph: &Graph, angle: ExprId, algebroid: &Algebroid) -> bool {
    let anchor = &algebroid.anchor;
    let place =
        graph.as_symbol(angle).and_then(|symbol| anchor.coordinates.iter().position(|x| *x == symbol));
    let row = place.map(|place| anchor.entries[place].iter().filter(|entry| !graph.is_literal_zero(**entry)));
    row.is_some_and(|mut row| row.all(|entry| graph.as_number(*entry).is_some()))
}

fn product(graph: &mut Graph, a: &Square, b: &Square) -> Square {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let column: Vector = std::array::from_fn(|k| b[k][j]);
            graph.inner_product(&a[i], &column)
        })
    })
}

fn sine(graph: &mut Graph, angle: ExprId) -> Sine {
    let value = graph.apply(Function::Sin, angle);
    match graph.node(value) {
        Node::Apply(Function::Sin, own) => Sine::Of(*own),
        Node::Product { coefficient, factors } => match factors.as_ref() {
            [(base, power)] if power.is_one() && *coefficient == -Rational::ONE => match graph.node(*base) {
                Node::Apply(Function::Sin, own) => Sine::Minus(*own),
                _ => Sine::Number,
            },
            _ => Sine::Number,
        },
        _ => Sine::Number,
    }
}

/// The shortest beginning of a path that holds all angles that a place depends on.
pub(super) fn path_of_point<'p>(
    graph: &Graph,
    position: &Vector,
    paths: impl Iterator<Item = &'p Vec<Hinge>>,
) -> Vec<Hinge> {
    let occurring = graph.symbols_in(position);
    let is_in = |hinge: &&Hinge| hinge.is_turned_by(|symbol| occurring.contains(symbol));
    let mut best: (usize, Vec<Hinge>) = (0, Vec::new());
    for path in paths {
        let found = path.iter().filter(is_in).count();
        if found > best.0 {
            let last = path.iter().rposition(|hinge| is_in(&hinge)).map_or(0, |last| last + 1);
            best = (found, path[..last].to_vec());
        }
    }
    best.1
}

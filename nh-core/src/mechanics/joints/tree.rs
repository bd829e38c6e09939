//! Which body carries which, found from where the bodies are.
//!
//! The attitude of a body is a product of rotations, and its place p a sum of what these turn. Two bodies share the first
//! factors of their attitudes, as far as they turn about the same axes: a tree. What a factor turns is found where
//! all angles of the attitude are 0: there ∂p/∂a = n × C, and C is all that is carried behind the axis n, up to a part
//! along n, which is counted among what it carries. Other angles, as that of an upper arm where the lower one has its
//! attitude from the angle that it makes with space, move what carries the body like lengths.

use super::inertia::Inertia;
use super::sheet::{Sheet, Square, Vector, transposed};
use super::turning::Turning;
use crate::algebra::{Derivation, Function, Graph, Node, Rational, Substitution};
use crate::id::{ExprId, SymbolId};
use crate::limits;
use crate::mechanics::{Attitude, Body, Turn, body};

/// Axes that are turned and moved in those of another frame.
pub(super) struct Frame {
    /// The frame that carries it; space if none.
    pub(super) parent: Option<usize>,
    pub(super) turning: Turning,
    /// The axis of the rotation, and the angle.
    pub(super) about: Option<(Vector, ExprId)>,
    /// The origin, in the axes of the parent.
    pub(super) offset: Vector,
    /// Of the bodies that are fixed in it.
    pub(super) inertia: Inertia,
}

/// Frames, each after the one that carries it.
pub(super) struct Tree {
    pub(super) frames: Vec<Frame>,
}

/// A rotation about an axis in the declaration.
#[derive(Clone)]
struct Hinge {
    axis: Vector,
    angle: ExprId,
    matrix: Vec<ExprId>,
    /// What stands for the sine of the angle, unless that is a number.
    sine: Option<SymbolId>,
}

/// The sine of an angle with its sign: sin(−a) is −sin(a).
enum Sine {
    Number,
    Of(ExprId),
    Minus(ExprId),
}

struct Hinges {
    /// Angles, and the symbols of their sines and cosines.
    angles: Vec<(ExprId, [SymbolId; 2])>,
    /// Symbols for sines and cosines.
    named: Substitution,
    /// Sines and cosines for the symbols.
    written: Substitution,
    by_sines: Vec<(SymbolId, Derivation)>,
}

impl Tree {
    /// `None` where a body is not in space, or an attitude is no product of rotations about axes that stand still in the
    /// factors before them.
    pub(super) fn of(sheet: &mut Sheet, bodies: &[Body], coordinates: &[SymbolId]) -> Option<Self> {
        let empty = || Substitution::new([]);
        let mut hinges =
            Hinges { angles: Vec::new(), named: empty(), written: empty(), by_sines: Vec::new() };
        let mut paths: Vec<Option<Vec<Hinge>>> = Vec::with_capacity(bodies.len());
        for body in bodies {
            paths.push(match &body.attitude {
                Attitude::None => None,
                Attitude::Angle(_) => return None,
                Attitude::Turns(turns) => Some(hinges.path(sheet.graph, turns, coordinates)?),
            });
        }
        let mut tree = Self { frames: Vec::new() };
        for (body, path) in bodies.iter().zip(&paths) {
            let position: Vector = body.position.as_slice().try_into().ok()?;
            let position = position.map(|entry| hinges.named.apply(sheet.graph, entry));
            let path = match path {
                Some(path) => path.clone(),
                None => path_of_point(sheet.graph, &position, paths.iter().flatten()),
            };
            tree.add(sheet, &mut hinges, (body, &position, &path), coordinates);
        }
        Some(tree)
    }

    /// Adds a body, and the frames that carry it.
    fn add(
        &mut self,
        sheet: &mut Sheet,
        hinges: &mut Hinges,
        (body, position, path): (&Body, &Vector, &[Hinge]),
        coordinates: &[SymbolId],
    ) {
        // what is carried behind all hinges so far, in the axes of space where the angles of the path are 0
        let mut level = hinges.level(sheet.graph, path);
        let mut behind = at_level(sheet.graph, &mut level, *position);
        let (zero, one) = (sheet.graph.zero(), sheet.graph.one());
        let unit = |k: usize| std::array::from_fn(|j| if j == k { one } else { zero });
        // the axes of the frame there
        let mut axes: Square = std::array::from_fn(unit);
        let mut frame = None;
        for hinge in path {
            let mut offset = sheet.zero();
            if let Some(sine) = hinge.sine {
                let axis = sheet.image(&axes, &hinge.axis);
                let slope = hinges.by_sine(sheet.graph, *position, sine);
                let slope = at_level(sheet.graph, &mut level, slope);
                // C = −n × (n × C) across n
                let beyond = sheet.cross(&slope, &axis);
                let along = sheet.dot(&axis, &behind);
                let along = sheet.scaled(along, axis);
                let across = sheet.difference(behind, along);
                let step = sheet.difference(across, beyond);
                let step = sheet.simplified(step);
                behind = sheet.difference(behind, step);
                behind = sheet.simplified(behind);
                offset = sheet.image(&transposed(&axes), &step);
                offset = hinges.written_out(sheet.graph, offset);
            } else {
                let matrix: Square =
                    std::array::from_fn(|i| std::array::from_fn(|j| hinge.matrix[3 * i + j]));
                let columns = transposed(&matrix);
                axes = transposed(&columns.map(|column| sheet.image(&axes, &column)));
            }
            frame = Some(self.frame(sheet, frame, hinge, offset));
        }
        let centre = sheet.image(&transposed(&axes), &behind);
        let mut centre = hinges.written_out(sheet.graph, centre);
        let moves = |graph: &Graph| centre.iter().any(|entry| graph.depends_on(*entry, coordinates));
        let place = match frame {
            Some(frame) if !moves(sheet.graph) => frame,
            _ => {
                let offset = std::mem::replace(&mut centre, [zero; 3]);
                self.shifted(sheet, frame, offset)
            }
        };
        let inertia = of_body(sheet, body, &centre);
        let whole = self.frames[place].inertia.plus(sheet, &inertia);
        self.frames[place].inertia = whole;
    }

    fn frame(&mut self, sheet: &mut Sheet, parent: Option<usize>, hinge: &Hinge, offset: Vector) -> usize {
        let about = Some((hinge.axis, hinge.angle));
        limits::spend(1 + self.frames.len() / 16);
        let known = self
            .frames
            .iter()
            .position(|frame| frame.parent == parent && frame.about == about && frame.offset == offset);
        known.unwrap_or_else(|| {
            let turning = Turning::about(sheet.graph, &hinge.axis, hinge.angle, &hinge.matrix);
            let inertia = Inertia::none(sheet);
            self.frames.push(Frame { parent, turning, about, offset, inertia });
            self.frames.len() - 1
        })
    }

    /// A frame with the same axes elsewhere.
    fn shifted(&mut self, sheet: &mut Sheet, parent: Option<usize>, offset: Vector) -> usize {
        let known = self
            .frames
            .iter()
            .position(|frame| frame.parent == parent && frame.about.is_none() && frame.offset == offset);
        known.unwrap_or_else(|| {
            let inertia = Inertia::none(sheet);
            self.frames.push(Frame { parent, turning: Turning::None, about: None, offset, inertia });
            self.frames.len() - 1
        })
    }
}

impl Hinges {
    fn path(&mut self, graph: &mut Graph, turns: &[Turn], coordinates: &[SymbolId]) -> Option<Vec<Hinge>> {
        let mut path: Vec<Hinge> = Vec::with_capacity(turns.len());
        for turn in turns {
            let (axis, angle) = turn.about.as_ref()?;
            let (mut axis, mut angle): (Vector, ExprId) = (axis.as_slice().try_into().ok()?, *angle);
            if axis.iter().any(|entry| graph.depends_on(*entry, coordinates)) {
                return None;
            }
            let sine = match sine(graph, angle) {
                Sine::Number => None,
                Sine::Of(own) => {
                    angle = own;
                    Some(self.symbol(graph, angle))
                }
                Sine::Minus(own) => {
                    angle = own;
                    axis = axis.map(|entry| graph.formula(-entry));
                    Some(self.symbol(graph, angle))
                }
            };
            if sine.is_some() && path.iter().any(|before| before.sine == sine) {
                return None;
            }
            path.push(Hinge { axis, angle, matrix: turn.matrix.clone(), sine });
        }
        Some(path)
    }

    fn symbol(&mut self, graph: &mut Graph, angle: ExprId) -> SymbolId {
        if let Some((_, known)) = self.angles.iter().find(|(other, _)| *other == angle) {
            return known[0];
        }
        let [sine, cosine] = ["sine", "cosine"].map(|name| graph.new_symbol(name));
        let images = [sine, cosine].map(|symbol| graph.symbol(symbol));
        let nodes = [Function::Sin, Function::Cos].map(|function| graph.apply(function, angle));
        for ((node, image), symbol) in nodes.into_iter().zip(images).zip([sine, cosine]) {
            self.named.insert_node(node, image);
            self.written.insert(symbol, node);
        }
        self.angles.push((angle, [sine, cosine]));
        sine
    }

    /// The angles of a path at 0. A place may depend on others as well, those of hinges beside the path: what carries it
    /// is then moved by these.
    fn level(&self, graph: &mut Graph, path: &[Hinge]) -> Substitution {
        let mut level = Substitution::new([]);
        for (_, [sine, cosine]) in &self.angles {
            if path.iter().any(|hinge| hinge.sine == Some(*sine)) {
                level.insert(*sine, graph.zero());
                level.insert(*cosine, graph.one());
            }
        }
        level
    }

    /// With sines and cosines in the place of their symbols.
    fn written_out(&mut self, graph: &mut Graph, values: Vector) -> Vector {
        values.map(|value| self.written.apply(graph, value))
    }

    /// The derivative by the sine of an angle.
    fn by_sine(&mut self, graph: &mut Graph, values: Vector, sine: SymbolId) -> Vector {
        let known = self.by_sines.iter().position(|(symbol, _)| *symbol == sine);
        let index = known.unwrap_or_else(|| {
            self.by_sines.push((sine, Derivation::partial(graph, sine)));
            self.by_sines.len() - 1
        });
        values.map(|value| self.by_sines[index].1.apply(graph, value))
    }
}

fn at_level(graph: &mut Graph, level: &mut Substitution, values: Vector) -> Vector {
    values.map(|value| {
        let value = level.apply(graph, value);
        graph.simplify(value)
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
fn path_of_point<'p>(
    graph: &Graph,
    position: &Vector,
    paths: impl Iterator<Item = &'p Vec<Hinge>>,
) -> Vec<Hinge> {
    let occurring = graph.symbols_in(position);
    let is_in = |hinge: &Hinge| hinge.sine.is_some_and(|sine| occurring.contains(&sine));
    let mut best: (usize, Vec<Hinge>) = (0, Vec::new());
    for path in paths {
        let found = path.iter().filter(|hinge| is_in(hinge)).count();
        if found > best.0 {
            let last = path.iter().rposition(is_in).map_or(0, |last| last + 1);
            best = (found, path[..last].to_vec());
        }
    }
    best.1
}

/// About the origin of a frame in which the centre of mass is at d.
fn of_body(sheet: &mut Sheet, body: &Body, centre: &Vector) -> Inertia {
    let zero = sheet.graph.zero();
    let mut turning: Square = match &body.inertia {
        body::Inertia::None => [[zero; 3]; 3],
        body::Inertia::Isotropic(value) => round(zero, [*value; 3]),
        body::Inertia::Diagonal(values) => round(zero, [values[0], values[1], values[2]]),
        // what is not symmetric has no power
        body::Inertia::Full(values) => std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let (one, other) = (values[3 * i + j], values[3 * j + i]);
                if one == other { one } else { sheet.graph.formula((one + other) / 2) }
            })
        }),
    };
    let moment = sheet.scaled(body.mass, *centre);
    let squares: Vector = std::array::from_fn(|k| sheet.graph.formula(moment[k] * centre[k]));
    for i in 0..3 {
        let others = sheet.graph.formula(squares[(i + 1) % 3] + squares[(i + 2) % 3]);
        for j in 0..3 {
            turning[i][j] = if i == j {
                sheet.graph.formula(turning[i][i] + others)
            } else {
                sheet.graph.formula(turning[i][j] - moment[i.min(j)] * centre[i.max(j)])
            };
        }
    }
    Inertia::Rigid { mass: body.mass, moment, turning }
}

fn round(zero: ExprId, values: Vector) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { values[i] } else { zero }))
}

//! Which body carries which, found from where the bodies are.
//!
//! The attitude of a body is a product of rotations, and its place p a sum of what these turn. Two bodies share the first
//! factors of their attitudes, as far as they turn about the same axes: a tree. What a factor turns is found where
//! all angles of the attitude are 0: there ∂p/∂a = n × C, and C is all that is carried behind the axis n, up to a part
//! along n, which is counted among what it carries. Other angles, as that of an upper arm where the lower one has its
//! attitude from the angle that it makes with space, move what carries the body like lengths.

use super::free_turn::FreeTurn;
use super::hinges::{Hinge, Hinges, Kind, path_of_point};
use super::inertia::Inertia;
use super::sheet::{Sheet, Square, Vector, transposed};
use super::turning::Turning;
use crate::algebra::{Graph, Substitution};
use crate::geometry::Algebroid;
use crate::id::{ExprId, Id};
use crate::limits;
use crate::mechanics::{Body, body};

/// Axes that are turned and moved in those of another frame.
pub(super) struct Frame {
    /// The frame that carries it; space if none.
    pub(super) parent: Option<usize>,
    pub(super) turning: Turning,
    /// How it turns.
    pub(super) spin: Spin,
    /// The origin, in the axes of the parent.
    pub(super) offset: Vector,
    /// Sections that move the origin along its own axes, with the directions; those of the parent otherwise.
    pub(super) slide: Vec<(usize, Vector)>,
    /// Of the bodies that are fixed in it.
    pub(super) inertia: Inertia,
}

/// How a frame turns in the one that carries it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Spin {
    /// Its axes are parallel.
    None,
    /// About an axis by an angle.
    About(Vector, ExprId),
    /// By velocities of the state.
    Free(FreeTurn),
}

/// Frames, each after the one that carries it.
pub(super) struct Tree {
    pub(super) frames: Vec<Frame>,
}

impl Tree {
    /// `None` where a body is not in space, or an attitude is no product of rotations about axes that stand still in the
    /// factors before them, and of such that turn as velocities of the state.
    pub(super) fn of(sheet: &mut Sheet, bodies: &[Body], algebroid: &Algebroid) -> Option<Self> {
        let mut hinges = Hinges::new();
        let paths = hinges.paths(sheet.graph, bodies, algebroid)?;
        let mut tree = Self { frames: Vec::new() };
        for (body, path) in bodies.iter().zip(&paths) {
            let position: Vector = body.position.as_slice().try_into().ok()?;
            let position = hinges.named(sheet.graph, position);
            let path = match path {
                Some(path) => path.clone(),
                None => path_of_point(sheet.graph, &position, paths.iter().flatten()),
            };
            tree.add(sheet, &mut hinges, (body, &position, &path), algebroid);
        }
        Some(tree)
    }

    /// Adds a body, and the frames that carry it.
    fn add(
        &mut self,
        sheet: &mut Sheet,
        hinges: &mut Hinges,
        (body, position, path): (&Body, &Vector, &[Hinge]),
        algebroid: &Algebroid,
    ) {
        let coordinates = &algebroid.anchor.coordinates;
        // what is carried behind all hinges so far, in the axes of space where the path is at rest
        let mut level = hinges.level(sheet.graph, path);
        let mut behind = at_level(sheet.graph, &mut level, *position);
        let (zero, one) = (sheet.graph.zero(), sheet.graph.one());
        let unit = |k: usize| std::array::from_fn(|j| if j == k { one } else { zero });
        // the axes of the frame there
        let mut axes: Square = std::array::from_fn(unit);
        let mut frame = None;
        for hinge in path {
            let carried = match &hinge.kind {
                Kind::Fixed { .. } => {
                    let columns = transposed(&hinge.matrix);
                    axes = transposed(&columns.map(|column| sheet.image(&axes, &column)));
                    behind
                }
                Kind::About { axis, sine, .. } => {
                    let axis = sheet.image(&axes, axis);
                    let slope = hinges.by_symbol(sheet.graph, *position, *sine);
                    let slope = at_level(sheet.graph, &mut level, slope);
                    // C = −n × (n × C) across n
                    let across = sheet.cross(&slope, &axis);
                    let along = sheet.dot(&axis, &behind);
                    let along = sheet.scaled(along, axis);
                    sheet.sum(along, across)
                }
                Kind::Free(free) => {
                    // C = −½ Σ n_k × (n_k × C)
                    let mut twice = sheet.zero();
                    for (k, axis) in transposed(&axes).iter().enumerate() {
                        for (symbol, speed) in free.tangent(k) {
                            let slope = hinges.by_symbol(sheet.graph, *position, symbol);
                            let slope = at_level(sheet.graph, &mut level, slope);
                            let slope = sheet.scaled(speed, slope);
                            let across = sheet.cross(&slope, axis);
                            twice = sheet.sum(twice, across);
                        }
                    }
                    twice.map(|entry| sheet.graph.formula(entry / 2))
                }
            };
            let step = sheet.difference(behind, carried);
            let step = sheet.simplified(step);
            behind = sheet.simplified(carried);
            let offset = sheet.image(&transposed(&axes), &step);
            let offset = hinges.written_out(sheet.graph, offset);
            frame = Some(self.hinged(sheet, frame, (hinge, offset), algebroid));
        }
        let centre = sheet.image(&transposed(&axes), &behind);
        let mut centre = hinges.written_out(sheet.graph, centre);
        let moves = |graph: &Graph| centre.iter().any(|entry| graph.depends_on(*entry, coordinates));
        let place = match frame {
            Some(frame) if !moves(sheet.graph) => frame,
            _ => {
                let offset = std::mem::replace(&mut centre, [zero; 3]);
                self.frame(sheet, frame, (Turning::None, Spin::None), (offset, Vec::new()))
            }
        };
        let inertia = of_body(sheet, body, &centre);
        let whole = self.frames[place].inertia.plus(sheet, &inertia);
        self.frames[place].inertia = whole;
    }

    /// The frame behind a hinge that stands at an offset.
    fn hinged(
        &mut self,
        sheet: &mut Sheet,
        parent: Option<usize>,
        (hinge, offset): (&Hinge, Vector),
        algebroid: &Algebroid,
    ) -> usize {
        match &hinge.kind {
            Kind::Fixed { axis, angle } | Kind::About { axis, angle, .. } => {
                let turning = Turning::about(sheet.graph, axis, *angle, &hinge.matrix);
                self.frame(sheet, parent, (turning, Spin::About(*axis, *angle)), (offset, Vec::new()))
            }
            Kind::Free(free) => {
                let turning = Turning::Matrix(hinge.matrix.map(|row| sheet.named_all("turn", row)));
                let spin = Spin::Free(free.clone());
                let slide = along_own_axes(sheet, &hinge.matrix, &offset, algebroid).unwrap_or_default();
                self.frame(sheet, parent, (turning, spin), (offset, slide))
            }
        }
    }

    /// The frame of this motion, which may be known.
    fn frame(
        &mut self,
        sheet: &mut Sheet,
        parent: Option<usize>,
        (turning, spin): (Turning, Spin),
        (offset, slide): (Vector, Vec<(usize, Vector)>),
    ) -> usize {
        limits::spend(1 + self.frames.len() / 16);
        let is_same = |frame: &Frame| frame.parent == parent && frame.spin == spin && frame.offset == offset;
        self.frames.iter().position(is_same).unwrap_or_else(|| {
            let inertia = Inertia::none(sheet);
            self.frames.push(Frame { parent, turning, spin, offset, slide, inertia });
            self.frames.len() - 1
        })
    }
}

/// The sections that move a place along the axes E, with the axes; `None` where it moves in another way.
fn along_own_axes(
    sheet: &mut Sheet,
    matrix: &Square,
    offset: &Vector,
    algebroid: &Algebroid,
) -> Option<Vec<(usize, Vector)>> {
    let (zero, one) = (sheet.graph.zero(), sheet.graph.one());
    let mut slide = Vec::new();
    for alpha in algebroid.sections() {
        let mut along = algebroid.anchor.along(alpha);
        let moved = offset.map(|entry| along.apply(sheet.graph, entry));
        let moved = sheet.simplified(moved);
        if sheet.is_zero(&moved) {
            continue;
        }
        let mut columns = transposed(matrix).into_iter();
        let axis = columns.position(|column| sheet.simplified(column) == moved)?;
        slide.push((alpha.index(), std::array::from_fn(|k| if k == axis { one } else { zero })));
    }
    Some(slide)
}

fn at_level(graph: &mut Graph, level: &mut Substitution, values: Vector) -> Vector {
    values.map(|value| {
        let value = level.apply(graph, value);
        graph.simplify(value)
    })
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

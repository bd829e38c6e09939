//! How frames move: angular velocities, and accelerations where those of the state vanish.

use super::free_turn::Axes;
use super::inertia::Twist;
use super::sheet::{Sheet, Square, Vector};
use super::tree::{Frame, Spin, Tree};
use crate::algebra::Derivation;
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::LagrangianSystem;

/// The motion of a frame, in its own axes.
pub(super) struct Motion {
    /// How it moves in the frame that carries it, for each velocity of the state that moves it there.
    pub(super) columns: Vec<(usize, Twist)>,
    /// ω.
    pub(super) rate: Vector,
    /// ω̇ where v̇ = 0.
    pub(super) turned: Vector,
    /// The acceleration of the origin, less that of free fall, where v̇ = 0.
    pub(super) moved: Vector,
}

/// A vector along the motion: the coefficients of v, the rest of the rate, and its change where v̇ = 0.
struct Rate {
    /// For each component.
    columns: [Vec<ExprId>; 3],
    value: Vector,
    change: Vector,
}

/// How the origin of a frame moves in its carrier.
struct Shift {
    /// In the axes of the frame.
    columns: [Vec<ExprId>; 3],
    /// What its rate adds to its acceleration where v̇ = 0, in the axes of the carrier.
    inner: Vector,
    /// The same in the axes of the frame.
    outer: Vector,
}

/// Rates of functions of the state along the motion.
struct Rates<'s> {
    velocities: &'s [SymbolId],
    /// Those of all sections.
    whole: &'s [ExprId],
    along: Derivation,
}

impl Rates<'_> {
    /// Of a vector; `None` where it is not linear in the velocities.
    fn of(&mut self, sheet: &mut Sheet, values: &Vector) -> Option<Rate> {
        let value = values.map(|entry| self.along.apply(sheet.graph, entry));
        self.with_change(sheet, value)
    }

    /// Of sections along directions.
    fn of_sections(&mut self, sheet: &mut Sheet, directions: &[(usize, Vector)]) -> Option<Rate> {
        let mut value = sheet.zero();
        for (alpha, direction) in directions {
            let part = sheet.scaled(self.whole[*alpha], *direction);
            value = sheet.sum(value, part);
        }
        self.with_change(sheet, value)
    }

    fn with_change(&mut self, sheet: &mut Sheet, value: Vector) -> Option<Rate> {
        let change = value.map(|entry| self.along.apply(sheet.graph, entry));
        let forms = value.map(|entry| sheet.graph.linear_form(entry, self.velocities).ok());
        let [Some(x), Some(y), Some(z)] = forms else { return None };
        Some(Rate { columns: [x, y, z].map(|form| form.coefficients), value, change })
    }

    /// ω in the carrier, in the axes of the frame.
    fn spin(&mut self, sheet: &mut Sheet, frame: &Frame) -> Option<Rate> {
        match &frame.spin {
            Spin::None => self.of_sections(sheet, &[]),
            Spin::About(axis, angle) => {
                let none = sheet.graph.zero();
                let turn = self.of(sheet, &[*angle, none, none])?;
                let own = sheet.named("rate", turn.value[0]);
                Some(Rate {
                    columns: axis.map(|entry| {
                        turn.columns[0].iter().map(|column| sheet.graph.formula(column * entry)).collect()
                    }),
                    value: sheet.scaled(own, *axis),
                    change: sheet.scaled(turn.change[0], *axis),
                })
            }
            Spin::Free(free) => {
                let rate = self.of_sections(sheet, &free.rates)?;
                Some(match free.axes {
                    Axes::Own => rate,
                    Axes::Carrier => outward(sheet, frame, &rate),
                })
            }
        }
    }

    /// Of the origin; `before` and `behind` it are ω of the carrier in its axes and in those of the frame, and `spun` is the
    /// rate of the frame in its carrier.
    fn shift(
        &mut self,
        sheet: &mut Sheet,
        frame: &Frame,
        [before, behind, spun]: [&Vector; 3],
    ) -> Option<Shift> {
        if frame.slide.is_empty() {
            let rate = self.of(sheet, &frame.offset)?;
            let inner = twice_crossed(sheet, before, &rate.value);
            let Rate { columns, change, .. } = outward(sheet, frame, &rate);
            return Some(Shift { columns, inner, outer: change });
        }
        // ṙ = E u, Eᵀ r̈ = u̇ + w × u
        let Rate { columns, value, change } = self.of_sections(sheet, &frame.slide)?;
        let own = sheet.cross(spun, &value);
        let outer = twice_crossed(sheet, behind, &value);
        let outer = sheet.sum(outer, own);
        Some(Shift { columns, inner: sheet.zero(), outer: sheet.sum(outer, change) })
    }
}

fn twice_crossed(sheet: &mut Sheet, a: &Vector, b: &Vector) -> Vector {
    let crossed = sheet.cross(a, b);
    crossed.map(|entry| sheet.graph.formula(2 * entry))
}

/// A rate in the carrier's axes, in those of the frame.
fn outward(sheet: &mut Sheet, frame: &Frame, rate: &Rate) -> Rate {
    let mut columns: [Vec<ExprId>; 3] = Default::default();
    for a in 0..rate.columns[0].len() {
        let column: Vector = std::array::from_fn(|k| rate.columns[k][a]);
        let column = frame.turning.outward(sheet, column);
        let column = sheet.simplified(column);
        columns.iter_mut().zip(column).for_each(|(row, entry)| row.push(entry));
    }
    let [value, change] = [rate.value, rate.change].map(|part| frame.turning.outward(sheet, part));
    Rate { columns, value, change: sheet.simplified(change) }
}

/// The motion of every frame; `None` where rates are not linear in the velocities.
pub(super) fn motions(
    sheet: &mut Sheet,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    (tree, fall): (&Tree, Vector),
) -> Option<Vec<Motion>> {
    let along = system.algebroid.along(sheet.graph, &distribution.velocity, &system.clock);
    let mut rates = Rates { velocities: &distribution.independent, whole: &distribution.velocity, along };
    let mut found: Vec<Motion> = Vec::with_capacity(tree.frames.len());
    let weight = fall.map(|entry| sheet.graph.formula(-entry));
    let none = sheet.zero();
    for frame in &tree.frames {
        let carrier = frame.parent.map(|parent| &found[parent]);
        let (carried_rate, carried_turn, carried_move) =
            carrier.map_or((none, none, weight), |motion| (motion.rate, motion.turned, motion.moved));
        let spin = rates.spin(sheet, frame)?;
        // 1. ω = Eᵀω' + w
        let outer = frame.turning.outward(sheet, carried_rate);
        let shift = rates.shift(sheet, frame, [&carried_rate, &outer, &spin.value])?;
        let columns = columns(sheet, &spin.columns, &shift.columns);
        let rate = sheet.sum(outer, spin.value);
        let rate = sheet.named_all("omega", rate);
        // 2. ω̇ = Eᵀω̇' + ω × w + ẇ
        let turn = frame.turning.outward(sheet, carried_turn);
        let gyroscopic = sheet.cross(&rate, &spin.value);
        let turned = sheet.sum(turn, gyroscopic);
        let turned = sheet.sum(turned, spin.change);
        let turned = sheet.named_all("turned", turned);
        // 3. Eᵀ(a' + ω̇' × r + ω' × (ω' × r) + 2 ω' × ṙ + r̈)
        let carried = accelerations(sheet, &carried_rate, &carried_turn);
        let swung = sheet.image(&carried, &frame.offset);
        let moved = sheet.sum(carried_move, swung);
        let moved = sheet.sum(moved, shift.inner);
        let moved = frame.turning.outward(sheet, moved);
        let moved = sheet.sum(moved, shift.outer);
        let moved = sheet.named_all("moved", moved);
        found.push(Motion { columns, rate, turned, moved });
    }
    Some(found)
}

/// The velocities that move a frame, with how they turn and shift it.
fn columns(sheet: &mut Sheet, turns: &[Vec<ExprId>; 3], shifts: &[Vec<ExprId>; 3]) -> Vec<(usize, Twist)> {
    let mut columns = Vec::new();
    for a in 0..turns[0].len() {
        let way: Twist = [turns, shifts].map(|rows| std::array::from_fn(|k| rows[k][a]));
        if way.iter().any(|part| !sheet.is_zero(part)) {
            columns.push((a, way.map(|part| sheet.named_all("way", part))));
        }
    }
    columns
}

/// U with U r = ω̇ × r + ω × (ω × r): U_ij = ω_i ω_j and the ω̇ beside, less ω² on the diagonal.
pub(super) fn accelerations(sheet: &mut Sheet, rate: &Vector, turned: &Vector) -> Square {
    let hat = sheet.hat(turned);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if i == j {
                let (k, l) = ((i + 1) % 3, (i + 2) % 3);
                sheet.graph.formula(-(rate[k] * rate[k] + rate[l] * rate[l]))
            } else {
                sheet.graph.formula(rate[i] * rate[j] + hat[i][j])
            }
        })
    })
}

/// (ω̇, a) of a body with the inertia of which Θ, h and m are given: moment about the origin and force that it takes.
pub(super) fn balance(
    sheet: &mut Sheet,
    motion: &Motion,
    (mass, moment, theta): (ExprId, &Vector, &Square),
) -> Twist {
    let Motion { rate, turned, moved, .. } = motion;
    let u = accelerations(sheet, rate, turned);
    let swung = sheet.image(&u, moment);
    let straight = sheet.scaled(mass, *moved);
    let force = sheet.sum(straight, swung);
    let lever = sheet.cross(moment, moved);
    let turning: Vector = std::array::from_fn(|x| {
        let (y, z) = ((x + 1) % 3, (x + 2) % 3);
        // Θ ω̇ + ω × Θω
        let graph = &mut *sheet.graph;
        let own = graph.formula(theta[x][x] * turned[x] + (theta[z][z] - theta[y][y]) * (rate[y] * rate[z]));
        let beside = graph.formula(theta[x][z] * u[y][x] - theta[x][y] * u[z][x]);
        let square = graph.formula(theta[y][z] * (rate[y] * rate[y] - rate[z] * rate[z]));
        graph.formula(own + beside + square)
    });
    let torque = sheet.sum(turning, lever);
    [sheet.named_all("torque", torque), sheet.named_all("force", force)]
}

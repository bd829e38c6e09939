//! How frames move: angular velocities, and accelerations where those of the state vanish.

use super::inertia::Twist;
use super::sheet::{Sheet, Square, Vector};
use super::tree::Tree;
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
    columns: Vec<Vec<ExprId>>,
    value: Vec<ExprId>,
    change: Vec<ExprId>,
}

/// The motion of every frame; `None` where rates are not linear in the velocities.
pub(super) fn motions(
    sheet: &mut Sheet,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    (tree, fall): (&Tree, Vector),
) -> Option<Vec<Motion>> {
    let velocities = &distribution.independent;
    let mut along = system.algebroid.along(sheet.graph, &distribution.velocity, &system.clock);
    let mut rate_of = |sheet: &mut Sheet, values: &[ExprId]| -> Option<Rate> {
        let graph = &mut *sheet.graph;
        let value = along.apply_all(graph, values);
        let change = along.apply_all(graph, &value);
        let columns =
            value.iter().map(|value| Some(graph.linear_form(*value, velocities).ok()?.coefficients));
        let columns = columns.collect::<Option<Vec<_>>>()?;
        Some(Rate { columns, value, change })
    };
    let mut found: Vec<Motion> = Vec::with_capacity(tree.frames.len());
    let weight = fall.map(|entry| sheet.graph.formula(-entry));
    let none = sheet.zero();
    for frame in &tree.frames {
        let carrier = frame.parent.map(|parent| &found[parent]);
        let (carried_rate, carried_turn, carried_move) =
            carrier.map_or((none, none, weight), |motion| (motion.rate, motion.turned, motion.moved));
        let axis = frame.about.map_or(none, |(axis, _)| axis);
        let angle = frame.about.map_or(none[0], |(_, angle)| angle);
        let turn = rate_of(sheet, &[angle])?;
        let shift = rate_of(sheet, &frame.offset)?;
        let columns = columns(sheet, velocities, (&frame.turning, axis), (&turn, &shift));
        // 1. ω = Eᵀω' + n ȧ
        let own = sheet.named("rate", turn.value[0]);
        let own = sheet.scaled(own, axis);
        let outer = frame.turning.outward(sheet, carried_rate);
        let rate = sheet.sum(outer, own);
        let rate = sheet.named_all("omega", rate);
        // 2. ω̇ = Eᵀω̇' + ω × n ȧ + n ä
        let outer = frame.turning.outward(sheet, carried_turn);
        let gyroscopic = sheet.cross(&rate, &own);
        let turned = sheet.sum(outer, gyroscopic);
        let change = sheet.scaled(turn.change[0], axis);
        let turned = sheet.sum(turned, change);
        let turned = sheet.named_all("turned", turned);
        // 3. Eᵀ(a' + ω̇' × r + ω' × (ω' × r) + 2 ω' × ṙ + r̈)
        let carried = accelerations(sheet, &carried_rate, &carried_turn);
        let swung = sheet.image(&carried, &frame.offset);
        let moved = sheet.sum(carried_move, swung);
        let shifted: Vector = shift.value.as_slice().try_into().ok()?;
        let crossed = sheet.cross(&carried_rate, &shifted);
        let twice = crossed.map(|entry| sheet.graph.formula(2 * entry));
        let moved = sheet.sum(moved, twice);
        let moved = frame.turning.outward(sheet, moved);
        let change: Vector = shift.change.as_slice().try_into().ok()?;
        let change = frame.turning.outward(sheet, change);
        let change = sheet.simplified(change);
        let moved = sheet.sum(moved, change);
        let moved = sheet.named_all("moved", moved);
        found.push(Motion { columns, rate, turned, moved });
    }
    Some(found)
}

fn columns(
    sheet: &mut Sheet,
    velocities: &[SymbolId],
    (turning, axis): (&super::turning::Turning, Vector),
    (turn, shift): (&Rate, &Rate),
) -> Vec<(usize, Twist)> {
    let mut columns = Vec::new();
    for a in 0..velocities.len() {
        let turned = sheet.scaled(turn.columns[0][a], axis);
        let shifted: Vector = std::array::from_fn(|k| shift.columns[k][a]);
        let shifted = turning.outward(sheet, shifted);
        let shifted = sheet.simplified(shifted);
        if !sheet.is_zero(&turned) || !sheet.is_zero(&shifted) {
            columns.push((a, [turned, shifted].map(|part| sheet.named_all("way", part))));
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

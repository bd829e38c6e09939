//! Where an event function comes near to zero and turns, between two points that show one sign.

use super::{Side, Station, Within, crossing, side};
use crate::{IntegrationError, Real};

/// A time and the value of a function there.
type Point<T> = (T, T);

/// A turning point that a parabola promises within this share of the nearer end is looked at.
const NEAR: f64 = 0.5;
/// How often the parabola is drawn anew.
const REFINEMENTS: u32 = 3;

/// The extremum of the parabola through three points, if it bends away from zero.
fn turn<T: Real>(from: Side, [a, b, c]: [Point<T>; 3]) -> Option<Point<T>> {
    let first = (b.1 - a.1) / (b.0 - a.0);
    let second = (c.1 - b.1) / (c.0 - b.0);
    let bend = (second - first) / (c.0 - a.0);
    let bends_away = match from {
        Side::Above => bend > T::ZERO,
        Side::Below => bend < T::ZERO,
        Side::On | Side::OnFromBelow | Side::OnFromAbove => false,
    };
    let slope = bend.mul_add(b.0 - a.0, first);
    let offset = -slope / (bend + bend);
    let value = (slope * T::from_f64(0.5)).mul_add(offset, b.1);
    (bends_away && offset.is_finite()).then_some((b.0 + offset, value))
}

fn within<T: Real>(a: T, time: T, b: T) -> bool {
    (a < time && time < b) || (b < time && time < a)
}

/// A time between `a` and `b`, where a function has the same sign, at which it has the other one; looked for where
/// the parabolas through these points and their neighbours turn.
fn other_side<T: Real>(
    from: Side,
    [before, a, b, after]: [Option<Point<T>>; 4],
    value_at: Within<'_, T, T>,
) -> Result<Option<T>, IntegrationError> {
    let (Some(a), Some(b)) = (a, b) else { return Ok(None) };
    for mut triple in
        [before.map(|before| [before, a, b]), after.map(|after| [a, b, after])].into_iter().flatten()
    {
        for _ in 0..REFINEMENTS {
            let Some((time, promised)) = turn(from, triple) else { break };
            let nearer = a.1.abs().min(b.1.abs()) * T::from_f64(NEAR);
            let comes_near = promised.abs() <= nearer || crossing(from, promised).is_some();
            if !comes_near || !within(a.0, time, b.0) {
                break;
            }
            let value = value_at(time)?;
            if crossing(from, value).is_some() {
                return Ok(Some(time));
            }
            triple = [a, (time, value), b];
        }
    }
    Ok(None)
}

/// The times between two stations at which functions show that they have changed their sign twice; the stations
/// around these come with them.
pub(super) fn double_changes<T: Real, const N: usize>(
    sides: &[Side; N],
    stations: [Option<&Station<T, N>>; 4],
    values_at: Within<'_, [T; N], T>,
) -> Result<[Option<T>; N], IntegrationError> {
    let mut times = [None; N];
    for (index, (time, from)) in times.iter_mut().zip(sides).enumerate() {
        let points =
            stations.map(|station| station.and_then(|s| s.values.get(index).map(|value| (s.time, *value))));
        if *from == Side::On || points[2].is_none_or(|(_, value)| side(value) != *from) {
            continue;
        }
        let value_at = |time| values_at(time).map(|values| values.get(index).copied().unwrap_or(T::ZERO));
        *time = other_side(*from, points, &value_at)?;
    }
    Ok(times)
}

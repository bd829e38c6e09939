//! Where in time an event function changes its sign between two points.

use super::start::Sides;
use super::{Side, Station, Within, crossing, settled};
use crate::{Direction, IntegrationError, Real};

/// The change of sign of a function between two stations, if it is wanted; its side is then that at the second.
pub(super) fn find<T: Real, const N: usize>(
    directions: &[Direction; N],
    index: usize,
    [here, there]: [Station<T, N>; 2],
    sides: &mut Sides<T, N>,
    values_at: Within<'_, [T; N], T>,
) -> Result<Option<(T, Direction)>, IntegrationError> {
    let (Some(&old), Some(&value), Some(wanted)) =
        (here.values.get(index), there.values.get(index), directions.get(index))
    else {
        return Ok(None);
    };
    let tells = sides.tells(index, (there.time, value));
    let Some(from) = sides.of.get_mut(index).filter(|_| tells) else { return Ok(None) };
    let before = *from;
    let direction = crossing(before, value);
    *from = settled(before, value);
    let Some(direction) = direction.filter(|direction| is_wanted(*wanted, *direction)) else {
        return Ok(None);
    };
    let value_at = |time| values_at(time).map(|values| values.get(index).copied().unwrap_or(value));
    let start = in_flight(before, ((here.time, old), there.time), &value_at)?;
    let time = locate(before, (start, (there.time, value)), &value_at)?;
    Ok(Some((time, direction)))
}

/// Whether a change in this direction is an event.
pub(super) fn is_wanted(wanted: Direction, direction: Direction) -> bool {
    match wanted {
        Direction::Either => true,
        Direction::Closing => direction == Direction::Falling,
        _ => wanted == direction,
    }
}

/// A point at which a function that leaves zero shows the side that it moves to: nearer and nearer to where it left,
/// as far as time resolves it, and that place itself if there is none.
fn in_flight<T: Real>(
    to: Side,
    ((time, value), end): ((T, T), T),
    value_at: Within<'_, T, T>,
) -> Result<(T, T), IntegrationError> {
    let half = T::from_f64(0.5);
    let mut distance = end - time;
    let shows = |value| crossing(to, value).is_none();
    while !shows(value) && time + distance != time {
        distance *= half;
        let there = value_at(time + distance)?;
        if shows(there) {
            return Ok((time + distance, there));
        }
    }
    Ok((time, value))
}

/// The first time with a new sign between two, to the resolution of time: by the Illinois variant of
/// the regula falsi (Dowell, Jarratt, BIT 11 (1971) 168), and every third time by bisection, which
/// halves the interval at least.
fn locate<T: Real>(
    from: Side,
    (mut before, mut after): ((T, T), (T, T)),
    value_at: Within<'_, T, T>,
) -> Result<T, IntegrationError> {
    let half = T::from_f64(0.5);
    let mut kept_after = false;
    // a function that stays where it reaches zero is zero at many times, of which the first is meant
    let mut stays = false;
    for count in 1_u32.. {
        let resolution = T::EPSILON * after.0.abs().max(before.0.abs());
        if (after.0 - before.0).abs() <= resolution {
            break;
        }
        if after.1 == T::ZERO && !stays {
            let sooner = if after.0 > before.0 { after.0 - resolution } else { after.0 + resolution };
            let value = value_at(sooner)?;
            if crossing(from, value).is_none() {
                break;
            }
            after = (sooner, value);
            stays = true;
            continue;
        }
        let middle = before.0 + (after.0 - before.0) * half;
        let chord = after.0 - (after.0 - before.0) * (after.1 / (after.1 - before.1));
        let inside = (before.0 < chord && chord < after.0) || (after.0 < chord && chord < before.0);
        let time = if count % 3 != 0 && inside { chord } else { middle };
        if time == before.0 || time == after.0 {
            break;
        }
        let value = value_at(time)?;
        if crossing(from, value).is_some() {
            after = (time, value);
            if kept_after {
                before.1 *= half;
            }
            kept_after = true;
        } else {
            before = (time, value);
            if !kept_after {
                after.1 *= half;
            }
            kept_after = false;
        }
    }
    Ok(after.0)
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::locate;
    use crate::events::Side;

    #[test]
    fn the_first_of_many_zeros_is_found_and_one_alone_at_once() {
        let clamped = |t: f64| Ok((1.0 - t).max(0.0));
        let time = locate(Side::Above, ((0.0, 1.0), (4.0, 0.0)), &clamped).unwrap();
        assert!((time - 1.0).abs() <= f64::EPSILON, "{time:?}");
        // backwards in time, and with a jump
        let stepped = |t: f64| Ok(if t > 1.3 { -2.0 } else { 0.0 });
        let time = locate(Side::Below, ((5.0, -2.0), (-1.0, 0.0)), &stepped).unwrap();
        assert!((time - 1.3).abs() <= 2.0 * f64::EPSILON, "{time:?}");
        let count = Cell::new(0);
        let line = |t: f64| {
            count.set(count.get() + 1);
            Ok(t - 0.5)
        };
        assert_eq!(locate(Side::Below, ((0.0, -0.5), (1.0, 0.5)), &line), Ok(0.5));
        assert!(count.get() < 4, "{count:?}");
    }
}

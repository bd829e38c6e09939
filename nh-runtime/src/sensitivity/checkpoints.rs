//! A sequence of steps, run through backwards with few states kept.

/// A state that is kept, with the tick before which it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkpoint<X> {
    tick: usize,
    state: X,
}

impl<X> Checkpoint<X> {
    /// An empty place: any state will do.
    #[must_use]
    pub fn room(state: X) -> Self {
        Self { tick: 0, state }
    }
}

/// Visits the ticks `ticks − 1`, …, 1, 0 in this order, each with the state before it: `step` leads from the state before
/// a tick to that before the next.
///
/// States are kept where binomial coefficients say (Griewank, Walther, Revolve, ACM Trans. Math. Software 26 (2000)): with
/// s places no tick is stepped over more than r times, where r is the least number with C(s + 1 + r, r) ≥ `ticks`.
///
/// # Errors
/// That of a visit, which ends the run.
pub(super) fn reversed<X: Copy, E>(
    ticks: usize,
    start: &X,
    places: &mut [Checkpoint<X>],
    step: impl Fn(usize, &X) -> X,
    mut visit: impl FnMut(usize, &X) -> Result<(), E>,
) -> Result<(), E> {
    let walk = |from: usize, to: usize, state: X| (from..to).fold(state, |state, tick| step(tick, &state));
    let (mut used, mut end) = (0_usize, ticks);
    loop {
        let last = used.checked_sub(1).and_then(|last| places.get(last));
        let (begin, state) = last.map_or((0, *start), |place| (place.tick, place.state));
        let length = end.saturating_sub(begin);
        match length {
            0 if used == 0 => return Ok(()),
            0 => used -= 1,
            1 => {
                visit(begin, &state)?;
                end = begin;
            }
            _ => {
                let free = places.len() - used;
                if let Some(place) = places.get_mut(used) {
                    let tick = begin + length - behind(length, free);
                    *place = Checkpoint { tick, state: walk(begin, tick, state) };
                    used += 1;
                } else {
                    visit(end - 1, &walk(begin, end - 1, state))?;
                    end -= 1;
                }
            }
        }
    }
}

/// How many of at least two ticks lie behind the state that is kept next, where so many places are free: the most that
/// those which are then left can reverse in as many repetitions as the whole needs.
fn behind(length: usize, free: usize) -> usize {
    let mut repetitions = 1;
    while reach(free + 1, repetitions) < length {
        repetitions += 1;
    }
    reach(free, repetitions).min(length - 1)
}

/// C(states + repetitions, states): the ticks that so many states, the one before the first included, reverse without
/// stepping over any of them more often than that.
fn reach(states: usize, repetitions: usize) -> usize {
    let (few, many) = if states < repetitions { (states, repetitions) } else { (repetitions, states) };
    let mut product = 1_usize;
    for i in 1..=few {
        // a binomial coefficient at every stage, so that the division leaves no rest
        let Some(next) = product.checked_mul(many + i) else { return usize::MAX };
        product = next / i;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;
    use core::convert::Infallible;
    use std::vec::Vec;

    /// Every tick is visited once, from behind, with the state before it, mathematics (52); and no tick is stepped over
    /// more often than is said.
    #[test]
    fn all_ticks_are_visited_from_behind() {
        for places in 0..7 {
            for ticks in 0..200 {
                let counts: Vec<Cell<usize>> = (0..ticks).map(|_| Cell::new(0)).collect();
                let mut room = [Checkpoint::room(usize::MAX); 7];
                let mut expected = ticks;
                let step = |tick: usize, state: &usize| {
                    assert_eq!(tick, *state);
                    counts[tick].set(counts[tick].get() + 1);
                    tick + 1
                };
                let run = reversed(ticks, &0, &mut room[..places], step, |tick, state| {
                    expected -= 1;
                    assert_eq!((tick, *state), (expected, expected));
                    Ok::<(), Infallible>(())
                });
                assert_eq!((run, expected), (Ok(()), 0));
                let most = counts.iter().map(Cell::get).max().unwrap_or(0);
                let repetitions = (0..=ticks).find(|r| reach(places + 1, *r) >= ticks).unwrap();
                assert!(most <= repetitions, "{places} places, {ticks} ticks: {most} > {repetitions}");
            }
        }
    }

    #[test]
    fn no_step_is_taken_twice_where_all_states_fit() {
        let taken = Cell::new(0);
        let mut room = [Checkpoint::room(0_usize); 99];
        let step = |tick: usize, _: &usize| {
            taken.set(taken.get() + 1);
            tick + 1
        };
        reversed(100, &0, &mut room, step, |_, _| Ok::<(), Infallible>(())).unwrap();
        assert_eq!(taken.get(), 99);
        assert_eq!((reach(3, 2), reach(60, 60)), (10, usize::MAX));
    }
}

//! Digits that are lost for nothing.

use f256::f256;

use crate::emitted::Emitted;
use crate::numbers::rounded;
use crate::place::Place;
use crate::reference::Motion;

/// One component at one place.
#[derive(Clone, Copy, Debug)]
pub struct Loss {
    /// How far the value is off, relative to it.
    pub error: f64,
    /// What an ulp of every input changes, relative to the value; NaN if that was not asked for.
    pub explained: f64,
}

impl Loss {
    /// The error in units of what an ulp of every input and of the value explains.
    #[must_use]
    pub fn units(self) -> f64 {
        self.error / (self.explained + f64::EPSILON)
    }
}

/// The largest loss.
#[derive(Clone, Copy, Debug)]
pub struct Worst {
    /// The component: an acceleration, or a multiplier after them.
    pub component: usize,
    /// Its loss.
    pub loss: Loss,
}

/// Below this a component is zero to all digits of the reference.
const NOTHING: f64 = 1e-45;

/// The worst loss of the accelerations and of the multipliers. What inputs explain is measured where a component is
/// off by more than `suspicious`, relative to its value. None where the equations are singular.
#[must_use]
pub fn losses(emitted: &Emitted, place: &Place, suspicious: f64) -> Option<[Option<Worst>; 2]> {
    let exact = reference(emitted, place)?;
    let found = emitted.run(place);
    let largest = exact.iter().map(f256::abs).fold(f256::ZERO, f256::max);
    let sized = |x: &f256| !largest.eq_zero() && rounded(x.abs() / largest) > NOTHING;
    let error = |index: usize| {
        let exact = exact[index];
        let off = rounded((f256::from(found[index]) - exact).abs() / exact.abs());
        if found[index].is_finite() { off } else { f64::INFINITY }
    };
    let worst_of = |range: std::ops::Range<usize>| {
        range.filter(|k| sized(&exact[*k])).map(|k| (k, error(k))).max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let accelerations = emitted.system.state_velocities.len();
    let ranges = [0..accelerations, accelerations..exact.len()];
    let is_suspicious = ranges.iter().any(|r| worst_of(r.clone()).is_some_and(|(_, e)| e > suspicious));
    if !is_suspicious {
        let plain = |(component, error)| Worst { component, loss: Loss { error, explained: f64::NAN } };
        return Some(ranges.map(|range| worst_of(range).map(plain)));
    }
    let mut explained = vec![0.0; exact.len()];
    for symbol in place.values.keys() {
        let mut moved = place.clone();
        let value = moved.values[symbol];
        moved.values.insert(*symbol, value.next_up());
        let moved = reference(emitted, &moved)?;
        for ((sum, moved), exact) in explained.iter_mut().zip(moved).zip(&exact) {
            *sum += rounded((moved - *exact).abs() / exact.abs());
        }
    }
    let rated = |range: std::ops::Range<usize>| {
        let worst = range.filter(|k| sized(&exact[*k])).map(|component| Worst {
            component,
            loss: Loss { error: error(component), explained: explained[component] },
        });
        worst.max_by(|a, b| a.loss.units().total_cmp(&b.loss.units()))
    };
    Some(ranges.map(rated))
}

/// The accelerations of the velocities in the state, then the multipliers.
fn reference(emitted: &Emitted, place: &Place) -> Option<Vec<f256>> {
    let kept = &emitted.system.state_velocities;
    let motion = Motion::of(&emitted.model, kept, place)?;
    let sections = emitted.model.sections.iter().zip(&motion.accelerations);
    let all: Vec<_> = sections.map(|(section, a)| (section.symbol, *a)).collect();
    let of = |symbol| all.iter().find(|(section, _)| *section == symbol).map(|(_, a)| *a);
    let mut values: Option<Vec<f256>> = kept.iter().map(|symbol| of(*symbol)).collect();
    if emitted.has_multipliers() {
        values.as_mut()?.extend(motion.multipliers);
    }
    values
}

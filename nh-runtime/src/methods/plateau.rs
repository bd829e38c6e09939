//! Whether corrections that no longer fall are rounding.

use crate::arrays::Array;
use crate::newton_return::{MULTIPLE, SURROUNDINGS, jumps_between};
use crate::projection::largest;
use crate::{Real, Scalar};

/// The corrections of an iteration since they stopped falling.
///
/// What rounding makes of a correction need not show in the size of what it corrects: beside lengths inside of equations
/// coordinates may be near to zero, as those of a pendulum about its lowest point.
#[derive(Clone, Copy)]
pub(in crate::methods) struct Plateau<V, T> {
    best: Option<T>,
    level: u32,
    most: Option<V>,
}

/// The largest of the numbers of two lists.
pub(in crate::methods) fn largest_of<T: Real, V: Array<T>>(lists: [&V; 2]) -> T {
    lists.iter().fold(T::ZERO, |most, list| Scalar::max(most, largest(list.as_ref())))
}

/// So many corrections in a row that do not halve the least one are no accident.
const LEVEL: u32 = 3;

impl<T: Real, V: Array<T>> Plateau<V, T> {
    /// Before the first correction.
    pub(in crate::methods) fn new() -> Self {
        Self { best: None, level: 0, most: None }
    }

    /// Takes over a correction with its size as a whole; whether corrections have been level for some time.
    pub(in crate::methods) fn is_level(&mut self, correction: &V, size: T) -> bool {
        let falls = self.best.is_none_or(|best| size < T::from_f64(0.5) * best);
        self.best = Some(self.best.map_or(size, |best| best.min(size)));
        if falls {
            (self.level, self.most) = (0, None);
            return false;
        }
        self.level += 1;
        let mut most = self.most.unwrap_or(*correction);
        for (most, correction) in most.as_mut().iter_mut().zip(correction.as_ref()) {
            *most = Scalar::max(most.abs(), correction.abs());
        }
        self.most = Some(most);
        self.level >= LEVEL && size.is_finite()
    }

    /// Whether a correction is rounding, where `ahead` is the correction at a multiple of this one ahead.
    ///
    /// Far ahead corrections lead back, nearly linearly, as those of an iteration do that converges; and close by they
    /// jump, which only rounding does and forces that jump. So it has to be less than `permitted`, which is
    /// a small part of the numbers that are corrected. Components that are known to be no more than rounding are not asked.
    #[cold]
    pub(in crate::methods) fn is_rounding(
        &self,
        correction: &V,
        permitted: T,
        is_open: impl Fn(usize) -> bool,
        mut ahead: impl FnMut(T) -> V,
    ) -> bool {
        let Some(most) = &self.most else { return false };
        let multiple = T::from_f64(MULTIPLE);
        let far = ahead(multiple);
        let of = |list: &V, row: usize| list.as_ref().get(row).copied().unwrap_or(T::ZERO);
        let mut open = (0..correction.as_ref().len()).filter(|row| is_open(*row));
        open.all(|row| {
            let (here, most) = (of(correction, row), of(most, row));
            if here.abs() > permitted {
                return false;
            }
            let off = (of(&far, row) + (multiple - T::ONE) * here).abs();
            let mut jumps = |from: f64, to: f64| {
                let between = (T::from_f64(from), T::from_f64(to));
                jumps_between(|part| of(&ahead(part), row), between, here.abs()) > T::ZERO
            };
            off * T::from_f64(4.0) <= multiple * most
                && (jumps(0.0, 1.0) || jumps(1.0, SURROUNDINGS) || jumps(-SURROUNDINGS, 0.0))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corrections of x to a zero of f with a slope that is taken for that of f, and whether they end as rounding.
    fn ends(f: impl Fn(f64) -> f64, slope: f64, start: f64) -> Option<f64> {
        let correction = |x: f64| [-f(x) / slope];
        let (mut x, mut plateau) = (start, Plateau::new());
        for _ in 0..50 {
            let c = correction(x);
            if plateau.is_level(&c, c[0].abs())
                && plateau.is_rounding(&c, 1e-8, |_| true, |part| correction(x + part * c[0]))
            {
                return Some(x);
            }
            x += c[0];
        }
        None
    }

    #[test]
    fn rounding_of_numbers_inside_is_seen_at_any_size() {
        // (x + 0.3) − 0.3 + 10⁻¹⁷ beside numbers whose digits are 5.6·10⁻¹⁷ apart
        for start in [0.1, 1e-9, 1e-20] {
            let end = ends(|x| ((x + 0.3) - 0.3) + 1e-17, 1.1, start);
            assert!(end.is_some_and(|x| x.abs() < 1e-16), "{start} {end:?}");
        }
    }

    #[test]
    fn what_creeps_or_leads_elsewhere_is_not_rounding() {
        for start in [0.3, 1e-9] {
            // slopes that are wrong: too steep by far, and of the other sign
            for slope in [10.0, 1.6, 0.5, -1.0] {
                assert_eq!(ends(|x| x, slope, start), None, "{slope} {start}");
            }
            // no zero, an edge, a double zero
            assert_eq!(ends(|x| 1.0 + x * x, 1.0, start), None, "{start}");
            assert_eq!(ends(|x| 1e-3 + x.abs(), 1.0, start), None, "{start}");
            // friction that jumps
            assert_eq!(ends(|x| x + 1e-3 * (x - 2e-9).signum(), 1.0, start), None, "{start}");
        }
    }
}

//! How much error a step may add to which component.

use crate::arrays::Array;
use crate::{Dim, IntegrationError, Real, Scalar, State};

/// The permitted error of the components of a state of type `X`: in component i, the absolute
/// tolerance plus the relative one times the larger of |xᵢ| at both ends of the step
/// (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4 eq. (4.10)).
///
/// Implemented by [`Uniform`] and [`PerComponent`].
pub trait Tolerance<X: State>: Copy {
    /// Checks the values.
    ///
    /// # Errors
    /// [`IntegrationError::Setting`] for the first value that is out of its range.
    fn check(&self) -> Result<(), IntegrationError>;

    /// The permitted error of each component of a state.
    fn permitted(&self, x: &VecOf<X>) -> VecOf<X>;

    /// The mean of the squares of eᵢ in units of the permitted error. What is not finite passes
    /// through it.
    fn mean_square(&self, e: &VecOf<X>, x0: &VecOf<X>, x1: &VecOf<X>) -> X::Scalar;
}

type VecOf<X> = <<X as State>::Dim as Dim>::Vec<<X as State>::Scalar>;

/// The same tolerances for all components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform<T> {
    pub(crate) rtol: T,
    /// As `rtol` if not given.
    pub(crate) atol: Option<T>,
}

/// Tolerances of each component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerComponent<X> {
    pub(crate) rtol: X,
    pub(crate) atol: X,
}

impl<T: Real> Uniform<T> {
    pub(crate) fn new() -> Self {
        Self { rtol: T::DEFAULT_TOLERANCE, atol: None }
    }
}

impl<T> Uniform<T> {
    /// A relative and an absolute tolerance.
    #[must_use]
    pub const fn of(rtol: T, atol: T) -> Self {
        Self { rtol, atol: Some(atol) }
    }
}

impl<X> PerComponent<X> {
    /// A relative and an absolute tolerance for each component.
    #[must_use]
    pub const fn of(rtol: X, atol: X) -> Self {
        Self { rtol, atol }
    }
}

impl<T: Real, X: State<Scalar = T>> Tolerance<X> for Uniform<T> {
    fn check(&self) -> Result<(), IntegrationError> {
        check_pair("rtol", self.rtol, "atol", self.atol.unwrap_or(self.rtol))
    }

    fn permitted(&self, x: &VecOf<X>) -> VecOf<X> {
        let (rtol, atol) = (self.rtol, self.atol.unwrap_or(self.rtol));
        let mut permitted = *x;
        permitted.as_mut().iter_mut().for_each(|x| *x = rtol.mul_add(x.abs(), atol));
        permitted
    }

    #[inline]
    fn mean_square(&self, e: &VecOf<X>, x0: &VecOf<X>, x1: &VecOf<X>) -> T {
        let (rtol, atol) = (self.rtol, self.atol.unwrap_or(self.rtol));
        mean_square(e, x0, x1, core::iter::repeat((rtol, atol)))
    }
}

impl<T: Real, X: State<Scalar = T>> Tolerance<X> for PerComponent<X> {
    fn check(&self) -> Result<(), IntegrationError> {
        let (rtol, atol, names) = (self.rtol.to_array(), self.atol.to_array(), X::names());
        for ((&rtol, &atol), name) in rtol.as_ref().iter().zip(atol.as_ref()).zip(names.as_ref()) {
            check_pair("rtol", rtol, "atol", atol).map_err(|error| match error {
                // the component says more than the kind of the tolerance, which the value shows
                IntegrationError::Setting { value, expected, .. } => {
                    IntegrationError::Setting { setting: name, value, expected }
                }
                other => other,
            })?;
        }
        Ok(())
    }

    fn permitted(&self, x: &VecOf<X>) -> VecOf<X> {
        let (rtol, mut permitted) = (self.rtol.to_array(), self.atol.to_array());
        for (permitted, (rtol, x)) in permitted.as_mut().iter_mut().zip(rtol.as_ref().iter().zip(x.as_ref()))
        {
            *permitted = rtol.mul_add(x.abs(), *permitted);
        }
        permitted
    }

    #[inline]
    fn mean_square(&self, e: &VecOf<X>, x0: &VecOf<X>, x1: &VecOf<X>) -> T {
        let (rtol, atol) = (self.rtol.to_array(), self.atol.to_array());
        let each = rtol.as_ref().iter().copied().zip(atol.as_ref().iter().copied());
        mean_square(e, x0, x1, each)
    }
}

/// The norm of e in units of the permitted error, for any e in the range of the numbers: the root of the mean square,
/// of which neither may be.
#[inline]
pub(crate) fn norm<X: State>(
    tolerance: &impl Tolerance<X>,
    e: &VecOf<X>,
    x0: &VecOf<X>,
    x1: &VecOf<X>,
) -> X::Scalar
where
    X::Scalar: Real,
{
    let square = tolerance.mean_square(e, x0, x1);
    if square >= X::Scalar::MIN_POSITIVE / X::Scalar::EPSILON && square.is_finite() {
        return square.sqrt();
    }
    norm_of_scaled(tolerance, e, [x0, x1]).unwrap_or_else(|| square.sqrt())
}

/// The same by components in units of a power of two near the largest ratio, if that is a number.
#[cold]
fn norm_of_scaled<X: State>(
    tolerance: &impl Tolerance<X>,
    e: &VecOf<X>,
    [x0, x1]: [&VecOf<X>; 2],
) -> Option<X::Scalar>
where
    X::Scalar: Real,
{
    let (before, after) = (tolerance.permitted(x0), tolerance.permitted(x1));
    let permitted = before.as_ref().iter().zip(after.as_ref()).map(|(a, b)| a.max(*b));
    let present = e.as_ref().iter().zip(permitted).filter(|(e, _)| **e != X::Scalar::ZERO);
    let largest = present.fold(X::Scalar::ZERO, |most, (e, permitted)| most.max(e.abs() / permitted));
    if largest == X::Scalar::ZERO || !largest.is_finite() {
        return None;
    }
    let unit = power_of_two(largest);
    let mut scaled = *e;
    scaled.as_mut().iter_mut().for_each(|e| *e = *e / unit);
    Some(tolerance.mean_square(&scaled, x0, x1).sqrt() * unit)
}

/// The largest power of two that is at most this positive number.
pub(crate) fn power_of_two<T: Real>(number: T) -> T {
    let mut power = T::ONE;
    for stride in [T::from_f64(4_294_967_296.0), T::from_f64(2.0)] {
        while power <= number / stride {
            power *= stride;
        }
        // what is no more a number is not below another
        while power > number && power / stride > T::ZERO {
            power = power / stride;
        }
    }
    power
}

/// Checks the tolerances of a component.
fn check_pair<T: Real>(
    relative: &'static str,
    rtol: T,
    absolute: &'static str,
    atol: T,
) -> Result<(), IntegrationError> {
    let refuse = |setting, value: T, expected| {
        Err(IntegrationError::Setting { setting, value: value.to_f64(), expected })
    };
    let resolved = T::from_f64(4.0) * T::EPSILON;
    if !(rtol.is_finite() && (rtol == T::ZERO || rtol >= resolved)) {
        return refuse(
            relative,
            rtol,
            "zero, or finite and at least four times the rounding unit of the numbers: 8.9e-16 in f64, \
             4.8e-7 in f32",
        );
    }
    if !(atol >= T::ZERO && atol.is_finite()) {
        return refuse(absolute, atol, "finite and not negative");
    }
    if rtol == T::ZERO && atol == T::ZERO {
        return refuse(absolute, atol, "positive where `rtol` is zero");
    }
    Ok(())
}

/// 1/N Σ (eᵢ/scᵢ)², scᵢ = atol + rtol max(|x₀ᵢ|, |x₁ᵢ|).
#[inline]
fn mean_square<T: Real, V: Array<T>>(e: &V, x0: &V, x1: &V, each: impl Iterator<Item = (T, T)> + Clone) -> T {
    let ratio = |e: T, x0: T, x1: T, (rtol, atol): (T, T)| {
        // not `max`, which would take care of NaN: an end that is not finite is refused anyway
        let larger = x0.abs().select_gt(x1.abs(), x0.abs(), x1.abs());
        e / rtol.mul_add(larger, atol)
    };
    let mut sum = T::ZERO;
    let mut count = 0;
    let terms = e.as_ref().iter().zip(x0.as_ref()).zip(x1.as_ref());
    for (((&e, &x0), &x1), tolerances) in terms.clone().zip(each.clone()) {
        let ratio = ratio(e, x0, x1, tolerances);
        sum += ratio * ratio;
        count += 1;
    }
    if !sum.is_finite() {
        // perhaps 0/0: a component that is exactly zero, with a relative tolerance only
        let present = terms.zip(each).filter(|(((e, _), _), _)| **e != T::ZERO);
        let square = |r: T| r * r;
        sum = present.fold(T::ZERO, |sum, (((&e, &x0), &x1), each)| sum + square(ratio(e, x0, x1, each)));
    }
    sum * T::from_f64(1.0 / f64::from(count.max(1)))
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // exact values are meant
mod tests {
    use super::*;
    use crate::pair::Pair;

    fn check(rtol: f64, atol: Option<f64>) -> Result<(), IntegrationError> {
        Tolerance::<Pair>::check(&Uniform { rtol, atol })
    }

    #[test]
    fn powers_of_two_are_found_to_the_least_number() {
        for number in [5e-324_f64, 1e-320, 2e-308, 1e-5, 1.0, 3.0, f64::MAX] {
            let power = power_of_two(number);
            assert!(power > 0.0 && power <= number && power > number / 2.0, "{number:e} {power:e}");
        }
        for number in [1e-45_f32, 1e-42, 2e-38, 1.5, f32::MAX] {
            let power = power_of_two(number);
            assert!(power > 0.0 && power <= number && power > number / 2.0, "{number:e} {power:e}");
        }
    }

    #[test]
    fn tolerances_are_checked() {
        assert_eq!(check(1e-6, None), Ok(()));
        assert_eq!(check(0.0, Some(1e-9)), Ok(()));
        let nan = f64::NAN;
        for (rtol, atol) in [
            (-1e-6, None),
            (nan, None),
            (f64::INFINITY, None),
            (1e-17, None),
            (0.0, None),
            (0.0, Some(0.0)),
            (1e-6, Some(-1.0)),
            (1e-6, Some(nan)),
        ] {
            assert!(matches!(check(rtol, atol), Err(IntegrationError::Setting { .. })), "{rtol} {atol:?}");
        }
        let each = PerComponent { rtol: Pair([1e-6, 0.0]), atol: Pair([0.0, -1.0]) };
        assert!(matches!(each.check(), Err(IntegrationError::Setting { setting: "b", value: -1.0, .. })));
    }

    #[test]
    fn the_norm_keeps_what_is_not_finite() {
        let uniform = Uniform { rtol: 1e-6, atol: None };
        let norm = |e| Tolerance::<Pair>::mean_square(&uniform, &e, &[1.0, 1.0], &[1.0, 1.0]);
        assert!(norm([0.0, f64::NAN]).is_nan());
        assert!(norm([f64::INFINITY, 0.0]).is_infinite());
        let relative = Uniform { rtol: 1e-6, atol: Some(0.0) };
        assert_eq!(Tolerance::<Pair>::mean_square(&relative, &[0.0; 2], &[0.0; 2], &[0.0; 2]), 0.0);
    }

    #[test]
    fn each_component_has_its_own() {
        let each = PerComponent { rtol: Pair([0.0, 0.5]), atol: Pair([2.0, 0.0]) };
        assert_eq!(each.mean_square(&[2.0, 4.0], &[9.0, 8.0], &[9.0, 1.0]), 1.0);
    }
}

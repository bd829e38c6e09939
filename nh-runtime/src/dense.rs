//! The state between the ends of a step.

use crate::Scalar;
use crate::arrays::Array;

/// The cubic with given values and derivatives at both ends, at the fraction s of the step:
/// (1−s) x₀ + s x₁ + s (s−1) ((1−2s)(x₁−x₀) + (s−1) h f₀ + s h f₁)
/// (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.6 eq. (6.7)).
pub(crate) fn hermite<T: Scalar, V: Array<T>>((x0, f0): (&V, &V), (x1, f1): (&V, &V), h: T, s: T) -> V {
    let rest = T::ONE - s;
    let bend = -(s * rest);
    let slope = rest - s;
    let mut x = *x0;
    let ends = x1.as_ref().iter().zip(f0.as_ref().iter().zip(f1.as_ref()));
    for (x, (&x1, (&f0, &f1))) in x.as_mut().iter_mut().zip(ends) {
        let change = x1 - *x;
        *x = *x + s * change + bend * (slope * change - rest * h * f0 + s * h * f1);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::hermite;

    #[test]
    fn cubics_are_reproduced() {
        let x = |t: f64| 2.0 - t + 3.0 * t * t - 0.5 * t * t * t;
        let f = |t: f64| -1.0 + 6.0 * t - 1.5 * t * t;
        let (t0, h) = (0.3, 1.7);
        for s in [0.0, 0.25, 0.6, 1.0] {
            let [at] = hermite((&[x(t0)], &[f(t0)]), (&[x(t0 + h)], &[f(t0 + h)]), h, s);
            assert!((at - x(t0 + s * h)).abs() < 1e-14);
        }
    }
}

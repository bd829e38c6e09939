//! The nonlinear systems of collocation methods: simplified Newton iterations in the coordinates where
//! the inverse of the Runge–Kutta matrix is block-diagonal (Hairer, Wanner, Solving Ordinary
//! Differential Equations II, section IV.8).

use crate::arrays::displaced;
use crate::complex::Complex;
use crate::linear::Factors;
use crate::methods::Start;
use crate::{Dim, DimOf, Dynamics, MatOf, Real, Scalar, ScalarOf, VecOf};

/// A collocation method of `S` stages, 2 or 3, with the unknowns zᵢ = h Σ aᵢⱼ f(t₀ + cⱼh, x₀ + zⱼ).
pub(super) struct Collocation<const S: usize> {
    /// The nodes c.
    pub(super) nodes: [f64; S],
    /// x₁ − x₀ = Σ dᵢ zᵢ, d = bA⁻¹.
    pub(super) end: [f64; S],
    /// The real eigenvalue of A⁻¹, if there are three stages.
    pub(super) real: f64,
    /// The complex ones, α ± iβ.
    pub(super) pair: (f64, f64),
    /// T with T⁻¹A⁻¹T = diag(real, (α β; −β α)).
    pub(super) from_blocks: [[f64; S]; S],
    /// T⁻¹.
    pub(super) to_blocks: [[f64; S]; S],
}

/// So many times its length the polynomial of a step is continued at most.
const FARTHEST: f64 = 32.0;

/// The factorized matrices λ/h − ∂f/∂x of the iteration.
pub(super) struct Matrices<S: Dynamics> {
    /// None with two stages.
    pub(super) real: Option<Factors<DimOf<S>, ScalarOf<S>>>,
    pair: Factors<DimOf<S>, Complex<ScalarOf<S>>>,
}

impl<S: Dynamics> Clone for Matrices<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Matrices<S> {}

/// Σ wᵢ vᵢ.
#[inline]
pub(super) fn weighted<T: Scalar, V: Copy + AsRef<[T]> + AsMut<[T]>, const S: usize>(
    zero: V,
    weights: &[f64; S],
    vectors: &[V; S],
) -> V {
    weights.iter().zip(vectors).fold(zero, |sum, (w, v)| displaced(&sum, T::from_f64(*w), v))
}

/// λ/h − ∂f/∂x.
pub(super) fn shifted<S: Dynamics>(jacobian: &MatOf<S>, shift: ScalarOf<S>) -> MatOf<S> {
    let mut matrix = *jacobian;
    for (i, row) in matrix.as_mut().iter_mut().enumerate() {
        for (j, entry) in row.as_mut().iter_mut().enumerate() {
            *entry = if i == j { shift - *entry } else { -*entry };
        }
    }
    matrix
}

impl<const N: usize> Collocation<N> {
    /// The matrices for steps of length h.
    pub(super) fn matrices<S: Dynamics>(&self, jacobian: &MatOf<S>, h: ScalarOf<S>) -> Matrices<S>
    where
        ScalarOf<S>: Real,
    {
        let w = ScalarOf::<S>::from_f64;
        let real = (N > 2).then(|| Factors::new(&shifted::<S>(jacobian, w(self.real) / h)));
        let zero = Complex { re: ScalarOf::<S>::ZERO, im: ScalarOf::<S>::ZERO };
        let mut pair = DimOf::<S>::mat(zero);
        // for w₂ + i w₃ the block is α − iβ
        let shift = Complex { re: w(self.pair.0) / h, im: -(w(self.pair.1) / h) };
        for (i, (to, from)) in pair.as_mut().iter_mut().zip(jacobian.as_ref()).enumerate() {
            for (j, (to, from)) in to.as_mut().iter_mut().zip(from.as_ref()).enumerate() {
                let entry = Complex { re: *from, im: ScalarOf::<S>::ZERO };
                *to = if i == j { shift - entry } else { -entry };
            }
        }
        Matrices { real, pair: Factors::new(&pair) }
    }

    /// One iteration: from the unknowns z to better ones; the correction is the difference.
    pub(super) fn iterate<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: ScalarOf<S>,
        matrices: &Matrices<S>,
        z: &mut [VecOf<S>; N],
    ) -> [VecOf<S>; N]
    where
        ScalarOf<S>: Real,
    {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let mut slopes = [zero; N];
        for ((slope, node), z) in slopes.iter_mut().zip(&self.nodes).zip(z.iter()) {
            let time = start.time + ScalarOf::<S>::from_f64(*node) * h;
            *slope = start.derivative_at(time, displaced(x, ScalarOf::<S>::ONE, z));
        }
        self.corrected(h, matrices, &slopes, z)
    }

    /// One iteration from the derivatives at the unknowns.
    pub(super) fn corrected<S: Dynamics>(
        &self,
        h: ScalarOf<S>,
        matrices: &Matrices<S>,
        slopes: &[VecOf<S>; N],
        z: &mut [VecOf<S>; N],
    ) -> [VecOf<S>; N]
    where
        ScalarOf<S>: Real,
    {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let scaled = |v: f64| ScalarOf::<S>::from_f64(v) / h;
        // in blocks: T⁻¹ f − Λ/h T⁻¹ z
        let mut defect = [zero; N];
        let mut blocks = [zero; N];
        for ((defect, block), row) in defect.iter_mut().zip(&mut blocks).zip(&self.to_blocks) {
            *defect = weighted(zero, row, slopes);
            *block = weighted(zero, row, z);
        }
        let mut correction = [zero; N];
        let (alpha, beta) = (scaled(self.pair.0), scaled(self.pair.1));
        if let ([single @ .., d2, d3], [real @ .., w2, w3], [first @ .., c2, c3]) =
            (defect.as_slice(), blocks.as_slice(), correction.as_mut_slice())
        {
            for ((c, d), w) in first.iter_mut().zip(single).zip(real) {
                if let Some(factors) = &matrices.real {
                    *c = factors.solve(&displaced(d, -scaled(self.real), w));
                }
            }
            let d2 = displaced(&displaced(d2, -alpha, w2), -beta, w3);
            let d3 = displaced(&displaced(d3, beta, w2), -alpha, w3);
            let mut right = DimOf::<S>::vec(Complex { re: ScalarOf::<S>::ZERO, im: ScalarOf::<S>::ZERO });
            for (r, (re, im)) in right.as_mut().iter_mut().zip(d2.as_ref().iter().zip(d3.as_ref())) {
                *r = Complex { re: *re, im: *im };
            }
            let solution = matrices.pair.solve(&right);
            let parts = c2.as_mut().iter_mut().zip(c3.as_mut());
            for ((re, im), s) in parts.zip(solution.as_ref()) {
                (*re, *im) = (s.re, s.im);
            }
        }
        let mut change = [zero; N];
        for ((change, z), row) in change.iter_mut().zip(z.iter_mut()).zip(&self.from_blocks) {
            *change = weighted(zero, row, &correction);
            *z = displaced(z, ScalarOf::<S>::ONE, change);
        }
        change
    }

    /// The collocation polynomial less x₀, through zero and the zᵢ, at the fraction s of its step.
    pub(super) fn polynomial<T: Real, V: Copy + AsRef<[T]> + AsMut<[T]>>(
        &self,
        zero: V,
        z: &[V; N],
        s: T,
    ) -> V {
        let w = T::from_f64;
        let mut sum = zero;
        for (i, (z, ci)) in z.iter().zip(&self.nodes).enumerate() {
            let mut weight = s / w(*ci);
            for (j, cj) in self.nodes.iter().enumerate() {
                if i != j {
                    weight *= (s - w(*cj)) / (w(*ci) - w(*cj));
                }
            }
            sum = displaced(&sum, weight, z);
        }
        sum
    }

    /// Starting values for a step that is `ratio` times as long as the last one, from its polynomial; zero where
    /// that says nothing so far away.
    pub(super) fn extrapolated<T: Real, V: Copy + AsRef<[T]> + AsMut<[T]>>(
        &self,
        zero: V,
        z: &[V; N],
        ratio: T,
    ) -> [V; N] {
        let mut next = [zero; N];
        if ratio.abs() > T::from_f64(FARTHEST) {
            return next;
        }
        let end = self.polynomial(zero, z, T::ONE);
        for (next, node) in next.iter_mut().zip(&self.nodes) {
            let there = self.polynomial(zero, z, T::ONE + ratio * T::from_f64(*node));
            *next = displaced(&there, -T::ONE, &end);
        }
        next
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Σⱼ over blocks: T diag T⁻¹ = A⁻¹ with A from the nodes: ∫₀^cᵢ of the Lagrange polynomials, which is
    /// checked on the monomials: Σⱼ aᵢⱼ cⱼ^(k−1) = cᵢᵏ/k.
    pub(in crate::methods::implicit) fn check<const N: usize>(method: &Collocation<N>) {
        for k in 1..=u8::try_from(N).unwrap() {
            let power = |c: f64, k: u8| c.powi(i32::from(k));
            // A⁻¹ (cᵢᵏ/k) = cᵢ^(k−1)
            let right: [f64; N] = method.nodes.map(|c| power(c, k) / f64::from(k));
            let blocks: [f64; N] =
                method.to_blocks.map(|row| row.iter().zip(&right).map(|(a, b)| a * b).sum());
            let mut moved = [0.0; N];
            let (alpha, beta) = method.pair;
            for i in 0..N - 2 {
                moved[i] = method.real * blocks[i];
            }
            moved[N - 2] = alpha * blocks[N - 2] + beta * blocks[N - 1];
            moved[N - 1] = -beta * blocks[N - 2] + alpha * blocks[N - 1];
            for (row, c) in method.from_blocks.iter().zip(method.nodes) {
                let sum: f64 = row.iter().zip(&moved).map(|(a, b)| a * b).sum();
                assert!((sum - power(c, k - 1)).abs() < 1e-14, "{k} {sum} {c}");
            }
            // the end is on the polynomial: Σ dᵢ cᵢᵏ = 1
            let end: f64 = method.end.iter().zip(method.nodes).map(|(d, c)| d * power(c, k)).sum();
            assert!((end - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn polynomials_are_continued() {
        let method = &super::super::radau5::RADAU;
        let x = |s: f64| 2.0 * s - 3.0 * s * s + 0.5 * s * s * s;
        let z = method.nodes.map(|c| [x(c)]);
        assert!((method.polynomial([0.0], &z, 0.3)[0] - x(0.3)).abs() < 1e-14);
        for (next, c) in method.extrapolated([0.0], &z, 0.7).iter().zip(method.nodes) {
            assert!((next[0] - (x(1.0 + 0.7 * c) - x(1.0))).abs() < 1e-13);
        }
    }
}

//! The nonlinear systems of collocation methods: simplified Newton iterations in the coordinates where
//! the inverse of the Runge–Kutta matrix is block-diagonal (Hairer, Wanner, Solving Ordinary
//! Differential Equations II, section IV.8).

use crate::arrays::displaced;
use crate::complex::Complex;
use crate::linear::Factors;
use crate::methods::Start;
use crate::{Dim, DimOf, Dynamics, MatOf, Real, Scalar, ScalarOf, VecOf};

/// A coefficient as a number and what rounding has taken from it. With coefficients that are merely rounded, the
/// method that is solved to round-off is another one: it is not symplectic, and its energy drifts by a
/// rounding unit with every unit of time (Hairer, McLachlan, Razakarivony, Achieving Brouwer's law with
/// implicit Runge–Kutta methods, BIT 48 (2008)).
pub(super) type Exact = (f64, f64);

/// The same in numbers of type T.
#[inline]
fn split<T: Scalar>((number, rest): Exact) -> (T, T) {
    let rounded = T::from_f64(number);
    (rounded, T::from_f64((number - rounded.to_f64()) + rest))
}

/// A sum and what rounding has taken from it.
#[derive(Clone, Copy)]
struct Sum<T> {
    sum: T,
    rest: T,
}

impl<T: Real> Sum<T> {
    const ZERO: Self = Self { sum: T::ZERO, rest: T::ZERO };

    /// Adds a number (Møller 1965, Knuth, The Art of Computer Programming 2, 4.2.2, theorem B).
    #[inline]
    fn add(self, x: T) -> Self {
        let sum = self.sum + x;
        let added = sum - self.sum;
        Self { sum, rest: self.rest + ((self.sum - (sum - added)) + (x - added)) }
    }

    /// Adds c x. The rounding error of the product has no common sign, as that of x has none.
    #[inline]
    fn add_product(self, c: Exact, x: T) -> Self {
        let (c, c_rest) = split::<T>(c);
        let next = self.add(c * x);
        Self { rest: next.rest + c_rest * x, ..next }
    }
}

/// A collocation method of `S` stages, 2 or 3, with the unknowns zᵢ = h Σ aᵢⱼ f(t₀ + cⱼh, x₀ + zⱼ).
pub(super) struct Collocation<const S: usize> {
    /// The nodes c.
    pub(super) nodes: [f64; S],
    /// The weights of z in the stages that it is continued to, for a step as long: [`continued`] of the nodes.
    pub(super) ahead: [[f64; S]; S],
    /// The Runge–Kutta matrix A.
    pub(super) matrix: [[Exact; S]; S],
    /// x₁ − x₀ = Σ dᵢ zᵢ, d = bA⁻¹.
    pub(super) end: [Exact; S],
    /// The real eigenvalue of A⁻¹, if there are three stages.
    pub(super) real: f64,
    /// The complex ones, α ± iβ.
    pub(super) pair: (f64, f64),
    /// T with T⁻¹A⁻¹T = diag(real, (α β; −β α)).
    pub(super) from_blocks: [[f64; S]; S],
    /// T⁻¹.
    pub(super) to_blocks: [[f64; S]; S],
}

/// The weights of z in the stages of the next step, if this is as long.
pub(super) const fn continued<const S: usize>(nodes: [f64; S]) -> [[f64; S]; S] {
    let mut rows = [[0.0; S]; S];
    let mut row = 0;
    while row < S {
        let mut i = 0;
        while i < S {
            let (mut there, mut end) = ((1.0 + nodes[row]) / nodes[i], 1.0 / nodes[i]);
            let mut j = 0;
            while j < S {
                if i != j {
                    there *= (1.0 + nodes[row] - nodes[j]) / (nodes[i] - nodes[j]);
                    end *= (1.0 - nodes[j]) / (nodes[i] - nodes[j]);
                }
                j += 1;
            }
            rows[row][i] = there - end;
            i += 1;
        }
        row += 1;
    }
    rows
}

/// So many times its length the polynomial of a step is continued at most.
const FARTHEST: f64 = 32.0;

/// The weights of z in the collocation polynomial less x₀, through zero and the zᵢ, at the fraction s of its step.
fn weights<T: Real, const N: usize>(nodes: &[T; N], s: T) -> [T; N] {
    let mut weights = [T::ZERO; N];
    for (i, (weight, ci)) in weights.iter_mut().zip(nodes).enumerate() {
        *weight = s / *ci;
        for (j, cj) in nodes.iter().enumerate() {
            if i != j {
                *weight *= (s - *cj) / (*ci - *cj);
            }
        }
    }
    weights
}

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
        let slopes = self.slopes(start, h, z, |z| displaced(x, ScalarOf::<S>::ONE, z));
        let mut left = *z;
        for (left, row) in left.iter_mut().zip(&self.matrix) {
            for left in left.as_mut() {
                *left = -*left;
            }
            for ((a, _), slope) in row.iter().zip(&slopes) {
                *left = displaced(left, ScalarOf::<S>::from_f64(*a) * h, slope);
            }
        }
        let change = self.correction(h, matrices, &left);
        for (z, change) in z.iter_mut().zip(&change) {
            *z = displaced(z, ScalarOf::<S>::ONE, change);
        }
        change
    }

    /// One iteration with the rounding errors of sums, from the state x + rest.
    pub(super) fn iterate_exactly<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        (x, rest): (&VecOf<S>, &VecOf<S>),
        h: ScalarOf<S>,
        matrices: &Matrices<S>,
        unknowns: (&mut [VecOf<S>; N], &mut [VecOf<S>; N]),
    ) -> [VecOf<S>; N]
    where
        ScalarOf<S>: Real,
    {
        let one = ScalarOf::<S>::ONE;
        let slopes = self.slopes(start, h, unknowns.0, |z| displaced(x, one, &displaced(z, one, rest)));
        self.corrected(h, matrices, &slopes, unknowns)
    }

    /// The derivatives at the stages.
    #[inline]
    fn slopes<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        z: &[VecOf<S>; N],
        point: impl Fn(&VecOf<S>) -> VecOf<S>,
    ) -> [VecOf<S>; N] {
        let mut slopes = [DimOf::<S>::vec(ScalarOf::<S>::ZERO); N];
        for ((slope, node), z) in slopes.iter_mut().zip(&self.nodes).zip(z) {
            *slope = start.derivative_at(start.time + ScalarOf::<S>::from_f64(*node) * h, point(z));
        }
        slopes
    }

    /// One iteration from the derivatives at the unknowns, h Σ aᵢⱼ fⱼ − zᵢ being what is left of their equations.
    pub(super) fn corrected<S: Dynamics>(
        &self,
        h: ScalarOf<S>,
        matrices: &Matrices<S>,
        slopes: &[VecOf<S>; N],
        (z, rests): (&mut [VecOf<S>; N], &mut [VecOf<S>; N]),
    ) -> [VecOf<S>; N]
    where
        ScalarOf<S>: Real,
    {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let mut increments = [zero; N];
        for (increment, slope) in increments.iter_mut().zip(slopes) {
            *increment = displaced(&zero, h, slope);
        }
        let mut left = [zero; N];
        for ((left, row), (z, rest)) in left.iter_mut().zip(&self.matrix).zip(z.iter().zip(rests.iter())) {
            let known = z.as_ref().iter().zip(rest.as_ref()).enumerate();
            for (left, (k, (z, rest))) in left.as_mut().iter_mut().zip(known) {
                let terms = row.iter().zip(&increments).filter_map(|(a, f)| Some((*a, *f.as_ref().get(k)?)));
                let known = Sum { sum: -*z, rest: -*rest };
                let sum = terms.fold(known, |sum, (a, f)| sum.add_product(a, f));
                *left = sum.sum + sum.rest;
            }
        }
        let change = self.correction(h, matrices, &left);
        for ((z, rest), change) in z.iter_mut().zip(rests).zip(&change) {
            for ((z, rest), change) in z.as_mut().iter_mut().zip(rest.as_mut()).zip(change.as_ref()) {
                let sum = Sum { sum: *z, rest: *rest }.add(*change);
                (*z, *rest) = (sum.sum, sum.rest);
            }
        }
        change
    }

    /// What the unknowns change by, from what is left of their equations.
    #[inline]
    fn correction<S: Dynamics>(
        &self,
        h: ScalarOf<S>,
        matrices: &Matrices<S>,
        left: &[VecOf<S>; N],
    ) -> [VecOf<S>; N]
    where
        ScalarOf<S>: Real,
    {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let scaled = |v: f64| ScalarOf::<S>::from_f64(v) / h;
        // in blocks: Λ/h T⁻¹ of it
        let mut blocks = [zero; N];
        for (block, row) in blocks.iter_mut().zip(&self.to_blocks) {
            *block = weighted(zero, row, left);
        }
        let mut correction = [zero; N];
        let (alpha, beta) = (scaled(self.pair.0), scaled(self.pair.1));
        if let ([real @ .., w2, w3], [first @ .., c2, c3]) = (blocks.as_slice(), correction.as_mut_slice()) {
            for (c, w) in first.iter_mut().zip(real) {
                if let Some(factors) = &matrices.real {
                    *c = factors.solve(&displaced(&zero, scaled(self.real), w));
                }
            }
            let d2 = displaced(&displaced(&zero, alpha, w2), beta, w3);
            let d3 = displaced(&displaced(&zero, -beta, w2), alpha, w3);
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
        for (change, row) in change.iter_mut().zip(&self.from_blocks) {
            *change = weighted(zero, row, &correction);
        }
        change
    }

    /// x₁ − x₀.
    pub(super) fn increment<T: Real, V: Copy + AsRef<[T]> + AsMut<[T]>>(
        &self,
        zero: V,
        z: &[V; N],
        rests: &[V; N],
    ) -> V {
        let mut increment = zero;
        for (k, increment) in increment.as_mut().iter_mut().enumerate() {
            let sum = self.end.iter().zip(z.iter().zip(rests)).fold(Sum::ZERO, |sum, (d, (z, rest))| {
                let (Some(z), Some(rest)) = (z.as_ref().get(k), rest.as_ref().get(k)) else { return sum };
                let next = sum.add_product(*d, *z);
                Sum { rest: next.rest + T::from_f64(d.0) * *rest, ..next }
            });
            *increment = sum.sum + sum.rest;
        }
        increment
    }

    /// The collocation polynomial less x₀, at the fraction s of its step.
    pub(super) fn polynomial<T: Real, V: Copy + AsRef<[T]> + AsMut<[T]>>(
        &self,
        zero: V,
        z: &[V; N],
        s: T,
    ) -> V {
        let weights = weights(&self.nodes.map(T::from_f64), s);
        weights.iter().zip(z).fold(zero, |sum, (w, z)| displaced(&sum, *w, z))
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
        if ratio == T::ONE {
            for (next, row) in next.iter_mut().zip(&self.ahead) {
                *next = weighted(zero, row, z);
            }
            return next;
        }
        let nodes = self.nodes.map(T::from_f64);
        let end = weights(&nodes, T::ONE);
        for (next, node) in next.iter_mut().zip(nodes) {
            let there = weights(&nodes, T::ONE + ratio * node);
            for ((there, end), z) in there.iter().zip(&end).zip(z) {
                *next = displaced(next, *there - *end, z);
            }
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
            // Σⱼ aᵢⱼ cⱼ^(k−1) = cᵢᵏ/k
            for (row, c) in method.matrix.iter().zip(method.nodes) {
                let sum: f64 = row.iter().zip(method.nodes).map(|((a, _), c)| a * power(c, k - 1)).sum();
                assert!((sum - power(c, k) / f64::from(k)).abs() < 1e-15, "{k} {sum} {c}");
            }
            // the end is on the polynomial: Σ dᵢ cᵢᵏ = 1
            let end: f64 = method.end.iter().zip(method.nodes).map(|((d, _), c)| d * power(c, k)).sum();
            assert!((end - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn polynomials_are_continued() {
        let method = &super::super::radau5::RADAU;
        let x = |s: f64| 2.0 * s - 3.0 * s * s + 0.5 * s * s * s;
        let z = method.nodes.map(|c| [x(c)]);
        assert!((method.polynomial([0.0], &z, 0.3)[0] - x(0.3)).abs() < 1e-14);
        for ratio in [0.7, 1.0] {
            for (next, c) in method.extrapolated([0.0], &z, ratio).iter().zip(method.nodes) {
                assert!((next[0] - (x(1.0 + ratio * c) - x(1.0))).abs() < 1e-13);
            }
        }
    }
}

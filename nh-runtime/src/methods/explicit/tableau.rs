//! Explicit Runge–Kutta methods, written down as tables and compiled to straight-line code.

use core::fmt::Debug;

use crate::arrays::{Array, displaced};
use crate::dense::hermite;
use crate::methods::{Arrival, Start};
use crate::{Dynamics, Real, Scalar, ScalarOf, State, VecOf};

/// The table of an explicit Runge–Kutta method: k₁ = f(t₀, x₀), kᵢ = f(t₀ + cᵢh, x₀ + h Σ aᵢⱼkⱼ),
/// x₁ = x₀ + h Σ bᵢkᵢ.
pub trait Tableau: Copy + Default + Debug + PartialEq + 'static {
    /// The order.
    const ORDER: u32;
    /// The common factor of the bᵢ.
    const SCALE: f64;
    /// The number of stages, k₁ included.
    const STAGES: u32;
    /// The derivatives k₁ … at the stages.
    type Stages<V: Copy>: Copy;
    /// Vectors of the dense output, beyond the derivatives at both ends.
    type Bulge<V: Copy>: Copy + AsRef<[V]>;

    /// An array with an entry for each stage.
    type List<V: Copy>: Copy + AsRef<[V]> + AsMut<[V]>;
    /// The table as numbers, k₁ first: cᵢ, and the aᵢⱼ that are not zero, each with its j counted from 0.
    const ROWS: &'static [(f64, &'static [(usize, f64)])];
    /// The bᵢ without their common factor, each with its i counted from 0.
    const WEIGHTS: &'static [(usize, f64)];

    /// The stages in order.
    fn list<V: Copy>(stages: &Self::Stages<V>) -> Self::List<V>;

    /// Room for the stages.
    fn room<V: Copy>(zero: V) -> Self::Stages<V>;

    /// k₁, to be given before the others are computed.
    fn first<V: Copy>(stages: &mut Self::Stages<V>) -> &mut V;

    /// Computes k₂ … from k₁ and gives Σ bᵢkᵢ without the common factor.
    fn slope<S: Dynamics>(
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: ScalarOf<S>,
        stages: &mut Self::Stages<VecOf<S>>,
    ) -> VecOf<S>;

    /// Zero if the stages that the sum leaves out are finite, and NaN otherwise: a system may hide from the
    /// later stages what is not finite in them. Nothing if it leaves out none.
    fn unweighted<T: Scalar, V: Array<T>>(stages: &Self::Stages<V>) -> Option<T>;

    /// The coefficients of the dense output, from the stages and the derivative at the end; further
    /// stages are evaluated here.
    fn bulge<S: Dynamics>(
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        stages: &Self::Stages<VecOf<S>>,
        last: &VecOf<S>,
    ) -> Self::Bulge<VecOf<S>>;

    /// The last stage, if it is at the end of the step: its state and the derivative there.
    fn last_stage<T: Scalar, V: Array<T>>(x: &V, h: T, stages: &Self::Stages<V>) -> Option<(V, V)>;

    /// The first stage whose derivative is not finite: component, value, and the time of the stage
    /// as a fraction of the step.
    fn blame<T: Scalar, V: Array<T>>(stages: &Self::Stages<V>) -> Option<((usize, f64), f64)>;
}

/// A method with a second solution embedded, whose distance estimates the error.
pub trait Pair: Tableau {
    /// One more than the order of the estimate: the power of h that the error goes with.
    const ERROR_ORDER: u32;
    /// Steps that stability holds back, by a fast decay at the rate λ, are longer than this over λ: nine tenths of the stable
    /// interval of the negative real axis, where the error estimate lets steps grow to its end; less where it does not.
    const HELD: f64;
    /// Whether the estimate uses the derivative at the end, which is the next step's first.
    const FIRST_SAME_AS_LAST: bool;

    /// The size of the error, from the stages, the derivative at the end (where it is used), and the
    /// norm in units of the tolerance.
    fn error<T: Real, V: Array<T>>(stages: &Self::Stages<V>, last: &V, h: T, norm: impl Fn(&V) -> T) -> T;
}

/// What the states within a step are computed from: with s the fraction of the step, the cubic
/// through both ends with the derivatives there, and h s²(1−s)² Σⱼ sʲ bulgeⱼ.
#[derive(Clone, Copy)]
pub struct Dense<V, B> {
    pub(in crate::methods) first: V,
    pub(in crate::methods) last: V,
    pub(in crate::methods) bulge: B,
}

/// The state at a time within the step.
pub(in crate::methods) fn interpolate<S: Dynamics, B: AsRef<[VecOf<S>]>>(
    dense: &Dense<VecOf<S>, B>,
    start: &Start<'_, S>,
    arrival: &Arrival<S>,
    time: ScalarOf<S>,
) -> S::State {
    let h = arrival.time - start.time;
    let s = (time - start.time) / h;
    let inside = s * (ScalarOf::<S>::ONE - s);
    let (x0, x1) = (start.state.to_array(), arrival.state.to_array());
    let mut x = hermite((&x0, &dense.first), (&x1, &dense.last), h, s);
    let mut weight = h * inside * inside;
    for bulge in dense.bulge.as_ref() {
        x = displaced(&x, weight, bulge);
        weight *= s;
    }
    S::State::from_array(x)
}

/// Methods of so many stages take a small system in at each of them: in four copies it stays small.
pub(in crate::methods) const FEW: u32 = 4;

/// The place of a stage among all, by its name.
pub(super) const fn place(name: &str, stages: &[&str]) -> usize {
    let mut place = 0;
    while place < stages.len() {
        let (a, b) = (name.as_bytes(), stages[place].as_bytes());
        let mut same = a.len() == b.len();
        let mut i = 0;
        while same && i < a.len() {
            same = a[i] == b[i];
            i += 1;
        }
        if same {
            return place;
        }
        place += 1;
    }
    place
}

/// Writes down a [`Tableau`]. Coefficients that are not listed are zero, and cost nothing.
///
/// `unweighted` lists the stages that are not in the sum, `last` names the derivative at the end of the
/// step, `extra` the stages that only the dense output needs, and each row of `dense` is the combination
/// of stages that is one coefficient of the bulge.
macro_rules! tableau {
    (
        $(#[$meta:meta])*
        $name:ident, $stages:ident: order $order:literal;
        stages {
            $first:ident at 0;
            $($k:ident at $c:expr => [$a0k:ident: $a0:expr $(, $ak:ident: $a:expr)*];)*
        }
        sum $(scaled by $scale:expr;)? [$b0k:ident: $b0:expr $(, $bk:ident: $b:expr)*];
        $(unweighted [$($u:ident),*];)?
        last $last:ident;
        $(extra $e:ident at $ec:expr => [$ea0k:ident: $ea0:expr $(, $eak:ident: $ea:expr)*];)*
        dense [$([$d0k:ident: $d0:expr $(, $dk:ident: $d:expr)*]),*];
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        /// The derivatives at the stages.
        #[derive(Clone, Copy)]
        pub struct $stages<V> {
            $first: V,
            $($k: V,)*
        }

        impl $crate::methods::explicit::tableau::Tableau for $name {
            const ORDER: u32 = $order;
            const SCALE: f64 = 1.0 $(* $scale)?;
            const STAGES: u32 = 1 $(+ { let _ = stringify!($k); 1 })*;
            type Stages<V: Copy> = $stages<V>;
            type Bulge<V: Copy> = [V; 0 $(+ { let _ = stringify!($d0k); 1 })*];
            type List<V: Copy> = [V; 1 $(+ { let _ = stringify!($k); 1 })*];
            const ROWS: &'static [(f64, &'static [(usize, f64)])] = {
                #[allow(dead_code)] // Euler's method looks for no stage
                const NAMES: &[&str] = &[stringify!($first) $(, stringify!($k))*];
                &[(0.0, &[]) $(, ($c, &[
                    ($crate::methods::explicit::tableau::place(stringify!($a0k), NAMES), $a0)
                    $(, ($crate::methods::explicit::tableau::place(stringify!($ak), NAMES), $a))*
                ]))*]
            };
            const WEIGHTS: &'static [(usize, f64)] = {
                const NAMES: &[&str] = &[stringify!($first) $(, stringify!($k))*];
                &[
                    ($crate::methods::explicit::tableau::place(stringify!($b0k), NAMES), $b0)
                    $(, ($crate::methods::explicit::tableau::place(stringify!($bk), NAMES), $b))*
                ]
            };

            #[inline]
            fn list<V: Copy>(stages: &$stages<V>) -> Self::List<V> {
                [stages.$first $(, stages.$k)*]
            }

            #[inline]
            fn room<V: Copy>(zero: V) -> $stages<V> {
                $stages { $first: zero, $($k: zero),* }
            }

            #[inline]
            fn first<V: Copy>(stages: &mut $stages<V>) -> &mut V {
                &mut stages.$first
            }

            // in one piece with the step, what the system leaves unused is not computed
            #[inline(always)]
            #[allow(clippy::inline_always)]
            fn slope<S: $crate::Dynamics>(
                start: &$crate::methods::Start<'_, S>,
                x: &$crate::VecOf<S>,
                h: $crate::ScalarOf<S>,
                stages: &mut $stages<$crate::VecOf<S>>,
            ) -> $crate::VecOf<S> {
                use $crate::Scalar;
                let w = $crate::ScalarOf::<S>::from_f64;
                $(
                    let ahead = $crate::arrays::ahead(
                        x, h, (w($a0), &stages.$a0k), [$((w($a), &stages.$ak)),*],
                    );
                    let time = start.time + w($c) * h;
                    stages.$k = if Self::STAGES <= $crate::methods::explicit::tableau::FEW {
                        start.derivative_in_line(time, ahead)
                    } else {
                        start.derivative_at(time, ahead)
                    };
                )*
                let _ = (start, x, h);
                $crate::arrays::combined((w($b0), &stages.$b0k), [$((w($b), &stages.$bk)),*])
            }

            #[inline]
            fn unweighted<T: $crate::Scalar, V: $crate::arrays::Array<T>>(stages: &$stages<V>) -> Option<T> {
                let _ = stages;
                None $(.or(Some(T::ZERO $(+ $crate::arrays::nought(&stages.$u))*)))?
            }

            #[allow(unused_variables, clippy::trivially_copy_pass_by_ref)] // not every stage is used
            fn bulge<S: $crate::Dynamics>(
                start: &$crate::methods::Start<'_, S>,
                h: $crate::ScalarOf<S>,
                stages: &$stages<$crate::VecOf<S>>,
                $last: &$crate::VecOf<S>,
            ) -> Self::Bulge<$crate::VecOf<S>> {
                use $crate::{Scalar, State};
                let w = $crate::ScalarOf::<S>::from_f64;
                let $stages { $first, $($k),* } = stages;
                let x = start.state.to_array();
                $(
                    let ahead = $crate::arrays::ahead(&x, h, (w($ea0), $ea0k), [$((w($ea), $eak)),*]);
                    let $e = &start.derivative_at(start.time + w($ec) * h, ahead);
                )*
                [$($crate::arrays::combined((w($d0), $d0k), [$((w($d), $dk)),*])),*]
            }

            #[cold]
            #[inline(never)]
            #[allow(unused_assignments, unused_mut, clippy::float_cmp)] // the last one stays; a node at the end is 1
            fn last_stage<T: $crate::Scalar, V: $crate::arrays::Array<T>>(
                x: &V,
                h: T,
                stages: &$stages<V>,
            ) -> Option<(V, V)> {
                let w = T::from_f64;
                let mut last = None;
                $(
                    last = ($c == 1.0).then(|| {
                        let rest = [$((w($a), &stages.$ak)),*];
                        ($crate::arrays::ahead(x, h, (w($a0), &stages.$a0k), rest), stages.$k)
                    });
                )*
                let _ = (x, h, stages, w);
                last
            }

            #[cold]
            fn blame<T: $crate::Scalar, V: $crate::arrays::Array<T>>(
                stages: &$stages<V>,
            ) -> Option<((usize, f64), f64)> {
                [(&stages.$first, 0.0) $(, (&stages.$k, $c))*].into_iter().find_map(|(k, c): (&V, f64)| {
                    $crate::arrays::first_non_finite::<T>(k.as_ref()).map(|found| (found, c))
                })
            }
        }

        #[cfg(test)]
        impl $crate::methods::explicit::order_conditions::Coefficients for $name {
            fn rows() -> std::vec::Vec<(&'static str, f64, std::vec::Vec<(&'static str, f64)>)> {
                std::vec![
                    (stringify!($first), 0.0, std::vec![]),
                    $((
                        stringify!($k), $c,
                        std::vec![(stringify!($a0k), $a0) $(, (stringify!($ak), $a))*],
                    ),)*
                ]
            }
            fn weights() -> std::vec::Vec<(&'static str, f64)> {
                let scale = <Self as $crate::methods::explicit::tableau::Tableau>::SCALE;
                std::vec![(stringify!($b0k), $b0 * scale) $(, (stringify!($bk), $b * scale))*]
            }
            fn unweighted() -> std::vec::Vec<&'static str> {
                std::vec![$($(stringify!($u)),*)?]
            }
            fn last() -> &'static str {
                stringify!($last)
            }
            fn extras() -> std::vec::Vec<(&'static str, f64, std::vec::Vec<(&'static str, f64)>)> {
                std::vec![$((
                    stringify!($e), $ec,
                    std::vec![(stringify!($ea0k), $ea0) $(, (stringify!($eak), $ea))*],
                ),)*]
            }
            fn bulges() -> std::vec::Vec<std::vec::Vec<(&'static str, f64)>> {
                std::vec![$(std::vec![(stringify!($d0k), $d0) $(, (stringify!($dk), $d))*]),*]
            }
        }
    };
}

/// Writes down the error weights that make a table a [`Pair`]: of the stages, and of the derivative at
/// the end of the step if that is used.
///
/// Stages without a weight act through the others alone: what they leave unused is not computed.
macro_rules! embedded {
    (
        $name:ident: error order $order:literal, first same as last $fsal:literal, held at $held:literal;
        error [$e0k:ident: $e0:expr $(, $ek:ident: $e:expr)*] $(last [$el:expr])?;
    ) => {
        impl $crate::methods::explicit::tableau::Pair for $name {
            const ERROR_ORDER: u32 = $order;
            const HELD: f64 = $held;
            const FIRST_SAME_AS_LAST: bool = $fsal;

            #[inline]
            fn error<T: $crate::Real, V: $crate::arrays::Array<T>>(
                stages: &Self::Stages<V>,
                last: &V,
                h: T,
                norm: impl Fn(&V) -> T,
            ) -> T {
                let w = T::from_f64;
                let _ = last;
                let defect = $crate::arrays::combined(
                    (w($e0), &stages.$e0k), [$((w($e), &stages.$ek),)* $((w($el), last))?],
                );
                h.abs() * norm(&defect)
            }
        }

        #[cfg(test)]
        impl $crate::methods::explicit::order_conditions::ErrorWeights for $name {
            fn errors() -> std::vec::Vec<std::vec::Vec<(&'static str, f64)>> {
                std::vec![std::vec![
                    (stringify!($e0k), $e0) $(, (stringify!($ek), $e))* $(, ("last", $el))?
                ]]
            }
        }
    };
}

pub(super) use {embedded, tableau};

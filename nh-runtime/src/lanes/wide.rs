//! [`Scalar`] for the lanes of the crate `wide`.

use ::wide::{f32x8, f64x4, u32x8, u64x4};

use super::Lanes;
use crate::sine::{self, Sine};
use crate::{Fast, Scalar};

/// Implements [`Scalar`] and [`Lanes`] for a pack of a primitive type.
macro_rules! pack {
    ($pack:ident of $count:literal $lane:tt, $bits:ident of $word:ident) => {
        impl Lanes for $pack {
            type Lane = $lane;
            const COUNT: usize = $count;

            #[inline]
            fn from_lanes(number: impl FnMut(usize) -> $lane) -> Self {
                Self::new(core::array::from_fn(number))
            }
            #[inline]
            fn splat(number: $lane) -> Self {
                Self::new([number; $count])
            }
            #[inline]
            fn lane(self, index: usize) -> $lane {
                self.to_array().get(index).copied().unwrap_or(0.0)
            }
        }

        impl Scalar for $pack {
            const ZERO: Self = Self::new([0.0; $count]);
            const ONE: Self = Self::new([1.0; $count]);

            #[inline]
            fn from_f64(value: f64) -> Self {
                Self::new([Scalar::from_f64(value); $count])
            }
            fn to_f64(self) -> f64 {
                let lanes = self.to_array();
                let [first, ..] = lanes;
                lanes.into_iter().find(|lane| !lane.is_finite()).unwrap_or(first).to_f64()
            }
            #[inline]
            fn sqrt(self) -> Self {
                $pack::sqrt(self)
            }
            #[inline]
            fn sin(self) -> Self {
                sine::sin_cos(self).0
            }
            #[inline]
            fn cos(self) -> Self {
                sine::sin_cos(self).1
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                sine::sin_cos(self)
            }
            pack! { @each $lane; cbrt tan asin acos atan sinh cosh tanh exp ln }
            fn atan2(self, x: Self) -> Self {
                let (y, x) = (self.to_array(), x.to_array());
                Self::new(core::array::from_fn(|i| Scalar::atan2(y[i], x[i])))
            }
            fn powf(self, exponent: Self) -> Self {
                let (base, exponent) = (self.to_array(), exponent.to_array());
                Self::new(core::array::from_fn(|i| Scalar::powf(base[i], exponent[i])))
            }
            #[inline]
            fn abs(self) -> Self {
                $pack::abs(self)
            }
            #[inline]
            fn sign(self) -> Self {
                let negative = self.simd_lt(Self::ZERO).select(-Self::ONE, self);
                self.simd_gt(Self::ZERO).select(Self::ONE, negative)
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                (self.simd_lt(other) | self.simd_ne(self)).select(self, other)
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                (self.simd_gt(other) | self.simd_ne(self)).select(self, other)
            }
            #[inline]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                // where that of one number is fused, and nowhere else
                #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
                {
                    $pack::mul_add(self, factor, summand)
                }
                #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
                {
                    self * factor + summand
                }
            }
            #[inline]
            fn mul_add_exact(self, factor: Self, summand: Self) -> Self {
                let (a, b, c) = (self.to_array(), factor.to_array(), summand.to_array());
                Self::new(core::array::from_fn(|i| Scalar::mul_add_exact(a[i], b[i], c[i])))
            }
            #[inline]
            fn is_finite(self) -> bool {
                $pack::is_finite(self).all()
            }
            #[inline]
            fn all_gt(self, other: Self) -> bool {
                self.simd_gt(other).all()
            }
            #[inline]
            fn all_ge(self, other: Self) -> bool {
                self.simd_ge(other).all()
            }
            #[inline]
            fn all_ne(self, other: Self) -> bool {
                self.simd_ne(other).all()
            }
            #[inline]
            fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
                self.simd_gt(other).select(then, otherwise)
            }
        }

        impl Sine for $pack {
            sine::coefficients!($lane);

            #[inline]
            fn turned(sin: Self, cos: Self, counter: Self) -> (Self, Self) {
                const SIGN: u32 = $word::BITS - 1;
                let bits = |pack: Self| -> $bits { ::wide::bytemuck::cast(pack) };
                let pack = |bits: $bits| -> Self { ::wide::bytemuck::cast(bits) };
                let one = $bits::splat(1);
                let sign = $bits::splat(1 << SIGN);
                let (n, sin, cos) = (bits(counter), bits(sin), bits(cos));
                let exchange = (sin ^ cos) & ($bits::splat(0) - (n & one));
                let half_turns = n << (SIGN - 1);
                let sin = sin ^ exchange ^ (half_turns & sign);
                let cos = cos ^ exchange ^ (((n + one) << (SIGN - 1)) & sign);
                (pack(sin), pack(cos))
            }

            #[cold]
            #[inline(never)]
            fn beyond_reach(self) -> (Self, Self) {
                let pairs = self.to_array().map(|lane| Fast(lane).sin_cos());
                (Self::new(pairs.map(|(sin, _)| sin.0)), Self::new(pairs.map(|(_, cos)| cos.0)))
            }
        }
    };
    (@each $lane:ident; $($name:ident)*) => {
        $(
            fn $name(self) -> Self {
                Self::new(self.to_array().map(<$lane as Scalar>::$name))
            }
        )*
    };
}

pack!(f64x4 of 4 f64, u64x4 of u64);
pack!(f32x8 of 8 f32, u32x8 of u32);

//! Sine and cosine of large angles: the reduction of M. H. Payne and R. N. Hanek (Radian reduction for
//! trigonometric functions, ACM SIGNUM Newsletter 18, 1983), in integers.
//!
//! A finite number is m · 2^e with an integer m. Of 2/π in binary, the digits whose product with it is
//! a multiple of 4 do not matter; the 192 digits after them leave more than 100 correct digits of the
//! fraction, twice what the closest approach of a number to a multiple of π/2 needs.

use super::{Sine, of_reduced};
use crate::Scalar;

/// 2/π in binary after 64 digits 0, 64 digits each.
const TWO_OVER_PI: [u64; 20] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

/// π/2 · 2^63.
const HALF_PI: u64 = 0xc90f_daa2_2168_c235;

/// A number of a binary format, in parts.
pub(super) trait Parts: Sine {
    /// m and e of |x| = m · 2^e, and whether x is negative.
    fn parts(self) -> (u64, u32, bool);
    /// g · 2^−shift.
    fn scaled(g: u64, shift: u32) -> Self;
    /// The counter of [`sin_cos`](super::sin_cos) that has a small n in its last digits.
    fn counter(n: u8) -> Self;
}

/// The offset of exponents: `parts` gives e + 128, so that it is not negative where it is needed.
const OFFSET: u32 = 128;

macro_rules! parts {
    ($float:ident, $bits:ident) => {
        impl Parts for $float {
            #[allow(clippy::cast_lossless, clippy::cast_possible_truncation)] // an exponent is small
            fn parts(self) -> (u64, u32, bool) {
                const DIGITS: u32 = $float::MANTISSA_DIGITS - 1;
                const BIAS: u32 = $float::MAX_EXP as u32 - 1 + DIGITS;
                let bits = self.abs().to_bits();
                let mantissa = (bits & ((1 << DIGITS) - 1)) | (1 << DIGITS);
                let exponent = (bits >> DIGITS) as u32;
                (mantissa as u64, (exponent + OFFSET).saturating_sub(BIAS), self < 0.0)
            }
            fn counter(n: u8) -> Self {
                Self::from_f64(Self::ROUNDER) + Self::from(n)
            }
            #[allow(clippy::cast_precision_loss)] // the one rounding
            fn scaled(g: u64, shift: u32) -> Self {
                const DIGITS: u32 = $float::MANTISSA_DIGITS - 1;
                const BIAS: u32 = $float::MAX_EXP as u32 - 1;
                g as Self * Self::from_bits($bits::from(BIAS.saturating_sub(shift)) << DIGITS)
            }
        }
    };
}
parts!(f64, u64);
parts!(f32, u32);

/// Sine and cosine of a finite number of at least 2^12.
#[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)] // digits are cut out on purpose
pub(super) fn sin_cos<T: Parts>(x: T) -> (T, T) {
    let (m, e, negative) = x.parts();
    // the first digit that matters has the weight 2^(1 − e)
    let first = (e + 62).saturating_sub(OFFSET);
    let (word, shift) = (first as usize / 64, first % 64);
    // the table is long enough for every finite number
    let word = |i: usize| u128::from(TWO_OVER_PI.get(word + i).copied().unwrap_or(0));
    let digits = [0, 1, 2].map(|i| ((((word(i) << 64) | word(i + 1)) << shift) >> 64) as u64);
    // m times the digits, modulo 4: two digits before the point, 126 after it
    let product = (u128::from(m.wrapping_mul(digits[0])) << 64)
        .wrapping_add(u128::from(m) * u128::from(digits[1]))
        .wrapping_add((u128::from(m) * u128::from(digits[2])) >> 64);
    // what is left after the nearest quarter turn, with its sign in the first digit
    let fraction = (product << 2) as i128;
    let quarters = (product >> 126) as u8 + u8::from(fraction < 0);
    let magnitude = fraction.unsigned_abs();
    let zeros = magnitude.leading_zeros().min(127);
    let leading = ((magnitude << zeros) >> 64) as u64;
    let r = T::scaled(((u128::from(leading) * u128::from(HALF_PI)) >> 64) as u64, 63 + zeros);
    let r = if (fraction < 0) == negative { r } else { -r };
    let n = if negative { quarters.wrapping_neg() } else { quarters } & 3;
    of_reduced(r, T::counter(n))
}

//! The elementary functions of 31 digits.
//!
//! A root, a logarithm or an angle starts from the nearest `f64` and takes one step of Newton's method,
//! whose error is the square of that of the start; sine, cosine and exponential are Taylor's series of a
//! small part of the argument. Each is as precise relative to its own size: near 0, and near 1 where it
//! vanishes there. Powers lose the digits that their exponents grow by.

use nonholonomic::Scalar;

use super::{DoubleDouble, two_product};

/// π/2 in three parts, each the nearest to what the ones before leave.
const HALF_PI: [f64; 3] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// ln 2 in three parts.
const LN_2: [f64; 3] = [std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17, 5.707_708_438_416_212e-34];

/// The argument as the nearest multiple of a period, and the rest.
fn divided(x: DoubleDouble, period: [f64; 3]) -> (f64, DoubleDouble) {
    let times = (x.high / period[0]).round();
    (times, period.iter().fold(x, |rest, part| rest - two_product(times, *part)))
}

pub(super) fn sqrt(x: DoubleDouble) -> DoubleDouble {
    if x.high <= 0.0 {
        return DoubleDouble::from_f64(x.high.sqrt());
    }
    let root = DoubleDouble::from_f64(x.high.sqrt());
    root + (x - root * root) / root.scaled(2.0)
}

pub(super) fn cbrt(x: DoubleDouble) -> DoubleDouble {
    let root = DoubleDouble::from_f64(x.high.cbrt());
    if x.high == 0.0 { root } else { root + (x / (root * root) - root) / DoubleDouble::from_f64(3.0) }
}

pub(super) fn sin_cos(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    // 1. the rest of the division by a quarter turn
    let (quarters, rest) = divided(x, HALF_PI);
    // 2. Taylor's series of an eighth of it, for sin and cos − 1
    let small = rest.scaled(0.125);
    let (mut sin, mut less) = (DoubleDouble::ZERO, DoubleDouble::ZERO);
    let mut term = DoubleDouble::ONE;
    for order in 1..=24 {
        term = term * small / DoubleDouble::from_f64(f64::from(order));
        match order % 4 {
            1 => sin += term,
            2 => less -= term,
            3 => sin -= term,
            _ => less += term,
        }
    }
    // 3. doubled three times
    for _ in 0..3 {
        (sin, less) =
            ((sin + sin * less).scaled(2.0), (less * (less + DoubleDouble::from_f64(2.0))).scaled(2.0));
    }
    let cos = DoubleDouble::ONE + less;
    // 4. turned back
    match quarters.rem_euclid(4.0) {
        0.0 => (sin, cos),
        1.0 => (cos, -sin),
        2.0 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The angle of the point (x, y).
pub(super) fn angle(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble {
    let start = DoubleDouble::from_f64(y.high.atan2(x.high));
    let (sin, cos) = sin_cos(start);
    // what is left to turn: its tangent is as good as itself
    let along = x * cos + y * sin;
    if along.high == 0.0 { start } else { start + (y * cos - x * sin) / along }
}

/// The length of the other leg, where one is `x` and the hypotenuse 1.
pub(super) fn other_leg(x: DoubleDouble) -> DoubleDouble {
    sqrt((DoubleDouble::ONE - x) * (DoubleDouble::ONE + x))
}

/// A number times 2ⁿ, in two steps that stay in range.
fn times_power_of_two(x: DoubleDouble, n: f64) -> DoubleDouble {
    let half = (n / 2.0).trunc();
    x.scaled(half.exp2()).scaled((n - half).exp2())
}

/// eˣ − 1 for |x| below one half.
fn small_exp_less_one(x: DoubleDouble) -> DoubleDouble {
    // Taylor's series of an eighth of it, doubled three times
    let small = x.scaled(0.125);
    let (mut less, mut term) = (DoubleDouble::ZERO, DoubleDouble::ONE);
    for order in 1..=20 {
        term = term * small / DoubleDouble::from_f64(f64::from(order));
        less += term;
    }
    for _ in 0..3 {
        less = less * (less + DoubleDouble::from_f64(2.0));
    }
    less
}

pub(super) fn exp(x: DoubleDouble) -> DoubleDouble {
    let plain = x.high.exp();
    if plain == 0.0 || !plain.is_finite() {
        return DoubleDouble::from_f64(plain);
    }
    let (twos, rest) = divided(x, LN_2);
    times_power_of_two(DoubleDouble::ONE + small_exp_less_one(rest), twos)
}

/// eˣ − 1.
fn exp_less_one(x: DoubleDouble) -> DoubleDouble {
    if x.high.abs() < 0.5 { small_exp_less_one(x) } else { exp(x) - DoubleDouble::ONE }
}

pub(super) fn ln(x: DoubleDouble) -> DoubleDouble {
    let start = x.high.ln();
    if !start.is_finite() {
        return DoubleDouble::from_f64(start);
    }
    if start < -0.5 {
        return -ln(DoubleDouble::ONE / x);
    }
    let start = DoubleDouble::from_f64(start);
    // x e⁻ˢ = 1 + left, in a form that keeps the digits of x − 1
    let left = (x - DoubleDouble::ONE - exp_less_one(start)) / exp(start);
    start + left
}

/// sinh |x| and cosh |x|.
fn hyperbolic(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let less = exp_less_one(x.abs());
    let grown = DoubleDouble::ONE + less;
    ((less + less / grown).scaled(0.5), (grown + DoubleDouble::ONE / grown).scaled(0.5))
}

pub(super) fn sinh(x: DoubleDouble) -> DoubleDouble {
    x.sign() * hyperbolic(x).0
}

pub(super) fn cosh(x: DoubleDouble) -> DoubleDouble {
    hyperbolic(x).1
}

pub(super) fn tanh(x: DoubleDouble) -> DoubleDouble {
    if x.high.abs() > 40.0 {
        return x.sign(); // up to 2 e⁻⁸⁰
    }
    let less = exp_less_one(x.abs().scaled(2.0));
    x.sign() * (less / (less + DoubleDouble::from_f64(2.0)))
}

pub(super) fn powf(base: DoubleDouble, exponent: DoubleDouble) -> DoubleDouble {
    let plain = base.high.powf(exponent.high);
    if base.high == 0.0 || plain == 0.0 || !plain.is_finite() {
        return DoubleDouble::from_f64(plain);
    }
    let size = exp(exponent * ln(base.abs()));
    if plain < 0.0 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: DoubleDouble = DoubleDouble::ONE;
    const SIN_ONE: [f64; 2] = [0.841_470_984_807_896_5, 1.776_845_092_935_536e-18];
    const COS_ONE: [f64; 2] = [0.540_302_305_868_139_8, -4.760_954_612_604_417e-17];

    fn of(value: f64) -> DoubleDouble {
        DoubleDouble::from_f64(value)
    }

    /// The number is this one to thirty digits.
    fn is(found: DoubleDouble, high: f64, low: f64) {
        same(found, DoubleDouble { high, low });
    }

    fn same(found: DoubleDouble, expected: DoubleDouble) {
        let error = found - expected;
        assert!(error.high.abs() <= 1e-30 * expected.high.abs(), "{found:?} for {expected:?}");
    }

    #[test]
    fn thirty_digits() {
        // as mpmath gives them
        is(of(2.0).sqrt(), std::f64::consts::SQRT_2, -9.667_293_313_452_913e-17);
        is(of(2.0).cbrt(), 1.259_921_049_894_873_2, -2.589_933_375_300_507e-17);
        is(of(1.0).exp(), std::f64::consts::E, 1.445_646_891_729_250_2e-16);
        is(of(-20.5).exp(), 1.250_152_866_386_742_6e-9, 6.448_235_878_237_776e-26);
        is(of(10.0).ln(), std::f64::consts::LN_10, -2.170_756_223_382_249_4e-16);
        let near_one = of(1.0 + (-30.0_f64).exp2());
        is(near_one.ln(), 9.313_225_741_817_976e-10, 2.692_645_221_273_596e-28);
        is(of(1.0).tan(), 1.557_407_724_654_902_3, -6.186_464_176_037_592e-17);
        is(of(0.75).asin(), 0.848_062_078_981_481, 3.505_894_887_495_446_5e-18);
        is(of(0.75).acos(), 0.722_734_247_813_415_7, -5.329_585_739_264_344e-17);
        is(of(0.25).atan(), 0.244_978_663_126_864_14, 1.069_875_561_873_445_1e-17);
        is(of(1.0).atan2(of(-2.0)), 2.677_945_044_588_987, 1.552_770_536_930_314_7e-16);
        is(of(0.0).atan2(of(-2.0)), 2.0 * HALF_PI[0], 2.0 * HALF_PI[1]);
        is(of(0.25).sinh(), 0.252_612_316_808_168_3, -5.550_352_555_023_456e-18);
        is(of(0.25).cosh(), 1.031_413_099_879_573_2, -1.578_222_208_955_495_4e-17);
        is(of(0.25).tanh(), 0.244_918_662_403_709_13, -1.603_622_884_988_269_3e-18);
        is(of(2.5).powf(of(-3.25)), 0.050_897_326_641_091_24, 2.992_082_607_611_438e-19);
    }

    #[test]
    fn turned_by_whole_turns() {
        for turns in [0.0, 4.0, -8.0] {
            let turned = of(1.0) + of(turns) * DoubleDouble { high: HALF_PI[0], low: HALF_PI[1] };
            let (sin, cos) = turned.sin_cos();
            is(sin, SIN_ONE[0], SIN_ONE[1]);
            is(cos, COS_ONE[0], COS_ONE[1]);
        }
    }

    #[test]
    fn identities_of_angles() {
        for x in [1e-9, 0.3, 0.785, 1.57, 2.2, -3.0, 99.0, -1234.5] {
            let (sin, cos) = of(x).sin_cos();
            let (twice, _) = of(2.0 * x).sin_cos();
            let defect = sin * sin + cos * cos - ONE;
            assert!(defect.high.abs() < 1e-30, "{x}: {defect:?}");
            let defect = (sin * cos).scaled(2.0) - twice;
            assert!(defect.high.abs() < 1e-30 * twice.high.abs().max(1e-4), "{x}: {defect:?}");
        }
    }

    #[test]
    fn angles_are_found_back() {
        for x in [1e-9, 0.3, 0.785, 1.3, -1e-5, -0.6, -1.2] {
            let x = of(x) + of(x * 1e-17);
            same(x.sin().asin(), x);
            same(x.tan().atan(), x);
            // the cosine of a small angle does not know it
            if x.high > 0.1 {
                same(x.cos().acos(), x);
            }
        }
        for x in [0.3, 1.57, 2.2, 3.1, -0.3, -1.6, -3.0] {
            let (sin, cos) = of(x).sin_cos();
            same((sin * of(7.0)).atan2(cos * of(7.0)), of(x));
        }
    }

    #[test]
    fn logarithms_and_exponentials() {
        for x in [1e-9, 0.2, 0.4, 1.0, 3.7, 41.0, 300.0] {
            let (x, inverse) = (of(x), ONE / of(x));
            same(x.ln().exp(), x);
            same(inverse.ln(), -x.ln());
            same((x * x).ln().scaled(0.5) + ONE, x.ln() + ONE);
            same(x.scaled(0.5).exp() * x.scaled(0.5).exp(), x.exp());
            let (sinh, cosh) = (x.sinh(), x.cosh());
            same(sinh + cosh, x.exp());
            same(x.scaled(2.0).sinh(), (sinh * cosh).scaled(2.0));
            same(x.tanh(), sinh / cosh);
            same((-x).tanh(), -(sinh / cosh));
        }
    }

    #[test]
    fn powers_and_roots() {
        for x in [1e-9, 0.7, 2.0, 31.0] {
            let x = of(x);
            same(x.powf(of(3.0)), x * x * x);
            same((-x).powf(of(3.0)), -(x * x * x));
            same(x.powf(of(0.5)), x.sqrt());
            let root = (-x).cbrt();
            same(root * root * root, -x);
        }
    }

    #[test]
    fn where_there_is_no_value() {
        let nan = of(f64::NAN);
        for x in [of(-1.0).sqrt(), of(-1.0).ln(), of(2.0).asin(), of(-2.0).powf(of(0.5)), nan.min(ONE)] {
            assert!(x.high.is_nan(), "{x:?}");
        }
        assert!(ONE.max(nan).high.is_nan());
        assert!(of(0.0).ln().high < f64::MIN && of(1e3).exp().high > f64::MAX);
        assert_eq!([of(-1e3).exp(), of(0.0).atan2(ONE), of(0.0).cbrt(), of(0.0).sinh()], [of(0.0); 4]);
        assert_eq!([of(2.0).min(ONE), of(2.0).max(ONE)], [ONE, of(2.0)]);
    }
}

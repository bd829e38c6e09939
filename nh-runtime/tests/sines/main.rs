//! The error of the runtime's own sine and cosine, which [`Fast`] numbers share with lanes, in units in the last place,
//! against references of twice the digits.
//!
//! Over every number of f32 and fifty million of f64, two minutes of processor time, shared by all cores:
//!
//! ```sh
//! cargo test --release -p nonholonomic --test sines -- --nocapture
//! ```

use nonholonomic::{Fast, Scalar};

fn sin_cos<T>(x: T) -> (T, T)
where
    Fast<T>: Scalar,
{
    let (sine, cosine) = Fast(x).sin_cos();
    (sine.0, cosine.0)
}

/// A number of twice the digits: the sum of two.
#[derive(Clone, Copy)]
struct Double(f64, f64);

impl Double {
    fn sum(a: f64, b: f64) -> Self {
        let s = a + b;
        let of_b = s - a;
        Self(s, (a - (s - of_b)) + (b - of_b))
    }
    fn product(a: f64, b: f64) -> Self {
        let p = a * b;
        Self(p, f64::mul_add(a, b, -p))
    }
    fn plus(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.0, other.0), Self::sum(self.1, other.1));
        let high = Self::sum(high.0, high.1 + low.0);
        Self::sum(high.0, high.1 + low.1)
    }
    fn times(self, other: Self) -> Self {
        let Self(p, e) = Self::product(self.0, other.0);
        Self::sum(p, e + (self.0 * other.1 + self.1 * other.0))
    }
    fn over(self, divisor: f64) -> Self {
        let q = self.0 / divisor;
        let Self(p, e) = Self::product(q, divisor);
        Self::sum(q, ((self.0 - p) - e + self.1) / divisor)
    }
}

/// π/2 in three numbers.
const HALF_PI: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Sine and cosine by their Taylor series, of a number of at most 2^30 in absolute value.
fn reference(x: f64) -> [Double; 2] {
    let n = (x / HALF_PI[0]).round();
    let r = HALF_PI.iter().fold(Double(x, 0.0), |r, part| r.plus(Double::product(-n, *part)));
    let minus_square = {
        let Double(high, low) = r.times(r);
        Double(-high, -low)
    };
    let series = |first: Double, k: f64| {
        let (mut term, mut sum) = (first, first);
        for i in 0..16 {
            let k = k + 2.0 * f64::from(i);
            term = term.times(minus_square).over(k * (k + 1.0));
            sum = sum.plus(term);
            // terms fall faster than by a quarter, and the digits of the sum end here
            if term.0.abs() < 1e-33 * sum.0.abs() {
                break;
            }
        }
        sum
    };
    let (sin, cos) = (series(r, 2.0), series(Double(1.0, 0.0), 1.0));
    let minus = |Double(high, low): Double| Double(-high, -low);
    match n.rem_euclid(4.0) {
        0.0 => [sin, cos],
        1.0 => [cos, minus(sin)],
        2.0 => [minus(sin), minus(cos)],
        _ => [minus(cos), sin],
    }
}

/// The error in units in the last place of the exact value, of so many digits; infinite where it is no number.
fn ulps(computed: f64, exact: Double, digits: u64) -> f64 {
    let exponent = (exact.0.to_bits() >> 52) & 0x7ff;
    let unit = f64::from_bits((exponent + 1).saturating_sub(digits).max(1) << 52);
    let error = ((computed - exact.0) - exact.1).abs() / unit;
    if error.is_nan() { f64::INFINITY } else { error }
}

/// The larger error of sine and cosine.
fn error(x: f64, [sin, cos]: [Double; 2]) -> f64 {
    let ours = sin_cos(x);
    ulps(ours.0, sin, 53).max(ulps(ours.1, cos, 53))
}

/// The larger error in single precision, where double precision is the reference.
fn single_error(x: f32, (sin, cos): (f64, f64)) -> f64 {
    let ours = sin_cos(x);
    ulps(ours.0.into(), Double(sin, 0.0), 24).max(ulps(ours.1.into(), Double(cos, 0.0), 24))
}

/// So many numbers of f32 in a row have one exponent, and lie at equal distances.
const ROW: u32 = 256;

/// The largest error in single precision among [`ROW`] numbers in a row, and where.
///
/// The reference is the platform's double precision; or the first terms of the series, of nearly half of all numbers with all
/// the digits of double precision; or the numbers before, turned by the distance. After a row of turns 1e-13 is lost of a
/// radius of one, a ten-thousandth of a unit where neither sine nor cosine is below 1e-2; where one is, the platform is asked.
fn worst_of_a_row(first: u32) -> (f64, f32) {
    let number = |i: u32| f32::from_bits(first + i);
    let start = f64::from(number(0));
    let is_small = start.abs() < 1.0 / 8192.0;
    let (mut sin, mut cos) = start.sin_cos();
    let (turn_sin, turn_cos) = (f64::from(number(1)) - start).sin_cos();
    let mut worst = (0.0, 0.0);
    for x in (0..ROW).map(number) {
        let wide = f64::from(x);
        let exact = if is_small {
            (wide - wide.powi(3) / 6.0, 1.0 - wide.powi(2) / 2.0)
        } else if sin.abs().min(cos.abs()) < 1e-2 {
            wide.sin_cos()
        } else {
            (sin, cos)
        };
        let found = single_error(x, exact);
        if found > worst.0 {
            worst = (found, x);
        }
        (sin, cos) = (sin * turn_cos + cos * turn_sin, cos * turn_cos - sin * turn_sin);
    }
    worst
}

fn random(seed: &mut u64) -> u64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    *seed
}

/// The largest errors that are accepted. They are documented at [`Fast`].
const WORST: f64 = 1.6;
const WORST_SINGLE: f64 = 2.4;

#[test]
fn hard_cases_in_double_precision() {
    for line in include_str!("hard_cases.txt").lines().filter(|line| !line.starts_with('#')) {
        let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
        let x = numbers[0];
        let exact = [Double(numbers[1], numbers[2]), Double(numbers[3], numbers[4])];
        let found = error(x, exact);
        assert!(found <= WORST, "{x:e}: {found}");
        if x.abs() < 1e9 {
            for (by_series, exact) in reference(x).into_iter().zip(exact) {
                let relative = ((by_series.0 - exact.0) + (by_series.1 - exact.1)) / exact.0;
                assert!(relative.abs() < 1e-22, "the reference at {x:e}: {relative:e}");
            }
        }
    }
}

/// Whether there is time for every number of f32: a debug build takes a sample.
const ALL: bool = !cfg!(debug_assertions);

/// The threads that share the numbers: always as many, so that the random ones are the same everywhere.
const THREADS: u32 = 8;

/// The largest error, and where, of what every thread finds in its part.
fn worst_of<X: Copy + Default + Send + 'static>(part: fn(u32) -> (f64, X)) -> (f64, X) {
    let parts: Vec<_> = (0..THREADS).map(|thread| std::thread::spawn(move || part(thread))).collect();
    let found = parts.into_iter().map(|part| part.join().unwrap());
    found.fold((0.0, X::default()), |worst, found| if found.0 > worst.0 { found } else { worst })
}

#[test]
fn random_numbers_in_double_precision() {
    let (worst, x) = worst_of(|thread| {
        let samples = if ALL { 50_000_000 } else { 100_000 } / THREADS;
        let mut seed = 0x9e37_79b9_7f4a_7c15 ^ (u64::from(thread) << 32);
        let mut worst = (0.0, 0.0);
        for i in 0..samples {
            // one in four in the first turns, the others of every magnitude
            let bits = random(&mut seed);
            let exponent = if i % 4 == 0 { 1023 + 2 } else { 1023 - 30 + random(&mut seed) % 60 };
            let x = f64::from_bits((bits & 0x800f_ffff_ffff_ffff) | (exponent << 52));
            let x = if i % 4 == 0 { x.signum() * (x.abs() - 4.0) * 3.0 } else { x };
            let found = error(x, reference(x));
            if found > worst.0 {
                worst = (found, x);
            }
        }
        worst
    });
    println!("largest error of f64: {worst} units at {x:e}");
    assert!(worst <= WORST, "{worst} at {x:e}");
}

/// All finite numbers that are not negative; [`odd_and_even_functions_of_their_argument`] has the others.
#[test]
fn single_precision() {
    let (worst, x) = worst_of(|thread| {
        let step = if ALL { 1 } else { 4001 } * ROW;
        let rows = (thread * step..f32::INFINITY.to_bits()).step_by((THREADS * step) as usize);
        rows.map(worst_of_a_row)
            .fold((0.0, 0.0), |worst, found| if found.0 > worst.0 { found } else { worst })
    });
    println!("largest error of f32: {worst} units at {x:e}");
    assert!(worst <= WORST_SINGLE, "{worst} at {x:e}");
    // the closest to multiples of π/2, and the ends of the reach
    for x in [7.729_179e28, 2.199_938_5e10, 252.898_21, 505.796_42, 4.712_389, 6_433.0, 6_433.000_5, f32::MAX]
    {
        let found = single_error(x, f64::from(x).sin_cos());
        assert!(found <= WORST_SINGLE, "{x:e}: {found}");
    }
}

#[test]
fn odd_and_even_functions_of_their_argument() {
    let mut seed = 7;
    for _ in 0..10_000 {
        let x = f64::from_bits(random(&mut seed));
        if x.is_finite() {
            let ((s, c), (s_minus, c_minus)) = (sin_cos(x), sin_cos(-x));
            assert!(s + s_minus == 0.0 && c.to_bits() == c_minus.to_bits(), "{x:e}");
        }
        let x = f32::from_bits(u32::try_from(random(&mut seed) >> 32).unwrap());
        if x.is_finite() {
            let ((s, c), (s_minus, c_minus)) = (sin_cos(x), sin_cos(-x));
            assert!(s + s_minus == 0.0 && c.to_bits() == c_minus.to_bits(), "{x:e}");
        }
    }
}

#[test]
fn what_is_not_finite_gives_nan() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
    }
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
    }
}

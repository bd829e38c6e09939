//! Systems for any scalar, and the numbers to try them with.

use nonholonomic::prelude::*;

nh_models::sleigh! {
    /// A rigid body on a plane, carried by a knife edge (Chaplygin sleigh).
    #[derive(Clone, Copy, Debug)]
    pub struct Sleigh<T> {
        /// Mass.
        pub m: T,
        /// Moment of inertia about the centre of mass.
        pub J: T,
        /// Centre of mass ahead of the contact point.
        pub a: T,
        /// Centre of mass to the left of the contact point.
        pub b: T,
        /// Rotary friction.
        pub c: T,
    }
    outputs { speed = sqrt(v1^2 + a^2 * omega^2); }
    assume  { m > 0; J > 0; }
    emit    { jacobian }
}

/// A sleigh with parameters of its own for every number.
#[must_use]
pub fn sleigh<L: Lanes>(number: impl Fn(usize) -> L::Lane) -> Sleigh<L> {
    let of = |value: f64, share: f64| {
        L::from_lanes(|i| L::Lane::from_f64(value) + L::Lane::from_f64(share) * number(i))
    };
    Sleigh { m: of(1.0, 0.1), J: of(0.5, 0.05), a: of(0.3, 0.1), b: of(0.1, -0.1), c: of(0.0, 0.01) }
}

/// Random numbers in [−1, 1), the same in every run.
#[derive(Clone, Copy, Debug)]
pub struct Random(pub u64);

impl Random {
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
    /// The next number.
    #[allow(clippy::cast_precision_loss)] // 53 bits
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / f64::from(1 << 26) / f64::from(1 << 26) - 1.0
    }
}

/// Start values of sleighs.
#[must_use]
pub fn starts(count: usize) -> Vec<SleighState<f64>> {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let mut next = || random.number();
    (0..count)
        .map(|_| SleighState { theta: 3.0 * next(), x: next(), y: next(), omega: next(), v1: next() })
        .collect()
}

//! Reproducible random numbers.

/// A generator (`SplitMix64`) that yields the same numbers in every run.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A generator; different seeds give unrelated numbers.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number between the bounds, uniformly distributed.
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^= bits >> 31;
        low + (high - low) * ((bits >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Numbers between the bounds.
    pub fn list(&mut self, length: usize, low: f64, high: f64) -> Vec<f64> {
        (0..length).map(|_| self.between(low, high)).collect()
    }

    /// The entries of a rotation matrix, row by row, from a quaternion that is not too short.
    pub fn rotation(&mut self) -> [f64; 9] {
        let [a, b, c, d] = loop {
            let quaternion: [f64; 4] = std::array::from_fn(|_| self.between(-1.0, 1.0));
            if quaternion.iter().map(|x| x * x).sum::<f64>() > 0.1 {
                break quaternion;
            }
        };
        let square = a * a + b * b + c * c + d * d;
        [
            a * a + b * b - c * c - d * d,
            2.0 * (b * c - a * d),
            2.0 * (b * d + a * c),
            2.0 * (b * c + a * d),
            a * a - b * b + c * c - d * d,
            2.0 * (c * d - a * b),
            2.0 * (b * d - a * c),
            2.0 * (c * d + a * b),
            a * a - b * b - c * c + d * d,
        ]
        .map(|entry| entry / square)
    }
}

//! Choices that follow from a seed.

/// SplitMix64 (Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The choices of one member of a family.
    #[must_use]
    pub fn of(seed: u64, member: u64) -> Self {
        let mut random = Self(seed ^ member.wrapping_mul(0xd605_bbb5_8c8a_bc3d));
        random.word();
        random
    }

    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to `bound`, which is left out.
    pub fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.word() % bound.max(1) as u64).unwrap_or(0)
    }

    /// Whether something happens that does so `percent` times in a hundred.
    pub fn happens(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// A number between two bounds.
    #[allow(clippy::cast_precision_loss, reason = "52 bits are enough")]
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.word() >> 12) as f64 / (1u64 << 52) as f64;
        low + (high - low) * unit
    }

    /// One of several.
    pub fn one_of<'a, T: ?Sized>(&mut self, choices: &[&'a T]) -> &'a T {
        choices[self.below(choices.len())]
    }
}

//! Numbers that look random and are the same in every run.

/// A small generator of numbers in (−1, 1): Marsaglia's xorshift. Numbers that were recorded come first.
pub struct Random {
    word: u64,
    recorded: std::vec::IntoIter<f64>,
}

impl Default for Random {
    fn default() -> Self {
        Self::new()
    }
}

impl Random {
    /// The generator, from the same number always.
    #[must_use]
    pub fn new() -> Self {
        Self::recorded(Vec::new())
    }

    /// Numbers that were recorded.
    #[must_use]
    pub fn recorded(numbers: Vec<f64>) -> Self {
        Self { word: 0x9e37_79b9_7f4a_7c15, recorded: numbers.into_iter() }
    }

    /// The next number.
    pub fn draw(&mut self) -> f64 {
        if let Some(number) = self.recorded.next() {
            return number;
        }
        self.word ^= self.word << 13;
        self.word ^= self.word >> 7;
        self.word ^= self.word << 17;
        (self.word >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

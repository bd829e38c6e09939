//! Reproducible numbers for tests.

/// Numbers from 0 to 1, one after the other.
pub(super) struct Draws(pub(super) u32);

impl Draws {
    pub(super) fn draw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0) / f64::from(u32::MAX)
    }
}

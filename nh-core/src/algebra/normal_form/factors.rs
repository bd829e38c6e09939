//! A short list in place: most monomials have few factors, and each term has one.

use super::monomial::Factor;
use std::ops::{Deref, DerefMut};

/// Factors that are kept in place.
const PLACES: usize = 5;

/// A list of factors, in place while it is short.
#[derive(Clone, Debug)]
pub(super) enum Factors {
    /// The first so many.
    Short(u8, [Factor; PLACES]),
    /// More than there are places for.
    Long(Vec<Factor>),
}

impl Factors {
    #[inline(always)]
    pub(super) fn push(&mut self, factor: Factor) {
        match self {
            Self::Short(len, places) if usize::from(*len) < PLACES => {
                places[usize::from(*len)] = factor;
                *len += 1;
            }
            Self::Short(_, places) => {
                let mut list = Vec::with_capacity(2 * PLACES);
                list.extend_from_slice(&places[..]);
                list.push(factor);
                *self = Self::Long(list);
            }
            Self::Long(list) => list.push(factor),
        }
    }

    pub(super) fn extend_from_slice(&mut self, more: &[Factor]) {
        let mut place = 0;
        while place < more.len() {
            self.push(more[place]);
            place += 1;
        }
    }

    pub(super) fn retain(&mut self, keep: impl Fn(&Factor) -> bool) {
        let mut kept = 0;
        for index in 0..self.len() {
            let factor = self[index];
            if keep(&factor) {
                self[kept] = factor;
                kept += 1;
            }
        }
        match self {
            Self::Short(len, _) => *len = u8::try_from(kept).unwrap_or(*len),
            Self::Long(list) => list.truncate(kept),
        }
    }
}

impl Default for Factors {
    #[inline(always)]
    fn default() -> Self {
        const EMPTY: Factors = Factors::Short(0, [Factor::NONE; PLACES]);
        EMPTY
    }
}

impl Deref for Factors {
    type Target = [Factor];
    #[inline(always)]
    fn deref(&self) -> &[Factor] {
        match self {
            Self::Short(len, places) => &places[..usize::from(*len)],
            Self::Long(list) => list,
        }
    }
}

impl DerefMut for Factors {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [Factor] {
        match self {
            Self::Short(len, places) => &mut places[..usize::from(*len)],
            Self::Long(list) => list,
        }
    }
}

/// Lists are equal by their entries, wherever these are.
impl PartialEq for Factors {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Eq for Factors {}

impl FromIterator<Factor> for Factors {
    fn from_iter<I: IntoIterator<Item = Factor>>(factors: I) -> Self {
        let mut list = Self::default();
        for factor in factors {
            list.push(factor);
        }
        list
    }
}

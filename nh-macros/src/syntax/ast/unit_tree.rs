//! Units of declared names.

use super::{Name, Place};
use crate::report::Extent;

/// `x, q[2] = kg m^2 s^-2`.
#[derive(Debug)]
pub(crate) struct UnitLine {
    /// Declared names, families and entries; labels, outputs, `t` and `lagrangian` too.
    pub(crate) places: Vec<Place>,
    /// The unit as a product; of nothing for `1`.
    pub(crate) factors: Vec<UnitFactor>,
    /// Where the unit stands.
    pub(crate) extent: Extent,
}

/// A power of a unit.
#[derive(Clone, Debug)]
pub(crate) struct UnitFactor {
    /// The unit.
    pub(crate) name: Name,
    /// The numerator of the exponent.
    pub(crate) numerator: i64,
    /// Its denominator, which is positive.
    pub(crate) denominator: i64,
}

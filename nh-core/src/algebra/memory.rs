//! What a graph remembers of its expressions, beside what they are.

use crate::count::Count;
use crate::id::ExprId;
use rustc_hash::FxHashMap;
use std::rc::Rc;

/// The styles among which simplification chooses.
pub(super) const STYLE_COUNT: usize = 3;

/// How far an expression is taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Style {
    /// Multiply out the positive powers of sums.
    pub(super) expand: bool,
    /// Apply the addition theorems.
    pub(super) angles: bool,
    /// Prefer the canonical form of trigonometric polynomials to a shorter one.
    pub(super) canonical: bool,
}

/// What came of expressions in styles.
#[derive(Clone, Debug, Default)]
pub(super) struct Attempts {
    pub(super) made: FxHashMap<(ExprId, Style), Attempt>,
    /// Those for which so much work was not enough, which it would not be a second time.
    pub(super) failed: FxHashMap<(ExprId, Style, usize), Attempt>,
}

/// What came of reading an expression in a style.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt {
    /// The canonical and the factored form; `None` beyond the budget.
    pub(super) forms: Option<(ExprId, ExprId)>,
    /// The work it took.
    pub(super) spent: usize,
    /// What it depends on of the style.
    pub(super) asked: Asked,
}

/// What a style was asked for while an expression was read: one that differs from it elsewhere reads the same.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Asked {
    /// Whether there was a power of a sum.
    pub(super) expand: bool,
    /// Whether there was a function with an addition theorem.
    pub(super) angles: bool,
}

impl Asked {
    /// Whether two styles read what asked for this alike.
    pub(super) fn nothing_between(self, one: Style, other: Style) -> bool {
        let with_angles = |style: Style| (style.angles, style.canonical);
        (!self.expand || one.expand == other.expand)
            && (!self.angles || with_angles(one) == with_angles(other))
    }
}

/// Simplifies expressions and remembers what became of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Simplifier {
    pub(super) known: FxHashMap<ExprId, Image>,
    /// The work done for all expressions so far.
    pub(super) spent: usize,
}

/// What became of an expression, and what could be simplified in anything that contains it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Image {
    pub(super) id: ExprId,
    /// The same with its parts simplified, and not itself.
    pub(super) of_parts: ExprId,
    pub(super) has_sum: bool,
    pub(super) has_angle: bool,
    /// Whether it had the budget of a whole expression.
    pub(super) is_whole: bool,
    /// The styles in which some part of it was beyond the budget, so that it is, too.
    pub(super) beyond: [bool; STYLE_COUNT],
}

/// What was found of expressions that lose digits: different ways to the same solution ask for the same entries, and
/// differ in the length that is allowed alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Cancelling {
    /// The units in the last place that expressions lose where symbols are far apart.
    pub(super) lost: FxHashMap<ExprId, f64>,
    /// Equal expressions with their lengths, and how many times less they lose.
    pub(super) others: FxHashMap<ExprId, Rc<[Other]>>,
}

/// An equal expression.
#[derive(Clone, Copy, Debug)]
pub(super) struct Other {
    pub(super) form: ExprId,
    pub(super) length: Count,
    pub(super) gain: f64,
}

//! Numbers, vectors and matrices of expressions.

use std::fmt;

use nonholonomic_core::id::ExprId;

/// How many entries there are, and how they are indexed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shape {
    /// One entry, no index.
    Number,
    /// So many entries.
    Vector(usize),
    /// So many rows of so many entries.
    Matrix(usize, usize),
}

impl Shape {
    /// The shape of a family with these lengths, at most two.
    pub(super) fn of(lengths: &[u32]) -> Self {
        match *lengths {
            [] => Self::Number,
            [n] => Self::Vector(n as usize),
            [rows, columns, ..] => Self::Matrix(rows as usize, columns as usize),
        }
    }

    /// The number of entries.
    pub(super) fn len(self) -> usize {
        match self {
            Self::Number => 1,
            Self::Vector(n) => n,
            Self::Matrix(rows, columns) => rows * columns,
        }
    }

    /// The values of the first index, and the shape that is left behind it.
    pub(super) fn split(self) -> Option<(usize, Self)> {
        match self {
            Self::Number => None,
            Self::Vector(n) => Some((n, Self::Number)),
            Self::Matrix(rows, columns) => Some((rows, Self::Vector(columns))),
        }
    }

    /// The same with so many values of the first index.
    pub(super) fn with_length(self, n: usize) -> Self {
        match self {
            Self::Number => Self::Number,
            Self::Vector(_) => Self::Vector(n),
            Self::Matrix(_, columns) => Self::Matrix(n, columns),
        }
    }

    /// The shape of so many things of this shape, if it is one.
    pub(super) fn times(self, n: usize) -> Option<Self> {
        match self {
            Self::Number => Some(Self::Vector(n)),
            Self::Vector(columns) => Some(Self::Matrix(n, columns)),
            Self::Matrix(..) => None,
        }
    }

    /// The indices of an entry, counted row by row.
    pub(super) fn indices(self, entry: usize) -> Vec<usize> {
        match self {
            Self::Number => Vec::new(),
            Self::Vector(_) => vec![entry],
            Self::Matrix(_, columns) => vec![entry / columns.max(1), entry % columns.max(1)],
        }
    }

    /// The name of an entry: `I[0][1]`.
    pub(super) fn entry_name(self, name: &str, entry: usize) -> String {
        self.indices(entry).iter().fold(name.to_owned(), |text, index| format!("{text}[{index}]"))
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => f.write_str("a number"),
            Self::Vector(1) => f.write_str("a vector of 1 entry"),
            Self::Vector(n) => write!(f, "a vector of {n} entries"),
            Self::Matrix(rows, columns) => write!(f, "a matrix of {rows} × {columns} entries"),
        }
    }
}

/// A part of something that has entries: a whole, a row, one entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// The first entry.
    pub(super) first: usize,
    /// The shape of the part.
    pub(super) shape: Shape,
}

impl Part {
    /// The positions of its entries.
    pub(super) fn positions(self) -> std::ops::Range<usize> {
        self.first..self.first + self.shape.len()
    }
}

/// Expressions in a shape, row by row.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Array {
    /// The shape.
    pub(super) shape: Shape,
    /// As many entries as the shape has.
    pub(super) entries: Vec<ExprId>,
}

impl Array {
    /// A single number.
    pub(super) fn number(entry: ExprId) -> Self {
        Self { shape: Shape::Number, entries: vec![entry] }
    }

    /// Entries in a vector.
    pub(super) fn vector(entries: Vec<ExprId>) -> Self {
        Self { shape: Shape::Vector(entries.len()), entries }
    }

    /// A part as an array.
    pub(super) fn part(&self, part: Part) -> Self {
        Self { shape: part.shape, entries: self.entries[part.positions()].to_vec() }
    }

    /// The number, if it is one.
    pub(super) fn as_number(&self) -> Option<ExprId> {
        match (self.shape, self.entries.as_slice()) {
            (Shape::Number, [entry]) => Some(*entry),
            _ => None,
        }
    }

    /// Column `j` of a matrix.
    pub(super) fn column(&self, j: usize) -> Vec<ExprId> {
        match self.shape {
            Shape::Matrix(_, columns) => self.entries.iter().skip(j).step_by(columns).copied().collect(),
            Shape::Number | Shape::Vector(_) => self.entries.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_counted_row_by_row() {
        let shape = Shape::of(&[2, 3]);
        assert_eq!(shape.len(), 6);
        assert_eq!(shape.entry_name("R", 5), "R[1][2]");
        assert_eq!(Shape::of(&[]).entry_name("m", 0), "m");
        assert_eq!(shape.split(), Some((2, Shape::Vector(3))));
        assert_eq!(shape.to_string(), "a matrix of 2 × 3 entries");
        assert_eq!(Shape::Vector(3).times(2), Some(shape));
    }
}

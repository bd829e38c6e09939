//! Typed indices, so that a coordinate can never be mistaken for a section.

use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// A typed index into a [`Table`].
pub trait Id: Copy + Eq + Ord + 'static {
    /// The id of the first entry.
    const FIRST: Self;
    /// The id of the entry at `index`.
    fn from_index(index: usize) -> Self;
    /// The position of the entry.
    fn index(self) -> usize;
}

macro_rules! ids {
    ($($(#[$doc:meta])* $visibility:vis struct $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        $visibility struct $name(u32);

        impl $crate::id::Id for $name {
            const FIRST: Self = Self(0);
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "it fits")]
            fn from_index(index: usize) -> Self {
                // compared in place: a conversion that may fail takes several calls in unoptimised builds
                assert!((index as u64) < 1 << u32::BITS, "fewer than 2^32 entries");
                Self(index as u32)
            }
            #[inline(always)]
            fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

pub(crate) use ids;

ids! {
    /// A node of the expression graph. Operands have smaller ids than what is built from them.
    pub struct ExprId;
    /// A name that stands for a number: a coordinate, velocity, parameter, input or the time.
    pub struct SymbolId;
    /// A number that has a name.
    pub struct ConstantId;
    /// A base coordinate `x^i`.
    pub struct CoordId;
    /// A section `e_α` of the declared basis, and its quasi-velocity `y^α`.
    pub struct SectionId;
    /// A scalar parameter: a field of the struct, or one entry of an array field.
    pub struct ParamId;
    /// A control input `u`.
    pub struct InputId;
    /// A declared constraint.
    pub struct ConstraintId;
    /// A place in the declaration, known only to the front end.
    pub struct Origin;
}

/// A vector indexed by one kind of id.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table<I, T> {
    entries: Vec<T>,
    kind: PhantomData<I>,
}

impl<I, T> Default for Table<I, T> {
    fn default() -> Self {
        Self { entries: Vec::new(), kind: PhantomData }
    }
}

impl<I: Id, T> Table<I, T> {
    /// An empty table.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends an entry and returns its id.
    pub fn push(&mut self, entry: T) -> I {
        self.entries.push(entry);
        I::from_index(self.entries.len() - 1)
    }

    /// Takes out the entries from an id on.
    pub fn split_off(&mut self, from: I) -> Vec<T> {
        self.entries.split_off(from.index())
    }

    /// The number of entries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is no entry.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The ids, in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + use<I, T> {
        (0..self.entries.len()).map(I::from_index)
    }

    /// The entries, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, T> {
        self.entries.iter()
    }

    /// The entries, in order, to be changed.
    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.entries.iter_mut()
    }

    /// Ids with their entries, in order.
    pub fn iter_ids(&self) -> impl Iterator<Item = (I, &T)> {
        self.entries.iter().enumerate().map(|(index, entry)| (I::from_index(index), entry))
    }

    /// The entry, if the id belongs to this table.
    #[must_use]
    pub fn get(&self, id: I) -> Option<&T> {
        self.entries.get(id.index())
    }
}

impl<I: Id, T> Index<I> for Table<I, T> {
    type Output = T;
    #[inline(always)]
    fn index(&self, id: I) -> &T {
        // as a slice: a vector takes calls of its own to index in unoptimised builds
        &self.entries.as_slice()[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for Table<I, T> {
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.entries[id.index()]
    }
}

impl<I, T> FromIterator<T> for Table<I, T> {
    fn from_iter<S: IntoIterator<Item = T>>(entries: S) -> Self {
        Self { entries: entries.into_iter().collect(), kind: PhantomData }
    }
}

impl<'a, I, T> IntoIterator for &'a mut Table<I, T> {
    type Item = &'a mut T;
    type IntoIter = std::slice::IterMut<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter_mut()
    }
}

impl<'a, I, T> IntoIterator for &'a Table<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter()
    }
}

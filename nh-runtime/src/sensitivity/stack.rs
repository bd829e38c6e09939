//! The components of a state with those of its columns, as one array.

use core::fmt;

use crate::dim::sealed;
use crate::{D, Dim};

/// A number of columns beside a state: `D<K>` of 0 to 32.
pub trait Columns: Dim {
    /// One row more than there are columns: `[R; K + 1]`.
    type Rows<R: Copy + 'static>: Copy + AsRef<[R]> + AsMut<[R]> + 'static;

    /// Rows that are all equal.
    fn rows<R: Copy + 'static>(row: R) -> Self::Rows<R>;

    /// The first row and the others.
    fn split<R: Copy + 'static>(rows: &Self::Rows<R>) -> (&R, &[R]);

    /// The same, to be changed.
    fn split_mut<R: Copy + 'static>(rows: &mut Self::Rows<R>) -> (&mut R, &mut [R]);
}

macro_rules! columns {
    ($($columns:literal)*) => {$(
        impl Columns for D<$columns> {
            type Rows<R: Copy + 'static> = [R; $columns + 1];

            #[inline]
            fn rows<R: Copy + 'static>(row: R) -> Self::Rows<R> {
                [row; $columns + 1]
            }
            #[inline]
            fn split<R: Copy + 'static>([first, others @ ..]: &Self::Rows<R>) -> (&R, &[R]) {
                (first, others)
            }
            #[inline]
            fn split_mut<R: Copy + 'static>([first, others @ ..]: &mut Self::Rows<R>) -> (&mut R, &mut [R]) {
                (first, others)
            }
        }
    )*};
}
columns!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32);

/// The number of components of a state of `N` with `K` columns of derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stack<const N: usize, const K: usize>;

/// As many entries: first those of the state, then those of each column.
pub struct Stacked<T: Copy + 'static, const N: usize, const K: usize>(<D<K> as Columns>::Rows<[T; N]>)
where
    D<K>: Columns;

// what the derive would ask for is `Clone` of the rows in every use
#[allow(clippy::expl_impl_clone_on_copy)]
impl<T: Copy + 'static, const N: usize, const K: usize> Clone for Stacked<T, N, K>
where
    D<K>: Columns,
{
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}
impl<T: Copy + 'static, const N: usize, const K: usize> Copy for Stacked<T, N, K> where D<K>: Columns {}

impl<T: Copy + fmt::Debug + 'static, const N: usize, const K: usize> fmt::Debug for Stacked<T, N, K>
where
    D<K>: Columns,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.as_ref()).finish()
    }
}

impl<T: Copy + 'static, const N: usize, const K: usize> AsRef<[T]> for Stacked<T, N, K>
where
    D<K>: Columns,
{
    #[inline]
    fn as_ref(&self) -> &[T] {
        self.0.as_ref().as_flattened()
    }
}

impl<T: Copy + 'static, const N: usize, const K: usize> AsMut<[T]> for Stacked<T, N, K>
where
    D<K>: Columns,
{
    #[inline]
    fn as_mut(&mut self) -> &mut [T] {
        self.0.as_mut().as_flattened_mut()
    }
}

impl<T: Copy + 'static, const N: usize, const K: usize> Stacked<T, N, K>
where
    D<K>: Columns,
{
    /// A state above its columns.
    #[inline]
    pub(super) fn of(state: [T; N], columns: &[[T; N]; K]) -> Self {
        let mut rows = <D<K> as Columns>::rows(state);
        for (row, column) in rows.as_mut().iter_mut().skip(1).zip(columns) {
            *row = *column;
        }
        Self(rows)
    }

    /// The state and the columns.
    #[inline]
    pub(super) fn parts(&self) -> (&[T; N], &[[T; N]]) {
        <D<K> as Columns>::split(&self.0)
    }

    /// The same, to be changed.
    #[inline]
    pub(super) fn parts_mut(&mut self) -> (&mut [T; N], &mut [[T; N]]) {
        <D<K> as Columns>::split_mut(&mut self.0)
    }
}

impl<const N: usize, const K: usize> sealed::Sealed for Stack<N, K> where D<K>: Columns {}

impl<const N: usize, const K: usize> Dim for Stack<N, K>
where
    D<K>: Columns,
{
    type Vec<T: Copy + 'static> = Stacked<T, N, K>;
    type Mat<T: Copy + 'static> = Stacked<Stacked<T, N, K>, N, K>;
    const N: usize = N * (K + 1);

    #[inline]
    fn vec<T: Copy + 'static>(value: T) -> Stacked<T, N, K> {
        Stacked(<D<K> as Columns>::rows([value; N]))
    }
    #[inline]
    fn mat<T: Copy + 'static>(value: T) -> Stacked<Stacked<T, N, K>, N, K> {
        Self::vec(Self::vec(value))
    }
}

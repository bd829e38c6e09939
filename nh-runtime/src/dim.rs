//! Dimensions as types, so that arrays of a state's size exist on the stack without a bound that
//! spreads through every signature.

/// The number of components of a state, as a type.
///
/// Implemented by [`D<N>`](D): `<D<5> as Dim>::Vec<f64>` is `[f64; 5]`, and `Mat<f64>` is
/// `[[f64; 5]; 5]`, an array of rows; and by [`Stack`](crate::sensitivity::Stack), a state with columns beside it.
pub trait Dim: sealed::Sealed + Copy + 'static {
    /// `[K; N]`, or what is laid out like it.
    type Vec<K: Copy + 'static>: Copy + AsRef<[K]> + AsMut<[K]> + 'static;
    /// `[[K; N]; N]`: the rows of a square matrix.
    type Mat<K: Copy + 'static>: Copy + AsRef<[Self::Vec<K>]> + AsMut<[Self::Vec<K>]> + 'static;
    /// The number of components.
    const N: usize;

    /// The array with all components equal.
    fn vec<K: Copy + 'static>(value: K) -> Self::Vec<K>;
    /// The square matrix with all entries equal.
    fn mat<K: Copy + 'static>(value: K) -> Self::Mat<K>;
}

pub(crate) mod sealed {
    /// What keeps [`Dim`](super::Dim) to this crate.
    pub trait Sealed {}
}

impl<const N: usize> sealed::Sealed for D<N> {}

/// The dimension `N`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct D<const N: usize>;

impl<const N: usize> Dim for D<N> {
    type Vec<K: Copy + 'static> = [K; N];
    type Mat<K: Copy + 'static> = [[K; N]; N];
    const N: usize = N;

    #[inline]
    fn vec<K: Copy + 'static>(value: K) -> [K; N] {
        [value; N]
    }
    #[inline]
    fn mat<K: Copy + 'static>(value: K) -> [[K; N]; N] {
        [[value; N]; N]
    }
}

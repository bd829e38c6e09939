//! Where a motion is kept.

/// Room for what is kept, given by the caller: an array, a slice, a `Vec`, or a type of one's own.
pub trait Buffer<T> {
    /// Puts an item at a place, which is that of an item put before or the next one; whether there was room.
    fn put(&mut self, index: usize, item: T) -> bool;

    /// Whether there is room at a place.
    fn has_room(&self, index: usize) -> bool;

    /// All places: those that have been put to come first.
    fn items(&self) -> &[T];
}

impl<T> Buffer<T> for [T] {
    fn put(&mut self, index: usize, item: T) -> bool {
        match self.get_mut(index) {
            Some(place) => {
                *place = item;
                true
            }
            None => false,
        }
    }

    fn has_room(&self, index: usize) -> bool {
        index < self.len()
    }

    fn items(&self) -> &[T] {
        self
    }
}

impl<T, const N: usize> Buffer<T> for [T; N] {
    fn put(&mut self, index: usize, item: T) -> bool {
        self.as_mut_slice().put(index, item)
    }

    fn has_room(&self, index: usize) -> bool {
        index < N
    }

    fn items(&self) -> &[T] {
        self
    }
}

impl<T, B: Buffer<T> + ?Sized> Buffer<T> for &mut B {
    fn put(&mut self, index: usize, item: T) -> bool {
        (**self).put(index, item)
    }

    fn has_room(&self, index: usize) -> bool {
        (**self).has_room(index)
    }

    fn items(&self) -> &[T] {
        (**self).items()
    }
}

/// A `Vec` has room for all that there is memory for.
#[cfg(feature = "std")]
impl<T> Buffer<T> for std::vec::Vec<T> {
    fn put(&mut self, index: usize, item: T) -> bool {
        if index == self.len() {
            self.push(item);
            return true;
        }
        self.as_mut_slice().put(index, item)
    }

    fn has_room(&self, index: usize) -> bool {
        index <= self.len()
    }

    fn items(&self) -> &[T] {
        self
    }
}

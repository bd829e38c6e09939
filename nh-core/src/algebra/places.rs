//! Where nodes stand, by what they are: a hash table of ids, which keeps no second copy of a node.

use crate::id::ExprId;

/// Ids by the hash of their node; a hash that is taken leads to the next place, and at most half are.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    slots: Vec<Option<(u32, ExprId)>>,
    taken: usize,
}

/// Places of the smallest table.
const FEWEST: usize = 256;

impl Places {
    /// The id with this hash that `is` what is sought.
    pub(super) fn find(&self, hash: u32, is: impl Fn(ExprId) -> bool) -> Option<ExprId> {
        let mask = self.slots.len().checked_sub(1)?;
        let mut place = hash as usize & mask;
        while let Some((known, id)) = self.slots[place] {
            if known == hash && is(id) {
                return Some(id);
            }
            place = (place + 1) & mask;
        }
        None
    }

    /// Stores an id that is not there.
    pub(super) fn insert(&mut self, hash: u32, id: ExprId) {
        if 2 * (self.taken + 1) > self.slots.len() {
            let larger = vec![None; (2 * self.slots.len()).max(FEWEST)];
            let smaller = std::mem::replace(&mut self.slots, larger);
            for (hash, id) in smaller.into_iter().flatten() {
                self.put(hash, id);
            }
        }
        self.put(hash, id);
        self.taken += 1;
    }

    /// The number of places is a power of two, and one of them is free.
    fn put(&mut self, hash: u32, id: ExprId) {
        let mask = self.slots.len() - 1;
        let mut place = hash as usize & mask;
        while self.slots[place].is_some() {
            place = (place + 1) & mask;
        }
        self.slots[place] = Some((hash, id));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::Id;

    #[test]
    fn what_was_stored_is_found() {
        let mut places = Places::default();
        // all hashes collide in pairs
        for index in 0..1000 {
            let (hash, id) = (u32::try_from(index / 2).unwrap(), ExprId::from_index(index));
            assert_eq!(places.find(hash, |known| known == id), None);
            places.insert(hash, id);
        }
        for index in 0..1000 {
            let (hash, id) = (u32::try_from(index / 2).unwrap(), ExprId::from_index(index));
            assert_eq!(places.find(hash, |known| known == id), Some(id));
        }
    }
}

//! What is known of some of many ids.

use crate::id::Id;
use std::ops::Index;

/// Entries by id, in the order in which they came.
///
/// Every pass over expressions asks for each operand once more, and unoptimised builds, as procedural macros are by
/// default, take ten times as long in a hash table for any key.
#[derive(Clone, Debug)]
pub(crate) struct IdMap<I, V> {
    /// An id and the number of its entry, both plus one, at or behind the place that the id asks for; zeros where nothing
    /// is. A power of two of them, at most half of them taken.
    slots: Box<[(usize, usize)]>,
    entries: Vec<(I, V)>,
}

/// Slots at first: most passes are short.
const FIRST: usize = 64;

impl<I, V> Default for IdMap<I, V> {
    fn default() -> Self {
        Self { slots: Box::default(), entries: Vec::new() }
    }
}

impl<I: Id, V> IdMap<I, V> {
    /// Makes room for so many more.
    pub(crate) fn reserve(&mut self, more: usize) {
        let wanted = 2 * (self.entries.len() + more);
        if wanted > self.slots.len() {
            self.spread(wanted.next_power_of_two().max(FIRST));
            self.entries.reserve(more);
        }
    }

    /// Puts the entries into new slots.
    fn spread(&mut self, slots: usize) {
        self.slots = vec![(0, 0); slots].into_boxed_slice();
        for place in 0..self.entries.len() {
            let id = self.entries[place].0;
            self.slots[self.slot(id)] = (id.index() + 1, place + 1);
        }
    }

    /// Where an id stands or would stand; there are slots.
    #[inline(always)]
    fn slot(&self, id: I) -> usize {
        let (slots, id) = (&*self.slots, id.index());
        let last = slots.len() - 1;
        let mut slot = (id.wrapping_mul(0x9E37_79B9) >> 7) & last;
        while slots[slot].0 != 0 && slots[slot].0 != id + 1 {
            slot = (slot + 1) & last;
        }
        slot
    }

    pub(crate) fn get(&self, id: &I) -> Option<&V> {
        if self.slots.is_empty() {
            return None;
        }
        match self.slots[self.slot(*id)].1 {
            0 => None,
            number => Some(&self.entries[number - 1].1),
        }
    }

    pub(crate) fn contains_key(&self, id: &I) -> bool {
        !self.slots.is_empty() && self.slots[self.slot(*id)].1 != 0
    }

    /// Takes up an entry, in place of the one before it.
    pub(crate) fn insert(&mut self, id: I, value: V) {
        self.reserve(1);
        let slot = self.slot(id);
        match self.slots[slot].1 {
            0 => {
                self.entries.push((id, value));
                self.slots[slot] = (id.index() + 1, self.entries.len());
            }
            number => self.entries[number - 1].1 = value,
        }
    }

    /// The entry of an id, which is this one if there was none.
    pub(crate) fn entry(&mut self, id: I, value: V) -> &mut V {
        self.reserve(1);
        let slot = self.slot(id);
        if self.slots[slot].1 == 0 {
            self.entries.push((id, value));
            self.slots[slot] = (id.index() + 1, self.entries.len());
        }
        &mut self.entries[self.slots[slot].1 - 1].1
    }

    /// The entries in the order in which they came.
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, (I, V)> {
        self.entries.iter()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    pub(crate) fn clear(&mut self) {
        self.slots = vec![(0, 0); self.slots.len()].into_boxed_slice();
        self.entries.clear();
    }
}

impl<I: Id, V> Index<&I> for IdMap<I, V> {
    type Output = V;
    fn index(&self, id: &I) -> &V {
        &self.entries[self.slots[self.slot(*id)].1 - 1].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::ExprId;

    #[test]
    fn every_id_has_its_last_entry() {
        // next to each other, far apart, and so many that the slots are spread anew
        let ids = |step: usize| (0..500).map(move |place| ExprId::from_index(place * step));
        for step in [1, 3, 64, 4096, 1 << 20] {
            let mut map = IdMap::default();
            assert!(map.is_empty() && map.get(&ExprId::FIRST).is_none());
            for (place, id) in ids(step).enumerate() {
                assert!(!map.contains_key(&id));
                map.insert(id, 0);
                map.insert(id, place);
            }
            assert!(
                ids(step).enumerate().all(|(place, id)| map[&id] == place && map.get(&id) == Some(&place))
            );
            assert!(!map.contains_key(&ExprId::from_index(500 * step + 1)));
            map.clear();
            assert!(map.is_empty() && ids(step).all(|id| map.get(&id).is_none()));
        }
    }
}

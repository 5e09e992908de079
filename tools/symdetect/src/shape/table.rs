//! Lists of different lengths, one behind the other.

/// A list for each of several things, one behind the other.
pub struct Table {
    offsets: Vec<u32>,
    items: Vec<u32>,
}

impl Table {
    /// From pairs of a thing, below `count`, and an item of its list. Keeps the order of the pairs.
    pub fn new(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut offsets = vec![0; count + 1];
        for (thing, _) in pairs.clone() {
            offsets[thing as usize + 1] += 1;
        }
        for i in 0..count {
            offsets[i + 1] += offsets[i];
        }
        let mut items = vec![0; offsets[count] as usize];
        let mut next = offsets.clone();
        for (thing, item) in pairs {
            let place = &mut next[thing as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        Self { offsets, items }
    }

    /// The list of a thing.
    pub fn of(&self, thing: u32) -> &[u32] {
        let [first, end] = [thing, thing + 1].map(|i| self.offsets[i as usize] as usize);
        &self.items[first..end]
    }

    /// Number of lists.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Sorts every list and drops what is in it twice; of more than `most` items, keeps some evenly chosen.
    pub fn thin_out(&mut self, most: usize) {
        let (mut offsets, mut items) = (vec![0], Vec::new());
        for thing in 0..self.len() as u32 {
            let mut list = self.of(thing).to_vec();
            list.sort_unstable();
            list.dedup();
            items.extend(list.iter().step_by(list.len().div_ceil(most)));
            offsets.push(items.len() as u32);
        }
        (self.offsets, self.items) = (offsets, items);
    }
}

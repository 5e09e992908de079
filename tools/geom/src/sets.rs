//! Disjoint sets.

/// Disjoint sets of the numbers `0..count` (union-find with path halving).
///
/// The representative of a set is its smallest member, whatever the order of the joins. So the
/// numbers of the sets are deterministic, and one pass in the order of the members finds them, where
/// a flood fill would go through memory at random.
pub struct DisjointSets {
    /// A member of the same set that is not larger; the member itself for a representative.
    smaller: Vec<u32>,
}

impl DisjointSets {
    /// `count` sets of one member each.
    pub fn new(count: usize) -> Self {
        Self {
            smaller: (0..count as u32).collect(),
        }
    }

    /// The smallest member of the set that a number belongs to.
    pub fn find(&mut self, member: u32) -> u32 {
        let mut here = member;
        loop {
            let next = self.smaller[here as usize];
            if next == here {
                return here;
            }
            let further = self.smaller[next as usize];
            self.smaller[here as usize] = further;
            here = further;
        }
    }

    /// Makes one set of those of two members; returns whether they were two.
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.smaller[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// The number of each member's set, and how many sets there are. Sets are numbered 0, 1, ... in
    /// the order of their smallest members.
    pub fn numbered(self) -> (Vec<u32>, usize) {
        let mut number = self.smaller;
        let mut count = 0;
        for member in 0..number.len() {
            // Smaller members have the number of their set already.
            let smaller = number[member] as usize;
            if smaller == member {
                number[member] = count;
                count += 1;
            } else {
                number[member] = number[smaller];
            }
        }
        (number, count as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_numbered_by_their_smallest_members() {
        let mut sets = DisjointSets::new(9);
        for (a, b) in [(8, 6), (6, 1), (7, 5), (5, 3), (3, 7), (2, 2)] {
            sets.join(a, b);
        }
        assert_eq!((sets.find(8), sets.find(7), sets.find(4)), (1, 3, 4));
        assert!(!sets.join(8, 1) && sets.join(0, 4));
        assert_eq!(sets.numbered(), (vec![0, 1, 2, 3, 0, 3, 1, 3, 1], 4));
        assert_eq!(DisjointSets::new(0).numbered(), (vec![], 0));
    }

    #[test]
    fn long_chains_are_one_set() {
        let count = 100_000;
        let mut sets = DisjointSets::new(count);
        (1..count as u32).rev().for_each(|i| {
            sets.join(i, i - 1);
        });
        assert_eq!(sets.numbered(), (vec![0; count], 1));
    }
}

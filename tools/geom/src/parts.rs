//! Things that are joined, two at a time, into parts.

/// Disjoint sets of things `0..count`, whose roots are their first members: in the order of the numbers, one pass
/// gives every thing the number of its part, where a flood would go through memory at random.
pub struct Parts {
    /// An earlier member of the same part, or the member itself.
    earlier: Vec<u32>,
}

impl Parts {
    /// Each thing by itself.
    pub fn new(count: usize) -> Self {
        Self {
            earlier: (0..count as u32).collect(),
        }
    }

    /// Joins the parts of two things.
    pub fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first(a), self.first(b));
        self.earlier[a.max(b) as usize] = a.min(b);
    }

    /// The first member of a thing's part; ways to it are shortened.
    fn first(&mut self, thing: u32) -> u32 {
        let mut here = thing;
        loop {
            let next = self.earlier[here as usize];
            if next == here {
                return here;
            }
            let further = self.earlier[next as usize];
            self.earlier[here as usize] = further;
            here = further;
        }
    }

    /// The part of each thing, and how many there are; numbered by their first members.
    pub fn numbered(self) -> (Vec<u32>, usize) {
        let mut of_thing = self.earlier;
        let mut count = 0;
        for thing in 0..of_thing.len() {
            // What is earlier has its number already.
            let earlier = of_thing[thing] as usize;
            if earlier == thing {
                of_thing[thing] = count;
                count += 1;
            } else {
                of_thing[thing] = of_thing[earlier];
            }
        }
        (of_thing, count as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_numbered_by_their_first_members() {
        let mut parts = Parts::new(9);
        for (a, b) in [(8, 6), (6, 1), (7, 5), (5, 3), (3, 7), (2, 2)] {
            parts.unite(a, b);
        }
        assert_eq!(parts.numbered(), (vec![0, 1, 2, 3, 4, 3, 1, 3, 1], 5));
        assert_eq!(Parts::new(0).numbered(), (vec![], 0));
    }

    #[test]
    fn long_chains_are_one_part() {
        let count = 100_000;
        let mut parts = Parts::new(count);
        (1..count as u32).rev().for_each(|i| parts.unite(i, i - 1));
        assert_eq!(parts.numbered(), (vec![0; count], 1));
    }
}

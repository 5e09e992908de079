//! Which vertices of the templates become one when the templates are placed.
//!
//! A *node* is a template vertex that lies on a wall. Each wall relates nodes: `(g, x)`, node `x` in
//! the instance placed by `g`, is the same point as `(g * w, y)`, for every `g`. Relations are
//! gathered in a union-find structure whose links carry isometries, so that chains (the high vertex
//! of a seam that also lies on a hub wall whose partner lies on a mirror wall) resolve by
//! composition. A relation that leads from a node back to itself says that `(g, x)` and `(g * s, x)`
//! are one point: `s` is then a *generator* of the node's stabilizer. Coordinates play no part.
//!
//! All isometries must have a common denominator as those of a valid document do; then every
//! product has it too.

use rustc_hash::FxHashMap;
use tmesh::Isometry;

/// Index of an interned set of generators; [`Orbits::FREE`] is the empty one.
pub type SetId = u32;

/// Union-find over nodes with isometries on its links.
pub struct Orbits {
    /// `(g, x)` is `(g * link[x], parent[x])`.
    parent: Vec<u32>,
    link: Vec<Isometry>,
    /// Generators of a root's stabilizer; meaningless for other nodes.
    set: Vec<SetId>,
    /// A root of higher rank stays the root.
    rank: Vec<u32>,
    sets: Vec<Vec<Isometry>>,
    ids: FxHashMap<Vec<Isometry>, SetId>,
    /// Result of adding a generator to a set.
    added: FxHashMap<(SetId, Isometry), SetId>,
}

impl Orbits {
    /// The set without generators: an interior vertex.
    pub const FREE: SetId = 0;

    /// No nodes yet.
    pub fn new() -> Self {
        Self {
            parent: Vec::new(),
            link: Vec::new(),
            set: Vec::new(),
            rank: Vec::new(),
            sets: vec![Vec::new()],
            ids: FxHashMap::from_iter([(Vec::new(), Self::FREE)]),
            added: FxHashMap::default(),
        }
    }

    /// A new node; of two related nodes the one with the higher rank represents both.
    pub fn add(&mut self, rank: u32) -> u32 {
        let node = self.parent.len() as u32;
        self.parent.push(node);
        self.link.push(Isometry::IDENTITY);
        self.set.push(Self::FREE);
        self.rank.push(rank);
        node
    }

    /// The node that represents `x`, and the isometry `o` for which `(g, x)` is `(g * o, root)`.
    pub fn find(&mut self, x: u32) -> (u32, Isometry) {
        let mut path = Vec::new();
        let mut at = x;
        while self.parent[at as usize] != at {
            path.push(at);
            at = self.parent[at as usize];
        }
        let mut offset = Isometry::IDENTITY;
        for &node in path.iter().rev() {
            offset = self.link[node as usize].compose(offset);
            self.link[node as usize] = offset;
            self.parent[node as usize] = at;
        }
        (at, offset)
    }

    /// Records that `(g, x)` is `(g * w, y)` for every `g`. Prefers `y` as the root among equals.
    pub fn relate(&mut self, x: u32, w: Isometry, y: u32) {
        let (root_x, offset_x) = self.find(x);
        let (root_y, offset_y) = self.find(y);
        // (h, root_x) is (h * step, root_y).
        let step = offset_x.inverse().compose(w).compose(offset_y);
        if root_x == root_y {
            self.stabilize(root_x, step);
            return;
        }
        let keep_x = self.rank[root_x as usize] > self.rank[root_y as usize];
        let (from, to, step) = if keep_x {
            (root_y, root_x, step.inverse())
        } else {
            (root_x, root_y, step)
        };
        self.parent[from as usize] = to;
        self.link[from as usize] = step;
        let moved = self.sets[self.set[from as usize] as usize].clone();
        for s in moved {
            let s = step.inverse().compose(s).compose(step);
            self.stabilize(to, s);
        }
    }

    fn stabilize(&mut self, root: u32, s: Isometry) {
        if s == Isometry::IDENTITY {
            return;
        }
        // A generator and its inverse say the same.
        let s = s.min(s.inverse());
        let old = self.set[root as usize];
        let new = match self.added.get(&(old, s)) {
            Some(&new) => new,
            None => {
                let mut set = self.sets[old as usize].clone();
                if let Err(at) = set.binary_search(&s) {
                    set.insert(at, s);
                }
                let next = self.sets.len() as SetId;
                let new = *self.ids.entry(set.clone()).or_insert(next);
                if new == next {
                    self.sets.push(set);
                }
                self.added.insert((old, s), new);
                new
            }
        };
        self.set[root as usize] = new;
    }

    /// Generators of a root's stabilizer.
    pub fn set(&self, root: u32) -> SetId {
        self.set[root as usize]
    }

    /// The generators in a set, increasing.
    pub fn generators(&self, set: SetId) -> &[Isometry] {
        &self.sets[set as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn id() -> Isometry {
        Isometry::IDENTITY
    }

    #[test]
    fn a_mirror_gives_one_generator_however_often_it_is_stated() {
        let mut orbits = Orbits::new();
        let x = orbits.add(1);
        let m = Isometry::reflection(0, 5);
        orbits.relate(x, m, x);
        orbits.relate(x, m, x);
        assert_eq!(orbits.find(x), (x, id()));
        assert_eq!(orbits.generators(orbits.set(x)), [m]);
    }

    #[test]
    fn a_chain_of_seam_mirror_and_hub_resolves_by_composition() {
        let mut orbits = Orbits::new();
        let [high, low, hub] = [1, 1, 9].map(|rank| orbits.add(rank));
        let r = Isometry::rotation(1, 7);
        let h = Isometry::rotation(2, 7);
        let m = Isometry::reflection(3, 7);
        orbits.relate(high, r, low);
        orbits.relate(high, m, high);
        orbits.relate(low, h, hub);
        // (g, high) = (g r, low) = (g r h, hub).
        assert_eq!(orbits.find(high), (hub, r.compose(h)));
        assert_eq!(orbits.find(low), (hub, h));
        // (g, high) = (g m, high), seen from the hub's vertex: k = g r h.
        let q = r.compose(h);
        let s = q.inverse().compose(m).compose(q);
        assert_eq!(orbits.generators(orbits.set(hub)), [s]);
    }

    #[test]
    fn going_around_gives_the_turn_as_generator() {
        // Three nodes in a ring, each a step of 1/9 from the next: three steps are a turn of 1/3.
        let mut orbits = Orbits::new();
        let ring = [0, 0, 0].map(|rank| orbits.add(rank));
        let r = Isometry::rotation(1, 9);
        for i in 0..3 {
            orbits.relate(ring[i], r, ring[(i + 1) % 3]);
        }
        let (root, _) = orbits.find(ring[0]);
        let generators = orbits.generators(orbits.set(root));
        assert_eq!(generators, [Isometry::rotation(1, 3)]);
    }

    #[test]
    fn equal_stabilizers_share_a_set() {
        let mut orbits = Orbits::new();
        let (a, b) = (Isometry::reflection(0, 4), Isometry::reflection(1, 4));
        let [x, y] = [0, 0].map(|rank| orbits.add(rank));
        for (node, order) in [(x, [a, b]), (y, [b, a])] {
            for m in order {
                orbits.relate(node, m, node);
            }
        }
        assert_eq!(orbits.set(x), orbits.set(y));
    }
}

//! The tetrahedra at each vertex, while some are replaced.

use tmesh::Tet;

/// Part of the common store that a vertex has for its list.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    start: u32,
    len: u32,
    room: u32,
    /// When something at the vertex changed last.
    stamp: u32,
}

/// Lists of tetrahedra in one common store; a list that outgrows its place moves to the end of it.
pub struct Stars {
    spans: Vec<Span>,
    store: Vec<u32>,
    now: u32,
}

impl Stars {
    /// Lists the tetrahedra at each of `vertices` vertices, increasing. Linear.
    pub fn new(vertices: usize, tets: &[Tet]) -> Self {
        let mut spans = vec![Span::default(); vertices];
        for &v in tets.iter().flat_map(|t| &t.vertices) {
            spans[v as usize].room += 1;
        }
        let mut end = 0;
        for span in &mut spans {
            span.start = end;
            end += span.room;
        }
        let mut stars = Self {
            spans,
            store: vec![0; end as usize],
            now: 0,
        };
        for (i, t) in tets.iter().enumerate() {
            for &v in &t.vertices {
                let span = &mut stars.spans[v as usize];
                stars.store[(span.start + span.len) as usize] = i as u32;
                span.len += 1;
            }
        }
        stars
    }

    /// Adds a vertex without tetrahedra.
    pub fn add(&mut self) {
        self.spans.push(Span {
            stamp: self.now,
            ..Span::default()
        });
    }

    /// Tetrahedra at a vertex.
    pub fn of(&self, v: u32) -> &[u32] {
        let span = self.spans[v as usize];
        &self.store[span.start as usize..][..span.len as usize]
    }

    /// Takes a tetrahedron off the list of a vertex; the others keep their order.
    pub fn remove(&mut self, v: u32, tet: u32) {
        let span = &mut self.spans[v as usize];
        let list = &mut self.store[span.start as usize..][..span.len as usize];
        if let Some(place) = list.iter().position(|&t| t == tet) {
            list.copy_within(place + 1.., place);
            span.len -= 1;
        }
        span.stamp = self.now;
    }

    /// Puts a tetrahedron at the end of the list of a vertex.
    pub fn push(&mut self, v: u32, tet: u32) {
        let span = &mut self.spans[v as usize];
        if span.len == span.room {
            let [from, len] = [span.start, span.len].map(|i| i as usize);
            span.start = self.store.len() as u32;
            span.room = 2 * span.len + 1;
            self.store.extend_from_within(from..from + len);
            self.store.resize((span.start + span.room) as usize, 0);
        }
        self.store[(span.start + span.len) as usize] = tet;
        span.len += 1;
        span.stamp = self.now;
    }

    /// Gives a tetrahedron on the list of a vertex another number.
    pub fn rename(&mut self, v: u32, tet: u32, other: u32) {
        let span = &mut self.spans[v as usize];
        let list = &mut self.store[span.start as usize..][..span.len as usize];
        if let Some(t) = list.iter_mut().find(|t| **t == tet) {
            *t = other;
        }
        span.stamp = self.now;
    }

    /// Notes that a tetrahedron at a vertex is not what it was.
    pub fn touch(&mut self, v: u32) {
        self.spans[v as usize].stamp = self.now;
    }

    /// Begins a new time: what changes now changes after what came before.
    pub fn renew(&mut self) {
        self.now += 1;
    }

    /// The time that it is: how often there was a new one.
    pub fn now(&self) -> u32 {
        self.now
    }

    /// Whether any tetrahedron at a vertex changed after that time.
    pub fn is_touched(&self, v: u32, time: u32) -> bool {
        self.spans[v as usize].stamp > time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_grow_and_shrink_in_order() {
        let tet = |vertices| Tet {
            vertices,
            region: 1,
        };
        let mut stars = Stars::new(6, &[tet([0, 1, 2, 3]), tet([4, 3, 2, 1])]);
        assert_eq!(stars.of(0), [0]);
        assert_eq!(stars.of(3), [0, 1]);
        assert_eq!(stars.of(5), [0_u32; 0]);
        // Beyond the room that there is, again and again.
        for t in 2..100 {
            stars.push(0, t);
            stars.push(5, t);
        }
        let expected: Vec<u32> = std::iter::once(0).chain(2..100).collect();
        assert_eq!(stars.of(0), expected);
        assert_eq!(stars.of(1), [0, 1]);
        stars.remove(5, 50);
        stars.rename(5, 51, 1000);
        let expected: Vec<u32> = (2..50).chain([1000]).chain(52..100).collect();
        assert_eq!(stars.of(5), expected);
        // What is not there changes nothing.
        stars.remove(4, 77);
        stars.rename(4, 77, 78);
        assert_eq!(stars.of(4), [1]);
    }

    #[test]
    fn changes_are_known_until_a_new_time_begins() {
        let tets = [Tet {
            vertices: [0, 1, 2, 3],
            region: 1,
        }];
        let mut stars = Stars::new(5, &tets);
        let first = stars.now();
        assert!((0..5).all(|v| !stars.is_touched(v, first)));
        stars.renew();
        stars.push(0, 1);
        stars.remove(1, 0);
        stars.rename(2, 0, 5);
        stars.touch(3);
        assert!((0..4).all(|v| stars.is_touched(v, first)) && !stars.is_touched(4, first));
        stars.renew();
        assert!((0..5).all(|v| !stars.is_touched(v, stars.now())));
        assert!(stars.is_touched(0, first) && !stars.is_touched(4, first));
    }
}

//! Edges and their images.

use super::Mesh;

impl Mesh<'_> {
    /// Images of an edge under each link: (link, whether the image is what it is the image of, the image). Edges in no face
    /// have them as well where the body touches its image along them. `None` if the edge is in a face and an image is missing.
    fn images(&self, [a, b]: [u32; 2]) -> Option<Vec<(usize, bool, [u32; 2])>> {
        let at_edge = self.at_edge(a, b);
        let faces = at_edge
            .iter()
            .map(|&t| self.images.faces[self.patch[t as usize] as usize]);
        let faces = faces.fold(0, |x, y| x | y);
        let mut images = Vec::new();
        for (i, maps) in self.images.maps.iter().enumerate() {
            for (back, map) in [false, true].into_iter().zip(maps) {
                if let (Some(&c), Some(&d)) = (map.get(&a), map.get(&b)) {
                    if !self.at_edge(c, d).is_empty() {
                        images.push((i, back, [c, d]));
                    } else if faces & 1 << i != 0 {
                        return None;
                    }
                }
            }
        }
        Some(images)
    }

    /// An edge that is to be collapsed into its second end with all of its images, itself first. `None` if the first end has
    /// an image where the edge has none, or something is its own image or beside it, but for images that are collapsed into the same
    /// vertex.
    pub fn collapsing(&self, edge: [u32; 2]) -> Option<Vec<[u32; 2]>> {
        let mut orbit = vec![edge];
        let mut next = 0;
        while let Some(&[from, to]) = orbit.get(next) {
            next += 1;
            let images = match self.images.has(from) {
                true => self.images([from, to])?,
                false => Vec::new(),
            };
            let maps = self.images.maps.iter().flatten();
            if maps.filter(|map| map.contains_key(&from)).count() != images.len() {
                return None;
            }
            for (_, _, image) in images {
                if !orbit.contains(&image) {
                    orbit.push(image);
                }
            }
        }
        let apart = |[a, b]: [u32; 2], [c, d]: [u32; 2]| {
            let near = self.neighbours(a);
            let is_near = |v: u32| near.binary_search(&v).is_ok();
            if a == c || a == d || b == c || is_near(c) {
                return false;
            }
            if b != d {
                return !is_near(d);
            }
            // Two that are collapsed into one vertex have no neighbours in common but those of all three.
            let of_b = self.neighbours(b);
            let common = self.neighbours(c).into_iter().filter(|&v| is_near(v));
            let mut others = common.filter(|&v| v != b);
            others.all(|v| of_b.binary_search(&v).is_ok())
        };
        let all = || orbit.iter().enumerate();
        let is_apart = all().all(|(i, &x)| all().all(|(j, &y)| i == j || apart(x, y)));
        is_apart.then_some(orbit)
    }

    /// An edge that is to be split with all of its images. `None` if a face is without an image of it, if it is its own image
    /// the other way round or has one beside it, or if it has images that the links lead to from none of them.
    pub fn splitting(&self, edge: [u32; 2]) -> Option<Orbit> {
        let all = self.orbit(edge)?.edges;
        let mut triangles: Vec<u32> = all.iter().flat_map(|&[a, b]| self.at_edge(a, b)).collect();
        triangles.sort_unstable();
        // All of those of an edge that is there twice, the other way round, are.
        if triangles.windows(2).any(|w| w[0] == w[1]) {
            return None;
        }
        let mut each = all.iter().map(|&first| self.orbit(first));
        each.find_map(|orbit| orbit.filter(Orbit::is_led_to))
    }

    /// An edge with all of its images. `None` if a face is without one.
    fn orbit(&self, edge: [u32; 2]) -> Option<Orbit> {
        let mut edges = vec![edge];
        let mut links: Vec<(usize, [usize; 2])> = Vec::new();
        let mut next = 0;
        while let Some(&this) = edges.get(next) {
            for (link, back, image) in self.images(this)? {
                let known = edges.iter().position(|e| *e == image);
                let at = known.unwrap_or(edges.len());
                if known.is_none() {
                    edges.push(image);
                }
                let step = (link, if back { [at, next] } else { [next, at] });
                if !links.contains(&step) {
                    links.push(step);
                }
            }
            next += 1;
        }
        Some(Orbit { edges, links })
    }
}

/// An edge and its images.
pub struct Orbit {
    /// All of them. Each is the image of one before, but for the first.
    pub edges: Vec<[u32; 2]>,
    /// What is the image of what: the link, and of which edge it makes which one, by their places in the list.
    pub links: Vec<(usize, [usize; 2])>,
}

impl Orbit {
    /// The link by which an edge is the image of one before, and of which.
    fn led_by(&self, edge: usize) -> Option<(usize, usize)> {
        let to = |&(link, [from, to]): &(usize, [usize; 2])| (to == edge).then_some((link, from));
        let mut before = self.links.iter().filter_map(to);
        before.find(|(_, from)| *from < edge)
    }

    fn is_led_to(&self) -> bool {
        (1..self.edges.len()).all(|edge| self.led_by(edge).is_some())
    }

    /// What is the image on each edge of a point of the first one. `None` if that is not the same by all links.
    pub fn places<P: Copy + PartialEq>(
        &self,
        first: P,
        image: impl Fn(usize, P) -> P,
    ) -> Option<Vec<P>> {
        let mut places = vec![first];
        for edge in 1..self.edges.len() {
            let (link, from) = self.led_by(edge)?;
            places.push(image(link, places[from]));
        }
        let mut all = self.links.iter();
        let is_same = all.all(|&(link, [from, to])| image(link, places[from]) == places[to]);
        is_same.then_some(places)
    }
}

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
    /// an image where the edge has none, or something is its own image or beside it.
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
            a != c
                && a != d
                && b != c
                && b != d
                && [c, d].iter().all(|v| near.binary_search(v).is_err())
        };
        let all = || orbit.iter().enumerate();
        let is_apart = all().all(|(i, &x)| all().all(|(j, &y)| i == j || apart(x, y)));
        is_apart.then_some(orbit)
    }

    /// What an edge is split with. `None` if it has several images, or one beside it.
    pub fn splitting(&self, edge: [u32; 2]) -> Option<Splitting> {
        let images = self.images(edge)?;
        if images.iter().all(|image| image.2 == edge) {
            let mut links: Vec<usize> = images.iter().map(|image| image.0).collect();
            links.dedup();
            return Some(Splitting::Alone(links));
        }
        let &[image] = &images[..] else {
            return None;
        };
        let [c, d] = image.2;
        let back = self.images([c, d])?;
        let is_pair = back.len() == 1 && back[0].2 == edge;
        let common = self
            .at_edge(c, d)
            .iter()
            .any(|t| self.at_edge(edge[0], edge[1]).contains(t));
        (is_pair && !common && [d, c] != edge).then_some(Splitting::With(image))
    }
}

/// What an edge is split with.
pub enum Splitting {
    /// Alone; under these links it is its own image, point by point.
    Alone(Vec<usize>),
    /// With the one edge that is its image, by this link, or that it is the image of.
    With((usize, bool, [u32; 2])),
}

//! Edges and their images.

use super::Mesh;

impl Mesh<'_> {
    /// Images of an edge under each link, where the edge is in its face: (link, whether the image is what it is the image of,
    /// the image).
    fn images(&self, [a, b]: [u32; 2]) -> Option<Vec<(usize, bool, [u32; 2])>> {
        let at_edge = self.at_edge(a, b);
        let faces = at_edge
            .iter()
            .map(|&t| self.images.faces[self.patch[t as usize] as usize]);
        let faces = faces.fold(0, |x, y| x | y);
        let mut images = Vec::new();
        for (i, maps) in self.images.maps.iter().enumerate() {
            if faces & 1 << i == 0 {
                continue;
            }
            for (back, map) in [false, true].into_iter().zip(maps) {
                if let (Some(&c), Some(&d)) = (map.get(&a), map.get(&b)) {
                    if self.at_edge(c, d).is_empty() {
                        return None;
                    }
                    images.push((i, back, [c, d]));
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

    /// The image of an edge that is to be split, and the link by which it is, if there is a single one: `Some(None)` where
    /// there is none at all.
    #[expect(
        clippy::option_option,
        reason = "whether it may be split, and with what"
    )]
    pub fn splitting(&self, edge: [u32; 2]) -> Option<Option<(usize, bool, [u32; 2])>> {
        let images = self.images(edge)?;
        let &[image] = &images[..] else {
            return images.is_empty().then_some(None);
        };
        let [c, d] = image.2;
        let back = self.images([c, d])?;
        let is_pair = back.len() == 1 && back[0].2 == edge;
        let common = self
            .at_edge(c, d)
            .iter()
            .any(|t| self.at_edge(edge[0], edge[1]).contains(t));
        (is_pair && !common && image.2 != edge && [d, c] != edge).then_some(Some(image))
    }
}

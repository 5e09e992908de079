//! Polygons of indexed formats, broken into triangles.

use crate::facet::triangulate;
use crate::soup::{Group, Soup};
use crate::weld::Welder;
use glam::DVec3;

/// Collects points and polygons of an indexed format.
pub struct Polygons {
    welder: Welder,
    /// Welded id of each point of the file.
    ids: Vec<u32>,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    group_of: Vec<u32>,
}

impl Polygons {
    /// Nothing yet; `expected` points at about.
    pub fn new(expected: usize) -> Self {
        Self {
            welder: Welder::new(expected),
            ids: Vec::with_capacity(expected),
            points: Vec::with_capacity(expected),
            triangles: Vec::new(),
            group_of: Vec::new(),
        }
    }

    /// Adds the next point of the file.
    pub fn point(&mut self, point: DVec3) {
        self.points.push(point);
        self.ids.push(self.welder.id(point));
    }

    /// Number of points of the file so far.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Adds a polygon of points of the file, by index, which must exist.
    pub fn polygon(&mut self, corners: &[u32], group: u32) {
        let before = self.triangles.len();
        if let &[a, b, c] = corners {
            self.triangles.push([a, b, c]);
        } else {
            self.several(corners);
        }
        for t in &mut self.triangles[before..] {
            *t = t.map(|v| self.ids[v as usize]);
        }
        self.group_of.resize(self.triangles.len(), group);
    }

    fn several(&mut self, corners: &[u32]) {
        let mut corners = corners.to_vec();
        let same = |a: u32, b: u32| self.ids[a as usize] == self.ids[b as usize];
        corners.dedup_by(|a, b| same(*a, *b));
        while corners.len() > 1 && same(corners[0], corners[corners.len() - 1]) {
            corners.pop();
        }
        match *corners.as_slice() {
            [] | [_] | [_, _] => {}
            [a, b, c] => self.triangles.push([a, b, c]),
            [a, b, c, d] => self
                .triangles
                .extend(quadrilateral(&self.points, [a, b, c, d])),
            _ => match planar(&self.points, &corners) {
                Some(triangles) => self.triangles.extend(triangles),
                // A fan keeps the boundary whatever the shape.
                None => self
                    .triangles
                    .extend(corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]])),
            },
        }
    }

    /// The triangles, in groups.
    pub fn into_soup(
        self,
        groups: Vec<Group>,
        group_word: &'static str,
        relative_precision: f64,
    ) -> Soup {
        Soup {
            points: self.welder.into_points(),
            triangles: self.triangles,
            group_of: self.group_of,
            groups,
            group_word,
            relative_precision,
            notices: Vec::new(),
        }
    }
}

/// Twice the area vector of a closed polygon (Newell's method), which has corners.
pub fn area_vector(points: &[DVec3], corners: &[u32]) -> DVec3 {
    let origin = points[corners[0] as usize];
    let at = |i: usize| points[corners[i % corners.len()] as usize] - origin;
    (1..corners.len()).map(|i| at(i).cross(at(i + 1))).sum()
}

/// Splits along the shorter diagonal that leaves both triangles facing the polygon's way.
fn quadrilateral(points: &[DVec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let normal = area_vector(points, &[a, b, c, d]);
    let at = |v: u32| points[v as usize];
    let splits = [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]];
    let good = |split: &[[u32; 3]; 2]| {
        split.iter().all(|t| {
            let [p, q, r] = t.map(at);
            (q - p).cross(r - p).dot(normal) > 0.0
        })
    };
    let length = |p: u32, q: u32| (at(p) - at(q)).length_squared();
    match (good(&splits[0]), good(&splits[1])) {
        (true, true) if length(b, d) < length(a, c) => splits[1],
        (false, true) => splits[1],
        _ => splits[0],
    }
}

/// Triangulates a polygon in its plane; `None` when it crosses itself there.
fn planar(points: &[DVec3], corners: &[u32]) -> Option<Vec<[u32; 3]>> {
    let project = Projection::along(area_vector(points, corners))?;
    let flat: Vec<[f64; 2]> = corners
        .iter()
        .map(|&v| project.flat(points[v as usize]))
        .collect();
    let n = corners.len() as u32;
    let loop_: Vec<[u32; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
    let triangles = triangulate(&flat, &loop_, &[]).ok()?;
    // Fewer where a corner lies on another edge: the boundary would be lost.
    (triangles.len() as u32 == n - 2).then(|| {
        triangles
            .into_iter()
            .map(|t| t.map(|i| corners[i as usize]))
            .collect()
    })
}

/// Projection along the coordinate axis nearest to a normal; keeps coordinates as they are.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    first: usize,
    second: usize,
}

impl Projection {
    /// The projection in which polygons with this normal are counter-clockwise; `None` for no
    /// normal.
    pub fn along(normal: DVec3) -> Option<Self> {
        let size = normal.abs();
        let axis = (0..3).fold(0, |best, i| if size[i] > size[best] { i } else { best });
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        if normal[axis] > 0.0 {
            Some(Self { first, second })
        } else if normal[axis] < 0.0 {
            Some(Self {
                first: second,
                second: first,
            })
        } else {
            None
        }
    }

    /// The two coordinates that remain.
    pub fn flat(self, p: DVec3) -> [f64; 2] {
        [p[self.first], p[self.second]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn broken(corners: &[[f64; 3]]) -> (f64, usize) {
        let mut polygons = Polygons::new(8);
        for &c in corners {
            polygons.point(DVec3::from(c));
        }
        let ids: Vec<u32> = (0..corners.len() as u32).collect();
        polygons.polygon(&ids, 0);
        let soup = polygons.into_soup(vec![Group::default()], "group", 1e-16);
        let area = soup
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| soup.points[v as usize]);
                0.5 * (b - a).cross(c - a).y
            })
            .sum();
        (area, soup.triangles.len())
    }

    #[test]
    fn concave_polygons_keep_their_area() {
        // In the plane y = 1, counter-clockwise seen from larger y.
        let dart = [
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 1.0],
            [0.0, 1.0, -4.0],
            [-1.0, 1.0, 1.0],
        ];
        let (area, n) = broken(&dart);
        assert_eq!((area.abs(), n), (4.0, 2));
        let l = [
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 3.0],
            [1.0, 1.0, 3.0],
            [1.0, 1.0, 1.0],
            [3.0, 1.0, 1.0],
            [3.0, 1.0, 0.0],
        ];
        assert_eq!(broken(&l), (5.0, 4));
    }

    #[test]
    fn repeated_corners_are_left_out() {
        let square = [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
        ];
        assert_eq!(broken(&square), (1.0, 2));
    }
}

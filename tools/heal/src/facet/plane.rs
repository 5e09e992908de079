//! The plane of a polygon.

use glam::DVec3;

/// Twice the area vector of a closed polygon (Newell's method), which has corners.
pub fn area_vector(points: &[DVec3], corners: &[u32]) -> DVec3 {
    let origin = points[corners[0] as usize];
    let at = |i: usize| points[corners[i % corners.len()] as usize] - origin;
    (1..corners.len()).map(|i| at(i).cross(at(i + 1))).sum()
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

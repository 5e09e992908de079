//! How many cubes of the sizes wanted a template holds.

use geom::tree::{Direction, Met, Rays};
use glam::DVec3;
use tmesh::{OUTSIDE, Template};

/// Places that are looked at. A choice: the number is known to a few parts in a hundred then, and takes milliseconds.
pub const PLACES: usize = 4096;

/// Ratios of a sequence that fills a cube evenly, the powers of one over the root of x^4 = x + 1 (Roberts, "The unreasonable
/// effectiveness of quasirandom sequences", 2018).
const RATIOS: DVec3 = DVec3::new(
    0.819_172_513_396_164_5,
    0.671_043_606_703_789_2,
    0.549_700_477_901_956,
);

/// A place of a sequence that fills the cube from 0 to 1 evenly.
pub fn place_in_cube(number: usize) -> DVec3 {
    (RATIOS * (number as f64 + 1.0)).fract()
}

/// Where a template has material.
pub struct Material<'a> {
    template: &'a Template,
    triangles: Vec<[u32; 3]>,
}

impl<'a> Material<'a> {
    /// Of a template.
    pub fn new(template: &'a Template) -> Self {
        Self {
            template,
            triangles: template.triangles.iter().map(|t| t.vertices).collect(),
        }
    }

    /// What is asked where it is. n log n.
    pub fn rays(&self) -> Rays<'_> {
        Rays::new(&self.template.vertices, &self.triangles)
    }

    /// Whether there is material at a place.
    pub fn is_at(&self, rays: &Rays<'_>, p: DVec3) -> bool {
        match rays.nearest(p, Direction::ALL[0], |_| true) {
            Met::Nothing => false,
            Met::Touches(_) => true,
            Met::Hit(hit) => {
                let triangle = &self.template.triangles[hit.triangle as usize];
                let region = if hit.front {
                    triangle.front
                } else {
                    triangle.back
                };
                region != OUTSIDE
            }
        }
    }
}

/// About how many cubes of the sizes wanted fit into the material of a template; `leaves` have their least coordinates, width and size.
/// Places are taken where the cubes are, so that small sizes in small places count.
pub fn cubes(template: &Template, leaves: &[(DVec3, f64, f64)]) -> f64 {
    let each = |&(_, width, size): &(DVec3, f64, f64)| (width / size).powi(3);
    let all: f64 = leaves.iter().map(each).sum();
    if !(all > 0.0 && all.is_finite()) {
        return 0.0;
    }
    let material = Material::new(template);
    let rays = material.rays();
    let (mut passed, mut next, mut inside) = (0.0, 0, 0);
    for leaf in leaves {
        passed += each(leaf);
        while next < PLACES && (next as f64 + 0.5) * all <= passed * PLACES as f64 {
            let place = leaf.0 + place_in_cube(next) * leaf.1;
            inside += usize::from(material.is_at(&rays, place));
            next += 1;
        }
    }
    all * inside as f64 / PLACES as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Triangle;

    #[test]
    fn half_of_a_cube_has_half_of_its_cubes() {
        // A triangular prism in a cube of eight leaves, one of which wants a tenth of the size.
        let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
        let at = |z: f64| corners.map(|[x, y]| DVec3::new(x, y, z));
        let faces = [
            [0, 2, 1],
            [3, 4, 5],
            [0, 1, 4],
            [0, 4, 3],
            [1, 2, 5],
            [1, 5, 4],
            [2, 0, 3],
            [2, 3, 5],
        ];
        let template = Template {
            vertices: [at(0.0), at(2.0)].concat(),
            triangles: faces
                .map(|vertices| Triangle {
                    vertices,
                    marker: 0,
                    front: OUTSIDE,
                    back: 1,
                })
                .to_vec(),
            ..Template::default()
        };
        let leaf = |i: usize| {
            let bits = [1, 2, 4].map(|bit| if i & bit == 0 { 0.0 } else { 1.0 });
            (DVec3::from_array(bits), 1.0, if i == 0 { 0.1 } else { 1.0 })
        };
        let leaves: Vec<_> = (0..8).map(leaf).collect();
        let found = cubes(&template, &leaves);
        // The small ones all, and of the other seven one, and two halves at either height but for one.
        let expected = 1000.0 + 1.0 + 4.0 * 0.5;
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        assert_eq!(cubes(&template, &[(DVec3::ZERO, 2.0, f64::INFINITY)]), 0.0);
    }
}

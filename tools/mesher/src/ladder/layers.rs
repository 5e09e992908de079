//! Thin layers, whose number of elements can be told before they are made.
//!
//! Delaunay refinement divides a face until no point of another face is within the smallest ball around one of its
//! triangles. So where two faces look at each other from a distance, points on both are about that far apart in the end:
//! a layer gets as many cubes as there are squares of its thickness in its width.

use crate::{Place, Plc};
use geom::measure::double_area_vector;
use geom::number::{number, significant};
use geom::tree::{Search, pairs};
use glam::{DVec2, DVec3};
use std::fmt;

/// Tetrahedra in a cube: those about a diagonal of it, which is the division into the fewest that fit those of the next
/// one.
pub const IN_CUBE: f64 = 6.0;

/// What the layers of a surface take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    /// Elements in them, about.
    pub elements: f64,
    /// The thickness of the one that takes most of them, model units.
    pub thickness: f64,
    /// A place in that.
    pub near: DVec3,
}

impl Layers {
    /// The layers of a surface; `None` if it has none, or if too many triangles are near each other to tell.
    pub fn of(plc: &Plc) -> Option<Self> {
        let faces: Vec<Face> = (0..plc.triangles.len())
            .map(|t| Face::new(plc, t))
            .collect();
        let boxes = faces.iter().map(|f| {
            let [a, b, c] = f.corners;
            let reach = 0.5 * f.width;
            [a.min(b).min(c) - reach, a.max(b).max(c) + reach]
        });
        // Of each triangle, the cubes as thick as the layers on both sides: those that the others over it tell of, and
        // those of the thinnest layer alone. A triangle may be over several others, and over others beyond them.
        let mut cubes = vec![(0.0, f64::INFINITY); faces.len()];
        let mut most = (0.0, 0.0, DVec3::ZERO);
        let search = pairs(
            boxes,
            |t| t,
            |s, t| {
                if let Some((thickness, area, near)) = faces[s as usize].beside(&faces[t as usize])
                {
                    let square = thickness * thickness;
                    for t in [s, t].map(|t| t as usize) {
                        let (all, least) = &mut cubes[t];
                        *all += area / square;
                        *least = square.min(*least);
                    }
                    if area / square > most.0 {
                        most = (area / square, thickness, near);
                    }
                }
                true
            },
        );
        // A layer is counted for the faces on both sides of it.
        let cubes = cubes.into_iter();
        let cubes = 0.5
            * cubes
                .zip(&faces)
                .map(|((all, least), f)| all.min(f.area / least))
                .sum::<f64>();
        (search == Search::Done && cubes > 0.0).then(|| Self {
            elements: IN_CUBE * cubes,
            thickness: most.1 / plc.scale,
            near: most.2 / plc.scale,
        })
    }
}

impl fmt::Display for Layers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "layers as thin as {} near {} would take about {} elements by the default bounds (a --radius-edge or --min-dihedral of your own is held, whatever that takes)",
            number(self.thickness),
            Place(self.near),
            significant(self.elements, 2)
        )
    }
}

/// A triangle.
struct Face {
    ids: [i32; 3],
    corners: [DVec3; 3],
    /// Unit normal, or zero.
    normal: DVec3,
    /// The least of its heights.
    width: f64,
    area: f64,
}

impl Face {
    fn new(plc: &Plc, t: usize) -> Self {
        let ids = plc.triangles[t];
        let corners = ids.map(|v| DVec3::from_array(plc.points[v as usize]));
        let [a, b, c] = corners;
        let area = double_area_vector(a, b, c);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        Self {
            ids,
            corners,
            area: 0.5 * area.length(),
            normal: area.normalize_or_zero(),
            width: area.length() / longest.max(f64::MIN_POSITIVE),
        }
    }

    /// The layer between this face and another one, if they lie over each other and are nearer than either is wide: its
    /// thickness in the middle, its area, and that middle.
    fn beside(&self, other: &Self) -> Option<(f64, f64, DVec3)> {
        let touch = self.ids.iter().any(|v| other.ids.contains(v));
        let most = self.width.min(other.width);
        let heights = other
            .corners
            .map(|p| (p - self.corners[0]).dot(self.normal));
        let is_near = heights.iter().any(|h| h.abs() < most);
        // What leans by more than 60 degrees is not over it.
        if touch || !is_near || self.normal.dot(other.normal).abs() < 0.5 {
            return None;
        }
        let x = (self.corners[1] - self.corners[0]).normalize_or_zero();
        let y = self.normal.cross(x);
        let flat =
            |p: DVec3| DVec2::new((p - self.corners[0]).dot(x), (p - self.corners[0]).dot(y));
        let common = clipped(other.corners.map(flat).to_vec(), self.corners.map(flat));
        let (area, middle) = area(&common)?;
        let middle = self.corners[0] + middle.x * x + middle.y * y;
        let over = (other.corners[0] - middle).dot(other.normal) / self.normal.dot(other.normal);
        let thickness = over.abs();
        (thickness > 0.0 && thickness < most)
            .then(|| (thickness, area, middle + 0.5 * over * self.normal))
    }
}

/// The part of a polygon that lies in a triangle, counter-clockwise.
fn clipped(mut polygon: Vec<DVec2>, triangle: [DVec2; 3]) -> Vec<DVec2> {
    for i in 0..3 {
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        let off = |p: DVec2| (b - a).perp_dot(p - a);
        let mut left = Vec::with_capacity(polygon.len() + 1);
        for (j, &p) in polygon.iter().enumerate() {
            let q = polygon[(j + 1) % polygon.len()];
            let [g, h] = [p, q].map(off);
            if g >= 0.0 {
                left.push(p);
            }
            if (g < 0.0) != (h < 0.0) {
                left.push(p.lerp(q, g / (g - h)));
            }
        }
        polygon = left;
    }
    polygon
}

/// The area of a polygon and the mean of its corners; `None` if it has no area.
fn area(polygon: &[DVec2]) -> Option<(f64, DVec2)> {
    let first = *polygon.first()?;
    let fan = polygon
        .windows(2)
        .map(|w| (w[0] - first).perp_dot(w[1] - first));
    let area = 0.5 * fan.sum::<f64>().abs();
    let middle = polygon.iter().sum::<DVec2>() / polygon.len() as f64;
    (area > 0.0).then_some((area, middle))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plate as wide as two blocks on both sides of it, whose faces are cut into triangles in two ways.
    fn sandwich(width: f64, thickness: f64) -> Plc {
        let levels = [-width, 0.0, thickness, thickness + width];
        let mut plc = Plc {
            scale: 2.0,
            ..Plc::default()
        };
        for (i, z) in levels.into_iter().enumerate() {
            let square = [[0.0, 0.0], [width, 0.0], [width, width], [0.0, width]];
            plc.points.extend(square.map(|[x, y]| [x, y, z]));
            let first = 4 * i as i32;
            let halves = match i % 2 {
                0 => [[0, 1, 2], [0, 2, 3]],
                _ => [[0, 1, 3], [1, 2, 3]],
            };
            plc.triangles.extend(halves.map(|t| t.map(|v| v + first)));
        }
        plc
    }

    #[test]
    fn a_layer_has_a_cube_for_each_square_of_its_thickness() {
        let layers = Layers::of(&sandwich(1.0, 0.01)).unwrap();
        assert!((layers.elements / 6e4 - 1.0).abs() < 1e-9, "{layers:?}");
        assert!((layers.thickness - 0.005).abs() < 1e-12, "{layers:?}");
        assert!((layers.near.z - 0.0025).abs() < 1e-12, "{layers:?}");
        // As thick as it is wide.
        assert_eq!(Layers::of(&sandwich(1.0, 1.0)), None);
    }
}

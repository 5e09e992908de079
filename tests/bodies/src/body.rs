//! The body: a triangle complex with materials.

use glam::DVec3;
use tmesh::Group;

/// A triangle and what lies on its two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Vertex ids, counter-clockwise seen from the front.
    pub vertices: [u32; 3],
    /// Material the right-hand normal points to, as index into [`Body::materials`]; `None` outside.
    pub front: Option<usize>,
    /// Material on the other side.
    pub back: Option<usize>,
}

/// A material of a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Material {
    /// Name of the solid or group it becomes in a file.
    pub name: String,
}

/// A body of one or several materials.
#[derive(Clone, Debug)]
pub struct Body {
    /// Vertex positions.
    pub vertices: Vec<DVec3>,
    /// Outer boundary and interfaces, each triangle once.
    pub faces: Vec<Face>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Highest order of a rotation; that of the group, but for random bodies with more symmetry by chance.
    pub order: u32,
    /// Point group of the shape, about the z axis (of the unplaced body).
    pub group: Group,
}

impl Body {
    /// The triangles of one material, normals out of it.
    pub fn solid(&self, material: usize) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.faces.iter().filter_map(move |face| {
            let [a, b, c] = face.vertices;
            if face.back == Some(material) {
                Some([a, b, c])
            } else if face.front == Some(material) {
                Some([a, c, b])
            } else {
                None
            }
        })
    }

    /// Volume of one material, by the divergence theorem; exact up to rounding, since faces are
    /// plane.
    pub fn volume(&self, material: usize) -> f64 {
        // Relative to the middle of the body, so that a far-away placement costs no digits.
        let middle = self.middle();
        let mut sum = 0.0;
        let mut lost = 0.0;
        for triangle in self.solid(material) {
            let [a, b, c] = triangle.map(|v| self.vertices[v as usize] - middle);
            // Kahan summation.
            let term = a.dot(b.cross(c)) - lost;
            let next = sum + term;
            lost = (next - sum) - term;
            sum = next;
        }
        sum / 6.0
    }

    /// Volume of all materials.
    pub fn total_volume(&self) -> f64 {
        (0..self.materials.len()).map(|m| self.volume(m)).sum()
    }

    /// Area of the triangles with one side outside.
    pub fn boundary_area(&self) -> f64 {
        let outer = self
            .faces
            .iter()
            .filter(|f| f.front.is_none() || f.back.is_none());
        outer
            .map(|f| {
                let [a, b, c] = f.vertices.map(|v| self.vertices[v as usize]);
                0.5 * (b - a).cross(c - a).length()
            })
            .sum()
    }

    /// Middle of the bounding box.
    fn middle(&self) -> DVec3 {
        let (low, high) = self
            .vertices
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| {
                (low.min(p), high.max(p))
            });
        0.5 * (low + high)
    }

    /// A point inside a material: halfway between its largest triangle and what a ray from there
    /// into the material meets first.
    pub fn seed(&self, material: usize) -> Option<DVec3> {
        let corners = |t: [u32; 3]| t.map(|v| self.vertices[v as usize]);
        let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let largest = self
            .solid(material)
            .map(corners)
            .max_by(|s, t| normal(*s).length().total_cmp(&normal(*t).length()))?;
        let [a, b, c] = largest;
        // Off the centroid, so that the ray misses edges of regular tessellations.
        let start = 0.36 * a + 0.33 * b + 0.31 * c;
        let direction = -normal(largest).normalize();
        let nearest = self
            .solid(material)
            .map(corners)
            .filter(|&t| t != largest)
            .filter_map(|t| ray_hit(start, direction, t))
            .filter(|&d| d > 0.0)
            .min_by(f64::total_cmp)?;
        Some(start + 0.5 * nearest * direction)
    }
}

/// Distance along the ray at which it meets a triangle.
fn ray_hit(start: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let normal = (b - a).cross(c - a);
    let slope = normal.dot(direction);
    let distance = normal.dot(a - start) / slope;
    let p = start + distance * direction;
    let inside = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(u, v)| (v - u).cross(p - u).dot(normal) >= 0.0);
    (inside && distance.is_finite()).then_some(distance)
}

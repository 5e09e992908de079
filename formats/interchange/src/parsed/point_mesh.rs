//! A mesh with numbers at its points.

use glam::DVec3;

/// A mesh of tetrahedra or triangles with numbers at its points. All points that elements name are there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointMesh {
    /// Positions, all finite; elements need not name all of them.
    pub points: Vec<DVec3>,
    /// Tetrahedra; other cells of volume are divided into some.
    pub tets: Vec<[u32; 4]>,
    /// Triangles; other faces are divided into some.
    pub triangles: Vec<[u32; 3]>,
    /// Numbers at the points, in the order of the file.
    pub arrays: Vec<PointArray>,
}

/// Numbers at points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointArray {
    /// What the file calls it.
    pub name: String,
    /// Numbers at each point.
    pub components: usize,
    /// As many for each point; what is missing is no number (NaN).
    pub values: Vec<f64>,
}

/// Faces of a hexahedron, by its corners: those of the bottom in order, then of the top.
const HEXAHEDRON: [&[usize]; 6] = [
    &[0, 1, 2, 3],
    &[4, 5, 6, 7],
    &[0, 1, 5, 4],
    &[1, 2, 6, 5],
    &[2, 3, 7, 6],
    &[3, 0, 4, 7],
];
/// Faces of a prism over a triangle.
const PRISM: [&[usize]; 5] = [
    &[0, 1, 2],
    &[3, 4, 5],
    &[0, 1, 4, 3],
    &[1, 2, 5, 4],
    &[2, 0, 3, 5],
];
/// Faces of a pyramid over a quadrilateral.
const PYRAMID: [&[usize]; 5] = [
    &[0, 1, 2, 3],
    &[0, 1, 4],
    &[1, 2, 4],
    &[2, 3, 4],
    &[3, 0, 4],
];

impl PointMesh {
    /// Adds a cell of volume by its corners: four, five, six or eight, ordered as in VTK and Gmsh. Cells that name a point twice are
    /// divided into what is left of them.
    ///
    /// Faces are divided from their lowest point, and cells into pyramids over those that do not have the cell's lowest point, so that
    /// cells beside each other divide their common face alike (Dompierre et al., "How to subdivide pyramids, prisms and hexahedra
    /// into tetrahedra", 1999).
    pub fn add_volume(&mut self, corners: &[u32]) {
        let faces: &[&[usize]] = match corners.len() {
            5 => &PYRAMID,
            6 => &PRISM,
            8 => &HEXAHEDRON,
            _ => {
                if let &[a, b, c, d] = corners {
                    self.add_tet([a, b, c, d]);
                }
                return;
            }
        };
        let Some(&top) = corners.iter().min() else {
            return;
        };
        for face in faces {
            let face: Vec<u32> = face.iter().map(|&i| corners[i]).collect();
            if !face.contains(&top) {
                fan(&face, |[a, b, c]| self.add_tet([top, a, b, c]));
            }
        }
    }

    /// Adds a face by its corners, three or more.
    pub fn add_face(&mut self, corners: &[u32]) {
        fan(corners, |t| {
            if is_simplex(t) {
                self.triangles.push(t);
            }
        });
    }

    fn add_tet(&mut self, tet: [u32; 4]) {
        if is_simplex(tet) {
            self.tets.push(tet);
        }
    }
}

/// Triangles of a polygon, from its lowest point.
fn fan(polygon: &[u32], mut sink: impl FnMut([u32; 3])) {
    let lowest = (0..polygon.len()).min_by_key(|&i| polygon[i]).unwrap_or(0);
    let at = |i: usize| polygon[(lowest + i) % polygon.len()];
    for i in 2..polygon.len() {
        sink([at(0), at(i - 1), at(i)]);
    }
}

fn is_simplex<const N: usize>(corners: [u32; N]) -> bool {
    (1..N).all(|k| !corners[..k].contains(&corners[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of two cubes beside each other, numbered at will, have six tetrahedra each, which fill them and share triangles.
    #[test]
    fn cells_are_divided_to_conform() {
        let names = [7_u32, 2, 9, 4, 0, 11, 5, 3, 8, 1, 10, 6];
        let at = |x: usize, y: usize, z: usize| names[4 * x + 2 * y + z];
        let cube = |x: usize| {
            [
                at(x, 0, 0),
                at(x + 1, 0, 0),
                at(x + 1, 1, 0),
                at(x, 1, 0),
                at(x, 0, 1),
                at(x + 1, 0, 1),
                at(x + 1, 1, 1),
                at(x, 1, 1),
            ]
        };
        let mut mesh = PointMesh::default();
        let mut points = vec![DVec3::ZERO; 12];
        for x in 0..3 {
            for y in 0..2 {
                for z in 0..2 {
                    let place = DVec3::new(x as f64, y as f64, z as f64);
                    points[at(x, y, z) as usize] = place;
                }
            }
        }
        mesh.add_volume(&cube(0));
        mesh.add_volume(&cube(1));
        assert_eq!(mesh.tets.len(), 12);
        let volume = |t: &[u32; 4]| {
            let [a, b, c, d] = t.map(|v| points[v as usize]);
            ((b - a).cross(c - a).dot(d - a) / 6.0).abs()
        };
        let total: f64 = mesh.tets.iter().map(volume).sum();
        assert!((total - 2.0).abs() < 1e-12, "{total}");
        // Every triangle between two tetrahedra is there twice; twelve times two triangles are outside.
        let mut faces = std::collections::BTreeMap::new();
        for t in &mesh.tets {
            for k in 0..4 {
                let mut face: Vec<u32> = (0..4).filter(|&i| i != k).map(|i| t[i]).collect();
                face.sort_unstable();
                *faces.entry(face).or_insert(0) += 1;
            }
        }
        assert_eq!(faces.values().filter(|&&n| n == 1).count(), 20);
        assert!(faces.values().all(|&n| n <= 2));
    }

    #[test]
    fn prisms_pyramids_and_folded_cells() {
        let mut mesh = PointMesh::default();
        mesh.add_volume(&[5, 4, 3, 2, 1, 0]);
        assert_eq!(mesh.tets.len(), 3);
        mesh.add_volume(&[5, 4, 3, 2, 1]);
        assert_eq!(mesh.tets.len(), 5);
        // A hexahedron folded to a prism.
        mesh.tets.clear();
        mesh.add_volume(&[0, 1, 2, 2, 4, 5, 6, 6]);
        assert_eq!(mesh.tets.len(), 3);
        mesh.add_face(&[3, 1, 2, 0]);
        assert_eq!(mesh.triangles, [[0, 3, 1], [0, 1, 2]]);
    }
}

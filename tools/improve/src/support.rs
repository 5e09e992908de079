//! Edges and triangles of the surface that a vertex may come to be on.
//!
//! Around an edge, triangles of the surface and the spaces between them take turns. The vertex divides the triangles, and what is in each
//! of the spaces makes room for it.

use crate::freedom::{Exact, Freedom};
use crate::freedoms::Freedoms;
use crate::mesh::Mesh;
use crate::surface::Sheet;
use arrayvec::ArrayVec;
use glam::DVec3;

/// An edge of the surface, or a triangle with nothing beyond.
pub struct Support {
    /// Its two or three corners.
    corners: ArrayVec<u32, 3>,
    /// The tetrahedra at it, those of each space.
    pub spaces: Vec<Vec<u32>>,
    /// What a vertex on it may do, and what it must keep.
    pub within: (Freedom, Exact),
    /// The patch of a curved shape that it is inside of.
    pub patch: Option<u32>,
    /// Patches with nothing beyond, in which more triangles may be divided.
    sheets: Vec<Sheet>,
}

impl Support {
    /// A face of a tetrahedron, if it is a triangle of a patch with nothing beyond.
    pub fn triangle(
        mesh: &Mesh<'_>,
        freedoms: &Freedoms,
        (face, tet): ([u32; 3], u32),
    ) -> Option<Self> {
        let sheet = mesh.surface().sheet(face)?;
        Some(Self {
            corners: face.into(),
            spaces: vec![vec![tet]],
            within: freedoms.within(&sheet, |v| mesh.positions[v as usize]),
            patch: mesh.surface().curved(face),
            sheets: vec![sheet],
        })
    }

    /// The edge between two vertices, if it is on the surface and all triangles there may be divided. Edges with an end on the axis
    /// stay, and those that touch a wall.
    pub fn edge(mesh: &Mesh<'_>, freedoms: &Freedoms, ends: [u32; 2]) -> Option<Self> {
        let [a, b] = ends;
        let is_kept = freedoms.is_on_axis(a) || freedoms.is_on_axis(b);
        if is_kept || mesh.surface().is_touching(ends) {
            return None;
        }
        let (spaces, corners) = spaces_around(mesh, ends);
        if corners.is_empty() {
            return None;
        }
        let surface = mesh.surface();
        let triangles = corners.iter().map(|&c| [a, b, c]);
        if !triangles.clone().all(|t| surface.is_divisible(t)) {
            return None;
        }
        let sheets: Vec<Sheet> = triangles.filter_map(|t| surface.sheet(t)).collect();
        let inside_of = match corners[..] {
            [c, d] => surface
                .flat([a, b, c])
                .filter(|patch| surface.is_in(patch, [a, b, d])),
            _ => None,
        };
        let within = match inside_of {
            // Inside of a sheet, there is more room in its triangles.
            Some(_) if !sheets.is_empty() => return None,
            Some(patch) => freedoms.within(&patch, |v| mesh.positions[v as usize]),
            None => {
                let [p, q] = ends.map(|v| mesh.positions[v as usize]);
                let along = (q - p).try_normalize()?;
                (Freedom::Line(along), freedoms.common(&ends))
            }
        };
        Some(Self {
            corners: ends.into_iter().collect(),
            spaces,
            within,
            patch: match corners[..] {
                [c, d] => mesh.patch_around(ends, [c, d]),
                _ => None,
            },
            sheets,
        })
    }

    /// The ends of an edge.
    pub fn ends(&self) -> Option<[u32; 2]> {
        match self.corners[..] {
            [a, b] => Some([a, b]),
            _ => None,
        }
    }

    /// Places to try: the middle, and for a triangle, those of its edges and the centre of its circumscribed circle.
    pub fn places(&self, mesh: &Mesh<'_>) -> impl Iterator<Item = DVec3> + use<> {
        let points: ArrayVec<DVec3, 3> = (self.corners.iter())
            .map(|&v| mesh.positions[v as usize])
            .collect();
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let mut all = ArrayVec::<DVec3, 5>::from_iter([middle]);
        if let [a, b, c] = points[..] {
            all.extend([[a, b], [b, c], [c, a]].map(|[p, q]| (p + q) * 0.5));
            let (u, v) = (b - a, c - a);
            let normal = u.cross(v);
            let sum = u.length_squared() * v.cross(normal) + v.length_squared() * normal.cross(u);
            let centre = a + sum / (2.0 * normal.length_squared());
            // Triangles of a patch may lean from its plane by what it is uneven by over their width, and centres of narrow ones are far away.
            let above = self.sheets.iter().find_map(|sheet| sheet.normal);
            let above = above.unwrap_or_default();
            let centre = centre - above * (centre - middle).dot(above);
            all.extend(Some(centre).filter(|p| p.is_finite()));
        }
        let exact = self.within.1;
        all.into_iter().map(move |p| exact.place(p))
    }

    /// Whether a face of what makes room for the vertex is one that it divides.
    pub fn is_divided(&self, mesh: &Mesh<'_>, face: [u32; 3]) -> bool {
        self.corners.iter().all(|v| face.contains(v))
            || self.sheets.iter().any(|s| mesh.surface().is_in(s, face))
    }
}

/// The tetrahedra at an edge, those of each space that the surface leaves there, and the third corners of the triangles of the surface,
/// increasing.
fn spaces_around(mesh: &Mesh<'_>, [a, b]: [u32; 2]) -> (Vec<Vec<u32>>, Vec<u32>) {
    let around = mesh.star(a).iter().copied();
    let mut left: Vec<u32> = around.filter(|&t| mesh.corners(t).contains(&b)).collect();
    let others = |tet: u32| {
        let corners = mesh.corners(tet).into_iter();
        corners.filter(move |&v| v != a && v != b)
    };
    let mut spaces: Vec<Vec<u32>> = Vec::new();
    let mut corners: Vec<u32> = Vec::new();
    while let Some(first) = left.pop() {
        let mut space = vec![first];
        let mut open: Vec<u32> = others(first).collect();
        while let Some(c) = open.pop() {
            let is_fixed = mesh.is_fixed_face([a, b, c]);
            let beyond = left.iter().position(|&t| mesh.corners(t).contains(&c));
            let next = beyond.filter(|&i| !is_fixed && mesh.region(left[i]) == mesh.region(first));
            if let Some(i) = next {
                let tet = left.swap_remove(i);
                space.push(tet);
                open.extend(others(tet).filter(|&v| v != c));
                continue;
            }
            // The last face of a ring around an edge inside is between two that are known.
            let known = space.iter().filter(|&&t| mesh.corners(t).contains(&c));
            if is_fixed || known.count() < 2 {
                corners.push(c);
            }
        }
        spaces.push(space);
    }
    corners.sort_unstable();
    corners.dedup();
    (spaces, corners)
}

//! The outer faces of a template and the measures of its boundary.

use super::table::sorted;
use geom::measure::triangle_area;
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Template};

/// The outer faces of a template, walls included, and measures of its boundary.
pub struct Skin {
    /// Vertices of each face with one tetrahedron, increasing; the faces are in increasing order.
    pub faces: Vec<[u32; 3]>,
    /// The surface triangle on each face, or `u32::MAX`.
    pub triangles: Vec<u32>,
    /// Area of the faces that are on no wall, model units squared.
    pub boundary_area: f64,
    /// Sum of the perimeters of those faces, model units.
    pub perimeter: f64,
    /// Area of boundary and interfaces of each region, walls left out.
    pub region_area: BTreeMap<u32, f64>,
}

impl Skin {
    /// No faces yet.
    pub fn empty() -> Self {
        Self {
            faces: Vec::new(),
            triangles: Vec::new(),
            boundary_area: 0.0,
            perimeter: 0.0,
            region_area: BTreeMap::new(),
        }
    }

    /// Position of a face, given by its vertices in any order.
    pub fn find(&self, face: [u32; 3]) -> Option<usize> {
        self.faces.binary_search(&sorted(face).0).ok()
    }

    /// The skin of a template without tetrahedra: its triangles with material on one side.
    pub fn of_triangles(template: &Template, on_wall: &[bool]) -> Self {
        let mut skin = Self::empty();
        let mut outer: Vec<([u32; 3], u32)> = Vec::new();
        for (i, t) in template.triangles.iter().enumerate() {
            let face = sorted(t.vertices).0;
            let sides = [t.front, t.back].map(|r| (r != OUTSIDE).then_some(r));
            if sides[0].is_some() != sides[1].is_some() {
                outer.push((face, i as u32));
            }
            if !on_wall[i] {
                skin.add(template, face, sides);
            }
        }
        outer.sort_unstable();
        (skin.faces, skin.triangles) = outer.into_iter().unzip();
        skin
    }

    /// Adds a face between two regions, or a region and the outside, to the measures.
    pub fn add(&mut self, template: &Template, face: [u32; 3], sides: [Option<u32>; 2]) {
        if sides[0] == sides[1] {
            return;
        }
        let [a, b, c] = face.map(|v| template.vertices[v as usize]);
        let area = triangle_area(a, b, c);
        if sides.contains(&None) {
            self.boundary_area += area;
            self.perimeter += a.distance(b) + b.distance(c) + c.distance(a);
        }
        for region in sides.into_iter().flatten() {
            *self.region_area.entry(region).or_insert(0.0) += area;
        }
    }
}

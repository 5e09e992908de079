//! A wedge as the estimate sees it: its surface, and which part of that the cuts have made.

use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::Template;

/// A wedge and its cut faces.
pub struct Wedge<'a> {
    /// The surface.
    pub template: &'a Template,
    /// Copies that make the body.
    pub copies: usize,
    /// Triangles of each section of the body: a cut face; of two faces that are images of each other, one.
    pub sections: Vec<Vec<u32>>,
    /// For each triangle, whether it is part of a cut face.
    pub is_cut: Vec<bool>,
    /// The cut faces that each vertex is on, a bit each.
    pub faces: Vec<u8>,
    /// The image of a vertex on the partner of its cut face.
    pub partner: FxHashMap<u32, u32>,
}

impl<'a> Wedge<'a> {
    /// Looks at what a wedge is glued to. `copies` of it make the body.
    pub fn new(template: &'a Template, copies: usize) -> Self {
        let mut wedge = Self {
            template,
            copies,
            sections: Vec::new(),
            is_cut: vec![false; template.triangles.len()],
            faces: vec![0; template.vertices.len()],
            partner: FxHashMap::default(),
        };
        let mut bits = (0..8).cycle().map(|i| 1_u8 << i);
        let mut next = || bits.next().unwrap_or(1);
        // The wedge is the document's first template, and faces of a hub are none of the body's sections.
        for gluing in template.gluings.iter().filter(|g| g.other == 0) {
            // The low face of a seam; a mirror wall is its own partner.
            wedge.sections.push(gluing.triangles_there().collect());
            for t in gluing.triangles_of(0) {
                wedge.is_cut[t as usize] = true;
            }
            let low = next();
            let high = if gluing.is_mirror(0) { low } else { next() };
            for &[here, there] in &gluing.vertex_pairs {
                wedge.faces[there as usize] |= low;
                wedge.faces[here as usize] |= high;
                if low != high {
                    wedge.partner.insert(here, there);
                    wedge.partner.insert(there, here);
                }
            }
        }
        wedge
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        geom::measure::corners(
            &self.template.vertices,
            &self.template.triangles[triangle as usize],
        )
    }

    /// Triangles of the body's own surface.
    pub fn body(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.is_cut.len() as u32).filter(|&t| !self.is_cut[t as usize])
    }

    /// Whether the sections are where the body has no mirror plane, so that their corners tell nothing.
    pub fn is_sliced(&self) -> bool {
        !self.partner.is_empty()
    }
}

/// Edge of the regular tetrahedron of a volume, model units.
pub fn edge_of_volume(volume: f64) -> f64 {
    (volume * 6.0 * std::f64::consts::SQRT_2).cbrt()
}

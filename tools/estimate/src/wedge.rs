//! A wedge as the estimate sees it: its surface, and which part of that the cuts have made.

use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Template, Wall};

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
        for wall in &template.walls {
            match wall {
                Wall::Mirror(m) => {
                    let bit = next();
                    m.vertices
                        .iter()
                        .for_each(|&v| wedge.faces[v as usize] |= bit);
                    wedge.sections.push(m.triangles.clone());
                    m.triangles
                        .iter()
                        .for_each(|&t| wedge.is_cut[t as usize] = true);
                }
                Wall::Seam(s) => {
                    let bits = [next(), next()];
                    for &pair in &s.vertex_pairs {
                        for (v, bit) in pair.into_iter().zip(bits) {
                            wedge.faces[v as usize] |= bit;
                        }
                        wedge.partner.insert(pair[0], pair[1]);
                        wedge.partner.insert(pair[1], pair[0]);
                    }
                    wedge
                        .sections
                        .push(s.triangle_pairs.iter().map(|p| p[0]).collect());
                    let both = s.triangle_pairs.iter().flatten();
                    both.for_each(|&t| wedge.is_cut[t as usize] = true);
                }
                Wall::Hub(_) => {}
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

//! A wedge as the estimate sees it: its surface, and which part of that the cuts have made.

use crate::asked::Asked;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Isometry, Template};

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
    /// Elements asked for across walls, at least.
    pub layers: f64,
    /// What is asked of edges, where surfaces are remeshed.
    pub asked: Option<Asked>,
    /// The image of a vertex on the partner of its cut face.
    pub partner: FxHashMap<u32, u32>,
}

impl<'a> Wedge<'a> {
    /// Looks at what a template of the given number is glued to. `copies` of it make the body, or its part of that.
    pub fn new(template: &'a Template, number: usize, copies: usize) -> Self {
        let mut wedge = Self {
            template,
            copies,
            sections: Vec::new(),
            is_cut: vec![false; template.triangles.len()],
            faces: vec![0; template.vertices.len()],
            layers: 1.0,
            asked: None,
            partner: FxHashMap::default(),
        };
        let mut bits = (0..8).cycle().map(|i| 1_u8 << i);
        let mut next = || bits.next().unwrap_or(1);
        // Faces across the axis are no sections by radius and height, and those of another template no cuts.
        for gluing in &template.gluings {
            if gluing.other_than(number).is_some() {
                continue;
            }
            let is_mirror = gluing.is_mirror(number);
            let there = next();
            let here = if is_mirror { there } else { next() };
            for &[v, w] in &gluing.vertex_pairs {
                wedge.faces[v as usize] |= here;
                wedge.faces[w as usize] |= there;
                if !is_mirror {
                    wedge.partner.insert(v, w);
                    wedge.partner.insert(w, v);
                }
            }
            for t in gluing.triangles_of(number) {
                wedge.is_cut[t as usize] = true;
            }
            let section: Vec<u32> = match gluing.step.mirrored() && gluing.step.flipped() {
                // The two halves of one face.
                true => gluing.triangles_of(number).collect(),
                false => gluing.triangles_there().collect(),
            };
            if gluing.step != Isometry::FLIP {
                wedge.sections.push(section);
            }
        }
        wedge
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        geom::measure::corners(
            &self.template.vertices,
            self.template.triangles[triangle as usize],
        )
    }

    /// Triangles of the body's own surface.
    pub fn body(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.is_cut.len() as u32).filter(|&t| !self.is_cut[t as usize])
    }

    /// Whether nothing is thin in the corners of sections: they tell nothing where the body has no mirror plane, and elements that are to have
    /// some length fit into corners as they are wide. The coefficients are measured with corners of what is drawn exactly.
    pub fn has_open_corners(&self) -> bool {
        !self.partner.is_empty() || self.asked.as_ref().is_some_and(Asked::has_lengths)
    }
}

/// Edge of the regular tetrahedron of a volume, model units.
pub fn edge_of_volume(volume: f64) -> f64 {
    (volume * 6.0 * std::f64::consts::SQRT_2).cbrt()
}

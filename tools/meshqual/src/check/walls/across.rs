//! Two faces that fall together when the template beyond a wall is placed.

use super::face::Face;
use crate::check::findings::{Findings, Kind};
use crate::instances::Links;
use geom::grid::Grid;
use geom::tolerance::PROMISE;
use rustc_hash::FxHashSet;
use tmesh::Isometry;

/// Checks that all faces and vertices that fall together are listed as pairs.
pub fn check(wall: &Face<'_>, findings: &mut Findings) {
    let across = Across::new(wall);
    across.check_faces(findings);
    across.check_vertices(findings);
}

struct Across<'a> {
    wall: &'a Face<'a>,
    /// The template beyond.
    beyond: usize,
    /// (vertex beyond, vertex here), increasing.
    vertex_pairs: Vec<[u32; 2]>,
}

impl<'a> Across<'a> {
    fn new(wall: &'a Face<'a>) -> Self {
        let pairs = wall.gluing.vertex_pairs.iter();
        let mut vertex_pairs: Vec<[u32; 2]> = pairs.map(|&[here, there]| [there, here]).collect();
        vertex_pairs.sort_unstable();
        Self {
            wall,
            beyond: wall.gluing.other as usize,
            vertex_pairs,
        }
    }

    /// The vertex here that a vertex beyond falls on.
    fn partner(&self, v: u32) -> Option<u32> {
        let found = self.vertex_pairs.binary_search_by_key(&v, |p| p[0]);
        found.ok().map(|i| self.vertex_pairs[i][1])
    }

    /// Outer faces beyond whose vertices are all paired fall on the face of the partners.
    fn check_faces(&self, findings: &mut Findings) {
        let pairs = self.wall.gluing.triangle_pairs.iter();
        let paired: FxHashSet<[u32; 2]> = pairs.copied().collect();
        let skins = self.wall.mesh.skins;
        let (here, beyond) = (&skins[self.wall.own], &skins[self.beyond]);
        for (face, &triangle) in beyond.faces.iter().zip(&beyond.triangles) {
            let [Some(a), Some(b), Some(c)] = face.map(|v| self.partner(v)) else {
                continue;
            };
            let Some(position) = here.find([a, b, c]) else {
                continue;
            };
            let own = here.triangles[position];
            if triangle == u32::MAX || !paired.contains(&[own, triangle]) {
                self.wall.unlisted(self.beyond, *face, findings);
            }
        }
    }

    /// Looks for vertices that fall together and are not paired.
    fn check_vertices(&self, findings: &mut Findings) {
        let mesh = &self.wall.mesh;
        let here = &self.wall.template(self.wall.own).vertices;
        let reach = PROMISE * mesh.size;
        let grid = Grid::of(here.iter().copied(), reach);
        let step = self.wall.gluing.step;
        let placed = step.placed();
        let mut links = None;
        for (v, &p) in (0..).zip(&self.wall.template(self.beyond).vertices) {
            let Some((w, distance)) = grid.nearest(placed.apply(p), reach) else {
                continue;
            };
            let partner = self.partner(v);
            let paired = partner.is_some_and(|q| q == w || here[q as usize] == here[w as usize]);
            // About the axis, and across both faces of a half turn's seam, vertices are joined by
            // way of others.
            let known = paired || {
                let own = (self.wall.own as u32, Isometry::IDENTITY, w);
                let other = (self.beyond as u32, step, v);
                let links = links.get_or_insert_with(|| Links::of(mesh.document));
                links.join(own, other)
            };
            if !known {
                findings.add(Kind::UnpairedVertex, || {
                    format!(
                        "vertex {v} placed across wall '{}' is {distance:e} from vertex {w} {}",
                        self.wall.gluing.name,
                        self.wall.at(self.wall.own, &[w])
                    )
                });
            }
        }
    }
}

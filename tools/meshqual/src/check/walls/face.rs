//! A wall of a template, with what is known of the mesh around it.

use crate::check::faces::Skin;
use crate::check::findings::{Findings, Kind, at};
use tmesh::{Document, Gluing, OUTSIDE, Template};

/// A mesh whose walls are checked.
#[derive(Clone, Copy)]
pub struct Mesh<'a> {
    /// The document.
    pub document: &'a Document,
    /// Diagonal of its bounding box.
    pub size: f64,
    /// Outer faces of all templates.
    pub skins: &'a [Skin],
}

/// A wall of a template.
#[derive(Clone, Copy)]
pub struct Face<'a> {
    /// The mesh it belongs to.
    pub mesh: Mesh<'a>,
    /// The template that lists it.
    pub own: usize,
    /// The wall.
    pub gluing: &'a Gluing,
}

impl<'a> Face<'a> {
    /// A template of the mesh.
    pub fn template(&self, index: usize) -> &'a Template {
        &self.mesh.document.templates[index]
    }

    /// "near (x, y, z)", the place of vertices of a template.
    pub fn at(&self, template: usize, vertices: &[u32]) -> String {
        at(self.mesh.document, template, vertices)
    }

    /// Checks that triangles of a template are outer faces, with nothing beyond.
    pub fn check_outer(
        &self,
        template: usize,
        triangles: impl Iterator<Item = u32>,
        findings: &mut Findings,
    ) {
        for triangle in triangles {
            let t = &self.template(template).triangles[triangle as usize];
            let one_sided = (t.front == OUTSIDE) != (t.back == OUTSIDE);
            let found = self.mesh.skins[template].find(t.vertices);
            if !one_sided || found.is_none() {
                findings.add(Kind::WallInside, || {
                    let place = self.at(template, &t.vertices);
                    format!("triangle {triangle} of wall '{}' {place}", self.gluing.name)
                });
            }
        }
    }

    /// Reports a face of a template that lies on the wall without being listed.
    pub fn unlisted(&self, template: usize, face: [u32; 3], findings: &mut Findings) {
        findings.add(Kind::UnlistedWallFace, || {
            let [a, b, c] = face;
            let place = self.at(template, &face);
            format!("face {a} {b} {c} on wall '{}' {place}", self.gluing.name)
        });
    }
}

//! Faces: two tetrahedra inside, one at the boundary, and the surface triangles on them.

use super::skin::Skin;
use super::table::{FaceTable, Side};
use crate::check::findings::{Findings, Kind, at};
use crate::error::Error;
use tmesh::{Document, OUTSIDE, Template};

/// Checks the faces of a template with tetrahedra. `inverted` lists tetrahedra that are reported
/// already: their sides are not compared.
pub fn conformity(
    document: &Document,
    index: usize,
    on_wall: &[bool],
    inverted: &[u32],
    findings: &mut Findings,
) -> Result<Skin, Error> {
    let template = &document.templates[index];
    // A mesh from elsewhere may come without surface triangles, or with some of them; what went
    // through the pipe has them all.
    let promised =
        document.symmetry.is_some() || document.promise.is_some() || !document.is_plain();
    let mut check = Check {
        document,
        index,
        template,
        on_wall,
        inverted,
        complete: promised && !template.triangles.is_empty(),
        skin: Skin::empty(),
        findings,
    };
    FaceTable::new(template)?.visit(|vertices, tets, triangles| {
        check.face(&Face {
            vertices,
            tets,
            triangles,
        });
    });
    Ok(check.skin)
}

/// A face with the tetrahedra and the surface triangles that have it.
struct Face<'a> {
    /// Increasing.
    vertices: [u32; 3],
    tets: &'a [Side],
    triangles: &'a [Side],
}

impl Face<'_> {
    fn name(&self) -> String {
        let [a, b, c] = self.vertices;
        format!("face {a} {b} {c}")
    }
}

struct Check<'a> {
    document: &'a Document,
    index: usize,
    template: &'a Template,
    on_wall: &'a [bool],
    inverted: &'a [u32],
    /// Whether all faces on boundaries and interfaces have a surface triangle.
    complete: bool,
    skin: Skin,
    findings: &'a mut Findings,
}

impl Check<'_> {
    fn face(&mut self, face: &Face<'_>) {
        if let [a, b, ..] = face.triangles {
            let (a, b) = (a.element, b.element);
            self.add(Kind::RepeatedTriangle, face, || {
                format!("triangles {a} and {b}")
            });
        }
        match face.tets {
            [] => {
                for t in face.triangles {
                    let text = || format!("triangle {}", t.element);
                    self.add(Kind::StrayTriangle, face, text);
                }
                return;
            }
            [tet] => self.outer(face, *tet),
            [a, b] => self.inner(face, [*a, *b]),
            more => {
                self.add(Kind::OverfullFace, face, || {
                    let tets: Vec<String> = more.iter().map(|s| s.element.to_string()).collect();
                    format!("{} of tetrahedra {}", face.name(), tets.join(", "))
                });
                return;
            }
        }
        if let Some(triangle) = face.triangles.first() {
            self.sides(face, *triangle);
        }
    }

    fn add(&mut self, kind: Kind, face: &Face<'_>, text: impl FnOnce() -> String) {
        let (document, index) = (self.document, self.index);
        self.findings.add(kind, || {
            format!("{} {}", text(), at(document, index, &face.vertices))
        });
    }

    fn region(&self, tet: Side) -> u32 {
        self.template.tets[tet.element as usize].region
    }

    fn is_upright(&self, tet: Side) -> bool {
        self.inverted.binary_search(&tet.element).is_err()
    }

    /// A face with one tetrahedron.
    fn outer(&mut self, face: &Face<'_>, tet: Side) {
        let triangle = face.triangles.first();
        self.skin.faces.push(face.vertices);
        let element = triangle.map_or(u32::MAX, |t| t.element);
        self.skin.triangles.push(element);
        if triangle.is_none() && self.complete {
            self.add(Kind::MissingTriangle, face, || {
                format!("{} of tetrahedron {}", face.name(), tet.element)
            });
        }
        if !triangle.is_some_and(|t| self.on_wall[t.element as usize]) {
            let sides = [Some(self.region(tet)), None];
            self.skin.add(self.template, face.vertices, sides);
        }
    }

    /// A face with two tetrahedra.
    fn inner(&mut self, face: &Face<'_>, [a, b]: [Side; 2]) {
        if a.even == b.even && self.is_upright(a) && self.is_upright(b) {
            self.add(Kind::SameSide, face, || {
                let (a, b) = (a.element, b.element);
                format!("{} of tetrahedra {a} and {b}", face.name())
            });
        }
        let regions = [a, b].map(|tet| self.region(tet));
        if regions[0] == regions[1] {
            return;
        }
        if face.triangles.is_empty() && self.complete {
            self.add(Kind::MissingInterface, face, || {
                let (a, b) = (a.element, b.element);
                format!("{} between tetrahedra {a} and {b}", face.name())
            });
        }
        let sides = regions.map(Some);
        self.skin.add(self.template, face.vertices, sides);
    }

    /// Compares the regions on the sides of a triangle with those of the tetrahedra beside it.
    fn sides(&mut self, face: &Face<'_>, side: Side) {
        let t = self.template.triangles[side.element as usize];
        // The triangle's normal points out of a tetrahedron behind it.
        let mut found = [OUTSIDE; 2];
        for &tet in face.tets {
            found[usize::from(tet.even == side.even)] = self.region(tet);
        }
        let upright = face.tets.iter().all(|&tet| self.is_upright(tet));
        if found != [t.front, t.back] && upright {
            self.add(Kind::WrongRegion, face, || {
                format!(
                    "triangle {} has {} in front and {} behind, the tetrahedra have {} and {}",
                    side.element,
                    region(t.front),
                    region(t.back),
                    region(found[0]),
                    region(found[1])
                )
            });
        }
    }
}

fn region(id: u32) -> String {
    match id {
        OUTSIDE => "nothing".to_owned(),
        id => format!("region {id}"),
    }
}

//! Faces: two tetrahedra inside, one at the boundary, and the surface triangles on them.

use super::findings::{Findings, Kind, at};
use crate::Error;
use crate::faces::{FaceTable, sorted};
use geom::measure::triangle_area;
use std::collections::BTreeMap;
use tmesh::{Document, OUTSIDE, Template};

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
    fn empty() -> Self {
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
    fn add(&mut self, template: &Template, face: [u32; 3], sides: [Option<u32>; 2]) {
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
    let complete = promised && !template.triangles.is_empty();
    let mut skin = Skin::empty();
    FaceTable::new(template)?.visit(|face, tets, triangles| {
        let place = || at(document, index, &face);
        let name = || format!("face {} {} {}", face[0], face[1], face[2]);
        let upright = |t: u32| inverted.binary_search(&t).is_err();
        if let [a, b, ..] = triangles {
            findings.add(Kind::RepeatedTriangle, || {
                format!("triangles {} and {} {}", a.element, b.element, place())
            });
        }
        let triangle = triangles.first();
        let regions = |i: usize| {
            tets.get(i)
                .map(|s| template.tets[s.element as usize].region)
        };
        match tets {
            [] => {
                for t in triangles {
                    findings.add(Kind::StrayTriangle, || {
                        format!("triangle {} {}", t.element, place())
                    });
                }
                return;
            }
            [tet] => {
                skin.faces.push(face);
                skin.triangles
                    .push(triangle.map_or(u32::MAX, |t| t.element));
                if triangle.is_none() && complete {
                    findings.add(Kind::MissingTriangle, || {
                        format!("{} of tetrahedron {} {}", name(), tet.element, place())
                    });
                }
                if !triangle.is_some_and(|t| on_wall[t.element as usize]) {
                    skin.add(template, face, [regions(0), None]);
                }
            }
            [a, b] => {
                if a.even == b.even && upright(a.element) && upright(b.element) {
                    findings.add(Kind::SameSide, || {
                        format!(
                            "{} of tetrahedra {} and {} {}",
                            name(),
                            a.element,
                            b.element,
                            place()
                        )
                    });
                }
                if regions(0) != regions(1) {
                    if triangle.is_none() && complete {
                        findings.add(Kind::MissingInterface, || {
                            format!(
                                "{} between tetrahedra {} and {} {}",
                                name(),
                                a.element,
                                b.element,
                                place()
                            )
                        });
                    }
                    skin.add(template, face, [regions(0), regions(1)]);
                }
            }
            more => {
                findings.add(Kind::OverfullFace, || {
                    let tets: Vec<String> = more.iter().map(|s| s.element.to_string()).collect();
                    format!("{} of tetrahedra {} {}", name(), tets.join(", "), place())
                });
                return;
            }
        }
        let Some(side) = triangle else { return };
        let t = &template.triangles[side.element as usize];
        // The triangle's normal points out of a tetrahedron behind it.
        let mut found = [OUTSIDE; 2];
        for tet in tets {
            found[usize::from(tet.even == side.even)] = template.tets[tet.element as usize].region;
        }
        if found != [t.front, t.back] && tets.iter().all(|s| upright(s.element)) {
            findings.add(Kind::WrongRegion, || {
                format!(
                    "triangle {} has {} in front and {} behind, the tetrahedra have {} and {} {}",
                    side.element,
                    region(t.front),
                    region(t.back),
                    region(found[0]),
                    region(found[1]),
                    place()
                )
            });
        }
    });
    Ok(skin)
}

fn region(id: u32) -> String {
    match id {
        OUTSIDE => "nothing".to_owned(),
        id => format!("region {id}"),
    }
}

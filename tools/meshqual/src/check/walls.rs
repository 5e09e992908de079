//! Walls: where copies meet, faces and vertices fall together exactly as listed.

use super::COINCIDENCE;
use super::conformity::Skin;
use super::findings::{Findings, Kind, at};
use crate::instances::Links;
use geom::grid::Grid;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use tmesh::{Document, Gluing, Isometry, OUTSIDE, Plane, Template};

/// Checks the walls of a template. `skins` are those of all templates.
///
/// That listed vertices lie on the plane, that pairs are exact images and that neighbours exist is
/// [`tmesh::validate`]'s part. Here: the lists are complete, the faces on them are outer faces, and
/// nothing reaches through a wall.
pub fn check(
    document: &Document,
    index: usize,
    size: f64,
    skins: &[Skin],
    findings: &mut Findings,
) {
    let template = &document.templates[index];
    let skin = &skins[index];
    for gluing in &template.gluings {
        let other = gluing.other as usize;
        for t in gluing.triangles_here() {
            outer(document, index, skin, t, &gluing.name, findings);
        }
        if let Some(plane) = gluing.mirror_plane(index) {
            mirror(document, index, size, skin, (gluing, plane), findings);
            continue;
        }
        for t in gluing.triangles_there() {
            outer(document, other, &skins[other], t, &gluing.name, findings);
        }
        let turned = |pairs: &[[u32; 2]]| {
            let mut turned: Vec<[u32; 2]> = pairs.iter().map(|&[a, b]| [b, a]).collect();
            turned.sort_unstable();
            turned
        };
        let across = Across {
            name: &gluing.name,
            here: other,
            there: index,
            placement: gluing.step,
            vertex_pairs: turned(&gluing.vertex_pairs),
            triangle_pairs: &turned(&gluing.triangle_pairs),
        };
        across.check(document, size, skins, findings);
    }
}

/// Checks that a wall triangle is an outer face, with nothing beyond.
fn outer(
    document: &Document,
    index: usize,
    skin: &Skin,
    triangle: u32,
    wall: &str,
    findings: &mut Findings,
) {
    let t = &document.templates[index].triangles[triangle as usize];
    let one_sided = (t.front == OUTSIDE) != (t.back == OUTSIDE);
    if !(one_sided && skin.find(t.vertices).is_some()) {
        findings.add(Kind::WallInside, || {
            let place = at(document, index, &t.vertices);
            format!("triangle {triangle} of wall '{wall}' {place}")
        });
    }
}

fn mirror(
    document: &Document,
    index: usize,
    size: f64,
    skin: &Skin,
    (wall, plane): (&Gluing, Plane),
    findings: &mut Findings,
) {
    let template = &document.templates[index];
    let listed = flags(template.vertices.len(), wall.vertices_here());
    for (v, p) in template
        .vertices
        .iter()
        .enumerate()
        .filter(|v| !listed[v.0])
    {
        let distance = plane.distance(*p);
        let kind = if distance.abs() <= COINCIDENCE * size {
            Kind::NearWall
        } else if distance > 0.0 {
            Kind::BeyondWall
        } else {
            continue;
        };
        findings.add(kind, || {
            let place = at(document, index, &[v as u32]);
            let name = &wall.name;
            format!("vertex {v} lies {distance:e} from the plane of wall '{name}' {place}")
        });
    }
    let triangles = flags(template.triangles.len(), wall.triangles_here());
    for (face, &triangle) in skin.faces.iter().zip(&skin.triangles) {
        let on_plane = face.iter().all(|&v| listed[v as usize]);
        let known = triangle != u32::MAX && triangles[triangle as usize];
        if on_plane && !known {
            unlisted(document, index, *face, &wall.name, findings);
        }
    }
    for triangle in wall.triangles_here() {
        let t = &template.triangles[triangle as usize];
        if !t.vertices.iter().all(|&v| listed[v as usize]) {
            findings.add(Kind::WallInside, || {
                format!(
                    "triangle {triangle} of wall '{}' has vertices that are not on it {}",
                    wall.name,
                    at(document, index, &t.vertices)
                )
            });
        }
    }
}

fn unlisted(
    document: &Document,
    index: usize,
    face: [u32; 3],
    wall: &str,
    findings: &mut Findings,
) {
    findings.add(Kind::UnlistedWallFace, || {
        format!(
            "face {} {} {} on wall '{wall}' {}",
            face[0],
            face[1],
            face[2],
            at(document, index, &face)
        )
    });
}

/// Two faces that fall together when one is placed.
struct Across<'a> {
    name: &'a str,
    /// The template that is placed, and the one it meets.
    here: usize,
    there: usize,
    placement: Isometry,
    /// (vertex here, vertex there), increasing.
    vertex_pairs: Vec<[u32; 2]>,
    /// (triangle here, triangle there).
    triangle_pairs: &'a [[u32; 2]],
}

impl Across<'_> {
    fn check(&self, document: &Document, size: f64, skins: &[Skin], findings: &mut Findings) {
        let here = &document.templates[self.here];
        let there = &document.templates[self.there];
        let partner = |v: u32| {
            let found = self.vertex_pairs.binary_search_by_key(&v, |p| p[0]);
            found.ok().map(|i| self.vertex_pairs[i][1])
        };
        // Outer faces whose vertices are all paired fall on the face of the partners.
        let paired: FxHashSet<[u32; 2]> = self.triangle_pairs.iter().copied().collect();
        for (face, &t) in skins[self.here]
            .faces
            .iter()
            .zip(&skins[self.here].triangles)
        {
            let [Some(a), Some(b), Some(c)] = face.map(partner) else {
                continue;
            };
            let Some(position) = skins[self.there].find([a, b, c]) else {
                continue;
            };
            let other = skins[self.there].triangles[position];
            if t == u32::MAX || !paired.contains(&[t, other]) {
                unlisted(document, self.here, *face, self.name, findings);
            }
        }
        self.unpaired(document, here, there, size, partner, findings);
    }

    /// Looks for vertices that fall together and are not paired.
    fn unpaired(
        &self,
        document: &Document,
        here: &Template,
        there: &Template,
        size: f64,
        partner: impl Fn(u32) -> Option<u32>,
        findings: &mut Findings,
    ) {
        let reach = COINCIDENCE * size;
        let grid = Grid::of(there.vertices.iter().copied(), reach);
        let placed = self.placement.placed();
        let mut links = None;
        for (v, &p) in here.vertices.iter().enumerate() {
            let image = placed.apply(p);
            let Some((w, distance)) = grid.nearest(image, reach) else {
                continue;
            };
            let paired = partner(v as u32).is_some_and(|q| {
                q == w || there.vertices[q as usize] == there.vertices[w as usize]
            });
            // About the axis, and across both faces of a half turn's seam, vertices are joined by
            // way of others.
            let known = paired || {
                let own = (self.there as u32, Isometry::IDENTITY, w);
                let other = (self.here as u32, self.placement, v as u32);
                links
                    .get_or_insert_with(|| Links::of(document))
                    .join(own, other)
            };
            if !known {
                findings.add(Kind::UnpairedVertex, || {
                    format!(
                        "vertex {v} placed across wall '{}' is {distance:e} from vertex {w} {}",
                        self.name,
                        at(document, self.there, &[w])
                    )
                });
            }
        }
    }
}

/// Checks that the hub walls together cover each triangle they meet, in each of its instances, exactly
/// once.
pub fn hub_coverage(document: &Document, findings: &mut Findings) {
    let copies = crate::instances::Copies::of(document).of_template;
    let mut met: Vec<FxHashMap<u32, u64>> = vec![FxHashMap::default(); copies.len()];
    let mut order: BTreeMap<(usize, u32), ()> = BTreeMap::new();
    for (index, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let Some(other) = gluing.other_than(index) else {
                continue;
            };
            for &[here, there] in &gluing.triangle_pairs {
                *met[other].entry(there).or_insert(0) += copies[index];
                order.insert((other, there), ());
                // Each wall meets one neighbour for each own instance.
                *met[index].entry(here).or_insert(0) += copies[index];
                order.insert((index, here), ());
            }
        }
    }
    for &(template, triangle) in order.keys() {
        let times = met[template][&triangle];
        if times != copies[template] {
            findings.add(Kind::HubCoverage, || {
                let t = &document.templates[template].triangles[triangle as usize];
                format!(
                    "triangle {triangle} meets a hub wall {times} times in {} instances {}",
                    copies[template],
                    at(document, template, &t.vertices)
                )
            });
        }
    }
}

fn flags(count: usize, set: impl Iterator<Item = u32>) -> Vec<bool> {
    let mut flags = vec![false; count];
    set.for_each(|i| flags[i as usize] = true);
    flags
}

//! The tetrahedra and triangles that images of such are.

use super::generators::Generator;
use super::images::NONE;
use super::part::Part;
use crate::check::faces::sorted;
use crate::check::findings::{Findings, Kind, at};
use rustc_hash::FxHashMap;
use tmesh::{Document, Template, Tet};

/// The elements of a plain document by their vertices.
pub struct Elements<'a> {
    document: &'a Document,
    tets: TetIndex,
    triangles: FxHashMap<[u32; 3], u32>,
}

/// How a generator maps vertices.
pub struct Mapped<'a> {
    /// The generator.
    pub generator: &'a Generator,
    /// The part that it has to map.
    pub part: &'a Part,
    /// The image of each vertex, or [`NONE`].
    pub images: &'a [u32],
}

impl Mapped<'_> {
    /// The images of an element's corners; `None` for elements of other parts, and where a vertex has no
    /// image, which is reported already.
    fn corners<const N: usize>(&self, corners: [u32; N]) -> Option<[u32; N]> {
        let images = corners.map(|v| self.images[v as usize]);
        let holds = !images.contains(&NONE) && self.part.has_element(&corners);
        holds.then_some(images)
    }
}

impl<'a> Elements<'a> {
    /// Sorts the elements.
    pub fn new(document: &'a Document) -> Self {
        let template = &document.templates[0];
        let triangles = template.triangles.iter().enumerate();
        Self {
            document,
            tets: TetIndex::new(&template.tets, template.vertices.len()),
            triangles: triangles
                .map(|(i, t)| (sorted(t.vertices).0, i as u32))
                .collect(),
        }
    }

    fn template(&self) -> &'a Template {
        &self.document.templates[0]
    }

    /// Checks that elements are mapped onto such, and regions onto regions.
    pub fn check(&self, mapped: &Mapped<'_>, findings: &mut Findings) {
        let regions = self.check_tets(mapped, findings);
        self.check_triangles(mapped, &regions, findings);
    }

    /// Checks that tetrahedra are mapped onto tetrahedra, and returns the permutation of regions seen.
    fn check_tets(&self, mapped: &Mapped<'_>, findings: &mut Findings) -> FxHashMap<u32, u32> {
        let name = &mapped.generator.name;
        let tets = &self.template().tets;
        let mut forward: FxHashMap<u32, u32> = FxHashMap::default();
        let mut backward: FxHashMap<u32, u32> = FxHashMap::default();
        // Regions run in blocks: most lookups repeat the last one.
        let mut last = None;
        for (i, tet) in tets.iter().enumerate() {
            let Some(image) = mapped.corners(tet.vertices) else {
                continue;
            };
            let place = || at(self.document, 0, &tet.vertices);
            let Some(other) = self.tets.find(image) else {
                findings.add(Kind::TetImage, || {
                    format!("that of tetrahedron {i} under {name} {}", place())
                });
                continue;
            };
            let (from, to) = (tet.region, tets[other as usize].region);
            if last == Some((from, to)) {
                continue;
            }
            let consistent = *forward.entry(from).or_insert(to) == to
                && *backward.entry(to).or_insert(from) == from;
            if consistent {
                last = Some((from, to));
            } else {
                findings.add(Kind::RegionImage, || {
                    format!(
                        "{name} maps tetrahedron {i} of region {from} onto tetrahedron {other} of region {to} {}",
                        place()
                    )
                });
            }
        }
        forward
    }

    /// Checks that triangles are mapped onto triangles with the images of their regions on their sides.
    fn check_triangles(
        &self,
        mapped: &Mapped<'_>,
        regions: &FxHashMap<u32, u32>,
        findings: &mut Findings,
    ) {
        let name = &mapped.generator.name;
        let turns_over = mapped.generator.isometry.reverses_orientation();
        let triangles = &self.template().triangles;
        // OUTSIDE is in no region map and stays itself.
        let region = |region: u32| regions.get(&region).copied().unwrap_or(region);
        for (i, t) in triangles.iter().enumerate() {
            let Some(image) = mapped.corners(t.vertices) else {
                continue;
            };
            let (key, odd) = sorted(image);
            let found = self.triangles.get(&key).map(|&j| &triangles[j as usize]);
            let same = found.is_some_and(|other| {
                let reversed = (sorted(other.vertices).1 != odd) != turns_over;
                let sides = if reversed {
                    [other.back, other.front]
                } else {
                    [other.front, other.back]
                };
                sides == [region(t.front), region(t.back)]
            });
            if !same {
                findings.add(Kind::TriangleImage, || {
                    let place = at(self.document, 0, &t.vertices);
                    format!("that of triangle {i} under {name} {place}")
                });
            }
        }
    }
}

/// Tetrahedra by their vertices.
struct TetIndex {
    start: Vec<u32>,
    /// The three higher vertices, and the tetrahedron; grouped by the lowest vertex.
    entries: Vec<([u32; 3], u32)>,
}

impl TetIndex {
    fn new(tets: &[Tet], vertices: usize) -> Self {
        let mut start = vec![0_u32; vertices + 1];
        for t in tets {
            start[increasing(t.vertices)[0] as usize + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut next = start.clone();
        let mut entries = vec![([0; 3], 0); tets.len()];
        for (i, t) in tets.iter().enumerate() {
            let [a, b, c, d] = increasing(t.vertices);
            entries[next[a as usize] as usize] = ([b, c, d], i as u32);
            next[a as usize] += 1;
        }
        for v in 0..vertices {
            entries[start[v] as usize..start[v + 1] as usize].sort_unstable();
        }
        Self { start, entries }
    }

    fn find(&self, vertices: [u32; 4]) -> Option<u32> {
        let [a, b, c, d] = increasing(vertices);
        let bucket =
            &self.entries[self.start[a as usize] as usize..self.start[a as usize + 1] as usize];
        let found = bucket.binary_search_by_key(&[b, c, d], |e| e.0);
        found.ok().map(|i| bucket[i].1)
    }
}

fn increasing(mut v: [u32; 4]) -> [u32; 4] {
    v.sort_unstable();
    v
}

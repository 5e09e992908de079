//! The surfaces of templates that are glued to each other, as one.

use glam::DVec3;
use mesher::{Faces, Piece};
use remesh::{Link, Surface};
use rustc_hash::FxHashMap;
use std::sync::Arc;
use tmesh::{Document, FixedSet, Gluing, Template, Triangle};

/// The bit of the axis; mirror walls have those below.
pub const AXIS: u32 = u32::BITS - 1;

/// A template of several.
pub struct Part<'a> {
    /// Its index in the document.
    pub index: usize,
    /// The template.
    pub template: &'a Template,
    /// The first of its vertices, of its triangles, and the bit of its first mirror wall.
    first: [u32; 3],
}

/// What the triangles of a label are.
pub struct Kind {
    /// A triangle like them.
    pub like: Triangle,
    /// The part that they are of.
    pub part: u32,
    /// The face of a wall that they are on, see [`mesher::face_key`].
    face: u32,
}

/// A gluing whose faces are both there.
pub struct Glued {
    /// The parts that list it, and beyond it.
    pub parts: [usize; 2],
    /// Which of the first part's it is.
    pub gluing: usize,
    /// Labels of the triangles there and here.
    pub labels: [Vec<u32>; 2],
}

/// The surfaces of several templates.
pub struct Joined<'a> {
    /// The templates.
    pub parts: Vec<Part<'a>>,
    /// All of them.
    pub surface: Surface,
    /// What the labels of the surface mean.
    pub kinds: Vec<Kind>,
    /// Planes and lines that each vertex is on: a bit for each mirror wall, and the axis.
    pub bound: Vec<u32>,
    /// Of each mirror wall, what it leaves in place.
    pub walls: Vec<FixedSet>,
    /// Of each vertex, whether it is on a face that is glued to a template that is not there.
    pub held: Vec<bool>,
    /// The other gluings that are not mirror walls.
    pub glued: Vec<Glued>,
}

/// Groups of templates whose surfaces can be joined: those that are glued to each other, if they have no more walls than
/// can be told apart; others one by one. `sizes_differ`: whether each has sizes of its own from place to place.
pub fn groups(document: &Document, sizes_differ: bool) -> Vec<Vec<usize>> {
    let groups = glued(&document.templates);
    let apart = |group: Vec<usize>| match fits(document, &group) && !sizes_differ {
        true => vec![group],
        false => group.into_iter().map(|index| vec![index]).collect(),
    };
    groups.into_iter().flat_map(apart).collect()
}

/// Templates that are glued to each other, also by way of others, in groups; increasing.
pub fn glued(templates: &[Template]) -> Vec<Vec<usize>> {
    let count = templates.len();
    let mut sets = geom::sets::DisjointSets::new(count);
    for (index, template) in templates.iter().enumerate() {
        for other in template.gluings.iter().filter_map(|g| g.other_than(index)) {
            sets.join(index as u32, other as u32);
        }
    }
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); count];
    for index in 0..count {
        groups[sets.find(index as u32) as usize].push(index);
    }
    groups.retain(|group| !group.is_empty());
    groups.sort_unstable();
    groups
}

/// Whether a group has no more walls than can be told apart.
fn fits(document: &Document, group: &[usize]) -> bool {
    let of = |&index: &usize| {
        let gluings = document.templates[index].gluings.iter();
        gluings.map(move |gluing| gluing.is_mirror(index))
    };
    let mirrors = group.iter().flat_map(of).filter(|mirror| *mirror).count();
    let links = group.iter().flat_map(of).filter(|mirror| !*mirror).count();
    mirrors <= AXIS as usize && links <= remesh::MOST_LINKS
}

impl<'a> Joined<'a> {
    /// Joins a group of templates. `None` where they have more walls than can be told apart.
    pub fn new(document: &'a Document, group: &[usize]) -> Option<Self> {
        let mut joined = Self {
            parts: Vec::new(),
            surface: Surface::default(),
            kinds: Vec::new(),
            bound: Vec::new(),
            walls: Vec::new(),
            held: Vec::new(),
            glued: Vec::new(),
        };
        if !fits(document, group) {
            return None;
        }
        let mut labels: FxHashMap<(usize, [u32; 4]), u32> = FxHashMap::default();
        for &index in group {
            let template = &document.templates[index];
            let (vertices, triangles) = (joined.surface.points.len(), joined.surface.labels.len());
            let part = Part {
                index,
                template,
                first: [vertices, triangles, joined.walls.len()].map(|n| n as u32),
            };
            let faces = Faces::new(Piece::of(document, index));
            for (t, &face) in template.triangles.iter().zip(&faces.of_triangle) {
                let kinds = &mut joined.kinds;
                let key = (index, [t.marker, t.front, t.back, face]);
                let label = *labels.entry(key).or_insert_with(|| {
                    kinds.push(Kind {
                        like: *t,
                        part: joined.parts.len() as u32,
                        face,
                    });
                    kinds.len() as u32 - 1
                });
                joined.surface.labels.push(label);
                let corners = t.vertices.map(|v| v + part.first[0]);
                joined.surface.triangles.push(corners);
            }
            joined.surface.points.extend(&template.vertices);
            joined.bind(&part);
            joined.held.extend(held(document, index, group));
            joined.parts.push(part);
        }
        joined.glue();
        Some(joined)
    }

    /// Notes the mirror walls of a part, and the axis.
    fn bind(&mut self, part: &Part<'_>) {
        let first = part.first[0] as usize;
        let Part {
            index, template, ..
        } = *part;
        self.bound.resize(self.surface.points.len(), 0);
        for gluing in template.gluings.iter().filter(|g| g.is_mirror(index)) {
            let bit = 1 << self.walls.len();
            let here = gluing.vertices_here();
            here.for_each(|v| self.bound[first + v as usize] |= bit);
            self.walls.push(FixedSet::of(gluing.step));
        }
        let axis = template.axis.iter();
        axis.for_each(|&v| self.bound[first + v as usize] |= 1 << AXIS);
    }

    /// Finds the gluings whose faces are both there.
    fn glue(&mut self) {
        for (p, part) in self.parts.iter().enumerate() {
            for (i, gluing) in part.template.gluings.iter().enumerate() {
                let beyond = |other: &Part<'_>| other.index == gluing.other as usize;
                let other = self.parts.iter().position(beyond);
                let Some(o) = other.filter(|_| !gluing.is_mirror(part.index)) else {
                    continue;
                };
                let labels = |part: &Part<'_>, triangles: &mut dyn Iterator<Item = u32>| {
                    let label = |t| self.surface.labels[(part.first[1] + t) as usize];
                    let mut labels: Vec<u32> = triangles.map(label).collect();
                    labels.sort_unstable();
                    labels.dedup();
                    labels
                };
                self.glued.push(Glued {
                    parts: [p, o],
                    gluing: i,
                    labels: [
                        labels(&self.parts[o], &mut gluing.triangles_there()),
                        labels(part, &mut gluing.triangles_here()),
                    ],
                });
            }
        }
    }

    /// The faces that are images of each other, in the order of the gluings.
    pub fn links(&self) -> Vec<Link> {
        let link = |glued: &Glued| {
            let [here, there] = glued.parts.map(|p| self.parts[p].first[0]);
            let gluing = glued.of(self);
            let step = gluing.step;
            let pairs = gluing.vertex_pairs.iter();
            Link {
                pairs: pairs.map(|&[h, t]| [t + there, h + here]).collect(),
                labels: glued.labels.concat(),
                image: Arc::new(move |p| step.apply(p)),
                back: Arc::new(move |p| step.inverse().apply(p)),
            }
        };
        self.glued.iter().map(link).collect()
    }

    /// The nearest point on the plane or line of a bit.
    pub fn onto(&self, bit: u32, p: DVec3) -> DVec3 {
        match bit {
            AXIS => FixedSet::Axis.nearest(p),
            bit => self.walls[bit as usize].nearest(p),
        }
    }

    /// Which vertices and triangles of the surface are those of a part.
    pub fn range(&self, part: &Part<'_>) -> [std::ops::Range<usize>; 2] {
        let [vertices, triangles, _] = part.first.map(|n| n as usize);
        [
            vertices..vertices + part.template.vertices.len(),
            triangles..triangles + part.template.triangles.len(),
        ]
    }

    /// The bit of a part's mirror wall.
    pub fn mirror(&self, part: &Part<'_>, gluing: usize) -> u32 {
        let before = part.template.gluings[..gluing].iter();
        part.first[2] + before.filter(|g| g.is_mirror(part.index)).count() as u32
    }

    /// Whether triangles of a label are on a wall of a part, by the wall's index.
    pub fn is_on(&self, label: u32, part: usize, gluing: usize) -> bool {
        let kind = &self.kinds[label as usize];
        kind.part as usize == part && kind.face == mesher::face_key(gluing, false)
    }
}

impl Glued {
    /// The gluing.
    pub fn of<'a>(&self, joined: &Joined<'a>) -> &'a Gluing {
        &joined.parts[self.parts[0]].template.gluings[self.gluing]
    }
}

/// Vertices of faces that are glued to templates that are not in the group, whoever lists them.
fn held(document: &Document, index: usize, group: &[usize]) -> Vec<bool> {
    on_faces(document, index, |beyond| !group.contains(&beyond))
}

/// Vertices of a template's faces that are glued, whoever lists them, to templates that count.
pub fn on_faces(document: &Document, index: usize, counts: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut on = vec![false; document.templates[index].vertices.len()];
    for (lists, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let beyond = gluing.other as usize;
            if lists == index && counts(beyond) {
                gluing.vertices_here().for_each(|v| on[v as usize] = true);
            }
            if beyond == index && counts(lists) {
                gluing.vertices_there().for_each(|v| on[v as usize] = true);
            }
        }
    }
    on
}

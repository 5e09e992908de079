//! What facets go on with beyond the planes and faces that a surface was cut at.
//!
//! A wedge has a part of a facet where it was cut there, and nothing beside it: how wide the facet is, and how what it stands for bends, tells only all
//! of it, with what is beside that.

use super::beside::Beside;
use crate::input::{Place, Rules, Surface};
use geom::edges::{Edges, apex_of};
use geom::flat::Plane;
use geom::measure::double_area_vector;
use geom::sets::DisjointSets;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// What there is beyond the cuts.
#[derive(Default)]
pub struct Beyond<'a> {
    /// Facets that go on in their plane.
    pub parts: Vec<Part<'a>>,
    /// Smooth edges at which facets end beside what is there.
    pub folds: Vec<Fold>,
    /// Facets with the lengths of their border along which they go on, model units.
    pub inner: Vec<(u32, f64)>,
    /// Facets, as often as a triangle of theirs goes on in its image.
    pub images: Vec<u32>,
    /// Of each facet, the first one of those that are one with it, if any are.
    same: Vec<u32>,
}

/// A facet of which another one is a part.
pub struct Part<'a> {
    /// The facet.
    pub facet: u32,
    /// The other one, or the facet itself.
    pub other: u32,
    /// Where points of the other one are beside the facet.
    pub place: Box<dyn Fn(DVec3) -> DVec3 + 'a>,
}

/// A smooth edge beyond which a facet is the image of another one, or of itself.
pub struct Fold {
    /// Both facets.
    pub facets: [u32; 2],
    /// The ends of the edge, as they are of either, model units.
    pub ends: [[DVec3; 2]; 2],
    /// Angle between both, radians.
    pub turn: f64,
}

/// What is beyond the cuts, as it is found.
struct Finding<'a> {
    surface: &'a Surface,
    rules: &'a Rules<'a>,
    edges: &'a Edges,
    normals: &'a [DVec3],
    facet: &'a [u32],
    /// Labels of faces that are glued to others.
    glued: FxHashSet<u32>,
    beyond: Beyond<'a>,
    /// Facets with the others that are known to be parts of them, by way of which plane or link.
    known: FxHashSet<(u32, u32, Way)>,
}

/// How what is beyond a cut gets there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Way {
    /// By reflection at a plane, or half a turn about a line.
    Bound(u32),
    /// As the image by a link.
    Image(usize),
    /// As what has its image there.
    Back(usize),
}

impl<'a> Beyond<'a> {
    /// Looks at the edges on planes, lines and glued faces of a surface with such normals and facets. Linear in the edges, times the links of those on glued faces.
    pub fn new(
        (surface, rules): (&'a Surface, &'a Rules<'a>),
        (edges, normals): (&'a Edges, &'a [DVec3]),
        facet: &'a [u32],
    ) -> Self {
        let labels = rules.links.iter().flat_map(|link| &link.labels);
        let mut finding = Finding {
            glued: labels.copied().collect(),
            surface,
            rules,
            edges,
            normals,
            facet,
            beyond: Self::default(),
            known: FxHashSet::default(),
        };
        finding.look_at_walls();
        finding.look_at_links();
        finding.beyond
    }

    /// Gives facets that are one what is beside all of them: how the part of it on one side lies says less than how all of it does. Of each facet, the one that
    /// has it.
    pub fn join(&self, beside: &mut [Beside]) -> Vec<u32> {
        let mut first: Vec<u32> = (0..beside.len() as u32).collect();
        for (f, &same) in self.same.iter().enumerate() {
            if f != same as usize {
                first[f] = same;
                let other = std::mem::take(&mut beside[f]);
                beside[same as usize].add(&other);
            }
        }
        first
    }
}

impl<'a> Finding<'a> {
    /// Facets that end at planes and lines go on with their images, unless they are cuts, which stand for no shape.
    fn look_at_walls(&mut self) {
        for (edge, ends) in self.edges.ends.iter().enumerate() {
            let [walls, others] = ends.map(|v| self.rules.bound[v as usize]);
            if walls & others == 0 {
                continue;
            }
            let [a, b] = ends.map(|v| self.surface.points[v as usize]);
            for u in self.edges.around(edge) {
                let (t, corners) = (u.triangle, self.surface.corners(u.triangle));
                let apex = apex_of(&self.surface.triangles[t as usize], u.corner) as usize;
                let bits = walls & others & !self.rules.bound[apex];
                if bits == 0 || self.is_cut(t) {
                    continue;
                }
                let (bit, onto) = (bits.trailing_zeros(), self.rules.onto);
                let place = move |p| onto(bit, p) * 2.0 - p;
                let (p, facet) = (self.surface.points[apex], self.facet[t as usize]);
                let image = place(p);
                // The ends of the edge and what is beside them are off one plane by that, and the image by twice as much.
                if Plane::of(corners).off([image; 3]) <= 4.0 * self.rules.flat {
                    self.beyond.images.push(facet);
                    self.beyond.inner.push((facet, a.distance(b)));
                    self.part([facet, facet], Way::Bound(bit), Box::new(place));
                    continue;
                }
                let [m, n] = [p, image].map(|p| double_area_vector(a, b, p).normalize_or_zero());
                self.fold([facet; 2], [[a, b]; 2], [m, -n]);
            }
        }
    }

    /// Facets that end at a face that is glued to another one go on with what ends there.
    fn look_at_links(&mut self) {
        let count = self.facet.iter().map(|f| *f as usize + 1).max();
        let mut sets = DisjointSets::new(count.unwrap_or(0));
        let mut inner: FxHashSet<(usize, u32)> = FxHashSet::default();
        let mut folded: FxHashSet<[u32; 2]> = FxHashSet::default();
        let rules = self.rules;
        // Of all edges, only those on glued faces are looked at for each of the links.
        let pairs = rules.links.iter().flat_map(|link| &link.pairs);
        let glued: FxHashSet<u32> = pairs.flatten().copied().collect();
        let ends = self.edges.ends.iter().enumerate();
        let on_faces: Vec<(usize, [u32; 2])> = ends
            .filter(|(_, ends)| ends.iter().all(|v| glued.contains(v)))
            .map(|(edge, ends)| (edge, *ends))
            .collect();
        for (number, link) in rules.links.iter().enumerate() {
            let image: FxHashMap<u32, u32> = link.pairs.iter().map(|&[v, w]| (v, w)).collect();
            let turned = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
            let images = on_faces.iter().filter_map(|&(e, ends)| {
                let [Some(a), Some(b)] = ends.map(|v| image.get(&v).copied()) else {
                    return None;
                };
                Some((turned([a, b]), e))
            });
            let from: FxHashMap<[u32; 2], usize> = images.collect();
            let (edges, labels) = (self.edges, &self.surface.labels);
            let free = |e: usize| {
                let around = edges.around(e).iter().map(|u| u.triangle);
                around.filter(move |t| !link.labels.contains(&labels[*t as usize]))
            };
            for &(there, ends) in &on_faces {
                let Some(&here) = from.get(&turned(ends)) else {
                    continue;
                };
                let of_edge =
                    |e: usize| self.edges.ends[e].map(|v| self.surface.points[v as usize]);
                let both_ends = [here, there].map(of_edge);
                for (t, u) in free(here).flat_map(|t| free(there).map(move |u| (t, u))) {
                    let facets = [t, u].map(|t| self.facet[t as usize]);
                    let image = self.surface.corners(t).map(|p| (link.image)(p));
                    if Plane::of(self.surface.corners(u)).off(image) > rules.flat {
                        let [m, n] = [t, u].map(|t| self.normals[t as usize]);
                        let m = (link.image)(m) - (link.image)(DVec3::ZERO);
                        // An edge that is its own image, as on an axis, is inside of the surface; and cuts stand for no shape.
                        let is_one = labels[t as usize] == labels[u as usize];
                        let ends_there = here != there && is_one && !self.is_cut(t);
                        if ends_there && folded.insert([t.min(u), t.max(u)]) {
                            self.fold(facets, both_ends, [m, n]);
                        }
                        continue;
                    }
                    // No border of either any more; one face may be glued to several.
                    for ((e, t), [a, b]) in [(here, t), (there, u)].into_iter().zip(both_ends) {
                        if inner.insert((e, t)) {
                            let facet = self.facet[t as usize];
                            self.beyond.inner.push((facet, a.distance(b)));
                        }
                    }
                    sets.join(facets[0], facets[1]);
                    let [f, g] = facets;
                    let to = |place: &Place| -> Box<dyn Fn(DVec3) -> DVec3> {
                        let place = Arc::clone(place);
                        Box::new(move |p| place(p))
                    };
                    self.part([f, g], Way::Back(number), to(&link.back));
                    self.part([g, f], Way::Image(number), to(&link.image));
                }
            }
        }
        self.beyond.same = (0..count.unwrap_or(0) as u32)
            .map(|f| sets.find(f))
            .collect();
    }

    /// Whether a triangle is in a face that is glued to another one.
    fn is_cut(&self, t: u32) -> bool {
        self.glued.contains(&self.surface.labels[t as usize])
    }

    /// Notes that another facet is a part of one.
    fn part(
        &mut self,
        [facet, other]: [u32; 2],
        way: Way,
        place: Box<dyn Fn(DVec3) -> DVec3 + 'a>,
    ) {
        if self.known.insert((facet, other, way)) {
            self.beyond.parts.push(Part {
                facet,
                other,
                place,
            });
        }
    }

    /// Notes an edge between facets with such normals, if the surface is smooth there.
    fn fold(&mut self, facets: [u32; 2], ends: [[DVec3; 2]; 2], [m, n]: [DVec3; 2]) {
        if m.dot(n) >= self.rules.feature {
            let turn = libm::atan2(m.cross(n).length(), m.dot(n));
            self.beyond.folds.push(Fold { facets, ends, turn });
        }
    }
}

//! Triangles of the surface, while edges between them are replaced and vertices put into them.
//!
//! Inside of a flat facet the shape does not depend on how it is triangulated, and a seam is inside of the assembled
//! mesh. An edge there goes like any other, with the tetrahedra around it, from one of its triangles to the other: both then
//! have the other diagonal of the quadrilateral that they are (J. Shewchuk, "Two discrete optimization algorithms for the
//! topological improvement of tetrahedral meshes", 2002). Where there is material on the other side, the ring is closed there.
//! Where there is none, a vertex may be put into triangles of a facet, which it divides.
//! What stands for a curved shape has other triangles where that allows it, and keeps near to its points ([`Near`]).

use crate::flats::Flats;
use crate::near::Near;
use crate::shape::{NO_PATCH, Point, Shape};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;
use tmesh::{Gluing, OUTSIDE, Template};

/// The triangles of a template's surface, and where their edges may be replaced.
#[derive(Clone, Default)]
pub struct Surface {
    triangles: Vec<[u32; 3]>,
    /// What may become of each triangle.
    patches: Vec<Patch>,
    /// Regions on both sides of each triangle.
    regions: Vec<[u32; 2]>,
    /// The triangle that each one on a seam is glued to, and the partners of its vertices.
    twins: FxHashMap<u32, (u32, [u32; 3])>,
    /// Edges that others have, too, where only they touch a wall: no triangle of it is there.
    touching: FxHashSet<[u32; 2]>,
    /// Number of the triangle between three vertices.
    numbers: FxHashMap<[u32; 3], u32>,
    /// Unit normal of each facet, which are the first patches.
    normals: Vec<DVec3>,
    /// Of each triangle that has come since, one that it is a part of.
    parents: Vec<u32>,
    /// The shape that curved patches are of.
    shape: Option<Arc<dyn Shape>>,
    /// Cosine of the angle from which on an edge of such a patch is a feature.
    feature: f64,
    /// Points of that shape.
    near: Near,
}

/// What may become of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Patch {
    /// Nothing: others have it as it is.
    Kept,
    /// It may be divided at a vertex on one of its edges, which leaves the shape as it is.
    Single,
    /// It stands for a patch of a curved shape, and edges and vertices there are what that allows.
    Curved(u32),
    /// Edges between triangles with the same number may be replaced, and vertices put into them.
    Of(u32),
}

impl Patch {
    /// The number that it has in common with others.
    fn number(self) -> Option<u32> {
        match self {
            Self::Of(number) => Some(number),
            Self::Kept | Self::Single | Self::Curved(_) => None,
        }
    }
}

/// A flat patch with nothing beyond, by one of its triangles; of what is curved, a triangle alone.
#[derive(Clone, Copy, Debug)]
pub struct Sheet {
    /// Corners of the triangle.
    pub corners: [u32; 3],
    /// Unit normal of the patch; that of the triangle where it is alone.
    pub normal: Option<DVec3>,
    patch: Option<u32>,
}

/// An edge between two triangles, and what is there when it is replaced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonal {
    /// The edge that goes.
    pub old: [u32; 2],
    /// The one that is there instead.
    pub new: [u32; 2],
}

/// What is on the other side of two triangles.
#[derive(Debug, PartialEq)]
pub enum Beyond {
    /// No tetrahedra of the template.
    Nothing,
    /// Tetrahedra of another region.
    Region(u32),
    /// Those of a region at two other triangles, which are glued to them.
    Twins(Diagonal, u32),
}

impl Surface {
    /// The surface of a template, number `own`, with its facets. Linear.
    pub fn new((template, own): (&Template, usize), flats: &Flats<'_>) -> Self {
        let triangles = &template.triangles;
        let is_flat = |f: usize| flats.slopes[f] == 0.0 && flats.normals[f] != DVec3::ZERO;
        let curved = |f: usize| {
            let curved = flats.curved.as_ref().map(|curved| curved.patches[f]);
            curved.filter(|&patch| patch != NO_PATCH)
        };
        let facets = flats.of_triangle.iter();
        let mut patches: Vec<Patch> = facets
            .map(|&f| match (is_flat(f as usize), curved(f as usize)) {
                (true, Some(patch)) => Patch::Curved(patch),
                (true, None) => Patch::Of(f),
                (false, _) => Patch::Single,
            })
            .collect();
        patches.resize(triangles.len(), Patch::Kept);
        let mut surface = Self {
            triangles: triangles.iter().map(|t| t.vertices).collect(),
            patches,
            regions: triangles.iter().map(|t| [t.front, t.back]).collect(),
            normals: flats.normals.to_vec(),
            shape: flats.curved.as_ref().map(|curved| curved.shape.clone()),
            feature: flats.curved.as_ref().map_or(1.0, |curved| curved.feature),
            near: (flats.curved.as_ref()).map_or_else(Near::default, |curved| {
                Near::new(template, flats.of_triangle, curved)
            }),
            ..Self::default()
        };
        let first = flats.normals.len() as u32;
        let mut kinds: FxHashMap<_, u32> = FxHashMap::default();
        for (g, gluing) in template.gluings.iter().enumerate() {
            surface.touch(gluing, own);
            if gluing.other_than(own).is_some() {
                surface.keep(gluing.triangle_pairs.iter().map(|p| p[0]));
                continue;
            }
            surface.glue(gluing, |t, side| {
                let of = &triangles[t as usize];
                let kind = (g, side, of.marker, of.front, of.back);
                let next = first + kinds.len() as u32;
                *kinds.entry(kind).or_insert(next)
            });
        }
        surface.keep(flats.kept.iter().copied());
        let free = surface.triangles.iter().zip(&surface.patches).enumerate();
        surface.numbers = free
            .filter(|(_, (_, patch))| **patch != Patch::Kept)
            .map(|(i, (t, _))| (sorted(*t), i as u32))
            .collect();
        surface
    }

    /// Triangles stay as they are.
    fn keep(&mut self, triangles: impl Iterator<Item = u32>) {
        for t in triangles {
            self.patches[t as usize] = Patch::Kept;
        }
    }

    /// Notes the edges between vertices of a wall that are at none of its triangles.
    fn touch(&mut self, gluing: &Gluing, own: usize) {
        let mut sides = vec![gluing.vertices_here().collect::<FxHashSet<u32>>()];
        let mut triangles: FxHashSet<u32> = gluing.triangle_pairs.iter().map(|p| p[0]).collect();
        if gluing.other_than(own).is_none() {
            sides.push(gluing.vertices_there().collect());
            triangles.extend(gluing.triangle_pairs.iter().map(|p| p[1]));
        }
        let of = |t: u32| edges(self.triangles[t as usize]);
        let of_wall: FxHashSet<[u32; 2]> = triangles.iter().flat_map(|&t| of(t)).collect();
        let all = self.triangles.iter().flat_map(|&t| edges(t));
        let is_on = |edge: &[u32; 2]| {
            let on = |side: &FxHashSet<u32>| edge.iter().all(|v| side.contains(v));
            sides.iter().any(on)
        };
        let touching = all.filter(|edge| is_on(edge) && !of_wall.contains(edge));
        self.touching.extend(touching.collect::<Vec<_>>());
    }

    /// Whether an edge touches a wall, so that what is beyond has it, too.
    pub fn is_touching(&self, [a, b]: [u32; 2]) -> bool {
        self.touching.contains(&[a.min(b), a.max(b)])
    }

    /// Notes which triangles of a seam are the same in the assembled mesh; `patch` numbers those on each side that may have
    /// edges between them replaced. Faces that are their own images have nothing beyond.
    fn glue(&mut self, gluing: &Gluing, mut patch: impl FnMut(u32, usize) -> u32) {
        let pairs = gluing.vertex_pairs.iter();
        let partners: FxHashMap<u32, u32> = pairs.map(|&[here, there]| (here, there)).collect();
        for &[here, there] in &gluing.triangle_pairs {
            let own = self.triangles[here as usize];
            let other = self.triangles[there as usize];
            let images = own.map(|v| partners.get(&v).copied().unwrap_or(v));
            if images == own {
                continue;
            }
            // A half turn may exchange corners of one triangle.
            if here == there || sorted(images) != sorted(other) {
                self.keep([here, there].into_iter());
                continue;
            }
            let back = other.map(|v| {
                if v == images[0] {
                    own[0]
                } else if v == images[1] {
                    own[1]
                } else {
                    own[2]
                }
            });
            self.twins.insert(here, (there, images));
            self.twins.insert(there, (here, back));
            for (side, t) in [here, there].into_iter().enumerate() {
                self.patches[t as usize] = Patch::Of(patch(t, side));
            }
        }
    }

    /// The triangles, in the order that they had.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// What is beyond the triangles at an edge to both other vertices, seen from a region, if they may be others.
    pub fn beyond(&self, diagonal: Diagonal, region: u32) -> Option<Beyond> {
        let [one, other] = self.at(diagonal)?;
        let regions = self.regions[one as usize];
        if regions != self.regions[other as usize] || regions[0] == regions[1] {
            return None;
        }
        match [one, other].map(|t| self.twins.get(&t)) {
            [None, None] => {
                let beyond = regions.into_iter().find(|&r| r != region)?;
                Some(match beyond {
                    OUTSIDE => Beyond::Nothing,
                    beyond => Beyond::Region(beyond),
                })
            }
            [Some(_), Some(_)] => {
                let twin = self.twin(diagonal, [one, other])?;
                let twins = self.at(twin)?;
                let apart = twins.iter().all(|t| ![one, other].contains(t));
                let beyond = self.regions[twins[0] as usize];
                let beyond = beyond.into_iter().find(|&r| r != OUTSIDE)?;
                apart.then_some(Beyond::Twins(twin, beyond))
            }
            _ => None,
        }
    }

    /// The triangle of the surface that a face is, as it runs.
    pub fn triangle(&self, face: [u32; 3]) -> Option<[u32; 3]> {
        let t = *self.numbers.get(&sorted(face))?;
        Some(self.triangles[t as usize])
    }

    /// The patch that a face is in, if a vertex may be put there.
    pub fn sheet(&self, face: [u32; 3]) -> Option<Sheet> {
        let t = *self.numbers.get(&sorted(face))?;
        let alone = || {
            self.curved(face)?;
            Some(Sheet {
                corners: face,
                normal: None,
                patch: None,
            })
        };
        let sheet = self.flat(face).or_else(alone);
        sheet.filter(|_| self.regions[t as usize].contains(&OUTSIDE))
    }

    /// Whether a face is a triangle of a patch.
    pub fn is_in(&self, sheet: &Sheet, face: [u32; 3]) -> bool {
        let Some(patch) = sheet.patch else {
            return sorted(face) == sorted(sheet.corners);
        };
        let number = self.numbers.get(&sorted(face));
        number.is_some_and(|&t| self.patches[t as usize] == Patch::Of(patch))
    }

    /// Whether a vertex on an edge of a triangle may divide it: with or without something beyond, but not on a seam, nor inside of
    /// a region.
    pub fn is_divisible(&self, face: [u32; 3]) -> bool {
        self.divisible(face).is_some()
    }

    fn divisible(&self, face: [u32; 3]) -> Option<u32> {
        let t = *self.numbers.get(&sorted(face))?;
        let [front, back] = self.regions[t as usize];
        (front != back && !self.twins.contains_key(&t)).then_some(t)
    }

    /// The patch of a curved shape that a face stands for, if it may be divided.
    pub fn curved(&self, face: [u32; 3]) -> Option<u32> {
        match self.patches[self.divisible(face)? as usize] {
            Patch::Curved(patch) => Some(patch),
            _ => None,
        }
    }

    /// The points of the shape that some faces are near to.
    pub fn points(&self, faces: &[[u32; 3]]) -> Vec<Point> {
        self.near.of(&self.numbers_of(faces))
    }

    /// Gives the points of some triangles to the nearest of them and others, by where these are now.
    pub fn share(&mut self, old: &[u32], new: &[u32], at: impl Fn(u32) -> DVec3) {
        let points = self.near.take(old);
        if !points.is_empty() {
            let corners = |t: u32| self.triangles[t as usize].map(&at);
            let triangles: Vec<_> = new.iter().map(|&t| (t, corners(t))).collect();
            self.near.give(points, &triangles);
        }
    }

    /// The numbers of triangles.
    pub fn numbers_of(&self, faces: &[[u32; 3]]) -> Vec<u32> {
        let numbers = faces.iter().map(|face| self.numbers.get(&sorted(*face)));
        numbers.flatten().copied().collect()
    }

    /// The shape that patches are of.
    pub fn shape(&self) -> Option<&dyn Shape> {
        self.shape.as_deref()
    }

    /// Cosine of the angle between triangles from which on an edge of a curved patch is a feature.
    pub fn feature(&self) -> f64 {
        self.feature
    }

    /// The flat patch that a face is in, if it may be divided.
    pub fn flat(&self, face: [u32; 3]) -> Option<Sheet> {
        let patch = self.patches[self.divisible(face)? as usize].number()?;
        Some(Sheet {
            corners: face,
            normal: Some(self.normals[patch as usize]),
            patch: Some(patch),
        })
    }

    /// Triangles as they run, those of each patch, none twice; alone where they are in none.
    pub fn by_patch<'f>(&self, faces: impl Iterator<Item = &'f [u32; 3]>) -> Vec<Vec<[u32; 3]>> {
        let number = |face: &[u32; 3]| self.numbers.get(&sorted(*face)).copied();
        let mut numbers: Vec<u32> = faces.filter_map(number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.sort_by_key(|&t| self.patches[t as usize]);
        let by_patch = numbers.chunk_by(|&s, &t| {
            let [p, q] = [s, t].map(|t| self.patches[t as usize]);
            p == q && p.number().is_some()
        });
        let triangles = by_patch.map(|some| some.iter().map(|&t| self.triangles[t as usize]));
        triangles.map(Iterator::collect).collect()
    }

    /// Puts triangles from a new vertex to the outline of some in their place, which are in one patch: there are two more than before,
    /// or one if it is on an edge of the outline, between the ends of that.
    pub fn divide(
        &mut self,
        faces: &[[u32; 3]],
        vertex: u32,
        edge: Option<[u32; 2]>,
        at: impl Fn(u32) -> DVec3,
    ) {
        let numbers = faces
            .iter()
            .filter_map(|f| self.numbers.remove(&sorted(*f)));
        let gone: Vec<u32> = numbers.collect();
        let Some(&parent) = gone.first() else { return };
        let triangles = gone.iter().map(|&t| self.triangles[t as usize]);
        let mut outline = outline(&triangles.collect::<Vec<_>>());
        outline.retain(|&[a, b]| edge.is_none_or(|e| e != [a, b] && e != [b, a]));
        let mut made = Vec::new();
        for (i, [a, b]) in outline.into_iter().enumerate() {
            let number = gone.get(i).copied().unwrap_or_else(|| {
                self.triangles.push([0; 3]);
                self.patches.push(self.patches[parent as usize]);
                self.regions.push(self.regions[parent as usize]);
                self.parents.push(parent);
                self.triangles.len() as u32 - 1
            });
            self.triangles[number as usize] = [a, b, vertex];
            self.numbers.insert(sorted([a, b, vertex]), number);
            made.push(number);
        }
        self.share(&gone, &made, at);
    }

    /// Of each triangle that has come since, the one of those before that it is a part of.
    pub fn parents(&self) -> Vec<u32> {
        let first = self.triangles.len() - self.parents.len();
        let mut parents: Vec<u32> = Vec::with_capacity(self.parents.len());
        for &parent in &self.parents {
            let known = (parent as usize).checked_sub(first).map(|i| parents[i]);
            parents.push(known.unwrap_or(parent));
        }
        parents
    }

    /// The triangles at an edge to both other vertices, if they may be others.
    fn at(&self, Diagonal { old: [a, b], new }: Diagonal) -> Option<[u32; 2]> {
        let number = |c: u32| self.numbers.get(&sorted([a, b, c])).copied();
        let both = [number(new[0])?, number(new[1])?];
        let [s, t] = both.map(|t| self.triangles[t as usize]);
        let [p, q] = both.map(|t| self.patches[t as usize]);
        let is_one = p == q && p != Patch::Single;
        (is_one && runs(s, a, b) != runs(t, a, b)).then_some(both)
    }

    /// The image of an edge between two triangles of a seam.
    fn twin(&self, Diagonal { old, new }: Diagonal, both: [u32; 2]) -> Option<Diagonal> {
        let image = |t: u32, v: u32| {
            let place = self.triangles[t as usize].iter().position(|&u| u == v)?;
            Some(self.twins.get(&t)?.1[place])
        };
        let [one, other] = both;
        let ends = |t: u32| Some([image(t, old[0])?, image(t, old[1])?]);
        let twin = Diagonal {
            old: ends(one)?,
            new: [image(one, new[0])?, image(other, new[1])?],
        };
        (ends(other)? == twin.old).then_some(twin)
    }

    /// Replaces an edge, and its image on a seam.
    pub fn replace(&mut self, diagonal: Diagonal) {
        let Some(both) = self.at(diagonal) else {
            return;
        };
        let twin = self.twin(diagonal, both);
        self.put(both, diagonal, twin);
        if let Some(twin) = twin
            && let Some(both) = self.at(twin)
        {
            self.put(both, twin, Some(diagonal));
        }
    }

    /// Gives both triangles at an edge the other diagonal, and their images that of the image.
    fn put(&mut self, both: [u32; 2], diagonal: Diagonal, twin: Option<Diagonal>) {
        for (i, t) in both.into_iter().enumerate() {
            // An end of the edge goes to the corner of the other triangle.
            let change =
                |d: Diagonal| move |v: u32| if v == d.old[1 - i] { d.new[1 - i] } else { v };
            let triangle = &mut self.triangles[t as usize];
            self.numbers.remove(&sorted(*triangle));
            *triangle = triangle.map(change(diagonal));
            self.numbers.insert(sorted(*triangle), t);
            if let (Some(twin), Some((_, images))) = (twin, self.twins.get_mut(&t)) {
                *images = images.map(change(twin));
            }
        }
    }
}

/// Edges of triangles that only one of them has, as it runs.
pub fn outline(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let edges = || {
        triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
    };
    edges()
        .filter(|&[a, b]| edges().all(|e| e != [b, a]))
        .collect()
}

/// The edges of a triangle, each from its lower to its higher end.
fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)])
}

/// Whether the way around a triangle goes from `a` to `b`.
fn runs([x, y, z]: [u32; 3], a: u32, b: u32) -> bool {
    [(x, y), (y, z), (z, x)].contains(&(a, b))
}

/// Vertices of a triangle in increasing order.
pub fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Isometry, Triangle};

    const DIAGONAL: Diagonal = Diagonal {
        old: [0, 2],
        new: [1, 3],
    };

    fn triangle(vertices: [u32; 3], front: u32, back: u32) -> Triangle {
        Triangle {
            vertices,
            marker: 0,
            front,
            back,
        }
    }

    /// The surface of a template whose triangles are in the given facets of ten, of which the last one has no normal, and the one
    /// before it leans.
    fn surface(template: &Template, of_triangle: &[u32], kept: &[u32]) -> Surface {
        let mut slopes = [0.0; 10];
        let mut normals = [DVec3::Z; 10];
        slopes[8] = 0.1;
        normals[9] = DVec3::ZERO;
        let flats = Flats {
            of_triangle,
            normals: &normals,
            slopes: &slopes,
            fixed: &[],
            kept,
            straight: 1e-12,
            curved: None,
        };
        Surface::new((template, 0), &flats)
    }

    fn square(front: u32, back: u32) -> Template {
        Template {
            triangles: vec![
                triangle([0, 1, 2], front, back),
                triangle([2, 3, 0], front, back),
            ],
            ..Template::default()
        }
    }

    #[test]
    fn diagonals_are_exchanged() {
        let mut flat = surface(&square(OUTSIDE, 5), &[7, 7], &[]);
        assert_eq!(flat.beyond(DIAGONAL, 5), Some(Beyond::Nothing));
        flat.replace(DIAGONAL);
        assert_eq!(flat.beyond(DIAGONAL, 5), None);
        // Both still run the same way around.
        assert_eq!(flat.triangles(), [[0, 1, 3], [2, 3, 1]]);
        let back = Diagonal {
            old: [3, 1],
            new: [0, 2],
        };
        assert_eq!(flat.beyond(back, 5), Some(Beyond::Nothing));
        flat.replace(back);
        let all: Vec<[u32; 3]> = flat.triangles().iter().map(|&t| sorted(t)).collect();
        assert!(all.contains(&[0, 1, 2]) && all.contains(&[0, 2, 3]));
        assert_eq!(flat.beyond(DIAGONAL, 5), Some(Beyond::Nothing));
    }

    #[test]
    fn shapes_borders_and_sheets_stay() {
        let all = square(OUTSIDE, 5);
        for (facets, kept) in [
            ([7, 6], &[][..]),
            ([8, 8], &[]),
            ([9, 9], &[]),
            ([7, 7], &[1]),
        ] {
            assert_eq!(surface(&all, &facets, kept).beyond(DIAGONAL, 5), None);
        }
        // Not a sheet inside of a region, not triangles that lie on each other, and not what is no triangle.
        let sheet = square(5, 5);
        assert_eq!(surface(&sheet, &[7, 7], &[]).beyond(DIAGONAL, 5), None);
        let mut folded = square(OUTSIDE, 5);
        folded.triangles[1].vertices = [0, 3, 2];
        assert_eq!(surface(&folded, &[7, 7], &[]).beyond(DIAGONAL, 5), None);
        let other = Diagonal {
            old: [0, 2],
            new: [1, 4],
        };
        assert_eq!(surface(&all, &[7, 7], &[]).beyond(other, 5), None);
        // Where two regions meet, both are asked.
        let between = surface(&square(4, 5), &[7, 7], &[]);
        assert_eq!(between.beyond(DIAGONAL, 5), Some(Beyond::Region(4)));
        assert_eq!(between.beyond(DIAGONAL, 4), Some(Beyond::Region(5)));
    }

    #[test]
    fn triangles_are_divided_from_a_vertex() {
        let mut flat = surface(&square(OUTSIDE, 5), &[7, 7], &[]);
        let sheet = flat.sheet([2, 1, 0]).unwrap();
        assert_eq!(sheet.normal, Some(DVec3::Z));
        assert!(flat.is_in(&sheet, [3, 0, 2]) && !flat.is_in(&sheet, [3, 0, 1]));
        flat.divide(&[[2, 1, 0], [0, 3, 2]], 4, None, |_| DVec3::ZERO);
        // Two more, which all run as before.
        let all: Vec<[u32; 3]> = flat.triangles().to_vec();
        assert_eq!(all.len(), 4);
        for edge in [[0, 1], [1, 2], [2, 3], [3, 0]] {
            assert!(all.contains(&[edge[0], edge[1], 4]), "{all:?}");
        }
        assert_eq!(flat.parents(), [0, 0]);
        // What is new is in the same patch, and parts of it are parts of the same.
        flat.divide(&[all[3]], 5, None, |_| DVec3::ZERO);
        assert_eq!(flat.parents(), [0; 4]);
        let [a, b, _] = all[3];
        assert!(flat.is_in(&sheet, [a, b, 5]) && !flat.is_in(&sheet, all[3]));
        // On an edge of the outline, it leaves that to both of its ends.
        let mut sides = surface(&square(OUTSIDE, 5), &[7, 7], &[]);
        sides.divide(&[[0, 1, 2]], 4, Some([1, 0]), |_| DVec3::ZERO);
        assert_eq!(sides.triangles(), [[1, 2, 4], [2, 3, 0], [2, 0, 4]]);
        assert_eq!(
            sides
                .by_patch([[4, 2, 1], [0, 2, 4], [2, 1, 4]].iter())
                .len(),
            1
        );
        let leaning = surface(&square(OUTSIDE, 5), &[8, 8], &[]);
        assert_eq!(leaning.by_patch([[0, 1, 2], [2, 3, 0]].iter()).len(), 2);
        let divisible = |surface: Surface| surface.is_divisible([2, 1, 0]);
        assert!(divisible(leaning) && divisible(surface(&square(4, 5), &[7, 7], &[])));
        assert!(!divisible(surface(&square(5, 5), &[7, 7], &[])));
        assert!(!divisible(surface(&square(4, 5), &[7, 7], &[0])));
        assert!(!divisible(surface(&seam(0), &[7; 4], &[])));
        // An edge that touches a wall is also that of what is beyond.
        let mut touching = square(OUTSIDE, 5);
        let mirror = Isometry::reflection(0, 1);
        touching.gluings = vec![Gluing::mirror("wall-a", 0, mirror, [0, 2], [])];
        let touching = surface(&touching, &[7, 7], &[]);
        assert!(touching.is_touching([2, 0]) && !touching.is_touching([1, 2]));
        let mut wall = square(OUTSIDE, 5);
        wall.gluings = vec![Gluing::mirror("wall-a", 0, mirror, 0..4, 0..2)];
        assert!(!surface(&wall, &[7, 7], &[]).is_touching([2, 0]));
        // Not inside of triangles of interfaces, not on seams, not in what leans.
        assert!(
            surface(&square(4, 5), &[7, 7], &[])
                .sheet([0, 1, 2])
                .is_none()
        );
        assert!(
            surface(&square(OUTSIDE, 5), &[8, 8], &[])
                .sheet([0, 1, 2])
                .is_none()
        );
        assert!(surface(&seam(0), &[7; 4], &[]).sheet([0, 1, 2]).is_none());
    }

    #[test]
    fn outlines_are_what_one_triangle_has() {
        assert_eq!(outline(&[[0, 1, 2]]), [[0, 1], [1, 2], [2, 0]]);
        assert_eq!(
            outline(&[[0, 1, 2], [2, 3, 0]]),
            [[0, 1], [1, 2], [2, 3], [3, 0]]
        );
    }

    /// Two squares, the second with the image of each vertex ten further on.
    fn seam(other: u32) -> Template {
        let mut template = square(OUTSIDE, 5);
        template.triangles.extend([
            triangle([12, 11, 10], OUTSIDE, 5),
            triangle([10, 13, 12], OUTSIDE, 5),
        ]);
        template.gluings = vec![Gluing {
            name: "seam".to_owned(),
            other,
            step: Isometry::rotation(1, 7),
            vertex_pairs: (0..4).map(|v| [v, 10 + v]).collect(),
            triangle_pairs: vec![[0, 2], [1, 3]],
        }];
        template
    }

    #[test]
    fn both_sides_of_a_seam_change_together() {
        // It may be in no facet at all, and in several.
        let template = seam(0);
        let mut both = surface(&template, &[9, 7, 6, 5], &[]);
        let image = Diagonal {
            old: [10, 12],
            new: [11, 13],
        };
        assert_eq!(both.beyond(DIAGONAL, 5), Some(Beyond::Twins(image, 5)));
        assert_eq!(both.beyond(image, 5), Some(Beyond::Twins(DIAGONAL, 5)));
        both.replace(image);
        let expected = [[0, 1, 3], [2, 3, 1], [13, 11, 10], [11, 13, 12]];
        assert_eq!(both.triangles(), expected);
        let back = |first: u32| Diagonal {
            old: [first + 1, first + 3],
            new: [first, first + 2],
        };
        assert_eq!(both.beyond(back(0), 5), Some(Beyond::Twins(back(10), 5)));
        // Not if a half turn exchanges corners of the triangles themselves.
        let mut turned = square(OUTSIDE, 5);
        turned.gluings = seam(0).gluings;
        turned.gluings[0].vertex_pairs = vec![[0, 2], [1, 1], [2, 0], [3, 3]];
        turned.gluings[0].triangle_pairs = vec![[0, 0], [1, 1]];
        let turned = surface(&turned, &[7, 7], &[]);
        assert_eq!(turned.beyond(DIAGONAL, 5), None);
        assert!(turned.sheet([0, 1, 2]).is_none());
        // Not if one side has to stay, and not where another template is beyond.
        assert_eq!(surface(&template, &[7; 4], &[3]).beyond(DIAGONAL, 5), None);
        assert_eq!(surface(&seam(1), &[7; 4], &[]).beyond(DIAGONAL, 5), None);
    }
}

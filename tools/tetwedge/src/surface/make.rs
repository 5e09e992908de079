//! The new surface of a template with a seam, or with a face that another template has refined.

use super::features::{Features, NONE};
use super::guide::refine;
use super::outline::{merged, same};
use super::planar::Patch;
use super::{Refined, SurfaceError, check};
use crate::Params;
use crate::walls::{NO_FACE, Projection, face_key};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use tmesh::{Document, Gluing, Template, Triangle};

/// Twice the area of a triangle up to which its corners count as on one line, over the square of its longer sides.
const FLAT: f64 = 1e-10;

/// A new surface.
pub struct Made {
    /// The template; second members of its hub walls' pairs are as they were.
    pub template: Template,
    /// New vertex of each vertex, `u32::MAX` for those that are gone.
    pub vertices: Vec<u32>,
    /// Triangles on faces that other templates list as a hub wall, increasing.
    pub shared: Vec<u32>,
}

/// Makes the surface of template `index`: its seam's faces become images of each other, its own hub
/// walls stay as they are, everything else is as fine as a free pass of the mesher has it.
///
/// # Errors
/// See [`SurfaceError`].
pub fn make(
    document: &Document,
    index: usize,
    params: &Params,
    log: &(dyn Fn(&str) + Sync),
) -> Result<Made, SurfaceError> {
    let input = &document.templates[index];
    let mut gluings = input.gluings.iter().enumerate();
    let seam = gluings.find(|(_, gluing)| gluing.is_seam(index));
    // The guide's own elements are thrown away; only the surface counts.
    let params = Params {
        optimize: None,
        ..params.clone()
    };
    let guide = refine(document, index, &params, log)?;
    let features = Features::new(input, index, &guide)?;
    let mut frozen = vec![false; guide.facets.facets.len()];
    for gluing in &input.gluings {
        if gluing.other_than(index).is_some() {
            for t in gluing.triangles_here() {
                frozen[guide.facets.of_triangle[t as usize] as usize] = true;
            }
        }
    }
    let mut maker = Maker {
        input,
        index,
        seam: seam.map(|s| s.1),
        guide: &guide,
        features: &features,
        frozen,
        made: Template::default(),
        face_of: Vec::new(),
        of_input: vec![NONE; input.vertices.len()],
        of_guide: vec![NONE; guide.vertices.len()],
        of_triangle: vec![NONE; input.triangles.len()],
        pairs: Vec::new(),
        chains: vec![Chain::default(); features.ends.len()],
    };
    maker.corners();
    maker.divide_edges()?;
    let triangle_pairs = maker.fill_facets()?;
    if let Some((i, _)) = seam {
        for pair in &triangle_pairs {
            maker.face_of[pair[1] as usize] = face_key(i, true);
        }
    }
    let gluings = maker.gluings(triangle_pairs);
    let Maker {
        mut made,
        face_of,
        of_input,
        ..
    } = maker;
    made.axis.sort_unstable();
    made.axis.dedup();
    made.gluings = gluings;
    let facets = &guide.facets.facets;
    let slack = facets.iter().map(|f| 2.0 * f.area * f.deviation).sum();
    check::same_body(input, &made, slack).map_err(|what| SurfaceError::Changed {
        template: index,
        what,
    })?;
    let others = face_key(input.gluings.len(), false);
    let shared = (0..face_of.len() as u32).filter(|&t| face_of[t as usize] >= others);
    Ok(Made {
        shared: shared.collect(),
        template: made,
        vertices: of_input,
    })
}

/// New points of a feature edge.
#[derive(Clone, Default)]
struct Chain {
    /// Vertices of the new template, from the edge's lower to its higher input vertex, without
    /// these.
    vertices: Vec<u32>,
    /// Whether they are not the guide's.
    changed: bool,
}

struct Maker<'a> {
    input: &'a Template,
    index: usize,
    seam: Option<&'a Gluing>,
    guide: &'a Refined,
    features: &'a Features,
    /// Facets that stay as they are.
    frozen: Vec<bool>,
    made: Template,
    /// Wall face of each new triangle; see [`crate::walls`].
    face_of: Vec<u32>,
    /// New vertex of each input vertex.
    of_input: Vec<u32>,
    /// New vertex of each guide vertex.
    of_guide: Vec<u32>,
    /// New index of each triangle of the facets that stay.
    of_triangle: Vec<u32>,
    /// Vertex pairs of the seam.
    pairs: Vec<[u32; 2]>,
    chains: Vec<Chain>,
}

impl Maker<'_> {
    fn unmatched(&self, v: u32) -> SurfaceError {
        SurfaceError::Unmatched {
            template: self.index,
            place: self.input.vertices[v as usize],
        }
    }

    fn add(&mut self, p: DVec3) -> u32 {
        self.made.vertices.push(p);
        self.made.vertices.len() as u32 - 1
    }

    /// The seam's pairs: low, high.
    fn seam_pairs(&self) -> impl Iterator<Item = [u32; 2]> + use<'_> {
        let pairs = self.seam.into_iter().flat_map(|s| &s.vertex_pairs);
        pairs.map(|&[high, low]| [low, high])
    }

    /// Takes over the input vertices where feature edges end, those on the axis and on facets that
    /// stay.
    fn corners(&mut self) {
        let mut stays = vec![false; self.input.vertices.len()];
        self.input
            .axis
            .iter()
            .for_each(|&v| stays[v as usize] = true);
        self.features
            .ends
            .iter()
            .flatten()
            .for_each(|&v| stays[v as usize] = true);
        for (t, &facet) in self.guide.facets.of_triangle.iter().enumerate() {
            if self.frozen[facet as usize] {
                let corners = self.input.triangles[t].vertices;
                corners.iter().for_each(|&v| stays[v as usize] = true);
            }
        }
        for (point, &v) in self.guide.vertex_of_point.iter().enumerate() {
            if stays[v as usize] {
                let new = self.add(self.input.vertices[v as usize]);
                self.of_input[v as usize] = new;
                self.of_guide[point] = new;
            }
        }
        let new = |v: &u32| self.of_input[*v as usize];
        self.made.axis = self
            .input
            .axis
            .iter()
            .map(new)
            .filter(|&v| v != NONE)
            .collect();
        let pairs = self.seam_pairs().map(|p| [new(&p[0]), new(&p[1])]);
        self.pairs = pairs.filter(|p| !p.contains(&NONE)).collect();
    }

    /// Of each feature edge, whether a facet that stays has it.
    fn undivided(&self) -> Vec<bool> {
        let mut whole = vec![false; self.features.ends.len()];
        for (t, &facet) in self.guide.facets.of_triangle.iter().enumerate() {
            if self.frozen[facet as usize] {
                let [a, b, c] = self.input.triangles[t].vertices;
                for (p, q) in [(a, b), (b, c), (c, a)] {
                    if let Some((edge, _)) = self.features.find(p, q) {
                        whole[edge] = true;
                    }
                }
            }
        }
        whole
    }

    /// Divides all feature edges, those of the seam and their images alike.
    fn divide_edges(&mut self) -> Result<(), SurfaceError> {
        let partner: FxHashMap<u32, u32> = self.seam_pairs().map(|p| (p[0], p[1])).collect();
        let whole = self.undivided();
        let mut on_axis = vec![false; self.input.vertices.len()];
        self.input
            .axis
            .iter()
            .for_each(|&v| on_axis[v as usize] = true);
        let count = self.features.ends.len();
        let parameters =
            |e: usize| -> Vec<f64> { self.features.points[e].iter().map(|p| p.t).collect() };
        // Image of each edge of the low face, and whether it runs the other way.
        let mut image: Vec<Option<(usize, bool)>> = vec![None; count];
        let mut is_image = vec![false; count];
        for (edge, [a, b]) in self.features.ends.iter().enumerate() {
            if let (Some(&p), Some(&q)) = (partner.get(a), partner.get(b))
                && let Some((other, reversed)) = self.features.find(p, q)
                && other != edge
            {
                image[edge] = Some((other, reversed));
                is_image[other] = true;
            }
        }
        let rotation = self.seam.map(|s| s.step.placed());
        for edge in 0..count {
            if is_image[edge] {
                continue;
            }
            let [a, b] = self.features.ends[edge];
            let own = parameters(edge);
            let (division, other) = match image[edge] {
                Some((other, reversed)) if whole[edge] || whole[other] => {
                    self.chains[other].changed = !self.features.points[other].is_empty();
                    (Vec::new(), Some((other, reversed)))
                }
                None if whole[edge] => (Vec::new(), None),
                Some((other, reversed)) => {
                    if image[other].is_some() {
                        return Err(self.unmatched(a));
                    }
                    let mut theirs = parameters(other);
                    if reversed {
                        theirs.reverse();
                        theirs.iter_mut().for_each(|t| *t = 1.0 - *t);
                    }
                    let both = merged(&own, &theirs);
                    self.chains[other].changed = !same(&both, &theirs);
                    (both, Some((other, reversed)))
                }
                None => (own.clone(), None),
            };
            self.chains[edge].changed = !same(&division, &own);
            let [p, q] = [a, b].map(|v| self.input.vertices[v as usize]);
            let points: Vec<DVec3> = division.iter().map(|&t| p + (q - p) * t).collect();
            let first = self.made.vertices.len() as u32;
            let vertices: Vec<u32> = (first..first + points.len() as u32).collect();
            self.made.vertices.extend(&points);
            if on_axis[a as usize] && on_axis[b as usize] {
                self.made.axis.extend(&vertices);
                self.pairs.extend(vertices.iter().map(|&v| [v, v]));
            }
            if let (Some((other, reversed)), Some(rotation)) = (other, &rotation) {
                let mut images = Vec::with_capacity(points.len());
                for (&v, &p) in vertices.iter().zip(&points) {
                    let w = self.add(rotation.apply(p));
                    self.pairs.push([v, w]);
                    images.push(w);
                }
                if reversed {
                    images.reverse();
                }
                self.chains[other].vertices = images;
            }
            self.chains[edge].vertices = vertices;
        }
        for (chain, points) in self.chains.iter().zip(&self.features.points) {
            if !chain.changed {
                for (&v, point) in chain.vertices.iter().zip(points) {
                    self.of_guide[point.vertex as usize] = v;
                }
            }
        }
        Ok(())
    }

    /// Triangulates all facets; gives the triangle pairs of the seam.
    fn fill_facets(&mut self) -> Result<Vec<[u32; 2]>, SurfaceError> {
        let facets = &self.guide.facets;
        let count = facets.facets.len();
        let mut old: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (t, &f) in facets.of_triangle.iter().enumerate() {
            old[f as usize].push(t as u32);
        }
        let mut fine: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (t, &f) in self.guide.facet.iter().enumerate() {
            fine[f as usize].push(t as u32);
        }
        // Of each facet of the low face, the triangle that says what its image is like.
        let mut low: Vec<Option<Triangle>> = vec![None; count];
        let mut high = vec![false; count];
        for &[b, a] in self.seam.map_or(&[][..], |s| &s.triangle_pairs) {
            let image = self.input.triangles[b as usize];
            let like = |t: &Triangle| (t.marker, t.front, t.back);
            let slot = &mut low[facets.of_triangle[a as usize] as usize];
            if slot.is_some_and(|s| like(&s) != like(&image)) {
                return Err(self.unmatched(self.input.triangles[a as usize].vertices[0]));
            }
            *slot = Some(image);
            high[facets.of_triangle[b as usize] as usize] = true;
        }
        let mut on_seam: Vec<(u32, Triangle)> = Vec::new();
        for facet in 0..count {
            if high[facet] {
                continue;
            }
            let attributes = facets.facets[facet].attributes;
            let first = self.made.triangles.len() as u32;
            let triangles = if self.frozen[facet] {
                self.frozen_facet(&old[facet], first)
            } else {
                self.facet(facet, &old[facet], &fine[facet], low[facet].is_some())?
            };
            let faces = std::iter::repeat_n(attributes.face, triangles.len());
            self.face_of.extend(faces);
            self.made
                .triangles
                .extend(triangles.into_iter().map(|vertices| Triangle {
                    vertices,
                    marker: attributes.marker,
                    front: attributes.front,
                    back: attributes.back,
                }));
            if let Some(image) = low[facet] {
                on_seam.extend((first..self.made.triangles.len() as u32).map(|t| (t, image)));
            }
        }
        self.copy_to_high(&on_seam)
    }

    /// The triangles of a facet that stays.
    fn frozen_facet(&mut self, old: &[u32], first: u32) -> Vec<[u32; 3]> {
        for (new, &t) in (first..).zip(old) {
            self.of_triangle[t as usize] = new;
        }
        let corners = old
            .iter()
            .map(|&t| self.input.triangles[t as usize].vertices);
        corners
            .map(|t| t.map(|v| self.of_input[v as usize]))
            .collect()
    }

    fn copy_to_high(&mut self, on_seam: &[(u32, Triangle)]) -> Result<Vec<[u32; 2]>, SurfaceError> {
        let Some(seam) = self.seam else {
            return Ok(Vec::new());
        };
        let mut image: FxHashMap<u32, u32> = self.pairs.iter().map(|p| (p[0], p[1])).collect();
        let rotation = seam.step.placed();
        let mut pairs = Vec::with_capacity(on_seam.len());
        for &(low, like) in on_seam {
            let corners = self.made.triangles[low as usize].vertices;
            let [a, b, c] = corners.map(|v| {
                *image.entry(v).or_insert_with(|| {
                    let w = self.made.vertices.len() as u32;
                    self.made
                        .vertices
                        .push(rotation.apply(self.made.vertices[v as usize]));
                    self.pairs.push([v, w]);
                    w
                })
            });
            pairs.push([low, self.made.triangles.len() as u32]);
            self.face_of.push(NO_FACE);
            self.made.triangles.push(Triangle {
                vertices: [a, c, b],
                ..like
            });
        }
        Ok(pairs)
    }

    /// Triangles of one facet in the new numbering.
    fn facet(
        &mut self,
        facet: usize,
        old: &[u32],
        fine: &[u32],
        low: bool,
    ) -> Result<Vec<[u32; 3]>, SurfaceError> {
        let mut outline: Vec<[u32; 2]> = Vec::new();
        let mut changed = low;
        let mut fixed: Vec<u32> = Vec::new();
        for &t in old {
            let corners = self.input.triangles[t as usize].vertices;
            for i in 0..3 {
                let [a, b] = [corners[i], corners[(i + 1) % 3]];
                let new = self.of_input[a as usize];
                if new != NONE {
                    fixed.push(new);
                }
                let Some((edge, reversed)) = self.features.find(a, b) else {
                    continue;
                };
                let chain = &self.chains[edge];
                changed |= chain.changed;
                let mut last = self.of_input[a as usize];
                let mut step = |v: u32| outline.push([std::mem::replace(&mut last, v), v]);
                if reversed {
                    chain.vertices.iter().rev().for_each(|&v| step(v));
                } else {
                    chain.vertices.iter().for_each(|&v| step(v));
                }
                step(self.of_input[b as usize]);
                fixed.extend(&chain.vertices);
            }
        }
        fixed.sort_unstable();
        fixed.dedup();

        let guide = self.guide;
        let mut inner: Vec<u32> = fine
            .iter()
            .flat_map(|&t| guide.triangles[t as usize])
            .collect();
        inner.sort_unstable();
        inner.dedup();
        inner.retain(|&v| !self.features.on[v as usize] && self.of_guide[v as usize] == NONE);
        let level = self.level(old);
        let projection = self.projection(guide.facets.facets[facet].attributes.face, low);
        let settle = |p: DVec3| {
            let p = level.map_or(p, |z| DVec3::new(p.x, p.y, z));
            projection.map_or(p, |plane| plane.apply(p))
        };
        // The guide's points on straight edges are on one line up to rounding only, and so may be all three corners
        // of a triangle.
        let is_flat = |&t: &u32| {
            let [a, b, c] = guide.triangles[t as usize].map(|v| guide.vertices[v as usize]);
            let (u, v) = (b - a, c - a);
            let longest = u.length_squared().max(v.length_squared());
            u.cross(v).length() <= FLAT * longest
        };
        changed |= fine.iter().any(is_flat);
        if !changed {
            for &v in &inner {
                let new = self.add(settle(guide.vertices[v as usize]));
                self.of_guide[v as usize] = new;
            }
            let corners = fine.iter().map(|&t| guide.triangles[t as usize]);
            return Ok(corners
                .map(|t| t.map(|v| self.of_guide[v as usize]))
                .collect());
        }

        let plane = Plane::new(guide.facets.facets[facet].normal);
        let mut local: FxHashMap<u32, u32> = FxHashMap::default();
        let mut points: Vec<DVec2> = Vec::with_capacity(fixed.len() + inner.len());
        for &v in &fixed {
            local.insert(v, points.len() as u32);
            points.push(plane.project(self.made.vertices[v as usize]));
        }
        let offset = points.len();
        points.extend(
            inner
                .iter()
                .map(|&v| plane.project(guide.vertices[v as usize])),
        );
        let height = fixed
            .iter()
            .map(|&v| plane.normal.dot(self.made.vertices[v as usize]))
            .sum::<f64>()
            / fixed.len() as f64;
        let mut patch = Patch {
            points,
            fixed: offset,
            outline: outline.iter().map(|e| e.map(|v| local[&v])).collect(),
        };
        let triangles = patch.triangulate().map_err(|broken| {
            let p = patch.points[broken.0 as usize];
            SurfaceError::Facet {
                template: self.index,
                place: plane.lift(p, height),
            }
        })?;
        let mut number: Vec<u32> = fixed;
        number.resize(patch.points.len(), NONE);
        Ok(triangles
            .into_iter()
            .map(|t| {
                t.map(|i| {
                    let i = i as usize;
                    if number[i] == NONE {
                        let p = match inner.get(i - offset) {
                            Some(&v) => guide.vertices[v as usize],
                            None => plane.lift(patch.points[i], height),
                        };
                        number[i] = self.add(settle(p));
                    }
                    number[i]
                })
            })
            .collect())
    }

    /// The plane of a wall's face that points have to be on.
    fn projection(&self, face: u32, low: bool) -> Option<Projection> {
        if low {
            // The low face of a seam is at angle 0 in the canonical frame.
            return Some(Projection::Vertical { cos: 1.0, sin: 0.0 });
        }
        let wall = (face.checked_sub(1)? / 2) as usize;
        let gluing = self.input.gluings.get(wall)?;
        gluing.is_mirror(self.index).then(|| Projection::of(gluing))
    }

    /// The gluings of the new surface.
    fn gluings(&mut self, triangle_pairs: Vec<[u32; 2]>) -> Vec<Gluing> {
        let mut gluings = self.input.gluings.clone();
        let mut of_face: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (t, &face) in self.face_of.iter().enumerate() {
            if face != NO_FACE {
                of_face.entry(face).or_default().push(t as u32);
            }
        }
        let mut triangle_pairs = Some(triangle_pairs);
        for (i, gluing) in gluings.iter_mut().enumerate() {
            if gluing.is_mirror(self.index) {
                let triangles = of_face.remove(&face_key(i, false)).unwrap_or_default();
                let old: Vec<u32> = gluing.vertices_here().collect();
                let mut on: Vec<u32> = self.on_wall(&old);
                let corners = |&t: &u32| self.made.triangles[t as usize].vertices;
                on.extend(triangles.iter().flat_map(corners));
                on.sort_unstable();
                on.dedup();
                gluing.vertex_pairs = on.into_iter().map(|v| [v, v]).collect();
                gluing.triangle_pairs = triangles.into_iter().map(|t| [t, t]).collect();
            } else if gluing.is_seam(self.index) {
                let mut pairs = std::mem::take(&mut self.pairs);
                pairs.sort_unstable();
                pairs.dedup();
                let triangles = triangle_pairs.take().unwrap_or_default();
                *gluing = Gluing::seam(&gluing.name, gluing.other, gluing.step, pairs, triangles);
            } else {
                for pair in &mut gluing.vertex_pairs {
                    pair[0] = self.of_input[pair[0] as usize];
                }
                for pair in &mut gluing.triangle_pairs {
                    pair[0] = self.of_triangle[pair[0] as usize];
                }
                gluing.sort();
            }
        }
        gluings
    }

    /// New vertices at input vertices of a wall, and on edges between them.
    fn on_wall(&self, vertices: &[u32]) -> Vec<u32> {
        let mut on = vec![false; self.input.vertices.len()];
        vertices.iter().for_each(|&v| on[v as usize] = true);
        let mut found: Vec<u32> = vertices
            .iter()
            .map(|&v| self.of_input[v as usize])
            .filter(|&v| v != NONE)
            .collect();
        for ([a, b], chain) in self.features.ends.iter().zip(&self.chains) {
            if on[*a as usize] && on[*b as usize] {
                found.extend(&chain.vertices);
            }
        }
        found
    }

    /// Height of a facet that is exactly horizontal.
    fn level(&self, old: &[u32]) -> Option<f64> {
        let mut heights = old
            .iter()
            .flat_map(|&t| self.input.triangles[t as usize].vertices)
            .map(|v| self.input.vertices[v as usize].z);
        let z = heights.next()?;
        heights.all(|other| other == z).then_some(z)
    }
}

/// An orthonormal frame in a facet's plane; upright and level facets keep exact coordinates.
struct Plane {
    u: DVec3,
    v: DVec3,
    normal: DVec3,
}

impl Plane {
    fn new(normal: DVec3) -> Self {
        let across = if normal.z.abs() > 0.9 {
            DVec3::X - normal * normal.x
        } else {
            DVec3::Z.cross(normal)
        };
        let u = across.normalize_or_zero();
        Self {
            u,
            v: normal.cross(u),
            normal,
        }
    }

    fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.u.dot(p), self.v.dot(p))
    }

    fn lift(&self, p: DVec2, height: f64) -> DVec3 {
        self.u * p.x + self.v * p.y + self.normal * height
    }
}

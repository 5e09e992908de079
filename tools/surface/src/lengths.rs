//! A surface whose edges have the length asked for before the mesher sees it.
//!
//! The mesher halves edges until its elements have good shapes, and where what it meshes is as thin as they are to be long, it ends at half
//! of the length. Here straight edges between facets are divided into equal parts, and flat facets triangulated
//! between them (`geom::cdt`), so that the mesher may leave the whole surface as it is. What stands for a curved shape has its
//! lengths from remeshing.

use geom::cdt::{Frame, Patch};
use glam::DVec3;
use mesher::{Facet, NO_FACE, Piece, Plc, Sizes};
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Document, FixedSet, Template, Tet};

/// Length of an edge, over the one asked for, up to which it stays whole: halves would miss it by more (as in remeshing, after
/// M. Botsch, L. Kobbelt, "A remeshing approach to multiresolution modeling", 2004).
const LONGEST: f64 = 4.0 / 3.0;

/// Lengths of edges asked for, model units, by region.
pub type Lengths = FxHashMap<u32, f64>;

/// Length asked for in each region, model units, unless sizes change from place to place in a template, which may want the surface divided.
pub fn lengths(document: &Document, sizes: &Sizes, template: usize) -> Option<Lengths> {
    let each = document.regions.iter().zip(&sizes.lengths);
    let known: Lengths = each
        .filter_map(|(r, &length)| Some((r.id, length?)))
        .collect();
    let is_even = sizes.local[template].is_none();
    (is_even && !known.is_empty()).then_some(known)
}

/// Mean length of edges over the one asked for, where all regions have one; elements count their six edges.
pub fn mean_edge(lengths: &Lengths, vertices: &[DVec3], tets: &[Tet]) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for tet in tets {
        let length = lengths.get(&tet.region)?;
        let corners = tet.vertices.map(|v| vertices[v as usize]);
        for i in 0..4 {
            for j in 0..i {
                sum += corners[i].distance(corners[j]) / length;
                count += 1.0;
            }
        }
    }
    (count > 0.0).then(|| sum / count)
}

/// A template with other triangles on the same surface.
pub struct Divided {
    /// The template; its first vertices are the given ones, and its first triangles lie in the facets that the given ones do.
    pub template: Template,
    /// Of each triangle, one that was given and is in the same facet.
    pub parents: Vec<u32>,
}

/// What becomes of faces that are images of each other, and of those that other templates are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shared {
    /// They stay as they are.
    Stay,
    /// They are divided as others are. What is made is a guide for a surface whose faces fit together, and has no gluings that do.
    Follow,
}

/// Divides the surface of a template for the shorter one of the lengths on both sides. What is curved stays as it is, and faces that another template
/// gives, and so do edges there; shared ones, if they are to. `None` where facets cannot be triangulated.
/// n log n in what comes of it.
pub fn divided(piece: Piece<'_>, plc: &Plc, lengths: &Lengths, shared: Shared) -> Option<Divided> {
    let facets = &plc.facets;
    let mut of_facet: Vec<Vec<u32>> = vec![Vec::new(); facets.facets.len()];
    for (t, &facet) in (0_u32..).zip(&facets.of_triangle) {
        of_facet[facet as usize].push(t);
    }
    let mut maker = Maker {
        piece,
        plc,
        lengths,
        shared,
        walls: walls(piece),
        template: piece.template.clone(),
        parents: (0..piece.template.triangles.len() as u32).collect(),
        chains: FxHashMap::default(),
    };
    maker.divide_edges();
    for (facet, triangles) in of_facet.iter().enumerate() {
        maker.facet(facet, triangles)?;
    }
    let Maker {
        mut template,
        parents,
        ..
    } = maker;
    template.axis.sort_unstable();
    template.gluings.iter_mut().for_each(|g| g.sort());
    Some(Divided { template, parents })
}

/// A mirror plane that a template lies on.
struct Wall {
    /// Its gluing.
    number: usize,
    /// The plane.
    plane: FixedSet,
    /// Of each vertex, whether it is on it.
    on: Vec<bool>,
}

fn walls(piece: Piece<'_>) -> Vec<Wall> {
    let gluings = piece.template.gluings.iter().enumerate();
    let mirrors = gluings.filter(|(_, gluing)| gluing.is_mirror(piece.index));
    mirrors
        .map(|(number, gluing)| {
            let mut on = vec![false; piece.template.vertices.len()];
            gluing.vertices_here().for_each(|v| on[v as usize] = true);
            Wall {
                number,
                plane: FixedSet::of(gluing.step),
                on,
            }
        })
        .collect()
}

/// A template while its surface is divided.
struct Maker<'a> {
    piece: Piece<'a>,
    plc: &'a Plc,
    lengths: &'a Lengths,
    shared: Shared,
    walls: Vec<Wall>,
    template: Template,
    parents: Vec<u32>,
    /// New vertices on an edge, from its lower to its higher end.
    chains: FxHashMap<[u32; 2], Vec<u32>>,
}

impl Maker<'_> {
    /// Whether a facet may have other triangles: it is flat, and if something else has it, too, that follows.
    fn is_flat(&self, facet: usize) -> bool {
        let facet = &self.plc.facets.facets[facet];
        let face = facet.attributes.face;
        let is_own = face == NO_FACE || self.wall(facet).is_some() || self.follows(face);
        is_own && facet.normal != DVec3::ZERO && facet.deviation <= self.plc.rounding
    }

    /// Whether what has a face, too, follows what becomes of it.
    fn follows(&self, face: u32) -> bool {
        let gluings = &self.piece.template.gluings;
        let gluing = gluings.get((face - 1) as usize / 2);
        let is_given = gluing.is_some_and(|g| g.other_than(self.piece.index).is_some());
        self.shared == Shared::Follow && !is_given
    }

    /// The mirror plane that a facet is in.
    fn wall(&self, facet: &Facet) -> Option<&Wall> {
        let face = facet.attributes.face;
        let number = face.checked_sub(1)? as usize / 2;
        self.walls.iter().find(|wall| wall.number == number)
    }

    /// Divides edges between facets, equal parts each.
    fn divide_edges(&mut self) {
        let facets = &self.plc.facets;
        let mut around: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
        let mut order: Vec<[u32; 2]> = Vec::new();
        for (triangle, &facet) in self
            .piece
            .template
            .triangles
            .iter()
            .zip(&facets.of_triangle)
        {
            for [a, b] in edges(triangle.vertices) {
                let key = [a.min(b), a.max(b)];
                let list = around.entry(key).or_default();
                if list.is_empty() {
                    order.push(key);
                }
                list.push(facet);
            }
        }
        for edge in order {
            let list = &around[&edge];
            let is_inside = matches!(list[..], [f, g] if f == g);
            if !is_inside && list.iter().all(|&f| self.is_flat(f as usize)) {
                let lengths = list.iter().map(|&f| self.length(f as usize));
                self.divide_edge(edge, lengths.fold(f64::INFINITY, f64::min));
            }
        }
    }

    /// Length asked for in a facet.
    fn length(&self, facet: usize) -> f64 {
        let attributes = self.plc.facets.facets[facet].attributes;
        let sides = [attributes.front, attributes.back];
        let lengths = sides.iter().filter_map(|region| self.lengths.get(region));
        lengths.copied().fold(f64::INFINITY, f64::min)
    }

    fn divide_edge(&mut self, edge: [u32; 2], length: f64) {
        let [p, q] = edge.map(|v| self.template.vertices[v as usize]);
        let whole = p.distance(q) / length;
        if whole <= LONGEST {
            return;
        }
        let parts = whole.round().max(2.0) as u32;
        let axis = &self.piece.template.axis;
        let is_on_axis = edge.iter().all(|v| axis.binary_search(v).is_ok());
        let walls: Vec<usize> = (0..self.walls.len())
            .filter(|&w| edge.iter().all(|&v| self.walls[w].on[v as usize]))
            .collect();
        let chain = (1..parts).map(|k| {
            let mut at = p + (q - p) * (f64::from(k) / f64::from(parts));
            for &w in &walls {
                at = self.walls[w].plane.nearest(at);
            }
            if is_on_axis {
                at = DVec3::new(0.0, 0.0, at.z);
            }
            let vertex = self.template.vertices.len() as u32;
            self.template.vertices.push(at);
            if is_on_axis {
                self.template.axis.push(vertex);
                let gluings = self.template.gluings.iter_mut();
                let joined = gluings.filter(|g| g.joins_at_axis(self.piece.index));
                joined.for_each(|g| g.vertex_pairs.push([vertex, vertex]));
            }
            for &w in &walls {
                let gluing = &mut self.template.gluings[self.walls[w].number];
                gluing.vertex_pairs.push([vertex, vertex]);
            }
            vertex
        });
        let chain = chain.collect();
        self.chains.insert(edge, chain);
    }

    /// Triangulates a facet, if its outline is another one or it has more than a triangle in each corner of that.
    fn facet(&mut self, facet: usize, triangles: &[u32]) -> Option<()> {
        if !self.is_flat(facet) {
            return Some(());
        }
        let old = triangles
            .iter()
            .map(|&t| self.piece.template.triangles[t as usize].vertices);
        let old: Vec<[u32; 3]> = old.collect();
        let outline = self.outline(&old);
        let is_changed = outline.len() != outline_of(&old).count();
        if !is_changed && old.len() < 3 {
            return Some(());
        }
        let new = self.triangulated(facet, &old, &outline)?;
        // Facets that are folded over have no triangulation.
        if new.len() < old.len() {
            return None;
        }
        let first = triangles[0];
        let like = self.template.triangles[first as usize];
        let mut places = triangles.iter().copied();
        let mut added = Vec::new();
        for vertices in new {
            if let Some(place) = places.next() {
                self.template.triangles[place as usize].vertices = vertices;
                continue;
            }
            added.push(self.template.triangles.len() as u32);
            self.parents.push(first);
            self.template
                .triangles
                .push(tmesh::Triangle { vertices, ..like });
        }
        if let Some(number) = self
            .wall(&self.plc.facets.facets[facet])
            .map(|wall| wall.number)
        {
            let gluing = &mut self.template.gluings[number];
            let pairs = added.iter().map(|&t| [t, t]);
            gluing.triangle_pairs.extend(pairs);
        }
        Some(())
    }

    /// The outline of triangles, divided as edges are.
    fn outline(&self, triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
        let mut outline = Vec::new();
        for [a, b] in outline_of(triangles) {
            let mut last = a;
            let mut step = |v: u32| outline.push([std::mem::replace(&mut last, v), v]);
            if let Some(chain) = self.chains.get(&[a.min(b), a.max(b)]) {
                match a < b {
                    true => chain.iter().for_each(|&v| step(v)),
                    false => chain.iter().rev().for_each(|&v| step(v)),
                }
            }
            step(b);
        }
        outline
    }

    /// Triangles of a flat facet, with new vertices inside where it is wide.
    fn triangulated(
        &mut self,
        facet: usize,
        old: &[[u32; 3]],
        outline: &[[u32; 2]],
    ) -> Option<Vec<[u32; 3]>> {
        let of = &self.plc.facets.facets[facet];
        let corners = old.iter().flatten();
        let mut fixed: Vec<u32> = corners.chain(outline.iter().flatten()).copied().collect();
        fixed.sort_unstable();
        fixed.dedup();
        let frame = Frame::new(of.normal);
        let at = |v: u32| self.template.vertices[v as usize];
        let local = |v: u32| fixed.binary_search(&v).map_or(0, |i| i as u32);
        let mut patch = Patch {
            points: fixed.iter().map(|&v| frame.project(at(v))).collect(),
            fixed: fixed.len(),
            outline: outline.iter().map(|edge| edge.map(local)).collect(),
            rounding: self.plc.rounding,
            // That of a triangle with sides of the longest edges that stay whole.
            largest: LONGEST * self.length(facet) / 3.0_f64.sqrt(),
        };
        let triangles = patch.triangulate().ok()?;
        let heights = fixed.iter().map(|&v| frame.normal.dot(at(v)));
        let height = heights.sum::<f64>() / fixed.len() as f64;
        let first = at(fixed[0]).z;
        let level = fixed.iter().all(|&v| at(v).z == first).then_some(first);
        let wall = self.wall(of);
        let wall = wall.map(|wall| (wall.number, wall.plane));
        let mut number: Vec<u32> = fixed;
        number.resize(patch.points.len(), u32::MAX);
        let mut vertex = |i: u32| {
            let i = i as usize;
            if number[i] == u32::MAX {
                number[i] = self.template.vertices.len() as u32;
                let mut p = frame.lift(patch.points[i], height);
                p.z = level.unwrap_or(p.z);
                if let Some((wall, plane)) = wall {
                    p = plane.nearest(p);
                    let pairs = &mut self.template.gluings[wall].vertex_pairs;
                    pairs.push([number[i], number[i]]);
                }
                self.template.vertices.push(p);
            }
            number[i]
        };
        Some(triangles.into_iter().map(|t| t.map(&mut vertex)).collect())
    }
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The edges of some triangles that no two of them have, each with the triangles to its left.
fn outline_of(triangles: &[[u32; 3]]) -> impl Iterator<Item = [u32; 2]> {
    let all: FxHashSet<[u32; 2]> = triangles.iter().copied().flat_map(edges).collect();
    let each = triangles.iter().copied().flat_map(edges);
    each.filter(move |&[a, b]| !all.contains(&[b, a]))
}

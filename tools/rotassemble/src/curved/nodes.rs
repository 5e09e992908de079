//! What is known of how far each node is from the shape.

use super::body::{Body, Place};
use super::fixed::fixed;
use crate::numbering::{Roots, Shared};
use glam::DVec3;
use interchange::Middles;
use tmesh::Document;

/// Where a node may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Anywhere: it is inside of a region.
    Free,
    /// Within the plane across this unit vector.
    Plane(DVec3),
    /// Where it is known to go.
    Known,
}

/// The nodes of all templates: vertices, then points on edges.
pub struct Nodes<'a> {
    /// The vertices of walls that are one.
    pub roots: &'a Roots,
    /// How far each node moves, model units, in the frame of its template.
    pub moves: Vec<Vec<DVec3>>,
    /// Where each may go.
    pub bounds: Vec<Vec<Bound>>,
    /// Of each template, the ends of the edges that its points on edges are on; these come after the vertices.
    pub ends: Vec<Vec<[u32; 2]>>,
}

/// Sines of angles below this are rounding: planes in which one face of the body was drawn are one.
const ONE_PLANE: f64 = 1e-6;

impl<'a> Nodes<'a> {
    /// Reads how far the nodes of the surface are from the shape. Lengths below `rounding` are none.
    pub fn new(
        document: &Document,
        (middles, roots): (&Middles, &'a Roots),
        body: &Body,
        rounding: f64,
    ) -> Self {
        let counts = document.templates.iter().map(|t| t.vertices.len());
        let mut nodes = Self {
            roots,
            moves: counts.clone().map(|n| vec![DVec3::ZERO; n]).collect(),
            bounds: counts.map(|n| vec![Bound::Free; n]).collect(),
            ends: Vec::new(),
        };
        for (t, template) in document.templates.iter().enumerate() {
            nodes.ends.push(ends(document, t, middles));
            let mut around: Vec<(u32, u32)> = Vec::new();
            for (i, triangle) in (0..).zip(&template.triangles) {
                around.extend(triangle.vertices.map(|v| (v, i)));
                around.extend(middles.triangles[t][i as usize].map(|v| (v, i)));
            }
            around.sort_unstable();
            for fan in around.chunk_by(|a, b| a.0 == b.0) {
                let node = fan[0].0 as usize;
                let triangles: Vec<u32> = fan.iter().map(|f| f.1).collect();
                match body.place(t, &triangles, template.vertices[node]) {
                    Some(Place::Curved(above)) => {
                        nodes.bounds[t][node] = Bound::Known;
                        if above.length() > rounding {
                            nodes.moves[t][node] = above;
                        }
                    }
                    Some(Place::Flat(normals)) => nodes.bounds[t][node] = flat(&normals),
                    None => {}
                }
            }
        }
        nodes.agree();
        nodes
    }

    /// Number of vertices of a template, without points on edges.
    pub fn vertices(&self, template: usize) -> usize {
        self.moves[template].len() - self.ends[template].len()
    }

    /// Gives what is one node one move and one bound: the mean of what is known of its copies.
    fn agree(&mut self) {
        let mut sums: Vec<Vec<(DVec3, u32)>> = (self.moves.iter())
            .map(|m| vec![(DVec3::ZERO, 0); m.len()])
            .collect();
        let roots = self.roots;
        for Shared { own, root, offset } in &roots.shared {
            let (bound, back) = (self.bounds[own.0][own.1 as usize], offset.inverse());
            if bound == Bound::Known {
                let sum = &mut sums[root.0][root.1 as usize];
                sum.0 += back.apply(self.moves[own.0][own.1 as usize]);
                sum.1 += 1;
            }
            let here = &mut self.bounds[root.0][root.1 as usize];
            *here = match (*here, bound) {
                (Bound::Plane(m), Bound::Plane(n)) => flat(&[m, back.apply(n)]),
                (Bound::Known, _) | (_, Bound::Known) => Bound::Known,
                (Bound::Free, Bound::Plane(n)) => Bound::Plane(back.apply(n)),
                (bound, Bound::Free) => bound,
            };
        }
        for &Shared { own, root, offset } in &roots.shared {
            if own == root {
                let (sum, count) = sums[own.0][own.1 as usize];
                let mean = if count > 0 {
                    sum / f64::from(count)
                } else {
                    sum
                };
                self.moves[own.0][own.1 as usize] = self.within(own, mean);
            }
            let bound = match self.bounds[root.0][root.1 as usize] {
                Bound::Plane(n) => Bound::Plane(offset.apply(n)),
                bound => bound,
            };
            self.bounds[own.0][own.1 as usize] = bound;
        }
        self.spread();
    }

    /// The part of a move of a root that leaves it in its plane and on what the isometries that keep it leave in place.
    pub fn within(&self, root: (usize, u32), by: DVec3) -> DVec3 {
        let by = match self.bounds[root.0][root.1 as usize] {
            Bound::Plane(normal) => by - normal * by.dot(normal),
            _ => by,
        };
        fixed(self.roots.generators(root), by)
    }

    /// Moves copies as what represents them.
    pub fn spread(&mut self) {
        for Shared { own, root, offset } in &self.roots.shared {
            if own != root {
                let by = self.moves[root.0][root.1 as usize];
                self.moves[own.0][own.1 as usize] = offset.apply(by);
            }
        }
    }

    /// How far the ends of an edge move in the mean.
    pub fn mean(&self, template: usize, [a, b]: [u32; 2]) -> DVec3 {
        let moves = &self.moves[template];
        0.5 * (moves[a as usize] + moves[b as usize])
    }
}

/// What is in these planes; with more than one, where it is.
fn flat(normals: &[DVec3]) -> Bound {
    let first = normals[0];
    let is_one = |n: &DVec3| first.cross(*n).length() <= ONE_PLANE;
    match normals.iter().all(is_one) {
        true => Bound::Plane(first),
        false => Bound::Known,
    }
}

/// The ends of the edges of a template that points are on, in the order of the points.
fn ends(document: &Document, t: usize, middles: &Middles) -> Vec<[u32; 2]> {
    let template = &document.templates[t];
    let on_tets = (template.tets.iter().zip(&middles.tets[t])).flat_map(|(tet, ids)| {
        let v = tet.vertices;
        let edges = Middles::TET_EDGES.iter().zip(ids);
        edges.map(move |(&[a, b], &id)| (id, [v[a], v[b]]))
    });
    let triangles = template.triangles.iter().zip(&middles.triangles[t]);
    let on_triangles = triangles.flat_map(|(triangle, ids)| {
        let v = triangle.vertices;
        let edges = Middles::TRIANGLE_EDGES.iter().zip(ids);
        edges.map(move |(&[a, b], &id)| (id, [v[a], v[b]]))
    });
    let mut all: Vec<(u32, [u32; 2])> = on_tets.chain(on_triangles).collect();
    all.sort_unstable_by_key(|(id, _)| *id);
    all.dedup_by_key(|(id, _)| *id);
    all.into_iter().map(|(_, ends)| ends).collect()
}

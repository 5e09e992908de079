//! Facets and the smooth edges between them.

use crate::shape::flat::{Flats, SAME_DIRECTION};
use crate::shape::table::Table;
use geom::edges::{EdgeUse, Edges, apex_of};
use geom::measure::double_area_vector;
use geom::smooth::SMOOTH_COSINE;
use glam::DVec3;

/// Cosine of the angle between facets of one surface at most where both bend into others, so that they are drawn on curved
/// faces: whether the edge between
/// two such faces is sharp, or the kernel drew one face coarser than it was told, as kernels do inside of faces that are
/// curved in two directions, cannot be told. No more than a sixth of a turn: nothing with fewer sides is drawn for round.
pub const BENT: f64 = 0.5;

/// The facets of a surface: flats of one or more triangles.
pub struct Facets<'a> {
    /// Vertices of the surface.
    pub vertices: &'a [DVec3],
    /// Its triangles.
    pub triangles: &'a [[u32; 3]],
    /// Their unit normals.
    pub normals: &'a [DVec3],
    /// Their edges.
    pub edges: Edges,
    /// The flats.
    pub flats: Flats,
    /// Whether each flat is a single triangle.
    pub single: Vec<bool>,
}

/// A smooth edge between two facets.
#[derive(Clone, Copy)]
pub struct Fold {
    /// The edge.
    pub edge: u32,
    /// The edge in a triangle of either.
    pub uses: [EdgeUse; 2],
    /// The flats.
    pub flats: [u32; 2],
    /// Extent of either facet across the edge.
    pub widths: [f64; 2],
    /// The angle between them, radians, positive where the body is convex.
    pub turn: f64,
}

impl Fold {
    /// Whether a facet, the first or the second, is no more than twice as wide as the one beyond the fold: what is wider is no
    /// facet of the same curve.
    pub fn is_like(&self, i: usize) -> bool {
        self.widths[i] <= 2.0 * self.widths[1 - i]
    }
}

impl<'a> Facets<'a> {
    /// The facets of a surface with these unit normals. Linear.
    pub fn new(vertices: &'a [DVec3], triangles: &'a [[u32; 3]], normals: &'a [DVec3]) -> Self {
        let edges = Edges::new(triangles);
        let flats = Flats::new(triangles, normals, &edges);
        let mut count = vec![0_u32; flats.count()];
        flats.of.iter().for_each(|f| count[*f as usize] += 1);
        let single = count.into_iter().map(|c| c == 1).collect();
        Self {
            vertices,
            triangles,
            normals,
            edges,
            flats,
            single,
        }
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|v| self.vertices[v as usize])
    }

    /// The flat of the triangle of a use of an edge.
    pub fn flat(&self, u: &EdgeUse) -> u32 {
        self.flats.of[u.triangle as usize]
    }

    /// The normal there.
    pub fn normal(&self, u: &EdgeUse) -> DVec3 {
        self.normals[u.triangle as usize]
    }

    /// Ends of an edge in the order of a triangle that uses it.
    pub fn ends(&self, u: &EdgeUse) -> [DVec3; 2] {
        let corners = self.corners(u.triangle as usize);
        [0, 1].map(|i| corners[(u.corner as usize + i) % 3])
    }

    /// The corner of the triangle across from the edge.
    pub fn apex(&self, u: &EdgeUse) -> DVec3 {
        self.vertices[apex_of(&self.triangles[u.triangle as usize], u.corner) as usize]
    }

    /// Whether facets of one smooth surface meet at an edge.
    pub fn is_smooth(&self, edge: usize) -> bool {
        match self.edges.around(edge) {
            [u, v] => u.forward != v.forward && self.normal(u).dot(self.normal(v)) >= SMOOTH_COSINE,
            _ => false,
        }
    }

    /// Whether facets meet at an edge at no more than the angle at which those of one surface ever do.
    pub fn may_be_smooth(&self, edge: usize) -> bool {
        match self.edges.around(edge) {
            [u, v] => u.forward != v.forward && self.normal(u).dot(self.normal(v)) >= BENT,
            _ => false,
        }
    }

    /// All smooth edges between different flats.
    pub fn folds(&self) -> Vec<Fold> {
        let smooth = (0..self.edges.len()).filter(|e| self.is_smooth(*e));
        smooth.filter_map(|e| self.fold(e)).collect()
    }

    /// The edges beside these folds that may be sharp or not: between facets of curved faces that are about as wide, up to
    /// [`BENT`].
    pub fn doubtful(&self, folds: &[Fold]) -> Vec<Fold> {
        let mut bends = vec![false; self.flats.count()];
        for flat in folds.iter().flat_map(|f| f.flats) {
            bends[flat as usize] = true;
        }
        let is_doubtful = |e: &usize| match self.edges.around(*e) {
            [u, v] => {
                let cosine = self.normal(u).dot(self.normal(v));
                let bent = [u, v].iter().all(|u| bends[self.flat(u) as usize]);
                bent && u.forward != v.forward && (BENT..SMOOTH_COSINE).contains(&cosine)
            }
            _ => false,
        };
        let edges = (0..self.edges.len()).filter(is_doubtful);
        let folds = edges.filter_map(|e| self.fold(e));
        folds.filter(|f| f.is_like(0) && f.is_like(1)).collect()
    }

    fn fold(&self, edge: usize) -> Option<Fold> {
        let [u, v] = self.edges.around(edge) else {
            return None;
        };
        let flats = [self.flat(u), self.flat(v)];
        if flats[0] == flats[1] {
            return None;
        }
        let [a, b] = self.ends(u);
        let along = (b - a).normalize_or_zero();
        let across = |v: &u32| (self.vertices[*v as usize] - a).cross(along).length();
        let widths = flats.map(|f| (self.flats.corners(f).iter().map(across)).fold(0.0, f64::max));
        let [m, n] = [u, v].map(|u| self.normal(u));
        let angle = libm::atan2(m.cross(n).length(), m.dot(n));
        let convex = m.dot(self.apex(v) - a) <= 0.0;
        Some(Fold {
            edge: edge as u32,
            uses: [*u, *v],
            flats,
            widths,
            turn: if convex { angle } else { -angle },
        })
    }

    /// The vertices of each flat of several triangles at which its border turns; the others only divide its sides or its
    /// inside. n log n.
    pub fn turning_points(&self) -> Table {
        let mut sides: Vec<(u32, u32, DVec3)> = Vec::new();
        for e in 0..self.edges.len() {
            let around = self.edges.around(e);
            if matches!(around, [u, v] if self.flat(u) == self.flat(v)) {
                continue;
            }
            let [a, b] = self.edges.ends[e];
            let along = self.vertices[b as usize] - self.vertices[a as usize];
            let along = along.normalize_or_zero();
            for flat in around.iter().map(|u| self.flat(u)) {
                if !self.single[flat as usize] {
                    sides.extend([(flat, a, along), (flat, b, -along)]);
                }
            }
        }
        sides.sort_by_key(|s| (s.0, s.1));
        let turns = |at: &&[(u32, u32, DVec3)]| match at {
            [s, t] => !is_straight(s.2, t.2),
            _ => true,
        };
        let at_vertices = sides.chunk_by(|s, t| (s.0, s.1) == (t.0, t.1));
        let corners: Vec<(u32, u32)> = at_vertices
            .filter(turns)
            .map(|s| (s[0].0, s[0].1))
            .collect();
        Table::new(self.flats.count(), corners.into_iter())
    }

    /// Area of each flat.
    pub fn areas(&self) -> Vec<f64> {
        let mut area = vec![0.0; self.flats.count()];
        for (t, &flat) in self.flats.of.iter().enumerate() {
            let [a, b, c] = self.corners(t);
            area[flat as usize] += 0.5 * double_area_vector(a, b, c).length();
        }
        area
    }
}

/// Whether two unit vectors away from a point are the two halves of a straight line.
pub fn is_straight(a: DVec3, b: DVec3) -> bool {
    -a.dot(b) > SAME_DIRECTION
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Edges that may be sharp or not of a coarse shaft so long, with a chamfer of 45 degrees so wide at one end.
    fn doubtful(length: f64, chamfer: f64) -> usize {
        const SIDES: u32 = 13;
        // Half a side between the ends, so that all facets are single triangles.
        let rings = [
            (1.0, 0.0, 0.0),
            (1.0, length, 0.5),
            (1.0 - chamfer, length + chamfer, 0.0),
        ];
        let ring = |&(radius, height, phase): &(f64, f64, f64)| {
            (0..SIDES).map(move |i| {
                let (s, c) = libm::sincos(TAU * (f64::from(i) + phase) / f64::from(SIDES));
                DVec3::new(radius * c, radius * s, height)
            })
        };
        let vertices: Vec<DVec3> = rings.iter().flat_map(ring).collect();
        let band = |k: u32, shift: u32| {
            (0..SIDES).flat_map(move |i| {
                let [low, high] = [SIDES * k, SIDES * (k + 1)];
                let next = (i + 1) % SIDES;
                let beyond = (i + shift) % SIDES;
                [
                    [low + i, low + next, high + beyond],
                    [low + next, high + (beyond + 1) % SIDES, high + beyond],
                ]
            })
        };
        let triangles: Vec<[u32; 3]> = band(0, 0).chain(band(1, 1)).collect();
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            double_area_vector(a, b, c).normalize()
        };
        let normals: Vec<DVec3> = triangles.iter().map(normal).collect();
        let facets = Facets::new(&vertices, &triangles, &normals);
        facets.doubtful(&facets.folds()).len()
    }

    #[test]
    fn a_long_facet_is_not_bent_by_a_chamfer() {
        assert_eq!(doubtful(20.0, 0.2), 0);
        assert!(doubtful(0.3, 0.2) >= 13);
    }
}

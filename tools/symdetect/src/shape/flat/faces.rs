//! Flat faces of a body, and operations that take every one of them to another.
//!
//! Triangles of the same interface in one plane form a face, however they divide it, and what bounds it in one line
//! is one edge. A bounded region of a plane is determined by its boundary: an operation that takes corners of faces
//! to corners, edges between them to edges, and the edges around each face to those around a face of the interface
//! wanted holds everywhere, as well as it does in the corners. That is quicker to see than that many places of the
//! surface land on it, and says more.

use crate::shape::flat::outlines::Outlines;
use crate::shape::motion::{Motion, Target};
use crate::shape::table::Table;
use geom::edges::{EdgeUse, Edges};
use geom::grid::Grid;
use geom::measure::double_area_vector;
use geom::sets::DisjointSets;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The faces of a surface, their edges and corners. All numbers count from zero.
pub struct Faces {
    /// Positions of the corners.
    corners: Vec<DVec3>,
    grid: Grid<3>,
    /// Corners at the ends of each edge, lower one first.
    edges: Vec<[u32; 2]>,
    edge_between: FxHashMap<[u32; 2], u32>,
    /// Faces that each edge bounds.
    around_edge: Table,
    /// Edges around each face.
    around_face: Table,
    /// Kind of interface of each face.
    class: Vec<u32>,
}

/// A surface to find the faces of.
pub struct Surface<'a> {
    /// Vertex positions in the unit ball.
    pub vertices: &'a [DVec3],
    /// Vertex ids.
    pub triangles: &'a [[u32; 3]],
    /// Regions before and behind each triangle.
    pub sides: &'a [[u32; 2]],
    /// Kind of interface of each triangle: the same for the same two regions.
    pub class: &'a [u32],
}

impl Surface<'_> {
    fn area(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.vertices[v as usize]);
        let area = double_area_vector(a, b, c);
        if self.is_turned(triangle) {
            -area
        } else {
            area
        }
    }

    /// Whether the triangle's sides are not those of its class in their order.
    fn is_turned(&self, triangle: u32) -> bool {
        let [front, back] = self.sides[triangle as usize];
        front > back
    }

    /// Whether two triangles around an edge continue each other, not folded over, and are in one plane as far as that
    /// can be told from them alone.
    fn continues(&self, s: &EdgeUse, t: &EdgeUse, normals: &[DVec3], flat: f64) -> bool {
        let forward = |u: &EdgeUse| u.forward != self.is_turned(u.triangle);
        if self.class[s.triangle as usize] != self.class[t.triangle as usize]
            || forward(s) == forward(t)
        {
            return false;
        }
        let apex = |u: &EdgeUse| {
            let corners = &self.triangles[u.triangle as usize];
            self.vertices[geom::edges::apex_of(corners, u.corner) as usize]
        };
        let on = self.vertices[self.triangles[s.triangle as usize][s.corner as usize] as usize];
        let [m, n] = [s, t].map(|u| match self.is_turned(u.triangle) {
            true => -normals[u.triangle as usize],
            false => normals[u.triangle as usize],
        });
        // The better one of the two planes tells.
        let height = (m.dot(apex(t) - on)).abs().min((n.dot(apex(s) - on)).abs());
        height <= flat && m.dot(n) > 0.0
    }
}

/// How exact a surface is, in the units of the shape.
#[derive(Clone, Copy)]
pub struct Exactness {
    /// Distance up to which vertices are in one plane.
    pub flat: f64,
    /// Distance up to which corners will be looked for.
    pub reach: f64,
}

impl Faces {
    /// Faces of a surface with these normals; `None` where their vertices are not in one plane.
    pub fn new(surface: &Surface<'_>, normals: &[DVec3], exact: Exactness) -> Option<Self> {
        let flat = exact.flat;
        let edges = Edges::new(surface.triangles);
        let mut parts = DisjointSets::new(surface.triangles.len());
        for e in 0..edges.len() {
            if let [s, t] = edges.around(e)
                && surface.continues(s, t, normals, flat)
            {
                parts.join(s.triangle, t.triangle);
            }
        }
        let (face_of, count) = parts.numbered();
        if !are_flat(surface, &face_of, count, flat) {
            return None;
        }
        let mut bounds = Outlines::new(&edges, &face_of);
        bounds.straighten(surface.vertices, flat)?;
        let (corners, ends) = bounds.numbered(surface.vertices);
        let pairs = || bounds.pairs();
        let around_face = Table::new(count, pairs().map(|(e, f)| (f, e)));
        if (0..count as u32).any(|f| around_face.of(f).is_empty()) {
            return None;
        }
        let mut class = vec![0; count];
        for (&face, &c) in face_of.iter().zip(surface.class) {
            class[face as usize] = c;
        }
        let numbered = ends.iter().zip(0..);
        let edge_between: FxHashMap<_, _> = numbered.map(|(ends, e)| (*ends, e)).collect();
        if edge_between.len() < ends.len() {
            return None;
        }
        Some(Self {
            edge_between,
            around_edge: Table::new(ends.len(), pairs()),
            edges: ends,
            grid: Grid::of(corners.iter().map(|p| p.to_array()), exact.reach),
            corners,
            around_face,
            class,
        })
    }

    /// Whether a motion takes the faces to faces of the interfaces wanted, with their corners within a distance of
    /// each other: the largest such distance, and the corner that is so far off.
    pub fn image(&self, motion: &Motion, target: &Target, within: f64) -> Option<(f64, DVec3)> {
        let mut worst = (0.0, DVec3::ZERO);
        let mut taken = vec![false; self.corners.len()];
        let mut image = Vec::with_capacity(self.corners.len());
        for &p in &self.corners {
            let (corner, distance) = self.corner_at(motion.apply(p), within)?;
            if std::mem::replace(&mut taken[corner as usize], true) {
                return None;
            }
            if distance >= worst.0 {
                worst = (distance, p);
            }
            image.push(corner);
        }
        let edge_at = |&[a, b]: &[u32; 2]| {
            let [a, b] = [a, b].map(|v| image[v as usize]);
            let ends = if a < b { [a, b] } else { [b, a] };
            self.edge_between.get(&ends).copied()
        };
        let edges: Vec<u32> = (self.edges.iter().map(edge_at)).collect::<Option<_>>()?;
        for (face, &class) in (0..).zip(&self.class) {
            let wanted = match target {
                Target::Any => None,
                Target::Classes(map) => Some(map[class as usize]),
            };
            let around = self.around_face.of(face);
            // Edges go to different edges: where all are around a face that has no more of them, they are its own.
            let is_image = |&f: &u32| {
                wanted.is_none_or(|class| self.class[f as usize] == class)
                    && self.around_face.of(f).len() == around.len()
                    && (around.iter()).all(|&e| self.around_edge.of(edges[e as usize]).contains(&f))
            };
            let candidates = self.around_edge.of(edges[around[0] as usize]);
            candidates.iter().find(|f| is_image(f))?;
        }
        Some(worst)
    }

    /// The corner nearest to a place, and its distance, if within one.
    pub fn corner_at(&self, p: DVec3, within: f64) -> Option<(u32, f64)> {
        self.grid.nearest(p.to_array(), within)
    }

    /// Positions of the corners.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// The largest distance of images of some corners, evenly chosen, from the corners next to them, if all are
    /// within a distance.
    pub fn image_of_some(&self, motion: &Motion, count: usize, within: f64) -> Option<f64> {
        let step = self.corners.len().div_ceil(count).max(1);
        let some = self.corners.iter().step_by(step);
        let mut off = some.map(|p| Some(self.corner_at(motion.apply(*p), within)?.1));
        off.try_fold(0.0, |worst: f64, off| Some(worst.max(off?)))
    }

    /// The corner that is farthest from an axis, and all as far from it and as far along it, up to `within`;
    /// `place` gives both distances.
    pub fn farthest(&self, place: impl Fn(DVec3) -> (f64, f64), within: f64) -> Vec<DVec3> {
        let places: Vec<(f64, f64)> = self.corners.iter().map(|p| place(*p)).collect();
        let farthest = (places.iter()).max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let Some(&(r, z)) = farthest else {
            return Vec::new();
        };
        let alike = |p: &(f64, f64)| (p.0 - r).abs() <= within && (p.1 - z).abs() <= within;
        let corners = places.iter().zip(&self.corners);
        corners.filter(|(p, _)| alike(p)).map(|(_, p)| *p).collect()
    }
}

/// Whether the vertices of each face are in one plane up to `flat`.
fn are_flat(surface: &Surface<'_>, face_of: &[u32], count: usize, flat: f64) -> bool {
    let mut area = vec![DVec3::ZERO; count];
    let mut on = vec![DVec3::ZERO; count];
    for (t, &face) in (0..).zip(face_of) {
        area[face as usize] += surface.area(t);
        on[face as usize] = surface.vertices[surface.triangles[t as usize][0] as usize];
    }
    let normals: Vec<DVec3> = area.iter().map(|a| a.normalize_or_zero()).collect();
    surface.triangles.iter().zip(face_of).all(|(t, &face)| {
        let (n, on) = (normals[face as usize], on[face as usize]);
        n != DVec3::ZERO
            && (t.iter()).all(|&v| n.dot(surface.vertices[v as usize] - on).abs() <= 2.0 * flat)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use std::f64::consts::FRAC_PI_2;

    const FLAT: f64 = 1e-12;

    /// A box about the origin with the given half lengths: eight corners, numbered by the signs of x, y and z, and
    /// the two triangles of each of its sides.
    fn cuboid(half: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let sign = |i: u32, bit: u32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corners = (0..8).map(|i| half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2)));
        let quads = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let split = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
        (
            corners.collect(),
            quads.into_iter().flat_map(split).collect(),
        )
    }

    fn faces_of_class(vertices: &[DVec3], triangles: &[[u32; 3]], class: &[u32]) -> Option<Faces> {
        let surface = Surface {
            vertices,
            triangles,
            sides: &vec![[0, 1]; triangles.len()],
            class,
        };
        let normal = |t: u32| surface.area(t).normalize_or_zero();
        let normals: Vec<DVec3> = (0..triangles.len() as u32).map(normal).collect();
        let exact = Exactness {
            flat: FLAT,
            reach: 1e-10,
        };
        Faces::new(&surface, &normals, exact)
    }

    fn faces(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Faces {
        faces_of_class(vertices, triangles, &vec![0; triangles.len()]).unwrap()
    }

    fn about_z(angle: f64) -> Motion {
        Motion {
            linear: DMat3::from_rotation_z(angle),
            centre: DVec3::ZERO,
        }
    }

    fn off(faces: &Faces, motion: &Motion) -> Option<f64> {
        faces.image(motion, &Target::Any, 1e-10).map(|(d, _)| d)
    }

    #[test]
    fn a_cube_has_six_faces_however_it_is_drawn() {
        let (mut vertices, mut triangles) = cuboid(DVec3::splat(0.5));
        let plain = faces(&vertices, &triangles);
        assert_eq!(
            (plain.class.len(), plain.edges.len(), plain.corners().len()),
            (6, 12, 8)
        );
        // A point in the middle of a side, and one on an edge: nothing that a quarter turn would know of.
        vertices.extend([DVec3::new(0.5, 0.2, 0.1), DVec3::new(-0.5, -0.5, 0.3)]);
        let [a, b, c] = triangles[2];
        triangles[2] = [a, b, 8];
        triangles.extend([[b, c, 8], [c, a, 8]]);
        let on_edge = |t: &[u32; 3]| t.contains(&0) && t.contains(&4);
        for t in triangles.clone().iter().filter(|t| on_edge(t)) {
            let place = triangles.iter().position(|u| u == t).unwrap();
            triangles[place] = t.map(|v| if v == 0 { 9 } else { v });
            triangles.push(t.map(|v| if v == 4 { 9 } else { v }));
        }
        let drawn = faces(&vertices, &triangles);
        assert_eq!(
            (drawn.class.len(), drawn.edges.len(), drawn.corners().len()),
            (6, 12, 8)
        );
        for cube in [plain, drawn] {
            assert!(off(&cube, &about_z(FRAC_PI_2)).unwrap() < 1e-15);
            assert!(off(&cube, &about_z(0.5 * FRAC_PI_2)).is_none());
            assert!(cube.image_of_some(&about_z(FRAC_PI_2), 3, 1e-10).is_some());
            let turned = about_z(FRAC_PI_2 + 1e-11);
            let distance = off(&cube, &turned).unwrap();
            assert!(
                (distance / (0.5_f64.sqrt() * 1e-11) - 1.0).abs() < 1e-3,
                "{distance}"
            );
            assert!(off(&cube, &about_z(FRAC_PI_2 + 1e-9)).is_none());
        }
        let (vertices, triangles) = cuboid(DVec3::new(0.4, 0.5, 0.6));
        let other = faces(&vertices, &triangles);
        assert!(off(&other, &about_z(2.0 * FRAC_PI_2)).is_some());
        assert!(off(&other, &about_z(FRAC_PI_2)).is_none());
    }

    #[test]
    fn corners_alone_do_not_make_an_image() {
        let quarter = about_z(FRAC_PI_2);
        // A wall between two edges: corners go to corners, its own edges to none.
        let (vertices, mut triangles) = cuboid(DVec3::splat(0.5));
        triangles.extend([[0, 3, 7], [0, 7, 4]]);
        let walled = faces(&vertices, &triangles);
        assert!(off(&walled, &quarter).is_none());
        assert!(off(&walled, &about_z(2.0 * FRAC_PI_2)).is_some());
        // A side is missing: corners and edges go to such.
        let (vertices, triangles) = cuboid(DVec3::splat(0.5));
        let open = faces(&vertices, &triangles[2..]);
        assert_eq!(
            (open.class.len(), open.edges.len(), open.corners().len()),
            (5, 12, 8)
        );
        assert!(off(&open, &quarter).is_none());
        assert!(off(&open, &about_z(0.0)).is_some());
    }

    #[test]
    fn faces_go_to_those_of_the_interface_wanted() {
        let (vertices, triangles) = cuboid(DVec3::splat(0.5));
        // The sides at either end of x are of a kind of their own.
        let class: Vec<u32> = (0..12).map(|t| u32::from(t < 4)).collect();
        let cube = faces_of_class(&vertices, &triangles, &class).unwrap();
        let quarter = about_z(FRAC_PI_2);
        let to = |map: [u32; 2]| Target::Classes(map.into());
        let holds = |motion: &Motion, target| cube.image(motion, &target, 1e-10).is_some();
        assert!(holds(&quarter, Target::Any));
        assert!(!holds(&quarter, to([0, 1])));
        assert!(!holds(&quarter, to([1, 0])), "top and bottom stay");
        assert!(holds(&about_z(2.0 * FRAC_PI_2), to([0, 1])));
        let nowhere = to([0, crate::shape::motion::NO_CLASS]);
        assert!(!holds(&about_z(2.0 * FRAC_PI_2), nowhere));
        // Two kinds in one plane are two faces.
        let class: Vec<u32> = (0..12).map(|t| u32::from(t == 0)).collect();
        let split = faces_of_class(&vertices, &triangles, &class).unwrap();
        assert_eq!((split.class.len(), split.edges.len()), (7, 13));
    }

    #[test]
    fn what_is_folded_over_is_not_one_face() {
        let (mut vertices, mut triangles) = cuboid(DVec3::splat(0.5));
        // A fin of two triangles back to back at an edge: with both in one face nothing would be left of it.
        vertices.push(DVec3::new(0.7, 0.7, 0.0));
        triangles.extend([[3, 7, 8], [7, 3, 8]]);
        let plain = faces(&vertices[..8], &triangles[..12]);
        let half = about_z(2.0 * FRAC_PI_2);
        assert!(off(&plain, &half).is_some());
        let finned = faces(&vertices, &triangles);
        assert!(off(&finned, &about_z(0.0)).is_some());
        assert!(off(&finned, &half).is_none());
    }

    #[test]
    fn what_is_hardly_bent_is_left_to_samples() {
        // Each step of the fan is flat by itself, all together are not.
        let step = 0.2 * FLAT.sqrt();
        let rim = |i: u32| {
            let x = f64::from(i) * step;
            DVec3::new(x, 0.0, 5.0 * x * x)
        };
        let count = 400;
        let vertices: Vec<DVec3> = (0..=count)
            .flat_map(|i| [rim(i), rim(i) + DVec3::Y])
            .collect();
        let quad = |i: u32| {
            [
                [2 * i, 2 * i + 2, 2 * i + 1],
                [2 * i + 1, 2 * i + 2, 2 * i + 3],
            ]
        };
        let triangles: Vec<[u32; 3]> = (0..count).flat_map(quad).collect();
        let class = vec![0; triangles.len()];
        assert!(faces_of_class(&vertices, &triangles, &class).is_none());
        let level: Vec<DVec3> = vertices.iter().map(|p| DVec3::new(p.x, p.y, 0.0)).collect();
        let level = faces_of_class(&level, &triangles, &class).unwrap();
        assert_eq!((level.class.len(), level.edges.len()), (1, 4));
    }
}

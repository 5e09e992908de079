//! Takes vertices out that the elements do not need.
//!
//! Delaunay refinement adds vertices one after the other and takes none back: many were needed when they came, and are no
//! longer with those that came after. So a vertex that it added goes to a neighbour, with the edges at it, where what is left is
//! good enough (edge collapse, as in Hu et al., "Tetrahedral meshing in the wild", 2018). On the surface it goes
//! within the facet that it is in, or along the straight edge that it divides, so that the shape stays as it is. The tetrahedra
//! at a vertex fill the same space from any corner that sees all of it, so that positive ones need no further proof.

use crate::mesh::{Corners, Mesh};
use crate::quality::{Goal, Grade};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::Tet;

/// A triangle of the surface, and the facet that it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Vertex ids.
    pub corners: [u32; 3],
    /// Number of the facet: what is in one may be triangulated anew.
    pub facet: u32,
    /// A number that it keeps.
    pub number: u32,
    /// Whether improvement leaves it as it is.
    pub stays: bool,
}

/// What may be left behind where a vertex goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leaves {
    /// Elements past the radius-edge bound, worth little less than good ones, as when improvement begins: it mends nearly all of them
    /// where vertices may move and be added.
    Mendable,
    /// Good elements only, in the place of good ones, for meshes of so few that there is little to mend them with.
    Good,
    /// Nothing past the bound by more than this factor that was not there, for surfaces that stay, and for shapes that leave improvement
    /// little room.
    Within(f64),
}

/// What is asked of the elements that are left.
pub struct Coarse<'a> {
    /// Dihedral angle of good ones, degrees.
    pub angle: f64,
    /// Smallest dihedral angle that there may be in the place of worse ones, degrees. Improvement brings back the rest, by vertices
    /// inside and on the surface and by other triangles there. Measured on 60 parts: two thirds of the angle of
    /// good ones leaves 5 % more elements with as many of the worst, no angle at all 1 % fewer with more past the radius-edge bound.
    /// Asking more of elements whose corners are all on the surface, and of corners of triangles there, leaves 9 % more on 73 parts, with
    /// angles that are no larger in the mean.
    pub min_dihedral: f64,
    /// Largest radius-edge ratio.
    pub radius_edge: f64,
    /// What improvement is to mend.
    pub leaves: Leaves,
    /// Largest volume by region, cubes of the unit of the positions.
    pub max_volume: &'a FxHashMap<u32, f64>,
    /// Largest volume at a point, if that changes from place to place.
    pub local: Option<&'a (dyn Fn(DVec3) -> f64 + Sync)>,
    /// Number of the first vertex that may go.
    pub first: u32,
}

/// What is there instead may have this part of the largest volume: what is larger than that is split by the mesher, which leaves elements
/// of a third to half of it, so that sizes are met in the mean.
const HALVED: f64 = 0.5;

/// A vertex that goes, and what is there instead of the tetrahedra at it.
struct Collapse {
    to: u32,
    least: f64,
    new: Vec<(Corners, Grade, u32)>,
}

/// A mesh that is coarsened.
struct Work<'w, 'a> {
    mesh: Mesh<'a>,
    faces: &'w mut Vec<Face>,
    /// Faces at each vertex of the surface.
    at: FxHashMap<u32, Vec<u32>>,
    gone: Vec<bool>,
    /// Quality that tetrahedra must have in the place of worse ones.
    least: f64,
    wish: &'w Coarse<'a>,
}

/// Takes vertices out of a mesh with its surface, the ones with the shortest edges first; returns how many. Numbers of vertices
/// stay, and the order of faces. Linear but for sorting.
pub fn coarsen(
    points: Vec<DVec3>,
    tets: &mut Vec<Tet>,
    faces: &mut Vec<Face>,
    wish: &Coarse<'_>,
) -> usize {
    let mut at: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for (i, face) in faces.iter().enumerate() {
        for v in face.corners {
            at.entry(v).or_default().push(i as u32);
        }
    }
    let limits = (wish.max_volume.iter())
        .map(|(&r, &v)| (r, 6.0 * HALVED * v))
        .collect();
    let goal = match wish.leaves {
        Leaves::Mendable => Goal::new(wish.angle, wish.radius_edge, 0.0).lenient(),
        Leaves::Good => Goal::new(wish.angle, wish.radius_edge, 0.0),
        Leaves::Within(factor) => Goal::new(wish.angle, factor * wish.radius_edge, 0.0),
    };
    let least = match wish.leaves {
        Leaves::Good => 1.0,
        _ => goal.of_angle(wish.min_dihedral).min(1.0),
    };
    let mut work = Work {
        mesh: Mesh::new(points, std::mem::take(tets), goal, &limits),
        gone: vec![false; faces.len()],
        least,
        faces,
        at,
        wish,
    };
    let mut removed = 0;
    // A vertex is tried again only where something has changed at it.
    let mut tried: FxHashMap<u32, u32> = FxHashMap::default();
    loop {
        let mut done = 0;
        for v in work.candidates() {
            let last = tried.insert(v, work.mesh.now());
            if last.is_none_or(|time| work.mesh.is_touched(v, time))
                && let Some(collapse) = work.find(v)
            {
                work.apply(v, &collapse);
                done += 1;
            }
        }
        removed += done;
        if done == 0 {
            break;
        }
    }
    let Work { mesh, gone, .. } = work;
    *tets = mesh.into_tets();
    let mut gone = gone.into_iter();
    faces.retain(|_| gone.next() == Some(false));
    removed
}

/// Sine of the sharpest corner of a triangle: half of the inverse of its radius-edge ratio.
fn sine_of_sharpest([a, b, c]: [DVec3; 3]) -> f64 {
    let sides = [b - c, c - a, a - b].map(DVec3::length);
    let twice_area = (b - a).cross(c - a).length();
    let shortest = sides.into_iter().fold(f64::INFINITY, f64::min);
    // By the law of sines.
    twice_area * shortest / sides.into_iter().product::<f64>()
}

impl Work<'_, '_> {
    /// Vertices that may go, those with the shortest edges first.
    fn candidates(&self) -> Vec<u32> {
        let all = self.wish.first..self.mesh.positions.len() as u32;
        let mut list: Vec<(f64, u32)> = all
            .filter(|&v| !self.mesh.star(v).is_empty())
            .map(|v| (self.shortest(v), v))
            .collect();
        list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        list.into_iter().map(|(_, v)| v).collect()
    }

    /// The other corners of the tetrahedra at a vertex, each as often as there is one.
    fn others(&self, v: u32) -> impl Iterator<Item = u32> + use<'_> {
        let all = self.mesh.star(v).iter().flat_map(|&t| self.mesh.corners(t));
        all.filter(move |&u| u != v)
    }

    /// Square of a distance.
    fn square(&self, a: u32, b: u32) -> f64 {
        self.mesh.positions[a as usize].distance_squared(self.mesh.positions[b as usize])
    }

    /// Square of the shortest edge at a vertex.
    fn shortest(&self, v: u32) -> f64 {
        let squares = self.others(v).map(|u| self.square(u, v));
        squares.fold(f64::INFINITY, f64::min)
    }

    /// Neighbours that a vertex may go to, the nearest first.
    fn targets(&self, v: u32) -> Vec<u32> {
        let mut list: Vec<u32> = match self.at.get(&v) {
            None => self.others(v).collect(),
            Some(around) => self.along_surface(v, around),
        };
        list.sort_unstable();
        list.dedup();
        list.sort_by(|&a, &b| self.square(a, v).total_cmp(&self.square(b, v)));
        list
    }

    /// Neighbours to which a vertex may go within the facet that it is in, or along the edge of facets that it divides. The
    /// mesher's own vertices are on straight edges only.
    fn along_surface(&self, v: u32, around: &[u32]) -> Vec<u32> {
        // Each neighbour, with the facets at the edge to it.
        let mut edges: Vec<(u32, u32)> = Vec::with_capacity(2 * around.len());
        for &t in around {
            let Face { corners, facet, .. } = self.faces[t as usize];
            let others = corners.into_iter().filter(|&u| u != v);
            edges.extend(others.map(|u| (u, facet)));
        }
        edges.sort_unstable();
        let is_inside = |edge: &[(u32, u32)]| matches!(edge, [(_, a), (_, b)] if a == b);
        let by_edge = || edges.chunk_by(|a, b| a.0 == b.0);
        let borders: Vec<u32> = by_edge()
            .filter(|edge| !is_inside(edge))
            .map(|edge| edge[0].0)
            .collect();
        match borders.len() {
            0 => by_edge().map(|edge| edge[0].0).collect(),
            2 => borders,
            _ => Vec::new(),
        }
    }

    /// The neighbour to which a vertex goes best, if what is left is good enough.
    fn find(&self, v: u32) -> Option<Collapse> {
        let old = self.mesh.star(v);
        let (worst, most) = self.mesh.bounds(old, 0.0, 0.0);
        let mut least = worst.clamp(self.least, 1.0);
        let mut best = None;
        for to in self.targets(v) {
            if let Some(collapse) = self.collapse((v, to), least, most) {
                least = collapse.least;
                best = Some(collapse);
            }
        }
        best
    }

    /// What is there if a vertex goes to a neighbour, if all of it has some quality and is not too large.
    fn collapse(&self, (v, to): (u32, u32), least: f64, most: f64) -> Option<Collapse> {
        let old = self.mesh.star(v);
        let mut new = Vec::with_capacity(old.len());
        let mut worst = f64::INFINITY;
        for &t in old {
            let corners = self.mesh.corners(t);
            if corners.contains(&to) {
                continue;
            }
            let corners = corners.map(|u| if u == v { to } else { u });
            let region = self.mesh.region(t);
            let grade = self.mesh.of_corners(corners);
            if grade.quality < least || !self.fits((corners, region), grade.six_volume, most) {
                return None;
            }
            worst = worst.min(grade.quality);
            new.push((corners, grade, region));
        }
        self.keeps_corners(v, to).then_some(Collapse {
            to,
            least: worst,
            new,
        })
    }

    /// Whether the corners of those faces at a vertex that stay are as wide then as the radius-edge bound asks for, or as they were: what is
    /// sharper there, no element can mend.
    fn keeps_corners(&self, v: u32, to: u32) -> bool {
        let at = self.at.get(&v).map_or(&[][..], Vec::as_slice);
        let sharpest = |corners: [u32; 3]| {
            let [a, b, c] = corners.map(|u| self.mesh.positions[u as usize]);
            sine_of_sharpest([a, b, c])
        };
        let faces = || {
            let all = at.iter().map(|&t| &self.faces[t as usize]);
            all.filter(|face| face.stays).map(|face| face.corners)
        };
        let before = faces().map(sharpest).fold(f64::INFINITY, f64::min);
        let least = before.min(0.5 / self.wish.radius_edge);
        let mut after = faces().filter(|corners| !corners.contains(&to));
        after.all(|corners| sharpest(corners.map(|u| if u == v { to } else { u })) >= least)
    }

    /// Whether a size is within the limits, or below what there was before.
    fn fits(&self, (corners, region): (Corners, u32), six_volume: f64, before: f64) -> bool {
        let here = || {
            let points = corners.map(|v| self.mesh.positions[v as usize]);
            points.into_iter().sum::<DVec3>() * 0.25
        };
        let local = self.wish.local.map(|local| 6.0 * HALVED * local(here()));
        self.mesh.fits(region, six_volume, before)
            && local.is_none_or(|most| six_volume <= most.max(before))
    }

    fn apply(&mut self, v: u32, collapse: &Collapse) {
        self.mesh.renew();
        let mut regions: Vec<u32> = self
            .mesh
            .star(v)
            .iter()
            .map(|&t| self.mesh.region(t))
            .collect();
        regions.sort_unstable();
        regions.dedup();
        for region in regions {
            // Numbers change with each replacement.
            let star = self.mesh.star(v).iter().copied();
            let old: Vec<u32> = star.filter(|&t| self.mesh.region(t) == region).collect();
            let new = collapse.new.iter().filter(|new| new.2 == region);
            let new: Vec<(Corners, Grade)> = new.map(|new| (new.0, new.1)).collect();
            self.mesh.replace(&old, &new);
        }
        for t in self.at.remove(&v).unwrap_or_default() {
            let corners = self.faces[t as usize].corners;
            if corners.contains(&collapse.to) {
                self.gone[t as usize] = true;
                for u in corners {
                    if let Some(at) = self.at.get_mut(&u) {
                        at.retain(|&s| s != t);
                    }
                }
            } else {
                self.faces[t as usize].corners =
                    corners.map(|u| if u == v { collapse.to } else { u });
                self.at.entry(collapse.to).or_default().push(t);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::measure::{tet_volume, triangle_area};
    use geom::tet::TetMeasures;

    /// A cube of `n` by `n` by `n` cells of six tetrahedra each, in two regions, below and above the middle, with the faces of its
    /// sides and of the middle; the corners of two by two by two larger cells come first.
    fn cubes(n: u32) -> (Vec<DVec3>, Vec<Tet>, Vec<Face>) {
        let coarse = n / 2;
        let mut grid: Vec<[u32; 3]> = (0..(n + 1).pow(3))
            .map(|i| [i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1).pow(2)])
            .collect();
        grid.sort_by_key(|p| p.iter().any(|c| c % coarse != 0));
        let number: FxHashMap<[u32; 3], u32> = grid
            .iter()
            .enumerate()
            .map(|(i, &p)| (p, i as u32))
            .collect();
        let mut tets = Vec::new();
        let mut around: FxHashMap<[u32; 3], Vec<(u32, [u32; 3])>> = FxHashMap::default();
        for cell in grid.iter().filter(|p| p.iter().all(|&c| c < n)) {
            let region = 1 + u32::from(cell[2] >= coarse);
            for order in [
                [0, 1, 2],
                [1, 2, 0],
                [2, 0, 1],
                [1, 0, 2],
                [0, 2, 1],
                [2, 1, 0],
            ] {
                let mut at = *cell;
                let mut corners = [number[&at]; 4];
                for (i, axis) in order.into_iter().enumerate() {
                    at[axis] += 1;
                    corners[i + 1] = number[&at];
                }
                if matches!(order, [1, 0, 2] | [0, 2, 1] | [2, 1, 0]) {
                    corners.swap(2, 3);
                }
                tets.push(Tet {
                    vertices: corners,
                    region,
                });
                for [i, j, k] in geom::tet::FACES {
                    let face = [i, j, k].map(|i| corners[i]);
                    let mut key = face;
                    key.sort_unstable();
                    around.entry(key).or_default().push((region, face));
                }
            }
        }
        let mut faces = Vec::new();
        for sides in around.values() {
            let corners = sides[0].1;
            // Its side of the cube, or the middle.
            let on = |axis: usize, at: u32| corners.iter().all(|&v| grid[v as usize][axis] == at);
            let sides_of_cube = (0..6).find(|i| on(i / 2, n * (i % 2) as u32));
            let facet = match sides[..] {
                [_] => sides_of_cube,
                [a, b] if a.0 != b.0 => Some(6),
                _ => None,
            };
            faces.extend(facet.map(|facet| Face {
                corners,
                facet: facet as u32,
                number: 10 + facet as u32,
                stays: false,
            }));
        }
        faces.sort_by_key(|f| f.corners);
        let points = grid.iter().map(|p| p.map(f64::from).into()).collect();
        (points, tets, faces)
    }

    fn wish(max_volume: &FxHashMap<u32, f64>) -> Coarse<'_> {
        Coarse {
            angle: 25.0,
            min_dihedral: 10.0,
            radius_edge: 1.4,
            leaves: Leaves::Mendable,
            max_volume,
            local: None,
            first: 27,
        }
    }

    /// Volumes of regions, and areas of facets.
    fn measures(points: &[DVec3], tets: &[Tet], faces: &[Face]) -> ([f64; 3], [f64; 7]) {
        let at = |v: u32| points[v as usize];
        let (mut volumes, mut areas) = ([0.0; 3], [0.0; 7]);
        for t in tets {
            let [a, b, c, d] = t.vertices.map(at);
            assert!(tet_volume(a, b, c, d) > 0.0);
            volumes[t.region as usize] += tet_volume(a, b, c, d);
        }
        for face in faces {
            let [a, b, c] = face.corners.map(at);
            assert_eq!(face.number, 10 + face.facet);
            areas[face.facet as usize] += triangle_area(a, b, c);
        }
        (volumes, areas)
    }

    #[test]
    fn what_is_not_needed_goes_and_the_shape_stays() {
        let (points, mut tets, mut faces) = cubes(8);
        let (count, before) = (tets.len(), measures(&points, &tets, &faces));
        let none = FxHashMap::default();
        let removed = coarsen(points.clone(), &mut tets, &mut faces, &wish(&none));
        assert!(
            removed > 300 && tets.len() < count / 2,
            "{removed} {}",
            tets.len()
        );
        let after = measures(&points, &tets, &faces);
        for (a, b) in before
            .0
            .iter()
            .zip(after.0)
            .chain(before.1.iter().zip(after.1))
        {
            assert!((a - b).abs() < 1e-9, "{before:?} {after:?}");
        }
        // What is left is conforming: each face of a tetrahedron is that of another, or on the surface, and all of that is.
        let mut sides: FxHashMap<[u32; 3], Vec<u32>> = FxHashMap::default();
        for t in &tets {
            for face in geom::tet::FACES {
                let mut key = face.map(|i| t.vertices[i]);
                key.sort_unstable();
                sides.entry(key).or_default().push(t.region);
            }
        }
        let mut of_surface: Vec<[u32; 3]> = faces.iter().map(|f| f.corners).collect();
        of_surface.iter_mut().for_each(|f| f.sort_unstable());
        for (key, regions) in sides {
            let inside = matches!(regions[..], [a, b] if a == b);
            assert!(
                regions.len() <= 2 && inside != of_surface.contains(&key),
                "{key:?}"
            );
        }
        // Twice is the same as once.
        let left = tets.clone();
        assert_eq!(coarsen(points, &mut tets, &mut faces, &wish(&none)), 0);
        assert_eq!(tets.len(), left.len());
    }

    #[test]
    fn the_first_vertices_stay() {
        let (points, mut tets, mut faces) = cubes(4);
        let none = FxHashMap::default();
        let all = Coarse {
            first: points.len() as u32,
            ..wish(&none)
        };
        let (old, before) = (tets.clone(), faces.clone());
        assert_eq!(coarsen(points, &mut tets, &mut faces, &all), 0);
        assert!(tets == old && faces == before);
    }

    #[test]
    fn good_elements_stay_good_and_small() {
        let (points, mut tets, mut faces) = cubes(8);
        let goal = Goal::new(25.0, 1.4, 0.0).lenient();
        let quality = |t: &Tet| goal.grade(t.vertices.map(|v| points[v as usize])).quality;
        let size = |t: &Tet| {
            let [a, b, c, d] = t.vertices.map(|v| points[v as usize]);
            tet_volume(a, b, c, d)
        };
        let least = |tets: &[Tet]| tets.iter().map(quality).fold(f64::INFINITY, f64::min);
        let before = least(&tets);
        // Of both regions, one may grow.
        let limits = FxHashMap::from_iter([(1, 0.4)]);
        assert!(coarsen(points.clone(), &mut tets, &mut faces, &wish(&limits)) > 0);
        assert!(least(&tets) >= before.min(1.0));
        let largest = |region: u32| {
            let own = tets.iter().filter(|t| t.region == region);
            own.map(size).fold(0.0, f64::max)
        };
        assert!(
            largest(1) <= 0.2 && largest(2) > 0.3,
            "{} {}",
            largest(1),
            largest(2)
        );
        // And as a size from place to place has it.
        let (_, mut tets, mut faces) = cubes(8);
        let none = FxHashMap::default();
        let local = |p: DVec3| if p.x < 4.0 { 0.4 } else { 9.0 };
        let local = Coarse {
            local: Some(&local),
            ..wish(&none)
        };
        assert!(coarsen(points.clone(), &mut tets, &mut faces, &local) > 0);
        for t in &tets {
            let middle = t
                .vertices
                .iter()
                .map(|&v| points[v as usize])
                .sum::<DVec3>()
                * 0.25;
            assert!(middle.x >= 4.0 || size(t) <= 0.2);
        }
        assert!(tets.iter().any(|t| size(t) > 0.3));
    }

    #[test]
    fn nothing_is_left_past_a_bound_that_is_kept() {
        let past = |leaves: Leaves| {
            let (points, mut tets, mut faces) = cubes(8);
            let none = FxHashMap::default();
            let wish = Coarse {
                leaves,
                ..wish(&none)
            };
            let removed = coarsen(points.clone(), &mut tets, &mut faces, &wish);
            assert!(removed > 100, "{removed}");
            let ratio = |t: &Tet| {
                let corners = t.vertices.map(|v| points[v as usize]);
                TetMeasures::of(corners).radius_edge_ratio
            };
            tets.iter().filter(|t| ratio(t) > 0.8 * 1.4).count()
        };
        assert_eq!(past(Leaves::Within(0.8)), 0);
        assert!(past(Leaves::Mendable) > 0);
    }

    /// Cubes whose vertices are not evenly apart: those that may go are shifted along each axis on its own, so that what is in a plane stays there.
    fn uneven_cubes() -> (Vec<DVec3>, Vec<Tet>, Vec<Face>) {
        let shifted = |x: f64, along: f64| match x {
            0.0 | 4.0 | 8.0 => x,
            x => x + 0.4 * (7.0 * x + along).sin(),
        };
        let (mut points, tets, faces) = cubes(8);
        for p in &mut points[27..] {
            *p = DVec3::new(shifted(p.x, p.y), shifted(p.y, p.z), shifted(p.z, p.x));
        }
        (points, tets, faces)
    }

    #[test]
    fn only_good_elements_are_new_where_that_is_asked_for() {
        let (points, given, given_faces) = uneven_cubes();
        let new_and_bad = |leaves: Leaves| {
            let (mut tets, mut faces) = (given.clone(), given_faces.clone());
            let none = FxHashMap::default();
            let wish = Coarse {
                leaves,
                ..wish(&none)
            };
            assert!(coarsen(points.clone(), &mut tets, &mut faces, &wish) > 0);
            let is_bad = |t: &&Tet| {
                let measures = TetMeasures::of(t.vertices.map(|v| points[v as usize]));
                measures.min_dihedral().to_degrees() < 25.0 || measures.radius_edge_ratio > 1.4
            };
            let new = tets.iter().filter(|t| !given.contains(t));
            new.filter(is_bad).count()
        };
        assert_eq!(new_and_bad(Leaves::Good), 0);
        assert!(new_and_bad(Leaves::Mendable) > 0);
    }

    #[test]
    fn faces_that_stay_keep_wide_corners() {
        let bound = 1.4;
        let sharpest_left = |stays: bool| {
            let (points, mut tets, mut faces) = uneven_cubes();
            faces.iter_mut().for_each(|face| face.stays = stays);
            let none = FxHashMap::default();
            assert!(coarsen(points.clone(), &mut tets, &mut faces, &wish(&none)) > 100);
            let corners = faces.iter().map(|face| face.corners);
            let sines = corners.map(|face| sine_of_sharpest(face.map(|v| points[v as usize])));
            sines.fold(f64::INFINITY, f64::min)
        };
        assert!(sharpest_left(true) >= 0.5 / bound);
        assert!(sharpest_left(false) < 0.5 / bound);
    }

    #[test]
    fn corners_of_triangles_are_measured() {
        let sine = sine_of_sharpest([DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.75_f64.sqrt(), 0.0)]);
        assert!((sine - 60_f64.to_radians().sin()).abs() < 1e-12);
        let sine = sine_of_sharpest([DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]);
        assert!((sine - 0.5_f64.sqrt()).abs() < 1e-12);
    }
}

//! The cells a triangle complex divides space into.
//!
//! Components of triangle sides (see [`crate::complex::sides`]) bound cells from one side each. A connected
//! piece of the complex, a *shell*, has one component on its outer side, the one that encloses a
//! negative volume; which cell that one lies in is settled by a ray from an extreme vertex of the
//! shell to the next triangle of another shell. Compare "Mesh Arrangements for Solid Geometry",
//! Zhou et al. 2016, section 3.3, which uses closest points where we use rays.

use crate::complex::edges::Edges;
use crate::complex::sides::{SideComponents, side_components};
use crate::element::measure::tet_volume;
use crate::sets::DisjointSets;
use crate::tree::{Direction, Met, Rays};
use glam::DVec3;
use std::cell::OnceCell;

const NONE: u32 = u32::MAX;
const MANY: u32 = u32::MAX - 1;

/// The cells of a triangle complex whose triangles meet in common vertices and edges only.
pub struct Cells<'a> {
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    /// Cell of each side: front of triangle `t` at `2 t`, back at `2 t + 1`.
    side: Vec<u32>,
    count: usize,
    rays: OnceCell<Rays<'a>>,
}

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the interior of this cell.
    Cell(u32),
    /// On this triangle.
    Triangle(u32),
}

impl<'a> Cells<'a> {
    /// The unbounded cell.
    pub const UNBOUNDED: u32 = 0;

    /// Finds the cells. O(n log n); linear for a complex in one piece.
    pub fn new(vertices: &'a [DVec3], triangles: &'a [[u32; 3]], edges: &Edges) -> Self {
        let sides = side_components(vertices, triangles, edges);
        let mut cells = Self {
            vertices,
            triangles,
            side: Vec::new(),
            count: 0,
            rays: OnceCell::new(),
        };
        let (shell, shells) = shells(&sides);
        let outer = outer_components(vertices, triangles, &sides, &shell, shells);
        // Component i is set i + 1; set 0 is what lies beyond everything.
        let mut sets = DisjointSets::new(sides.count + 1);
        if shells == 1 {
            sets.join(0, outer[0] + 1);
        } else {
            for (s, around) in cells
                .surroundings(&sides, &shell, &outer)
                .into_iter()
                .enumerate()
            {
                sets.join(outer[s] + 1, around.map_or(0, |c| c + 1));
            }
        }
        let (label, count) = sets.numbered();
        cells.side = sides
            .component
            .iter()
            .map(|&c| label[c as usize + 1])
            .collect();
        cells.count = count;
        cells
    }

    /// Number of cells, the unbounded one included.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Cell on the side the triangle's normal points to.
    pub fn front(&self, triangle: usize) -> u32 {
        self.side[2 * triangle]
    }

    /// Cell on the other side.
    pub fn back(&self, triangle: usize) -> u32 {
        self.side[2 * triangle + 1]
    }

    /// The cell a point lies in, by a ray to the next triangle; exact but for the order of triangles
    /// whose distances from the point agree to rounding. O(log n) where few boxes overlap.
    pub fn locate(&self, point: DVec3) -> Place {
        match self.rays().nearest(point, Direction::ALL[0], |_| true) {
            Met::Nothing => Place::Cell(Self::UNBOUNDED),
            Met::Touches(t) => Place::Triangle(t),
            Met::Hit(hit) if hit.front => Place::Cell(self.front(hit.triangle as usize)),
            Met::Hit(hit) => Place::Cell(self.back(hit.triangle as usize)),
        }
    }

    fn rays(&self) -> &Rays<'a> {
        self.rays
            .get_or_init(|| Rays::new(self.vertices, self.triangles))
    }

    /// For each shell, the component of another shell's sides that bounds the same cell as the
    /// shell's outer side, or `None` for the unbounded cell.
    fn surroundings(
        &self,
        sides: &SideComponents,
        shell: &[u32],
        outer: &[u32],
    ) -> Vec<Option<u32>> {
        let mut shell_of = vec![NONE; self.vertices.len()];
        for (t, triangle) in self.triangles.iter().enumerate() {
            for &v in triangle {
                let s = &mut shell_of[v as usize];
                *s = match *s {
                    NONE => shell[t],
                    same if same == shell[t] => same,
                    _ => MANY,
                };
            }
        }
        let extremes = self.extremes(shell, outer.len());
        let seen = |triangle: u32, front: bool| {
            if front {
                sides.front(triangle as usize)
            } else {
                sides.back(triangle as usize)
            }
        };
        (0..outer.len())
            .map(|s| {
                for (along, extreme) in Direction::ALL.into_iter().zip(&extremes[s]) {
                    if shell_of[*extreme as usize] == MANY {
                        continue;
                    }
                    let from = self.vertices[*extreme as usize];
                    let other = |t: u32| shell[t as usize] != s as u32;
                    match self.rays().nearest(from, along, other) {
                        Met::Nothing => return None,
                        Met::Hit(hit) => return Some(seen(hit.triangle, hit.front)),
                        Met::Touches(_) => {}
                    }
                }
                self.surroundings_from_within(s as u32, shell, outer, seen)
            })
            .collect()
    }

    /// For a shell that touches others at all its extreme vertices: the component met first, from a
    /// point on the shell, among those that surround the point.
    fn surroundings_from_within(
        &self,
        s: u32,
        shell: &[u32],
        outer: &[u32],
        seen: impl Fn(u32, bool) -> u32,
    ) -> Option<u32> {
        let area = |t: usize| {
            let [a, b, c] = self.triangles[t].map(|v| self.vertices[v as usize]);
            (b - a).cross(c - a).length_squared()
        };
        let largest = (0..self.triangles.len())
            .filter(|&t| shell[t] == s)
            .max_by(|&t, &u| area(t).total_cmp(&area(u)).then(u.cmp(&t)))?;
        let [a, b, c] = self.triangles[largest].map(|v| self.vertices[v as usize]);
        let from = (a + b + c) / 3.0;
        let other = |t: u32| shell[t as usize] != s;
        let mut passed = rustc_hash::FxHashSet::default();
        for hit in self.rays().all(from, Direction::ALL[0], other) {
            let component = seen(hit.triangle, hit.front);
            let around = shell[hit.triangle as usize];
            if passed.insert(around) && component != outer[around as usize] {
                return Some(component);
            }
        }
        None
    }

    /// Per shell, its extreme vertex in each of the six directions; ties are broken by the other two
    /// coordinates of the direction's view, in which the ray's origin counts as moved forward.
    fn extremes(&self, shell: &[u32], shells: usize) -> Vec<[u32; 6]> {
        let mut extremes = vec![[NONE; 6]; shells];
        for (t, triangle) in self.triangles.iter().enumerate() {
            for &v in triangle {
                let p = self.vertices[v as usize];
                for (along, best) in Direction::ALL
                    .into_iter()
                    .zip(&mut extremes[shell[t] as usize])
                {
                    let beyond = *best == NONE || {
                        let q = along.view(self.vertices[*best as usize]);
                        let p = along.view(p);
                        [p.x, p.y, p.z] > [q.x, q.y, q.z]
                    };
                    if beyond {
                        *best = v;
                    }
                }
            }
        }
        extremes
    }
}

/// Shell of each triangle: pieces connected through edges; and their number.
fn shells(sides: &SideComponents) -> (Vec<u32>, usize) {
    let triangles = sides.component.len() / 2;
    let mut sets = DisjointSets::new(sides.count);
    for t in 0..triangles {
        sets.join(sides.front(t), sides.back(t));
    }
    let (label, count) = sets.numbered();
    let shell = (0..triangles)
        .map(|t| label[sides.front(t) as usize])
        .collect();
    (shell, count)
}

/// Per shell, the component on its outer side. Seen from a cell, a component that bounds it from
/// within encloses a negative volume, and a shell has one such component.
fn outer_components(
    vertices: &[DVec3],
    triangles: &[[u32; 3]],
    sides: &SideComponents,
    shell: &[u32],
    shells: usize,
) -> Vec<u32> {
    let mut origin = vec![None; shells];
    let mut volume = vec![0.0_f64; sides.count];
    let mut shell_of_component = vec![0; sides.count];
    for (t, &triangle) in triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|v| vertices[v as usize]);
        let origin = *origin[shell[t] as usize].get_or_insert(a);
        let v = tet_volume(origin, a, b, c);
        volume[sides.back(t) as usize] += v;
        volume[sides.front(t) as usize] -= v;
        shell_of_component[sides.back(t) as usize] = shell[t];
        shell_of_component[sides.front(t) as usize] = shell[t];
    }
    let mut outer = vec![NONE; shells];
    for (component, &s) in shell_of_component.iter().enumerate() {
        let best = &mut outer[s as usize];
        if *best == NONE || volume[component] < volume[*best as usize] {
            *best = component as u32;
        }
    }
    outer
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds a box with outward triangles; returns the index of its first triangle.
    fn add_box(
        vertices: &mut Vec<DVec3>,
        triangles: &mut Vec<[u32; 3]>,
        low: DVec3,
        high: DVec3,
    ) -> usize {
        let base = vertices.len() as u32;
        for i in 0..8 {
            let pick = |bit: u32, a: f64, b: f64| if i >> bit & 1 == 0 { a } else { b };
            vertices.push(DVec3::new(
                pick(0, low.x, high.x),
                pick(1, low.y, high.y),
                pick(2, low.z, high.z),
            ));
        }
        let first = triangles.len();
        for [a, b, c, d] in [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ] {
            triangles.push([a, b, c].map(|v| v + base));
            triangles.push([a, c, d].map(|v| v + base));
        }
        first
    }

    #[test]
    fn nested_and_separate_boxes() {
        let (mut v, mut t) = (Vec::new(), Vec::new());
        let cube = |r: f64| (DVec3::splat(-r), DVec3::splat(r));
        let mut firsts = Vec::new();
        for r in [3.0, 1.0, 2.0] {
            let (low, high) = cube(r);
            firsts.push(add_box(&mut v, &mut t, low, high));
        }
        // Beside, in the shadow of the others along x, and inside the middle one, touching nothing.
        let low = DVec3::new(-9.0, -1.0, -1.0);
        firsts.push(add_box(&mut v, &mut t, low, low + DVec3::ONE));
        let cells = Cells::new(&v, &t, &Edges::new(&t));
        assert_eq!(cells.count(), 5);
        let [large, small, middle, beside] = [0, 1, 2, 3].map(|i| firsts[i]);
        assert_eq!(cells.front(large), Cells::UNBOUNDED);
        assert_eq!(cells.front(beside), Cells::UNBOUNDED);
        assert_eq!(cells.back(large), cells.front(middle));
        assert_eq!(cells.back(middle), cells.front(small));
        assert_eq!(cells.locate(DVec3::ZERO), Place::Cell(cells.back(small)));
        assert_eq!(
            cells.locate(DVec3::splat(1.5)),
            Place::Cell(cells.back(middle))
        );
        assert_eq!(
            cells.locate(DVec3::splat(9.0)),
            Place::Cell(Cells::UNBOUNDED)
        );
        assert!(matches!(
            cells.locate(DVec3::new(3.0, 0.5, 0.25)),
            Place::Triangle(_)
        ));
    }

    #[test]
    fn boxes_that_touch_at_vertices_only() {
        // A box around an octahedron that touches it at all six extreme vertices: the box's faces
        // are fans about the octahedron's vertices.
        let mut v: Vec<DVec3> = (0..8)
            .map(|i| {
                let s = |bit: u32| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
                DVec3::new(s(0), s(1), s(2))
            })
            .collect();
        v.extend([
            -DVec3::Z,
            DVec3::Z,
            -DVec3::Y,
            DVec3::Y,
            -DVec3::X,
            DVec3::X,
        ]);
        let mut t = Vec::new();
        for (face, quad) in [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ]
        .into_iter()
        .enumerate()
        {
            for i in 0..4 {
                t.push([8 + face as u32, quad[i], quad[(i + 1) % 4]]);
            }
        }
        let first = t.len();
        for octant in 0..8_u32 {
            let [x, y, z] = [octant & 1, octant >> 1 & 1, octant >> 2];
            let corner = [12 + x, 10 + y, 8 + z];
            let outward = (x + y + z) % 2 == 1;
            t.push(if outward {
                corner
            } else {
                [corner[0], corner[2], corner[1]]
            });
        }
        let cells = Cells::new(&v, &t, &Edges::new(&t));
        assert_eq!(cells.count(), 3);
        assert_eq!(cells.front(0), Cells::UNBOUNDED);
        assert_eq!(cells.front(first), cells.back(0));
        assert_eq!(cells.locate(DVec3::ZERO), Place::Cell(cells.back(first)));
    }
}

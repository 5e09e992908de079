//! What the tests share.

#![allow(dead_code)] // Not every test needs all of it.

use glam::DVec3;
use interchange::MeshStream;
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Tet, Triangle};

/// A mesh in memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    pub points: Vec<DVec3>,
    pub tets: Vec<Tet>,
    pub triangles: Vec<Triangle>,
}

/// Gathers a stream, and checks that it keeps its word.
pub fn gather(stream: &dyn MeshStream) -> Mesh {
    let mut mesh = Mesh::default();
    stream
        .points(&mut |points| {
            mesh.points.extend(points);
            Ok(())
        })
        .unwrap();
    let mut regions: Vec<u32> = Vec::new();
    stream
        .tet_regions(&mut |block| {
            regions.extend(block.regions);
            Ok(())
        })
        .unwrap();
    stream
        .tets(&mut |block| {
            let both = block.vertices.iter().zip(block.regions);
            mesh.tets
                .extend(both.map(|(&vertices, &region)| Tet { vertices, region }));
            Ok(())
        })
        .unwrap();
    stream
        .triangles(&mut |block| {
            for i in 0..block.vertices.len() {
                let vertices = block.vertices[i];
                mesh.triangles.push(Triangle {
                    vertices,
                    marker: block.markers[i],
                    front: block.front[i],
                    back: block.back[i],
                });
            }
            Ok(())
        })
        .unwrap();
    let mut next = 0;
    stream
        .facets(&mut |block| {
            for (vertices, corners) in block.vertices.iter().zip(block.corners) {
                assert_eq!(*vertices, mesh.triangles[next].vertices);
                assert_eq!(*corners, vertices.map(|v| mesh.points[v as usize]));
                next += 1;
            }
            Ok(())
        })
        .unwrap();
    assert_eq!(next, mesh.triangles.len());
    assert_eq!(stream.point_count(), mesh.points.len() as u64);
    assert_eq!(stream.tet_count(), mesh.tets.len() as u64);
    assert_eq!(stream.triangle_count(), mesh.triangles.len() as u64);
    assert!(mesh.tets.iter().map(|t| t.region).eq(regions));
    mesh
}

impl Mesh {
    fn at(&self, v: u32) -> DVec3 {
        self.points[v as usize]
    }

    /// Volume of one region's tetrahedra.
    pub fn volume(&self, region: u32) -> f64 {
        let tets = self.tets.iter().filter(|t| t.region == region);
        tets.map(|t| {
            let [a, b, c, d] = t.vertices.map(|v| self.at(v));
            (b - a).cross(c - a).dot(d - a) / 6.0
        })
        .sum()
    }

    /// Smallest volume of a tetrahedron.
    pub fn smallest(&self) -> f64 {
        let volume = |t: &Tet| {
            let [a, b, c, d] = t.vertices.map(|v| self.at(v));
            (b - a).cross(c - a).dot(d - a) / 6.0
        };
        self.tets.iter().map(volume).fold(f64::INFINITY, f64::min)
    }

    /// Smallest distance between two points, if below `limit`: a grid search.
    pub fn closest_pair(&self, limit: f64) -> Option<f64> {
        let cell = |p: DVec3| (p / limit).floor().as_i64vec3().to_array();
        let mut grid: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (i, &p) in self.points.iter().enumerate() {
            grid.entry(cell(p)).or_default().push(i);
        }
        let mut closest = limit;
        for (i, &p) in self.points.iter().enumerate() {
            let [x, y, z] = cell(p);
            for n in 0..27 {
                let near = [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1];
                for &j in grid.get(&near).into_iter().flatten() {
                    if j != i {
                        closest = closest.min((self.points[j] - p).length());
                    }
                }
            }
        }
        (closest < limit).then_some(closest)
    }

    /// Checks that the mesh is conforming: each face of a tetrahedron has another tetrahedron of
    /// the same region behind it, or a triangle with the right regions on its sides; and triangles
    /// are nowhere else.
    pub fn assert_conforming(&self) {
        // Per face, sorted: regions of the tets on it by side (even or odd permutation).
        let mut faces: BTreeMap<[u32; 3], [Vec<u32>; 2]> = BTreeMap::new();
        for tet in &self.tets {
            let [a, b, c, d] = tet.vertices;
            // Outward normals.
            for face in [[a, c, b], [a, b, d], [b, c, d], [a, d, c]] {
                let (key, odd) = sorted(face);
                faces.entry(key).or_default()[usize::from(odd)].push(tet.region);
            }
        }
        let mut found: BTreeMap<[u32; 3], Vec<[u32; 2]>> = BTreeMap::new();
        for triangle in &self.triangles {
            // A tet behind the triangle has it as a face with outward normal: same winding.
            let (key, odd) = sorted(triangle.vertices);
            let sides = [triangle.back, triangle.front];
            let sides = if odd { [sides[1], sides[0]] } else { sides };
            found.entry(key).or_default().push(sides);
        }
        for (face, sides) in &faces {
            let region = |side: &Vec<u32>| match side[..] {
                [] => OUTSIDE,
                [region] => region,
                _ => panic!("face {face:?} has two tetrahedra on one side"),
            };
            let sides = [region(&sides[0]), region(&sides[1])];
            let expected: &[[u32; 2]] = if sides[0] == sides[1] { &[] } else { &[sides] };
            let triangles = found.remove(face).unwrap_or_default();
            assert_eq!(triangles, expected, "face {face:?}");
        }
        assert!(found.is_empty(), "triangles that are no face: {found:?}");
    }

    /// Checks that each edge of the outer boundary has as many triangles one way as the other.
    pub fn assert_closed(&self) {
        let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for t in &self.triangles {
            let [a, b, c] = t.vertices;
            let way = i32::from(t.back != OUTSIDE) - i32::from(t.front != OUTSIDE);
            for [p, q] in [[a, b], [b, c], [c, a]] {
                let sign = if p < q { way } else { -way };
                *edges.entry([p.min(q), p.max(q)]).or_default() += sign;
            }
        }
        assert!(edges.values().all(|&n| n == 0), "the boundary is open");
    }

    /// Checks that `map` of the world permutes points (within `tolerance`), tetrahedra and
    /// triangles.
    pub fn assert_symmetric(&self, map: impl Fn(DVec3) -> DVec3, tolerance: f64) {
        let cell = |p: DVec3| (p / (8.0 * tolerance)).round().as_i64vec3().to_array();
        let mut grid: BTreeMap<[i64; 3], u32> = BTreeMap::new();
        for (i, &p) in self.points.iter().enumerate() {
            grid.insert(cell(p), i as u32);
        }
        let image: Vec<u32> = self
            .points
            .iter()
            .map(|&p| {
                let q = map(p);
                let [x, y, z] = cell(q);
                (0..27)
                    .filter_map(|n| grid.get(&[x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]))
                    .copied()
                    .find(|&j| (self.at(j) - q).length() <= tolerance)
                    .unwrap_or_else(|| panic!("{p} has no image at {q}"))
            })
            .collect();
        let sorted_tets = |map: &dyn Fn(u32) -> u32| {
            let mut all: Vec<_> = self
                .tets
                .iter()
                .map(|t| {
                    let mut v = t.vertices.map(map);
                    v.sort_unstable();
                    (v, t.region)
                })
                .collect();
            all.sort_unstable();
            all
        };
        assert!(sorted_tets(&|v| v) == sorted_tets(&|v| image[v as usize]));
        let sorted_triangles = |map: &dyn Fn(u32) -> u32| {
            let mut all: Vec<_> = self
                .triangles
                .iter()
                .map(|t| (sorted(t.vertices.map(map)).0, t.marker))
                .collect();
            all.sort_unstable();
            all
        };
        assert!(sorted_triangles(&|v| v) == sorted_triangles(&|v| image[v as usize]));
    }
}

/// Vertices in increasing order, and whether that takes an odd permutation.
fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let mut v = [a, b, c];
    v.sort_unstable();
    let even = [[a, b, c], [b, c, a], [c, a, b]].contains(&v);
    (v, !even)
}

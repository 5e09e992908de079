//! Polygons by distinct points, broken into triangles.

use crate::facet::triangles_of;
use crate::welded::welded;
use glam::DVec3;
use interchange::parsed::Faces;

/// Triangles by distinct points.
pub struct Welded {
    /// Distinct points, in order of first appearance.
    pub points: Vec<DVec3>,
    /// Three points each, which may be the same.
    pub triangles: Vec<[u32; 3]>,
    /// Group of each triangle.
    pub group: Vec<u32>,
}

/// Gives points with equal coordinates one id and breaks polygons into triangles. `group_of` has the
/// group of each polygon, or nothing where all are in group 0.
pub fn weld(points: Vec<DVec3>, faces: Faces, group_of: &[u32]) -> Welded {
    // A closed surface of triangles has half as many vertices as triangles, but for a few.
    let expected = points.len().min(faces.len() / 2 + 3);
    let (points, ids) = welded(points, expected);
    let id = |v: u32| ids[v as usize];
    let group_of = |polygon: usize| group_of.get(polygon).copied().unwrap_or(0);
    let (triangles, group) = match faces {
        Faces::Triangles(mut all) => {
            let group = (0..all.len()).map(group_of).collect();
            all.iter_mut().for_each(|t| *t = t.map(id));
            (all, group)
        }
        Faces::Polygons { corners, ends } => {
            let (mut triangles, mut group) = (Vec::new(), Vec::new());
            let mut begin = 0;
            for (i, end) in ends.into_iter().enumerate() {
                let polygon: Vec<u32> = corners[begin..end].iter().map(|&v| id(v)).collect();
                match polygon[..] {
                    // What a triangle of the file is worth is told later.
                    [a, b, c] => triangles.push([a, b, c]),
                    _ => triangles.extend(triangles_of(&points, &polygon)),
                }
                group.resize(triangles.len(), group_of(i));
                begin = end;
            }
            (triangles, group)
        }
    };
    Welded {
        points,
        triangles,
        group,
    }
}

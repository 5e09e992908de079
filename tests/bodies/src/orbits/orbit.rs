//! A closed surface as the orbit of a patch under a point group: the triangles share the symmetry of the
//! shape by construction.

use crate::{Body, Face, Material};
use glam::DVec3;
use std::collections::HashMap;
use tmesh::Group;

/// A triangle by its corners, counter-clockwise seen from outside.
pub type Corners = [DVec3; 3];

/// The body of one material whose surface is the images of a patch under C_nh or S_2n.
pub fn orbit(group: Group, patch: &[Corners]) -> Body {
    let mut surface = Welded::default();
    for element in group.elements() {
        let reversed = element.reverses_orientation();
        for &corners in patch {
            let [a, b, c] = corners.map(|p| surface.vertex(element.apply(p)));
            surface.triangles.push(match reversed {
                true => [a, c, b],
                false => [a, b, c],
            });
        }
    }
    let face = |vertices| Face {
        vertices,
        front: None,
        back: Some(0),
    };
    Body {
        faces: surface.triangles.into_iter().map(face).collect(),
        vertices: surface.vertices,
        materials: vec![Material {
            name: "body".to_owned(),
        }],
        order: group.order,
        group,
    }
}

/// Points of different images that are the same but for rounding are one vertex.
#[derive(Default)]
struct Welded {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    ids: HashMap<[i64; 3], u32>,
}

impl Welded {
    fn vertex(&mut self, p: DVec3) -> u32 {
        // Coordinates are about 1, so rounding is near 2^-52; cells are far larger, and bodies far coarser.
        let cell = |p: DVec3| (p * 2.0_f64.powi(36)).round().as_i64vec3().to_array();
        let [x, y, z] = cell(p);
        // A point near the border of a cell may be in the next one.
        let near = (0..27).map(|n| [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]);
        let known = near
            .into_iter()
            .find_map(|cell| self.ids.get(&cell).copied());
        known.unwrap_or_else(|| {
            let id = self.vertices.len() as u32;
            self.vertices.push(p);
            self.ids.insert([x, y, z], id);
            id
        })
    }
}

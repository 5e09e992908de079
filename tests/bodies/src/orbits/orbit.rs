//! A closed surface as the orbit of a patch under a point group: the triangles share the symmetry of the
//! shape by construction.

use crate::{Body, Face, Material};
use glam::DVec3;
use std::collections::HashMap;
use tmesh::Isometry;

/// A triangle by its corners, counter-clockwise seen from outside.
pub type Corners = [DVec3; 3];

/// What takes the upper half of the body to the lower one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Below {
    /// The reflection at z = 0: the group is C_nh.
    Mirrored,
    /// The rotary reflection by half a step of the rotation: the group is S_2n.
    Alternating,
}

/// The body of one material that a patch generates under C_nh or S_2n, the order of the rotation being n.
pub fn orbit(order: u32, below: Below, patch: &[Corners]) -> Body {
    let mut surface = Welded::default();
    for k in 0..i64::from(2 * order) {
        // Even elements are rotations; odd ones turn the patch over.
        let lower = k % 2 == 1;
        let turn = match below {
            Below::Mirrored => Isometry::rotation(k / 2, order),
            Below::Alternating => Isometry::rotation(k, 2 * order),
        };
        for &corners in patch {
            let image = corners.map(|p| turn.apply(if lower { p * FLIP } else { p }));
            let [a, b, c] = image.map(|p| surface.vertex(p));
            surface.triangles.push(match lower {
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
        order,
        mirror: false,
        group: match below {
            Below::Mirrored => format!("C{order}h"),
            Below::Alternating => format!("S{}", 2 * order),
        },
    }
}

/// The reflection at z = 0, as factors.
const FLIP: DVec3 = DVec3::new(1.0, 1.0, -1.0);

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

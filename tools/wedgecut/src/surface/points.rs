//! The surface being cut: points with their class, faces with their attributes and flat patch.

use super::coincident::join_coincident;
use super::patches::flat_patches;
use crate::cell::{Cell, Class};
use geom::weld::Welder;
use glam::DVec3;
use tmesh::Triangle;

/// A surface in the canonical frame, with every point classified.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Positions, model units.
    pub points: Vec<DVec3>,
    /// Class of each point.
    pub classes: Vec<Class>,
    /// Triangles with their attributes.
    pub faces: Vec<Triangle>,
    /// Flat patch of each face.
    pub patches: Vec<u32>,
    /// Points where three cut planes meet; no face has them unless the surface passes there.
    pub corners: Vec<u32>,
}

impl Surface {
    /// Classifies points against the cell (without one, all are inside), joins points that have
    /// become one, drops faces that have lost their area with them, and finds flat patches.
    pub fn new(
        points: Vec<DVec3>,
        faces: Vec<Triangle>,
        cell: Option<&Cell>,
        flatness: f64,
    ) -> Self {
        let mut surface = Self::default();
        let mut welder = Welder::new(points.len());
        let mut renumbered = Vec::with_capacity(points.len());
        for p in points {
            let (p, class) = cell.map_or((p, Class::INSIDE), |cell| cell.classify(p));
            let (v, is_new) = welder.add(p);
            if is_new {
                surface.add(p, class);
            }
            renumbered.push(v);
        }
        for mut face in faces {
            face.vertices = face.vertices.map(|v| renumbered[v as usize]);
            let [a, b, c] = face.vertices;
            if a != b && b != c && a != c {
                surface.faces.push(face);
            }
        }
        join_coincident(&mut surface.faces, &mut surface.patches);
        surface.patches = flat_patches(&surface.points, &surface.faces, flatness);
        surface
    }

    /// Adds a point.
    pub fn add(&mut self, p: DVec3, class: Class) -> u32 {
        self.points.push(p);
        self.classes.push(class);
        self.points.len() as u32 - 1
    }

    /// Adds the points where three cut planes meet: the caps need them where they are inside of the
    /// body.
    pub fn add_corners(&mut self, cell: &Cell) {
        let used = self.faces.iter().flat_map(|f| f.vertices);
        let mut present = Welder::new(self.points.len());
        for v in used {
            present.id(self.points[v as usize]);
        }
        for (p, class) in cell.corners() {
            if present.find(p).is_none() {
                let v = self.add(p, class);
                self.corners.push(v);
            }
        }
    }

    /// Position and class of a point.
    pub fn at(&self, v: u32) -> (DVec3, Class) {
        (self.points[v as usize], self.classes[v as usize])
    }
}

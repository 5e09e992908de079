//! The surface being cut: points with their class, faces with their attributes and flat patch.

use crate::opening::{Class, Opening};
use geom::edges::Edges;
use geom::flat::{Flatness, Flats};
use geom::weld::Welder;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Triangle};

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
    /// Classifies points against the opening (without one, all are inside), joins points that have
    /// become one, drops faces that have lost their area with them, and finds flat patches.
    pub fn new(
        points: Vec<DVec3>,
        faces: Vec<Triangle>,
        opening: Option<&Opening>,
        flatness: f64,
    ) -> Self {
        let mut surface = Self::default();
        let mut welder = Welder::new(points.len());
        let mut renumbered = Vec::with_capacity(points.len());
        for p in points {
            let (p, class) = opening.map_or((p, Class::INSIDE), |o| o.classify(p));
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
    pub fn add_corners(&mut self, opening: &Opening) {
        let used = self.faces.iter().flat_map(|f| f.vertices);
        let mut present = Welder::new(self.points.len());
        for v in used {
            present.id(self.points[v as usize]);
        }
        for (p, class) in opening.corners() {
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

/// Joins faces on the same three points, as they are left when the layer between them has been
/// collapsed: one face from the material before the first to the material behind the second, or none
/// where these are the same.
pub fn join_coincident(faces: &mut Vec<Triangle>, patches: &mut Vec<u32>) {
    let mut seen: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let mut keep = vec![true; faces.len()];
    for i in 0..faces.len() {
        let f = faces[i];
        let mut key = f.vertices;
        key.sort_unstable();
        let Some(&j) = seen.get(&key) else {
            seen.insert(key, i);
            continue;
        };
        let g = faces[j];
        let [a, b, c] = f.vertices;
        let same = [[a, b, c], [b, c, a], [c, a, b]].contains(&g.vertices);
        // What lies before and behind the second face, seen from the front of the first.
        let (front, back) = if same {
            (f.front, f.back)
        } else {
            (f.back, f.front)
        };
        let joined = if g.back == front {
            (g.front, back)
        } else if g.front == back {
            (front, g.back)
        } else {
            // No layer between them: contradicting faces, left for the caps to report.
            continue;
        };
        keep[i] = false;
        if joined.0 == joined.1 {
            keep[j] = false;
            seen.remove(&key);
            continue;
        }
        let outer = |t: &Triangle| t.front == OUTSIDE || t.back == OUTSIDE;
        let marker = if outer(&f) && !outer(&g) {
            f.marker
        } else {
            g.marker
        };
        faces[j] = Triangle {
            front: joined.0,
            back: joined.1,
            marker,
            ..g
        };
    }
    let mut flags = keep.iter();
    faces.retain(|_| *flags.next().unwrap_or(&true));
    let mut flags = keep.iter();
    patches.retain(|_| *flags.next().unwrap_or(&true));
}

/// Cosine above which neighbouring normals may belong to one flat patch; flatness decides, this
/// only keeps folds of tiny faces out.
const PATCH_COSINE: f64 = 0.99;

/// Numbers connected sets of faces with equal attributes that lie within `flatness` (model units)
/// of the plane of their largest face.
pub fn flat_patches(points: &[DVec3], faces: &[Triangle], flatness: f64) -> Vec<u32> {
    let corners: Vec<[u32; 3]> = faces.iter().map(|f| f.vertices).collect();
    let across = Edges::new(&corners).across();
    let flatness = Flatness {
        distance: flatness,
        cosine: PATCH_COSINE,
    };
    let attributes = |t: u32| {
        let face = &faces[t as usize];
        (face.marker, face.front, face.back)
    };
    let alike = |s: u32, t: u32| attributes(s) == attributes(t);
    let flats = Flats::new(points, &corners, &across, |_| flatness, alike);
    flats.regions.of
}

//! The surface being cut: points with their class, faces with their attributes and flat patch.

use crate::opening::{Class, Opening};
use geom::edges::Edges;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
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
        let mut at: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        let mut renumbered = Vec::with_capacity(points.len());
        for p in points {
            let (p, class) = opening.map_or((p, Class::INSIDE), |o| o.classify(p));
            let entry = at.entry(bits(p));
            renumbered.push(*entry.or_insert_with(|| surface.add(p, class)));
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
        let present: FxHashSet<[u64; 3]> = used.map(|v| bits(self.points[v as usize])).collect();
        for (p, class) in opening.corners() {
            if !present.contains(&bits(p)) {
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

fn bits(p: DVec3) -> [u64; 3] {
    // Adding zero folds the two zeros into one.
    (p + DVec3::ZERO).to_array().map(f64::to_bits)
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
    let corner_ids: Vec<[u32; 3]> = faces.iter().map(|f| f.vertices).collect();
    let edges = Edges::new(&corner_ids);
    let mut neighbours = vec![[u32::MAX; 3]; faces.len()];
    for e in 0..edges.len() {
        if let [u, v] = edges.around(e)
            && u.forward != v.forward
        {
            neighbours[u.triangle as usize][u.corner as usize] = v.triangle;
            neighbours[v.triangle as usize][v.corner as usize] = u.triangle;
        }
    }
    let normals: Vec<DVec3> = faces
        .iter()
        .map(|f| {
            let [a, b, c] = geom::measure::corners(points, f);
            geom::measure::double_area_vector(a, b, c)
        })
        .collect();
    let mut order: Vec<u32> = (0..faces.len() as u32).collect();
    order.sort_by(|&i, &j| {
        let size = |k: u32| normals[k as usize].length_squared();
        size(j).total_cmp(&size(i)).then(i.cmp(&j))
    });
    let mut patch = vec![u32::MAX; faces.len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in order {
        if patch[seed as usize] != u32::MAX {
            continue;
        }
        patch[seed as usize] = count;
        let normal = normals[seed as usize].normalize_or_zero();
        let origin = points[faces[seed as usize].vertices[0] as usize];
        stack.push(seed);
        while let Some(f) = stack.pop() {
            for n in neighbours[f as usize] {
                if n == u32::MAX || patch[n as usize] != u32::MAX {
                    continue;
                }
                let (face, other) = (&faces[n as usize], &faces[f as usize]);
                let alike =
                    (face.marker, face.front, face.back) == (other.marker, other.front, other.back);
                let flat = face
                    .vertices
                    .iter()
                    .all(|&v| (points[v as usize] - origin).dot(normal).abs() <= flatness);
                let turned = normals[n as usize];
                if alike && flat && turned.dot(normal) >= PATCH_COSINE * turned.length() {
                    patch[n as usize] = count;
                    stack.push(n);
                }
            }
        }
        count += 1;
    }
    patch
}

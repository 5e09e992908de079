//! What a document stands for, expanded: whether that is the mesh of a body. Slow and simple.

use crate::part::{NOTHING, Part, Placement, faces_of};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Says what is wrong.
pub fn judge(part: &Part) -> Result<(), String> {
    let placed: BTreeSet<Placement> = part.instances.iter().copied().collect();
    if placed.len() < part.instances.len() {
        return Err("a copy twice".to_owned());
    }
    if placed.is_empty() {
        return Err("nothing".to_owned());
    }
    pairs_are_images(part)?;
    let whole = Whole::of(part)?;
    whole.vertices_differ()?;
    whole.tetrahedra_are_upright()?;
    whole.faces_fit(part)?;
    whole.copies_keep_apart()?;
    whole.is_the_body(part)
}

/// Pairs as section 7 has them.
fn pairs_are_images(part: &Part) -> Result<(), String> {
    for glue in &part.glues {
        for &[here, there] in &glue.vertices {
            let [p, q] = [here, there].map(|v| part.vertices[v as usize]);
            if glue.step.place(q).distance(p) > 1e-14 {
                return Err(format!("vertex {here} is no image"));
            }
        }
        let partner: BTreeMap<u32, u32> = glue.vertices.iter().map(|p| (p[1], p[0])).collect();
        for &[here, there] in &glue.triangles {
            let [mut a, b] = [here, there].map(|t| part.triangles[t as usize].vertices);
            let mut images = b.map(|v| partner.get(&v).copied().unwrap_or(NOTHING));
            a.sort_unstable();
            images.sort_unstable();
            if a != images {
                return Err(format!("triangle {here} is no image"));
            }
        }
    }
    Ok(())
}

/// The expanded mesh; vertices that gluings make one are one.
struct Whole {
    points: Vec<DVec3>,
    tets: Vec<[u32; 4]>,
    /// Volumes with sign.
    volumes: Vec<f64>,
    /// Assembled vertex of each instance's vertices.
    of: Vec<Vec<u32>>,
}

impl Whole {
    fn of(part: &Part) -> Result<Self, String> {
        let count = part.vertices.len();
        let mut points = Vec::new();
        for g in &part.instances {
            points.extend(part.vertices.iter().map(|&p| g.place(p)));
        }
        let mut root: Vec<usize> = (0..points.len()).collect();
        fn find(root: &[usize], mut v: usize) -> usize {
            while root[v] != v {
                v = root[v];
            }
            v
        }
        for (i, &g) in part.instances.iter().enumerate() {
            for glue in &part.glues {
                let neighbour = g.times(glue.step);
                let Some(j) = part.instances.iter().position(|&h| h == neighbour) else {
                    return Err(format!("instance {i} has no neighbour at {}", glue.name));
                };
                for &[here, there] in &glue.vertices {
                    let a = find(&root, i * count + here as usize);
                    let b = find(&root, j * count + there as usize);
                    root[a.max(b)] = a.min(b);
                }
            }
        }
        let of: Vec<Vec<u32>> = (0..part.instances.len())
            .map(|i| {
                (0..count)
                    .map(|v| find(&root, i * count + v) as u32)
                    .collect()
            })
            .collect();
        let (mut tets, mut volumes) = (Vec::new(), Vec::new());
        for (i, g) in part.instances.iter().enumerate() {
            for (tet, _) in &part.tets {
                let mut tet = *tet;
                if g.mirrored != g.flipped {
                    tet.swap(2, 3);
                }
                let tet = tet.map(|v| of[i][v as usize]);
                volumes.push(volume(tet.map(|v| points[v as usize])));
                tets.push(tet);
            }
        }
        Ok(Self {
            points,
            tets,
            volumes,
            of,
        })
    }

    fn size(&self) -> f64 {
        2.0 * self.points.iter().fold(0.0_f64, |m, p| m.max(p.length()))
    }

    fn vertices_differ(&self) -> Result<(), String> {
        let used: BTreeSet<u32> = self.of.iter().flatten().copied().collect();
        let mut used: Vec<(u32, DVec3)> =
            used.iter().map(|&v| (v, self.points[v as usize])).collect();
        used.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
        let reach = 1e-12 * self.size();
        for (i, a) in used.iter().enumerate() {
            let near = used[i + 1..].iter().take_while(|b| b.1.x - a.1.x <= reach);
            for b in near {
                if a.1.distance(b.1) <= reach {
                    return Err(format!("vertices {} and {} coincide", a.0, b.0));
                }
            }
        }
        Ok(())
    }

    fn tetrahedra_are_upright(&self) -> Result<(), String> {
        match self.volumes.iter().position(|v| *v <= 0.0) {
            Some(t) => Err(format!("tetrahedron {t} is inside out")),
            None => Ok(()),
        }
    }

    /// Two tetrahedra inside, one at the boundary, where there is a triangle.
    fn faces_fit(&self, part: &Part) -> Result<(), String> {
        let mut glued = BTreeSet::new();
        for glue in &part.glues {
            glued.extend(glue.triangles.iter().flatten().copied());
        }
        let mut listed = BTreeSet::new();
        for of in &self.of {
            for (t, face) in (0..).zip(&part.triangles) {
                if !glued.contains(&t) && (face.front == NOTHING || face.back == NOTHING) {
                    let mut key = face.vertices.map(|v| of[v as usize]);
                    key.sort_unstable();
                    if !listed.insert(key) {
                        return Err("a boundary triangle lies on another".to_owned());
                    }
                }
            }
        }
        let boundary: BTreeSet<[u32; 3]> = self.boundary()?.into_iter().collect();
        if boundary == listed {
            Ok(())
        } else {
            Err("the boundary is not the triangles".to_owned())
        }
    }

    fn boundary(&self) -> Result<Vec<[u32; 3]>, String> {
        let mut faces: BTreeMap<[u32; 3], u32> = BTreeMap::new();
        for tet in &self.tets {
            for mut face in faces_of(*tet) {
                face.sort_unstable();
                *faces.entry(face).or_default() += 1;
            }
        }
        if faces.values().any(|&n| n > 2) {
            return Err("a face has three tetrahedra".to_owned());
        }
        Ok(faces
            .into_iter()
            .filter(|f| f.1 == 1)
            .map(|f| f.0)
            .collect())
    }

    /// The middle of each tetrahedron of the first copies is in no other one.
    fn copies_keep_apart(&self) -> Result<(), String> {
        let corners = |t: &[u32; 4]| t.map(|v| self.points[v as usize]);
        for (i, tet) in self.tets.iter().enumerate() {
            let middle: DVec3 = 0.25 * corners(tet).into_iter().sum::<DVec3>();
            for (j, other) in self.tets.iter().enumerate() {
                let other = corners(other);
                let inside = (0..4).all(|k| {
                    let mut part = other;
                    part[k] = middle;
                    volume(part) > 0.0
                });
                if i != j && inside {
                    return Err(format!("tetrahedra {i} and {j} overlap"));
                }
            }
        }
        Ok(())
    }

    fn is_the_body(&self, part: &Part) -> Result<(), String> {
        let Some([volume, area]) = part.source else {
            return Ok(());
        };
        let sum: f64 = self.volumes.iter().sum();
        let areas = self.boundary()?.into_iter().map(|face| {
            let [a, b, c] = face.map(|v| self.points[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        });
        let off = [sum / volume - 1.0, areas.sum::<f64>() / area - 1.0];
        if off.iter().any(|x| x.abs() > 1e-6) {
            return Err(format!("volume and area are off by {off:?}"));
        }
        Ok(())
    }
}

fn volume([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a) / 6.0
}

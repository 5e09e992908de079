//! Bodies for tests.

use crate::shape::Random;
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::TAU;
use tmesh::{Document, OUTSIDE, Region, Template, Triangle};

/// A prism over a regular polygon of `n` sides and the given radius, from z = 0 to `height`.
pub fn prism(n: usize, radius: f64, height: f64) -> Document {
    profile(n, &[(radius, 0.0), (radius, height)], |_, r, z| (r, z))
}

/// A document from closed surface triangles with region 1 behind them.
pub fn document(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Document {
    let triangles = triangles
        .into_iter()
        .map(|vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        })
        .collect();
    let mut document = Document::single(Template {
        vertices,
        triangles,
        ..Template::default()
    });
    document.regions = vec![region(1)];
    document
}

/// A region with a name.
pub fn region(id: u32) -> Region {
    Region {
        id,
        name: format!("r{id}"),
        size: None,
        volume: None,
    }
}

/// The solid swept by an open profile (r, z) around the z axis, closed by fans over the planar
/// polygons at its two ends; `shape` moves each point, given its angle.
pub fn profile(
    n: usize,
    points: &[(f64, f64)],
    shape: impl Fn(f64, f64, f64) -> (f64, f64),
) -> Document {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for &(r, z) in points {
        for i in 0..n {
            let a = TAU * i as f64 / n as f64;
            let (r, z) = shape(a, r, z);
            vertices.push(DVec3::new(r * a.cos(), r * a.sin(), z));
        }
    }
    let id = |row: usize, i: usize| (row * n + i % n) as u32;
    for row in 0..points.len() - 1 {
        for i in 0..n {
            let (a, b, c, d) = (
                id(row, i),
                id(row, i + 1),
                id(row + 1, i + 1),
                id(row + 1, i),
            );
            // Four triangles around the middle: diagonals would lean to one side.
            let middle = vertices.len() as u32;
            let sum: DVec3 = [a, b, c, d].iter().map(|&v| vertices[v as usize]).sum();
            vertices.push(0.25 * sum);
            triangles.extend([
                [a, b, middle],
                [b, c, middle],
                [c, d, middle],
                [d, a, middle],
            ]);
        }
    }
    // Fans over the ends from points off the axis: a tessellation without symmetry.
    for (row, up) in [(0, false), (points.len() - 1, true)] {
        let middle = vertices.len() as u32;
        let ring = &vertices[row * n..(row + 1) * n];
        let z = ring.iter().map(|p| p.z).sum::<f64>() / n as f64;
        vertices.push(DVec3::new(0.012, 0.007, z));
        for i in 0..n {
            let (a, b) = (id(row, i), id(row, i + 1));
            triangles.push(if up { [middle, a, b] } else { [middle, b, a] });
        }
    }
    document(vertices, triangles)
}

/// Lobed, toothed or twisted bodies, one for each kind of axial group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// C_n: a leaning saw blade, tapered.
    Cn,
    /// C_nv: lobes, tapered.
    Cnv,
    /// C_nh: a leaning saw blade.
    Cnh,
    /// D_n: twisted lobes.
    Dn,
    /// D_nd: lobes that change sign half-way up.
    Dnd,
    /// D_nh: straight lobes.
    Dnh,
    /// S_2n: as D_nd, but leaning.
    S2n,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Cn,
        Self::Cnv,
        Self::Cnh,
        Self::Dn,
        Self::Dnd,
        Self::Dnh,
        Self::S2n,
    ];

    /// The symbol expected.
    pub fn symbol(self, n: u32) -> String {
        match self {
            Self::Cn => format!("C{n}"),
            Self::Cnv => format!("C{n}v"),
            Self::Cnh => format!("C{n}h"),
            Self::Dn => format!("D{n}"),
            Self::Dnd => format!("D{n}d"),
            Self::Dnh => format!("D{n}h"),
            Self::S2n => format!("S{}", 2 * n),
        }
    }

    /// A body of radius about 1 and height 0.8, with lobes of the given depth and `per_lobe` facets
    /// around each.
    pub fn body(self, n: u32, per_lobe: usize, depth: f64) -> Document {
        profile(n as usize * per_lobe, &levels(8), self.shape(n, depth))
    }

    /// The same body with `facets` and up to a quarter more facets around each of its levels, another
    /// number for each and begun anywhere, so that nothing of the drawing is symmetric.
    pub fn uneven_body(self, n: u32, facets: usize, depth: f64, random: &mut Random) -> Document {
        let levels = levels(16);
        let counts: Vec<(usize, f64)> = (levels.iter())
            .map(|_| (facets + random.below(facets / 4), random.unit()))
            .collect();
        let shape = self.shape(n, depth);
        let (mut vertices, mut triangles, mut first) = (Vec::new(), Vec::new(), Vec::new());
        for (&(r, z), &(count, phase)) in levels.iter().zip(&counts) {
            first.push(vertices.len());
            for i in 0..count {
                let a = TAU * (i as f64 + phase) / count as f64;
                let (r, z) = shape(a, r, z);
                vertices.push(DVec3::new(r * a.cos(), r * a.sin(), z));
            }
        }
        let id = |row: usize, i: usize| (first[row] + i % counts[row].0) as u32;
        for row in 0..levels.len() - 1 {
            let at = |row: usize, i: usize| (i as f64 + counts[row].1) / counts[row].0 as f64;
            let (mut i, mut j) = (0, 0);
            while i < counts[row].0 || j < counts[row + 1].0 {
                let (a, b) = (id(row, i), id(row + 1, j));
                let below = j == counts[row + 1].0
                    || i < counts[row].0 && at(row, i + 1) < at(row + 1, j + 1);
                if below {
                    triangles.push([a, id(row, i + 1), b]);
                    i += 1;
                } else {
                    triangles.push([a, id(row + 1, j + 1), b]);
                    j += 1;
                }
            }
        }
        for (row, up) in [(0, false), (levels.len() - 1, true)] {
            let middle = vertices.len() as u32;
            vertices.push(DVec3::new(0.012, 0.007, levels[row].1));
            for i in 0..counts[row].0 {
                let (a, b) = (id(row, i), id(row, i + 1));
                triangles.push(if up { [middle, a, b] } else { [middle, b, a] });
            }
        }
        document(vertices, triangles)
    }

    /// Moves a point of a cylinder, given its angle, radius and height, to the body's surface.
    fn shape(self, n: u32, depth: f64) -> impl Fn(f64, f64, f64) -> (f64, f64) {
        let n_f = f64::from(n);
        let saw = |t: f64| {
            let x = (t / TAU).rem_euclid(1.0);
            if x < 0.75 { x / 0.75 } else { (1.0 - x) / 0.25 }
        };
        move |a, _, z| {
            let u = z / 0.4;
            let (wave, taper) = match self {
                Self::Cn => (saw(n_f * a), 1.0 - 0.2 * u),
                Self::Cnv => ((n_f * a).cos(), 1.0 - 0.2 * u),
                Self::Cnh => (saw(n_f * a), 1.0),
                Self::Dn => ((n_f * a + 0.8 * u).cos(), 1.0),
                Self::Dnd => (u * (n_f * a).cos(), 1.0),
                Self::Dnh => ((n_f * a).cos(), 1.0),
                Self::S2n => (u * (n_f * a).cos() + u * u * u * (n_f * a).sin(), 1.0),
            };
            ((1.0 - depth + depth * wave) * taper, z)
        }
    }
}

/// Radius and height of the levels of a body.
fn levels(layers: u32) -> Vec<(f64, f64)> {
    (0..=layers)
        .map(|i| (1.0, 0.8 * f64::from(i) / f64::from(layers) - 0.4))
        .collect()
}

/// Somewhere in space, at some scale.
pub fn placement(random: &mut Random, scale: f64) -> impl Fn(DVec3) -> DVec3 + use<> {
    let q = DQuat::from_xyzw(
        random.unit() - 0.5,
        random.unit() - 0.5,
        random.unit() - 0.5,
        random.unit() - 0.5,
    );
    let rotation = DMat3::from_quat(q.normalize());
    let shift = 4.0 * random_vector(random);
    move |p| (rotation * p + shift) * scale
}

/// Puts a body somewhere, at some scale, with noise of the given share of the size on every
/// coordinate, rounded to single precision.
pub fn place(document: &Document, random: &mut Random, scale: f64, noise: f64) -> Document {
    let mut placed = document.clone();
    let place = placement(random, scale);
    let mut largest = 0.0_f64;
    for p in &mut placed.templates[0].vertices {
        let moved = place(*p) + scale * noise * random_vector(random);
        *p = moved.as_vec3().as_dvec3();
        largest = largest.max(p.abs().max_element());
    }
    placed.source = Some(tmesh::Source {
        sector_of: None,
        format: "stl".to_owned(),
        triangles: placed.templates[0].triangles.len() as u64,
        volume: 0.0,
        boundary_area: 0.0,
        precision: largest * f64::from(f32::EPSILON) / 2.0,
    });
    placed
}

/// Uniform in the cube from -1 to 1.
pub fn random_vector(random: &mut Random) -> DVec3 {
    let mut x = || 2.0 * random.unit() - 1.0;
    DVec3::new(x(), x(), x())
}

/// Splits random triangles at a random inner point, which leaves the shape as it is.
pub fn split_faces(document: &Document, random: &mut Random, share: f64) -> Document {
    let mut split = document.clone();
    let template = &mut split.templates[0];
    for i in 0..template.triangles.len() {
        if random.unit() >= share {
            continue;
        }
        let t = template.triangles[i];
        let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
        let (u, v) = (0.2 + 0.3 * random.unit(), 0.2 + 0.3 * random.unit());
        let new = template.vertices.len() as u32;
        template.vertices.push(a + (b - a) * u + (c - a) * v);
        let [p, q, r] = t.vertices;
        template.triangles[i].vertices = [p, q, new];
        for vertices in [[q, r, new], [r, p, new]] {
            template.triangles.push(Triangle { vertices, ..t });
        }
    }
    split
}

/// Unit cubes on a grid of `size`, each of the region that `region` gives it; faces between different
/// regions only.
pub fn cubes(size: [i32; 3], region: impl Fn([i32; 3]) -> u32) -> Document {
    let inside = |c: [i32; 3]| (0..3).all(|k| (0..size[k]).contains(&c[k]));
    let region_at = |c: [i32; 3]| if inside(c) { region(c) } else { OUTSIDE };
    let id = |c: [i32; 3]| (c[0] + (size[0] + 1) * (c[1] + (size[1] + 1) * c[2])) as u32;
    let mut vertices = Vec::new();
    for z in 0..=size[2] {
        for y in 0..=size[1] {
            for x in 0..=size[0] {
                vertices.push(DVec3::new(x.into(), y.into(), z.into()));
            }
        }
    }
    let mut triangles = Vec::new();
    let mut regions = std::collections::BTreeSet::new();
    for z in 0..=size[2] {
        for y in 0..=size[1] {
            for x in 0..=size[0] {
                let here = [x, y, z];
                for k in 0..3 {
                    let mut below = here;
                    below[k] -= 1;
                    let (front, back) = (region_at(here), region_at(below));
                    if front == back {
                        continue;
                    }
                    regions.extend([front, back]);
                    let (mut u, mut v, mut w) = (here, here, here);
                    u[(k + 1) % 3] += 1;
                    v[(k + 1) % 3] += 1;
                    v[(k + 2) % 3] += 1;
                    w[(k + 2) % 3] += 1;
                    for vertices in [[here, u, v], [here, v, w]] {
                        triangles.push(Triangle {
                            vertices: vertices.map(id),
                            marker: 0,
                            front,
                            back,
                        });
                    }
                }
            }
        }
    }
    regions.remove(&OUTSIDE);
    let mut document = Document::single(Template {
        vertices,
        triangles,
        ..Template::default()
    });
    document.regions = regions.into_iter().map(self::region).collect();
    document
}

/// The convex hull of a few points: every plane through three of them with all others on one side.
pub fn hull(points: &[DVec3]) -> Document {
    let n = points.len();
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                if i >= j || i >= k || j == k {
                    continue;
                }
                let normal = (points[j] - points[i]).cross(points[k] - points[i]);
                let below = |p: &DVec3| normal.dot(*p - points[i]) < 1e-9;
                let on = |p: &&DVec3| normal.dot(**p - points[i]).abs() < 1e-9;
                if normal.length() > 1e-9 && points.iter().all(below) {
                    assert_eq!(points.iter().filter(on).count(), 3, "faces are triangles");
                    triangles.push([i as u32, j as u32, k as u32]);
                }
            }
        }
    }
    document(points.to_vec(), triangles)
}

/// A body around the z axis, divided into sectors and layers that may be of different regions.
pub struct Cells<P> {
    /// Sectors around the axis.
    pub sectors: usize,
    /// Heights of the levels between the layers, increasing.
    pub levels: Vec<f64>,
    /// The outermost point at the start of a sector, on a level.
    pub place: P,
}

impl<P: Fn(usize, f64) -> DVec3> Cells<P> {
    /// The body with the region that `region` gives each cell by its sector, its layer and the number of layers.
    pub fn document(&self, region: impl Fn(usize, usize, usize) -> u32) -> Document {
        let (n, layers) = (self.sectors, self.levels.len() - 1);
        let rings = (self.levels.iter()).flat_map(|&z| (0..n).map(move |i| (self.place)(i, z)));
        let mut vertices: Vec<DVec3> = rings.collect();
        let middles = vertices.chunks(n).map(|ring| ring[0].z);
        let axis: Vec<DVec3> = middles.map(|z| DVec3::new(0.0, 0.0, z)).collect();
        vertices.extend(axis);
        let ring = |i: usize, level: usize| (level * n + i % n) as u32;
        let axis = |level: usize| (n * (layers + 1) + level) as u32;
        let mut triangles = Vec::new();
        let mut add = |corners: &[u32], front: u32, back: u32| {
            if front == back {
                return;
            }
            let mut corners = corners.to_vec();
            let mut sides = [front, back];
            if back == OUTSIDE {
                corners.reverse();
                sides.reverse();
            }
            let mut triangle = |vertices| {
                triangles.push(Triangle {
                    vertices,
                    marker: 0,
                    front: sides[0],
                    back: sides[1],
                });
            };
            if let [a, b, c] = corners[..] {
                return triangle([a, b, c]);
            }
            // Four triangles around the middle: diagonals would lean to one side.
            let middle = vertices.len() as u32;
            let sum: DVec3 = corners.iter().map(|&v| vertices[v as usize]).sum();
            vertices.push(0.25 * sum);
            for (i, &a) in corners.iter().enumerate() {
                triangle([a, corners[(i + 1) % corners.len()], middle]);
            }
        };
        for i in 0..n {
            let at = |layer: usize| region(i, layer, layers);
            for layer in 0..layers {
                let [low, high] = [layer, layer + 1];
                let outer = [
                    ring(i, low),
                    ring(i + 1, low),
                    ring(i + 1, high),
                    ring(i, high),
                ];
                add(&outer, OUTSIDE, at(layer));
                let wall = [axis(low), ring(i, low), ring(i, high), axis(high)];
                add(&wall, region((i + n - 1) % n, layer, layers), at(layer));
            }
            for level in 0..=layers {
                let above = if level < layers { at(level) } else { OUTSIDE };
                let below = if level > 0 { at(level - 1) } else { OUTSIDE };
                add(
                    &[axis(level), ring(i, level), ring(i + 1, level)],
                    above,
                    below,
                );
            }
        }
        let ids = triangles.iter().map(|t: &Triangle| t.back);
        let ids: std::collections::BTreeSet<u32> = ids.collect();
        let mut document = Document::single(Template {
            vertices,
            triangles,
            ..Template::default()
        });
        document.regions = ids.into_iter().map(self::region).collect();
        document
    }
}

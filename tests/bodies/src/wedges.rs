//! Surfaces of wedges with their gluings, made in code as grids of cells.

use glam::DVec3;
use tmesh::{Document, Gluing, Instance, Isometry, OUTSIDE, Region, Template, Triangle};

/// A grid of cells in cylindrical coordinates: radii, `turns` equal steps over the wedge's angle,
/// heights. Its surface separates cells of different regions.
pub struct Grid<'a> {
    /// Order of the rotation.
    pub order: u32,
    /// Mirror walls and half the angle; else a seam.
    pub mirror: bool,
    /// Radii of the grid's points; the first may be 0.
    pub radii: &'a [f64],
    /// Steps over the angle.
    pub turns: usize,
    /// Heights of the grid's points.
    pub heights: &'a [f64],
    /// Region of the cell (radius, turn, height).
    pub region: &'a dyn Fn(usize, usize, usize) -> u32,
}

/// Marker of the inner and the outer side.
pub const SIDE: u32 = 1;
/// Marker of the walls.
pub const WALL: u32 = 2;
/// Marker of bottom and top.
pub const LEVEL: u32 = 3;

impl Grid<'_> {
    fn vertex(&self, i: usize, j: usize, k: usize) -> DVec3 {
        let p = DVec3::new(self.radii[i], 0.0, self.heights[k]);
        // The whole angle is half a step of the rotation for a mirror wedge, else a step.
        let parts = if self.mirror {
            2 * self.order
        } else {
            self.order
        };
        let turn = Isometry::rotation(j as i64, parts * self.turns as u32);
        if self.radii[i] == 0.0 {
            p
        } else {
            turn.apply(p)
        }
    }

    /// The template, with walls where there are any, and without unused vertices.
    pub fn template(&self) -> Template {
        let (ni, nj, nk) = (self.radii.len(), self.turns + 1, self.heights.len());
        let axis = self.radii[0] == 0.0;
        let raw = |i: usize, j: usize, k: usize| {
            let j = if axis && i == 0 { 0 } else { j };
            (i * nj + j) * nk + k
        };
        let cell = |i: isize, j: isize, k: isize| {
            let inside = |x: isize, n: usize| x >= 0 && (x as usize) + 1 < n;
            if inside(i, ni) && inside(j, nj) && inside(k, nk) {
                (self.region)(i as usize, j as usize, k as usize)
            } else {
                OUTSIDE
            }
        };
        let mut quads: Vec<([usize; 4], u32, u32, u32, usize)> = Vec::new();
        for i in 0..ni {
            for j in 0..nj {
                for k in 0..nk {
                    let (a, b, c) = (i as isize, j as isize, k as isize);
                    // Corners counter-clockwise seen from the larger index.
                    if j + 1 < nj && k + 1 < nk {
                        let q = [
                            raw(i, j, k),
                            raw(i, j + 1, k),
                            raw(i, j + 1, k + 1),
                            raw(i, j, k + 1),
                        ];
                        quads.push((q, cell(a, b, c), cell(a - 1, b, c), SIDE, usize::MAX));
                    }
                    if i + 1 < ni && k + 1 < nk {
                        let q = [
                            raw(i, j, k),
                            raw(i, j, k + 1),
                            raw(i + 1, j, k + 1),
                            raw(i + 1, j, k),
                        ];
                        quads.push((q, cell(a, b, c), cell(a, b - 1, c), WALL, j));
                    }
                    if i + 1 < ni && j + 1 < nj {
                        let q = [
                            raw(i, j, k),
                            raw(i + 1, j, k),
                            raw(i + 1, j + 1, k),
                            raw(i, j + 1, k),
                        ];
                        quads.push((q, cell(a, b, c), cell(a, b, c - 1), LEVEL, usize::MAX));
                    }
                }
            }
        }
        let mut triangles = Vec::new();
        let mut wall_of = Vec::new();
        for (q, front, back, marker, j) in quads.into_iter().filter(|q| q.1 != q.2) {
            for t in [[q[0], q[1], q[2]], [q[0], q[2], q[3]]] {
                if t[0] != t[1] && t[1] != t[2] && t[0] != t[2] {
                    triangles.push((t, front, back, marker));
                    wall_of.push(j);
                }
            }
        }
        let mut id = vec![u32::MAX; ni * nj * nk];
        for t in &triangles {
            t.0.iter().for_each(|&v| id[v] = 0);
        }
        let mut vertices = Vec::new();
        let mut place = vec![(0, 0, 0); ni * nj * nk];
        for i in 0..ni {
            for j in (0..nj).rev() {
                for k in 0..nk {
                    place[raw(i, j, k)] = (i, j, k);
                }
            }
        }
        for raw in 0..id.len() {
            if id[raw] == 0 {
                id[raw] = vertices.len() as u32;
                let (i, j, k) = place[raw];
                vertices.push(self.vertex(i, j, k));
            }
        }
        let triangles: Vec<Triangle> = triangles
            .into_iter()
            .map(|(t, front, back, marker)| {
                let [a, b, c] = t.map(|v| id[v]);
                // Boundaries and walls face out of the body.
                if back == OUTSIDE {
                    return Triangle {
                        vertices: [a, c, b],
                        marker,
                        front: back,
                        back: front,
                    };
                }
                Triangle {
                    vertices: [a, b, c],
                    marker,
                    front,
                    back,
                }
            })
            .collect();
        let on_axis: Vec<u32> = (0..nk)
            .filter(|_| axis)
            .map(|k| id[raw(0, 0, k)])
            .filter(|&v| v != u32::MAX)
            .collect();
        let of_wall = |j: usize| -> Vec<u32> {
            (0..triangles.len() as u32)
                .filter(|&t| wall_of[t as usize] == j)
                .collect()
        };
        let (low, high) = (of_wall(0), of_wall(nj - 1));
        let vertices_of = |list: &[u32]| {
            let mut v: Vec<u32> = list
                .iter()
                .flat_map(|&t| triangles[t as usize].vertices)
                .collect();
            v.sort_unstable();
            v.dedup();
            v
        };
        let gluings = if self.mirror {
            [
                ("wall-a", low, Isometry::reflection(0, 1)),
                ("wall-b", high, Isometry::reflection(1, self.order)),
            ]
            .map(|(name, list, reflection)| {
                Gluing::mirror(name, 0, reflection, vertices_of(&list), list)
            })
            .to_vec()
        } else {
            let mut vertex_pairs: Vec<[u32; 2]> = Vec::new();
            for i in 0..ni {
                for k in 0..nk {
                    let pair = [id[raw(i, 0, k)], id[raw(i, nj - 1, k)]];
                    if pair[0] != u32::MAX {
                        vertex_pairs.push(pair);
                    }
                }
            }
            vec![Gluing::seam(
                "seam",
                0,
                Isometry::rotation(1, self.order),
                vertex_pairs,
                low.iter().zip(&high).map(|(&a, &b)| [a, b]),
            )]
        };
        Template {
            vertices,
            triangles,
            tets: Vec::new(),
            gluings,
            axis: on_axis,
        }
    }

    /// A document of this one template and all its instances.
    pub fn document(&self) -> Document {
        let mut document = Document::single(self.template());
        document.instances.clear();
        add_instances(&mut document, 0, self.order, self.mirror);
        name_regions(&mut document);
        document
    }
}

fn add_instances(document: &mut Document, template: u32, order: u32, mirror: bool) {
    for k in 0..order {
        for mirrored in [false, true].into_iter().filter(|&m| mirror || !m) {
            document.instances.push(Instance {
                template,
                isometry: Isometry::new(i64::from(k), order, mirrored, false),
                region_map: 0,
            });
        }
    }
}

/// Lists the regions that triangles name.
pub fn name_regions(document: &mut Document) {
    let mut ids: Vec<u32> = document
        .templates
        .iter()
        .flat_map(|t| t.triangles.iter().flat_map(|t| [t.front, t.back]))
        .filter(|&r| r != OUTSIDE)
        .collect();
    ids.sort_unstable();
    ids.dedup();
    document.regions = ids
        .into_iter()
        .map(|id| Region {
            id,
            name: format!("material-{id}"),
            size: None,
            volume: None,
        })
        .collect();
}

/// A prism: one region, axis inside.
pub fn prism(order: u32) -> Document {
    Grid {
        order,
        mirror: true,
        radii: &[0.0, 1.0],
        turns: if order < 2 { 3 } else { 1 },
        heights: &[0.0, 0.5],
        region: &|_, _, _| 1,
    }
    .document()
}

/// A ring with a thin coating on its outside.
pub fn coated_ring(order: u32, coating: f64) -> Document {
    Grid {
        order,
        mirror: true,
        radii: &[0.5, 1.0, 1.0 + coating],
        turns: 1,
        heights: &[0.0, 0.5],
        region: &|i, _, _| [4, 9][i],
    }
    .document()
}

/// A wedge whose outer part and hub are templates of their own, shared at radius 0.25.
pub fn with_hub(order: u32) -> Document {
    let outer = Grid {
        order,
        mirror: true,
        radii: &[0.25, 1.0],
        turns: 2,
        heights: &[0.0, 0.2, 0.5],
        region: &|_, _, k| k as u32,
    };
    let inner = Grid {
        radii: &[0.0, 0.25],
        ..outer
    };
    let mut document = outer.document();
    let mut hub = inner.template();
    let shared = |t: &Template| -> Vec<u32> {
        (0..t.triangles.len() as u32)
            .filter(|&i| {
                let t = &t.triangles[i as usize]
                    .vertices
                    .map(|v| t.vertices[v as usize]);
                t.iter().all(|p| (p.x.hypot(p.y) - 0.25).abs() < 1e-12)
            })
            .collect()
    };
    let rim = &document.templates[0];
    let find = |p: DVec3| hub.vertices.iter().position(|&q| q == p).unwrap() as u32;
    let mut vertex_pairs = Vec::new();
    let mut triangle_pairs = Vec::new();
    for (a, b) in shared(rim).into_iter().zip(shared(&hub)) {
        triangle_pairs.push([a, b]);
        for v in rim.triangles[a as usize].vertices {
            vertex_pairs.push([v, find(rim.vertices[v as usize])]);
        }
    }
    vertex_pairs.sort_unstable();
    vertex_pairs.dedup();
    // Levels inside the shared face: the hub's triangles face the other way, so pairs match.
    triangle_pairs.sort_unstable();
    document.templates[0].gluings.push(Gluing {
        name: "hub".to_owned(),
        other: 1,
        step: Isometry::IDENTITY,
        vertex_pairs,
        triangle_pairs,
    });
    hub.gluings.iter_mut().for_each(|own| own.other = 1);
    hub.tets.clear();
    document.templates.push(hub);
    add_instances(&mut document, 1, order, true);
    name_regions(&mut document);
    document
}

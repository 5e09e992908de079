//! Structured meshes of wedges, built in code: a grid in radius, angle and height, each cell cut
//! into six tetrahedra along the paths from its lowest to its highest corner (Kuhn's subdivision),
//! so that faces of neighbouring cells, and both faces of a seam, are cut alike.

use glam::DVec3;
use tmesh::{
    Document, Gluing, Instance, Isometry, Marker, OUTSIDE, Region, Template, Tet, Triangle,
};

/// A wedge of a prism over a ring or a disc, and the group that makes the prism of it.
#[derive(Clone, Copy, Debug)]
pub struct Structured {
    /// Order of the rotation.
    pub order: u32,
    /// Mirror walls and a wedge of half the angle; else a seam.
    pub mirror: bool,
    /// A horizontal mirror wall at z = 0.
    pub flip: bool,
    /// Radius of the bore; 0 for material on the axis.
    pub bore: f64,
    /// Outer radius.
    pub radius: f64,
    /// Cells in radius, angle and height.
    pub cells: [u32; 3],
}

/// Region inside the interface at half the cells in radius.
pub const INNER: u32 = 4;
/// Region outside of it.
pub const OUTER: u32 = 9;
/// Height of the wedge.
pub const HEIGHT: f64 = 0.5;

impl Structured {
    /// Instances that the group has.
    pub fn copies(&self) -> u32 {
        self.order * if self.mirror { 2 } else { 1 } * if self.flip { 2 } else { 1 }
    }

    /// The wedge, and all its instances.
    pub fn document(&self) -> Document {
        let mut document = Document::single(self.template());
        document.instances.clear();
        for flipped in [false, true] {
            for k in 0..i64::from(self.order) {
                for mirrored in [false, true] {
                    if (flipped && !self.flip) || (mirrored && !self.mirror) {
                        continue;
                    }
                    document.instances.push(Instance {
                        template: 0,
                        isometry: Isometry::new(k, self.order, mirrored, flipped),
                        region_map: 0,
                    });
                }
            }
        }
        document.regions = [(INNER, "inner"), (OUTER, "outer")]
            .map(|(id, name)| Region {
                id,
                name: name.to_owned(),
                size: None,
                volume: None,
            })
            .to_vec();
        document.markers = (0..6)
            .map(|id| Marker {
                id,
                name: format!("face-{id}"),
                area: None,
            })
            .collect();
        document
    }

    /// Vertex of a grid point; points on the axis are the same for every angle.
    pub fn vertex(&self, [i, j, k]: [u32; 3]) -> u32 {
        let [nr, na, nz] = self.cells;
        let layer = nz + 1;
        if self.bore > 0.0 {
            return (i * (na + 1) + j) * layer + k;
        }
        if i == 0 {
            return k;
        }
        debug_assert!(i <= nr);
        layer + ((i - 1) * (na + 1) + j) * layer + k
    }

    fn points(&self) -> Vec<DVec3> {
        let [nr, na, nz] = self.cells;
        // Directions from exact fractions of a turn; the far wall's as its isometry has it.
        let parts = if self.mirror {
            2 * self.order
        } else {
            self.order
        } * na;
        let direction: Vec<(f64, f64)> = (0..=na)
            .map(|j| Isometry::rotation(i64::from(j), parts).cos_sin())
            .collect();
        let mut points = Vec::new();
        for i in 0..=nr {
            let r = self.bore + (self.radius - self.bore) * f64::from(i) / f64::from(nr);
            for j in 0..=na {
                for k in 0..=nz {
                    let z = HEIGHT * f64::from(k) / f64::from(nz);
                    let (c, s) = direction[j as usize];
                    if self.vertex([i, j, k]) as usize == points.len() {
                        points.push(DVec3::new(r * c, r * s, z));
                    }
                }
            }
        }
        if !self.mirror {
            let turn = Isometry::rotation(1, self.order).placed();
            for (low, high) in self.seam_pairs() {
                points[high as usize] = turn.apply(points[low as usize]);
            }
        }
        points
    }

    fn seam_pairs(&self) -> Vec<(u32, u32)> {
        let [nr, na, nz] = self.cells;
        let grid = (0..=nr).flat_map(|i| (0..=nz).map(move |k| (i, k)));
        let mut pairs: Vec<_> = grid
            .map(|(i, k)| (self.vertex([i, 0, k]), self.vertex([i, na, k])))
            .collect();
        pairs.sort_unstable();
        pairs
    }

    fn region(&self, i: u32) -> u32 {
        if 2 * i < self.cells[0] { INNER } else { OUTER }
    }

    fn tets(&self, points: &[DVec3]) -> Vec<Tet> {
        let [nr, na, nz] = self.cells;
        const PATHS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [0, 2, 1],
            [1, 0, 2],
            [2, 1, 0],
        ];
        let mut tets = Vec::new();
        for i in 0..nr {
            for j in 0..na {
                for k in 0..nz {
                    for path in PATHS {
                        let mut at = [i, j, k];
                        let mut v = [self.vertex(at); 4];
                        for (corner, axis) in path.into_iter().enumerate() {
                            at[axis] += 1;
                            v[corner + 1] = self.vertex(at);
                        }
                        if v[0] == v[1] || v[1] == v[2] || v[2] == v[3] {
                            continue;
                        }
                        let [a, b, c, d] = v.map(|v| points[v as usize]);
                        if (b - a).cross(c - a).dot(d - a) < 0.0 {
                            v.swap(2, 3);
                        }
                        tets.push(Tet {
                            vertices: v,
                            region: self.region(i),
                        });
                    }
                }
            }
        }
        tets
    }

    /// Triangles of the grid face where index `axis` is `at`, with normals towards higher indices.
    fn face(&self, axis: usize, at: u32) -> Vec<([u32; 3], [u32; 3])> {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut triangles = Vec::new();
        for a in 0..self.cells[u] {
            for b in 0..self.cells[v] {
                let corner = |da: u32, db: u32| {
                    let mut cell = [0; 3];
                    (cell[axis], cell[u], cell[v]) = (at, a + da, b + db);
                    cell
                };
                let [p, q, r, s] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                for [x, y, z] in [[p, q, r], [p, r, s]] {
                    let t = [x, y, z].map(|c| self.vertex(c));
                    if t[0] != t[1] && t[1] != t[2] && t[0] != t[2] {
                        triangles.push((t, p));
                    }
                }
            }
        }
        triangles
    }

    /// The wedge.
    pub fn template(&self) -> Template {
        let vertices = self.points();
        let tets = self.tets(&vertices);
        let mut template = Template {
            vertices,
            tets,
            ..Template::default()
        };
        let [nr, na, nz] = self.cells;
        let mut add = |axis: usize, at: u32, high: bool, marker: u32| -> Vec<u32> {
            let first = template.triangles.len() as u32;
            for ([a, b, c], cell) in self.face(axis, at) {
                let inside = match axis {
                    0 if high => self.region(nr - 1),
                    0 => self.region(0),
                    _ => self.region(cell[0]),
                };
                let vertices = if high { [a, b, c] } else { [a, c, b] };
                template.triangles.push(Triangle {
                    vertices,
                    marker,
                    front: OUTSIDE,
                    back: inside,
                });
            }
            (first..template.triangles.len() as u32).collect()
        };
        let low = add(1, 0, false, 0);
        let high = add(1, na, true, 0);
        let floor = add(2, 0, false, 1);
        add(2, nz, true, 2);
        add(0, nr, true, 3);
        if self.bore > 0.0 {
            add(0, 0, false, 4);
        }
        let middle = nr.div_ceil(2);
        if middle > 0 && middle < nr {
            for (vertices, _) in self.face(0, middle) {
                template.triangles.push(Triangle {
                    vertices,
                    marker: 5,
                    front: OUTER,
                    back: INNER,
                });
            }
        }
        let on = |triangles: &[u32]| {
            let all = &template.triangles;
            let mut on: Vec<u32> = triangles
                .iter()
                .flat_map(|&t| all[t as usize].vertices)
                .collect();
            on.sort_unstable();
            on.dedup();
            on
        };
        let mut gluings = Vec::new();
        let mut mirror = |name: &str, reflection: Isometry, triangles: Vec<u32>| {
            gluings.push(Gluing::mirror(
                name,
                0,
                reflection,
                on(&triangles),
                triangles,
            ));
        };
        if self.mirror {
            mirror("wall-a", Isometry::reflection(0, self.order), low.clone());
            mirror("wall-b", Isometry::reflection(1, self.order), high.clone());
        }
        if self.flip {
            mirror("floor", Isometry::FLIP, floor);
        }
        if !self.mirror {
            gluings.push(Gluing::seam(
                "seam",
                0,
                Isometry::rotation(1, self.order),
                self.seam_pairs().into_iter().map(|(a, b)| [a, b]),
                low.into_iter().zip(high).map(|(a, b)| [a, b]),
            ));
        }
        template.gluings = gluings;
        if self.bore == 0.0 {
            template.axis = (0..=nz).collect();
        }
        template
    }
}
